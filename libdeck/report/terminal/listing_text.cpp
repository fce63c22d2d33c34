// A listing of the Starter explained for people: messages, contacts, time steps.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/shared/columns.hpp"
#include "base/shared/count.hpp"
#include "base/shared/escape.hpp"
#include "report/shared/listing.hpp"
#include "report/shared/parts.hpp"
#include "report/shared/text_table.hpp"
#include "report/terminal/words.hpp"

namespace deck {
namespace listing_for_people {
namespace {

Tone tone_of(Severity s) {
  return s == Severity::error ? Tone::red : s == Severity::warning ? Tone::yellow : Tone::cyan;
}

template <class List>
std::string first_of(const List& list, std::size_t most) {
  std::string out;
  for (std::size_t i = 0; i < std::min(most, list.size()); ++i)
    out += (i == 0 ? "" : ", ") + std::to_string(list[i]);
  return list.size() > most ? fmt::format("{} and {} more", out, list.size() - most) : out;
}

std::string figure(double v) { return fmt::format("{:.6g}", v); }

class Writer {
 public:
  Writer(const Listing& listing, const ListingReport& report, const LoadedDeck* loaded,
         const ListingTextOptions& options)
      : listing_(listing),
        report_(report),
        loaded_(loaded),
        options_(options),
        width_(options.width == 0 ? 1000 : options.width) {}

  std::string text() {
    head();
    for (const MessageGroup& group : report_.messages) message(group);
    if (loaded_ != nullptr) {
      contacts();
      steps();
      not_listed();
    }
    return std::move(out_);
  }

 private:
  void paragraph(const std::string& text, std::size_t indent) {
    out_ += wrapped(terminal_text(text), indent, width_);
  }

  void head() {
    std::string line = listing_.path;
    if (loaded_ != nullptr) line += " beside " + loaded_->path();
    paragraph(line, 0);
    const bool none_found =
        std::all_of(report_.contacts.begin(), report_.contacts.end(),
                    [](const ComparedContact& c) { return c.listed == nullptr; });
    if (loaded_ != nullptr && report_.unnamed_contacts > 0 && none_found)
      paragraph("No contact of this listing is in the deck: the two do not belong together.", 0);
    std::uint64_t errors = 0, warnings = 0;
    for (const MessageGroup& g : report_.messages)
      (g.severity == Severity::error ? errors : warnings) +=
          g.severity == Severity::info ? 0 : g.times;
    const std::string found =
        count(errors, "error", "errors") + " and " + count(warnings, "warning", "warnings");
    if (!listing_.errors)
      paragraph("The listing has no end: the Starter was stopped. Up to there: " + found + ".", 0);
    else
      paragraph((*listing_.errors > 0 ? "The Starter stops: " : "The Starter finished: ") + found +
                    ". The Starter works in two passes and prints most messages in both.",
                0);
  }

  // ---- messages

  void message(const MessageGroup& group) {
    out_ += "\n" + toned(fmt::format("{} {}", to_string(group.severity), group.number),
                         tone_of(group.severity), options_.color);
    out_ += fmt::format(": {} ({})\n",
                        group.title.empty() ? "no page tells what it means" : group.title,
                        count(group.times, "time", "times"));
    if (!group.means.empty()) paragraph(group.means, 2);
    if (!group.action.empty()) paragraph("What to do: " + group.action, 2);
    const std::size_t most = options_.verbose ? group.places.size() : 10;
    for (std::size_t p = 0; p < std::min(most, group.places.size()); ++p)
      place(group, group.places[p]);
    if (group.places.size() > most)
      paragraph(fmt::format("{} more places: -v", group.places.size() - most), 2);
    for (const std::size_t f : some(group.findings)) finding(f, 2);
    if (loaded_ != nullptr && silent(group))
      paragraph("deck lint has no finding for this message.", 2);
  }

  static bool silent(const MessageGroup& group) {
    return group.findings.empty() &&
           std::all_of(group.places.begin(), group.places.end(),
                       [](const MessagePlace& p) { return p.findings.empty(); });
  }

  std::vector<std::size_t> some(const std::vector<std::size_t>& findings) const {
    const std::size_t most = options_.verbose ? findings.size() : 3;
    return {findings.begin(),
            findings.begin() + static_cast<std::ptrdiff_t>(std::min(most, findings.size()))};
  }

  void place(const MessageGroup& group, const MessagePlace& place) {
    std::string where;
    if (place.span.valid()) where = loaded_->deck().sources.where(place.span);
    if (!place.name.empty()) paragraph(place.name + (where.empty() ? "" : ", " + where), 2);
    std::string detail =
        fmt::format("{} {} of the listing", place.lines.size() == 1 ? "line" : "lines",
                    first_of(place.lines, 4));
    if (!place.counted.empty())
      detail += "; " + std::string(place.counted.size() == 1 ? "number" : "numbers") +
                " in the message: " + first_of(place.counted, 8);
    if (!place.nodes.empty() && group.number != 1164)
      detail += fmt::format("; {} {}", place.nodes.size() == 1 ? "node" : "nodes",
                            first_of(place.nodes, options_.verbose ? place.nodes.size() : 8));
    paragraph(detail, 4);
    for (const std::size_t f : some(place.findings)) finding(f, 4);
    if (is_tie(group, place))
      paragraph("These pairs are tied at the start. They are not penetrations.", 4);
  }

  /// True for a number of pairs that belong to a contact that ties.
  bool is_tie(const MessageGroup& group, const MessagePlace& place) const {
    if (loaded_ == nullptr || (group.number != 343 && group.number != 1164)) return false;
    const auto& contacts = loaded_->scene().contacts;
    return std::any_of(contacts.begin(), contacts.end(),
                       [&](const Contact& c) { return c.inter->id == place.id && c.ties(); });
  }

  void finding(std::size_t f, std::size_t indent) {
    const Diagnostic& d = report_.findings[f];
    std::string where;
    if (d.span.valid()) where = loaded_->deck().sources.where(d.span) + ": ";
    paragraph(
        fmt::format("deck: {}{} {}: {}", where, finding_name(d), to_string(d.severity), d.message),
        indent);
  }

  // ---- contacts

  void contacts() {
    const Scene& scene = loaded_->scene();
    TextTable table = make_table({">interface", "type", ">listing", ">deck", "pairs", ">line"});
    for (const ComparedContact& c : report_.contacts) {
      if (c.pairs.empty() && c.listed_count == 0 && c.agrees()) continue;
      const Contact& contact = scene.contacts[c.contact];
      table.row({std::to_string(contact.inter->id),
                 kind_name(contact),
                 c.listed == nullptr ? "absent" : std::to_string(c.listed_count),
                 {std::to_string(c.pairs.size()), c.agrees() ? Tone::plain : Tone::yellow},
                 pairs_text(c),
                 c.listed == nullptr
                     ? ""
                     : std::to_string(c.listed->total_line != 0 ? c.listed->total_line
                                                                : c.listed->line)});
    }
    out_ += "\nInitial penetrations: pairs in the listing and of deck gaps\n";
    if (table.size() == 0)
      out_ += report_.unnamed_contacts == 0 ? "  none in either\n" : "  none in the deck\n";
    else
      out_ += table.fitted(options_.width, options_.color, 2);
    if (report_.unnamed_contacts > 0)
      paragraph(count(report_.unnamed_contacts, "contact of the listing has",
                      "contacts of the listing have") +
                    " no counterpart in the deck",
                2);
    if (listing_.printout < 1)
      paragraph("The listing shows numbers only; with /IOFLAG 5 it shows pairs and depths.", 2);
    rows();
  }

  static std::string pairs_text(const ComparedContact& c) {
    if (c.listed == nullptr) return "";
    if (!c.by_pair) return c.agrees() ? "same number" : "another number";
    std::uint64_t same = 0;
    for (const ComparedPair& p : c.pairs) same += p.listed ? 1 : 0;
    std::string out = fmt::format("{} the same", same);
    if (same < c.pairs.size()) out += fmt::format(", {} of deck only", c.pairs.size() - same);
    if (!c.only_listed.empty()) out += fmt::format(", {} listed only", c.only_listed.size());
    const bool depths = std::any_of(c.pairs.begin(), c.pairs.end(), [](const ComparedPair& p) {
      return p.listed_depth.has_value();
    });
    if (depths) out += fmt::format("; depths within {:.2g} of the gap", c.largest_difference);
    return out;
  }

  /// The rows behind the numbers: of each contact the deepest, and what only one side has.
  void rows() {
    const Scene& scene = loaded_->scene();
    TextTable table = make_table({">interface", ">secondary", "main", "parts", ">depth", ">gap",
                                  "listed", "the solver does"});
    for (const ComparedContact& c : report_.contacts) {
      const Contact& contact = scene.contacts[c.contact];
      std::size_t shown = 0;
      for (const ComparedPair& p : c.pairs) {
        const bool odd = c.by_pair && !p.listed;
        if (shown >= options_.worst && !(odd && options_.verbose)) continue;
        ++shown;
        const PenetrationRow& row = contact.penetrations[p.pair.row];
        table.row({std::to_string(contact.inter->id), ids(p.pair.secondary), ids(p.pair.main),
                   fmt::format("{} on {}", p.pair.secondary_element.part, p.pair.main_element.part),
                   figure(row.depth), figure(row.gap), listed_text(c, p),
                   contact.ties() ? "tied" : action_words(row.action, 1)});
      }
      for (std::size_t i = 0;
           i < std::min<std::size_t>(c.only_listed.size(),
                                     options_.verbose ? c.only_listed.size() : options_.worst);
           ++i) {
        const ListedPair& p = c.only_listed[i];
        table.row({std::to_string(contact.inter->id), ids(p.secondary), ids(p.main), "",
                   p.depth ? figure(*p.depth) : "", "", "only there", ""});
      }
    }
    if (table.size() == 0) return;
    out_ += fmt::format("\nDeepest pairs of each contact (all: deck gaps {} --csv -)\n",
                        terminal_text(loaded_->path()));
    out_ += table.fitted(options_.width, options_.color, 2, 3);
  }

  template <std::size_t N>
  static std::string ids(const std::array<std::int64_t, N>& nodes) {
    std::string out;
    for (std::size_t i = 0; i < N; ++i)
      if (nodes[i] != 0 && (i == 0 || nodes[i] != nodes[i - 1]))
        out += (out.empty() ? "" : " ") + std::to_string(nodes[i]);
    return out;
  }

  static std::string listed_text(const ComparedContact& c, const ComparedPair& p) {
    if (!c.by_pair) return "not shown";
    if (!p.listed) return "no";
    return p.listed_depth ? figure(*p.listed_depth) : "yes";
  }

  // ---- time steps

  void steps() {
    if (report_.steps.empty()) return;
    TextTable table =
        make_table({"of", ">listed", ">equal", ">different", ">not computed", ">smallest", ">id"});
    for (const ComparedSteps& s : report_.steps)
      table.row(
          {s.kind ? std::string(detail::kind_name(*s.kind)) : "node",
           std::to_string(s.listed),
           std::to_string(s.equal),
           {std::to_string(s.different.size()), s.different.empty() ? Tone::plain : Tone::yellow},
           std::to_string(s.not_computed),
           s.smallest >= 1e29 ? "none" : figure(s.smallest),
           s.smallest >= 1e29 ? "" : std::to_string(s.smallest_id)});
    out_ += fmt::format("\nTime steps in the listing and of deck parts (equal: within {:g})\n",
                        step_tolerance);
    out_ += table.fitted(options_.width, options_.color, 2);
    for (const ComparedSteps& s : report_.steps)
      for (std::size_t i = 0;
           i < std::min<std::size_t>(s.different.size(),
                                     options_.verbose ? s.different.size() : options_.worst);
           ++i)
        paragraph(fmt::format("{} {}: {} in the listing, {}",
                              s.kind ? std::string(detail::kind_name(*s.kind)) : "node",
                              s.different[i].id, figure(s.different[i].listed),
                              std::isnan(s.different[i].computed)
                                  ? "absent in the deck"
                                  : figure(s.different[i].computed) + " in deck"),
                  2);
  }

  void not_listed() {
    if (report_.not_listed.empty()) return;
    out_ += "\nExpected by deck, and not in the listing\n";
    const std::size_t most = options_.verbose ? report_.not_listed.size() : 10;
    for (std::size_t i = 0; i < std::min(most, report_.not_listed.size()); ++i) {
      const Diagnostic& d = report_.findings[report_.not_listed[i]];
      std::string where;
      if (d.span.valid()) where = loaded_->deck().sources.where(d.span) + ": ";
      paragraph(fmt::format("{} {}: {}{} {}", to_string(d.reference->severity), d.reference->number,
                            where, finding_name(d), d.message),
                2);
    }
    if (report_.not_listed.size() > most)
      paragraph(fmt::format("{} more: -v", report_.not_listed.size() - most), 2);
  }

  const Listing& listing_;
  const ListingReport& report_;
  const LoadedDeck* loaded_;
  const ListingTextOptions& options_;
  std::size_t width_;
  std::string out_;
};

}  // namespace
}  // namespace listing_for_people

std::string listing_text(const Listing& listing, const ListingReport& report,
                         const LoadedDeck* loaded, const ListingTextOptions& options) {
  return listing_for_people::Writer(listing, report, loaded, options).text();
}

}  // namespace deck
