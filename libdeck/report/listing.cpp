// A listing of the Starter compared with its deck as JSON and as text: messages, contacts, time
// steps.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/shared/shown_text.hpp"
#include "report/shared/inspection.hpp"
#include "report/shared/parts.hpp"
#include "report/shared_records.hpp"
#include "report/terminal/words.hpp"

namespace deck {

namespace {

using Ids = std::vector<std::int64_t>;

/// Ids without trailing zeros.
template <std::size_t N>
Ids ids_of(const std::array<std::int64_t, N>& list) {
  Ids out;
  std::copy_if(list.begin(), list.end(), std::back_inserter(out),
               [](std::int64_t id) { return id != 0; });
  return out;
}

std::optional<double> finite_step(double dt) { return known(dt < 1e29, dt); }

}  // namespace

std::string_view listed_kind(const ComparedSteps& steps) {
  return steps.kind ? detail::kind_name(*steps.kind) : "node";
}

LINE_RECORD(ListedPair, "listed_pair", "A pair that only the listing has.",
            COLUMN("secondary", "", ids_of(r.secondary)), COLUMN("main", "", ids_of(r.main)),
            COLUMN("listed_penetration", "", r.depth));

LINE_RECORD(StepDifference, "step_difference", "", COLUMN("id", "", r.id),
            COLUMN("listed", "", finite_step(r.listed)),
            COLUMN("computed", "", finite_step(r.computed)));

RECORD(ComparedSteps, "steps", "", COLUMN("of", "Kind of element, or node", listed_kind(r)),
       COLUMN("listed", "", r.listed), COLUMN("equal", "Within 1e-6", r.equal),
       COLUMN("not_computed", "", r.not_computed),
       COLUMN("largest_difference", "Relative, of those that are equal", r.largest_difference),
       COLUMN("smallest", "null: no element limits the step", finite_step(r.smallest)),
       COLUMN("smallest_id", "", r.smallest_id), COLUMN("different", "", r.different));

namespace {

struct ListingDocument {
  const Listing& listing;
  const ListingReport& report;
  const LoadedDeck* loaded = nullptr;

  std::optional<SourcePlace> place(const Span& span) const {
    return loaded == nullptr ? std::nullopt : place_of(loaded->deck(), span);
  }
};

struct FindingOfListing {
  const ListingDocument& document;
  const std::size_t* index;  ///< in ListingReport::findings
  const Finding& finding() const { return document.report.findings[*index]; }
};
LINE_RECORD(FindingOfListing, "finding", "A finding of deck lint.",
            COLUMN("rule", "", id_text(r.finding().rule)),
            COLUMN("severity", "", r.finding().severity),
            COLUMN("message", "", r.finding().message),
            COLUMN("reference", "", *r.finding().reference),
            COLUMN("place", "", r.document.place(r.finding().span)));

struct PlaceRow {
  const ListingDocument& document;
  const MessagePlace* at;
};
RECORD(PlaceRow, "message_place", "",
       COLUMN("name", "What the message is about; may be empty", r.at->name),
       COLUMN("id", "0: it names nothing", r.at->id), COLUMN("times", "", r.at->times),
       COLUMN("says", "Numbers that its messages show, such as of penetrations, each once",
              r.at->counted),
       COLUMN("place", "", r.document.place(r.at->span)), COLUMN("nodes", "", r.at->nodes),
       COLUMN("lines", "Lines of the listing", r.at->lines),
       COLUMN("findings", "", rows<FindingOfListing>(r.at->findings, r.document)));

struct MessageRow {
  const ListingDocument& document;
  const MessageGroup* group;
};
RECORD(MessageRow, "message", "", COLUMN("message", "", r.group->number),
       COLUMN("severity", "", r.group->severity), COLUMN("times", "", r.group->times),
       COLUMN("title", "", r.group->title), COLUMN("means", "", r.group->means),
       COLUMN("do", "", r.group->action),
       COLUMN("places", "", rows<PlaceRow>(r.group->places, r.document)),
       COLUMN("findings", "With the same message, about something else",
              rows<FindingOfListing>(r.group->findings, r.document)));

struct ContactOfListing {
  const ListingDocument& document;
  const ComparedContact* c;
  const Contact& contact() const { return document.loaded->scene().contacts[c->contact]; }
  std::vector<std::size_t> lines() const {
    if (c->listed == nullptr) return {};
    std::vector<std::size_t> out{c->listed->line};
    if (c->listed->total_line != 0) out.push_back(c->listed->total_line);
    return out;
  }
};

struct PairOfListing {
  const ContactOfListing& of;
  const ComparedPair* pair;
  const PenetrationRow& row() const {
    return of.document.loaded->scene().contacts[pair->pair.contact].penetrations[pair->pair.row];
  }
};
LINE_RECORD(PairOfListing, "pair", "",
            COLUMN("secondary", "A node, or the two of an edge", ids_of(r.pair->pair.secondary)),
            COLUMN("main", "", ids_of(r.pair->pair.main)),
            COLUMN("parts", "Of the secondary and of the main side; 0: none",
                   std::array{r.pair->pair.secondary_element.part, r.pair->pair.main_element.part}),
            COLUMN("penetration", "", r.row().depth), COLUMN("gap", "", r.row().gap),
            COLUMN("action", "", r.row().action),
            COLUMN("listed", "null: the listing does not show pairs",
                   known(r.of.c->by_pair, r.pair->listed)),
            COLUMN("listed_penetration", "", r.pair->listed_depth));

RECORD(ContactOfListing, "contact", "", COLUMN("interface", "", r.contact().inter->id),
       COLUMN("type", "", r.contact().inter->type), COLUMN("role", "", r.contact().role),
       COLUMN("agrees", "", r.c->agrees()),
       COLUMN("listed", "Penetrations in the listing; null: it does not work on the contact",
              known(r.c->listed != nullptr, r.c->listed_count)),
       COLUMN("computed", "Pairs of deck gaps, ties included as in the listing", r.c->pairs.size()),
       COLUMN("by_pair", "The listing shows the pairs", r.c->by_pair),
       COLUMN("largest_difference", "Of depths, as a share of the gap", r.c->largest_difference),
       COLUMN("lines", "Of the listing: where its work begins, and the message with the number",
              r.lines()),
       COLUMN("pairs", "", rows<PairOfListing>(r.c->pairs, r)),
       COLUMN("listed_only", "", r.c->only_listed));

RECORD(ListingDocument, "document", "",
       LINE_OBJECT("listing", "", COLUMN("path", "", r.listing.path),
                   COLUMN("printout", "/IOFLAG Ipri: pairs from 1 on, depths from 5 on",
                          r.listing.printout),
                   COLUMN("errors", "From its end; null: it has no end", r.listing.errors),
                   COLUMN("warnings", "", r.listing.warnings)),
       COLUMN("deck", "null: none is beside the listing",
              r.loaded == nullptr ? std::nullopt : std::optional(deck_row(*r.loaded))),
       COLUMN("agrees", "Penetrations and time steps are those of deck", r.report.agrees()),
       COLUMN("messages", "", rows<MessageRow>(r.report.messages, r)),
       COLUMN("contacts", "", rows<ContactOfListing>(r.report.contacts, r)),
       COLUMN("contacts_of_listing_only", "Contacts that the deck does not have",
              r.report.unnamed_contacts),
       COLUMN("steps", "", r.report.steps),
       COLUMN("not_listed", "Findings about a message of the solver that the listing does not have",
              rows<FindingOfListing>(r.report.not_listed, r)));

constexpr DocumentHead listing_head{
    "deck/explain", 1,
    "Written by deck explain NAME_0000.out --json: a listing of the Starter beside its deck.",
    false};

}  // namespace

DocumentSchema explain_schema() { return document_schema<ListingDocument>(listing_head); }

std::string listing_json(const Listing& listing, const ListingReport& report,
                         const LoadedDeck* loaded) {
  return write_document(listing_head, ListingDocument{listing, report, loaded});
}

// ---- for people --------------------------------------------------------------------------------

namespace listing_for_people {
namespace {

Tone tone_of(Severity s) {
  return s == Severity::error ? Tone::red : s == Severity::warning ? Tone::yellow : Tone::cyan;
}

std::string figure(double v) { return fmt::format("{:.6g}", v); }

class ListingWriter {
 public:
  ListingWriter(const Listing& listing, const ListingReport& report, const LoadedDeck* loaded,
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

  /// First `few` items of a list, or all with -v.
  template <class List>
  std::span<const typename List::value_type> shown(const List& list, std::size_t few) const {
    return std::span(list).first(options_.verbose ? list.size() : std::min(few, list.size()));
  }

  /// Place of a finding in the deck, "car_0000.rad:3:1: "
  std::string where(const Finding& d) const {
    return d.span.valid() ? loaded_->deck().sources.where(d.span) + ": " : std::string();
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
    const auto places = shown(group.places, 10);
    for (const MessagePlace& p : places) place(group, p);
    if (group.places.size() > places.size())
      paragraph(fmt::format("{} more places: -v", group.places.size() - places.size()), 2);
    for (const std::size_t f : shown(group.findings, 3)) finding(f, 2);
    if (loaded_ != nullptr && group.findings.empty() &&
        std::all_of(group.places.begin(), group.places.end(),
                    [](const MessagePlace& p) { return p.findings.empty(); }))
      paragraph("deck lint has no finding for this message.", 2);
  }

  void place(const MessageGroup& group, const MessagePlace& place) {
    std::string name = place.name;
    if (place.span.valid()) name += ", " + loaded_->deck().sources.where(place.span);
    if (!place.name.empty()) paragraph(name, 2);
    const auto plural = [](const auto& list) { return list.size() == 1 ? "" : "s"; };
    std::string detail =
        fmt::format("line{} {} of the listing", plural(place.lines), first_of(place.lines, 4));
    if (!place.counted.empty())
      detail += fmt::format("; number{} in the message: {}", plural(place.counted),
                            first_of(place.counted, 8));
    if (!place.nodes.empty() && group.number != 1164)
      detail += fmt::format("; node{} {}", plural(place.nodes),
                            first_of(place.nodes, options_.verbose ? place.nodes.size() : 8));
    paragraph(detail, 4);
    for (const std::size_t f : shown(place.findings, 3)) finding(f, 4);
    if (is_tie(group, place))
      paragraph("These pairs are tied at the start. They are not penetrations.", 4);
  }

  /// True for numbers of pairs of a tied contact.
  bool is_tie(const MessageGroup& group, const MessagePlace& place) const {
    if (loaded_ == nullptr || (group.number != 343 && group.number != 1164)) return false;
    const auto& contacts = loaded_->scene().contacts;
    return std::any_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
      return c.inter->id == place.id && c.is_tied_contact();
    });
  }

  void finding(std::size_t f, std::size_t indent) {
    const Finding& d = report_.findings[f];
    paragraph(fmt::format("deck: {}{} {}: {}", where(d), finding_name(d), to_string(d.severity),
                          d.message),
              indent);
  }

  // ---- contacts

  void contacts() {
    const Scene& scene = loaded_->scene();
    TextTable table({">interface", "type", ">listing", ">deck", "pairs", ">line"});
    for (const ComparedContact& c : report_.contacts) {
      if (c.pairs.empty() && c.listed_count == 0 && c.agrees()) continue;
      const Contact& contact = scene.contacts[c.contact];
      std::string listed = "absent", line;
      if (c.listed != nullptr) {
        listed = std::to_string(c.listed_count);
        line = std::to_string(c.listed->total_line != 0 ? c.listed->total_line : c.listed->line);
      }
      table.row({contact.inter->id,
                 kind_name(contact),
                 listed,
                 {c.pairs.size(), c.agrees() ? Tone::plain : Tone::yellow},
                 pairs_text(c),
                 line});
    }
    out_ += "\nInitial penetrations: pairs in the listing and of deck gaps\n";
    if (table.size() == 0)
      out_ += report_.unnamed_contacts == 0 ? "  none in either\n" : "  none in the deck\n";
    out_ += table.below_heading(options_);
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

  /// Rows behind the numbers: the deepest per contact, and pairs of one side only.
  void rows() {
    const Scene& scene = loaded_->scene();
    TextTable table({">interface", ">secondary", "main", "parts", ">depth", ">gap", "listed",
                     "the solver does"});
    for (const ComparedContact& c : report_.contacts) {
      const Contact& contact = scene.contacts[c.contact];
      std::size_t rows = 0;
      for (const ComparedPair& p : c.pairs) {
        const bool odd = c.by_pair && !p.listed;
        if (rows >= options_.worst && !(odd && options_.verbose)) continue;
        ++rows;
        const PenetrationRow& row = scene.contacts[p.pair.contact].penetrations[p.pair.row];
        table.row({contact.inter->id, ids(p.pair.secondary), ids(p.pair.main),
                   fmt::format("{} on {}", p.pair.secondary_element.part, p.pair.main_element.part),
                   row.depth, row.gap, listed_text(c, p),
                   contact.is_tied_contact() ? "tied" : action_words(row.action, 1)});
      }
      for (const ListedPair& p : shown(c.only_listed, options_.worst))
        table.row({contact.inter->id, ids(p.secondary), ids(p.main), "",
                   p.depth ? figure(*p.depth) : "", "", "only there", ""});
    }
    if (table.size() == 0) return;
    out_ += fmt::format("\nDeepest pairs of each contact (all: deck gaps {} --csv -)\n",
                        terminal_text(loaded_->path()));
    out_ += table.below_heading(options_, 3);
  }

  template <std::size_t N>
  static std::string ids(const std::array<std::int64_t, N>& nodes) {
    std::string out;
    for (std::size_t i = 0; i < N; ++i)
      if (nodes[i] != 0 && (i == 0 || nodes[i] != nodes[i - 1]))
        append(out, " ", std::to_string(nodes[i]));
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
    TextTable table({"of", ">listed", ">equal", ">different", ">not computed", ">smallest", ">id"});
    for (const ComparedSteps& s : report_.steps) {
      const bool none = s.smallest >= 1e29;
      table.row({listed_kind(s),
                 s.listed,
                 s.equal,
                 {s.different.size(), s.different.empty() ? Tone::plain : Tone::yellow},
                 s.not_computed,
                 none ? "none" : figure(s.smallest),
                 none ? "" : std::to_string(s.smallest_id)});
    }
    out_ += fmt::format("\nTime steps in the listing and of deck parts (equal: within {:g})\n",
                        step_tolerance);
    out_ += table.below_heading(options_);
    for (const ComparedSteps& s : report_.steps)
      for (const StepDifference& d : shown(s.different, options_.worst))
        paragraph(
            fmt::format(
                "{} {}: {} in the listing, {}", listed_kind(s), d.id, figure(d.listed),
                std::isnan(d.computed) ? "absent in the deck" : figure(d.computed) + " in deck"),
            2);
  }

  void not_listed() {
    if (report_.not_listed.empty()) return;
    out_ += "\nExpected by deck, and not in the listing\n";
    const auto found = shown(report_.not_listed, 10);
    for (const std::size_t f : found) {
      const Finding& d = report_.findings[f];
      paragraph(fmt::format("{} {}: {}{} {}", to_string(d.reference->severity), d.reference->number,
                            where(d), finding_name(d), d.message),
                2);
    }
    if (report_.not_listed.size() > found.size())
      paragraph(fmt::format("{} more: -v", report_.not_listed.size() - found.size()), 2);
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
  return listing_for_people::ListingWriter(listing, report, loaded, options).text();
}

}  // namespace deck
