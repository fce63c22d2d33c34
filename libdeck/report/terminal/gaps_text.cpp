// Verdict and tables of `deck gaps`.
#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <iterator>

#include "base/shared/escape.hpp"
#include "base/shared/length_text.hpp"
#include "deck/report/gaps.hpp"
#include "model/shared/item_spans.hpp"
#include "report/gaps_names.hpp"
#include "report/shared/gate.hpp"
#include "report/shared/text_table.hpp"
#include "report/terminal/ties_text.hpp"
#include "report/terminal/words.hpp"

namespace deck {
namespace {

const PenetrationRow& row_of(const Scene& scene, const NamedPenetration& p) {
  return scene.contacts[p.contact].penetrations[p.row];
}

/// Why a contact without penetrations is no clean one, in words; empty: it is.
std::string obstacle(const Contact& c) {
  switch (obstacle_of(c)) {
    case Obstacle::empty_main:
      return "main side is empty";
    case Obstacle::empty_secondary:
      return "secondary side is empty";
    case Obstacle::no_gap:
      return "there is no gap";
    case Obstacle::no_area:
      return fmt::format("{} without area", count(static_cast<std::size_t>(c.degenerate_segments),
                                                  "segment", "segments"));
    case Obstacle::no_element:
      return "segments or edges without element";
    case Obstacle::no_stiffness:
      return "main side has no stiffness";
    case Obstacle::none:
      break;
  }
  return {};
}

/// What a contact that ties does.
std::string tied_words(const Contact& c, const ContactTotals& t) {
  if (t.untied == 0) return count(t.tied.pairs, "pair tied", "pairs tied");
  return fmt::format("{} of {} not tied", t.untied, count(c.secondary.size(), "node", "nodes"));
}

/// What the solver does about the penetrations of contacts, in a few words; first what stops it.
std::string action_words(const std::vector<const Contact*>& contacts) {
  std::size_t by_action[penetration_actions] = {}, all = 0;
  std::string why, left_out;
  for (const Contact* c : contacts) {
    if (!c->evaluated) {
      if (contacts.size() == 1) return "not evaluated";
      left_out += fmt::format("{}{} not evaluated", left_out.empty() ? "" : ", ",
                              c->role == ContactRole::primary ? "nodes" : to_string(c->role));
      continue;
    }
    if (why.empty()) why = obstacle(*c);
    all += c->penetrations.size();
    for (const PenetrationRow& row : c->penetrations)
      ++by_action[static_cast<std::size_t>(row.action)];
  }
  if (all == 0) return !left_out.empty() ? left_out : why.empty() ? "-" : why;
  std::string text;
  const auto add = [&](bool stops) {
    for (std::size_t a = 0; a < std::size(by_action); ++a) {
      const auto action = static_cast<PenetrationAction>(a);
      if (by_action[a] == 0 || stops_solver(action) != stops) continue;
      const char* const words = action_words(action, by_action[a]);
      if (!text.empty()) text += ", ";
      text += by_action[a] == all ? words : fmt::format("{} {}", by_action[a], words);
    }
  };
  add(true);
  add(false);
  return text + (left_out.empty() ? "" : "; " + left_out);
}

std::string segment_text(const NamedPenetration& p) {
  std::string text;
  for (const std::int64_t n : p.main)
    if (n != 0) text += fmt::format("{}{}", text.empty() ? "" : " ", n);
  return text;
}

std::string secondary_text(const NamedPenetration& p) {
  return p.secondary[1] == 0 ? fmt::format("{}", p.secondary[0])
                             : fmt::format("{}-{}", p.secondary[0], p.secondary[1]);
}

/// Totals of several contacts of one interface: a node that is in two of them counts in both.
ContactTotals sum_of(const std::vector<ContactTotals>& all) {
  ContactTotals sum;
  for (const ContactTotals& t : all) {
    sum.count.pairs += t.count.pairs;
    sum.count.nodes += t.count.nodes;
    sum.count.edges += t.count.edges;
    sum.tied.pairs += t.tied.pairs;
    sum.untied += t.untied;
    sum.solver_errors += t.solver_errors;
    sum.max_depth = std::max(sum.max_depth, t.max_depth);
    sum.max_ratio = std::max(sum.max_ratio, t.max_ratio);
  }
  return sum;
}

/// Of a gap; where there is none there is no share.
std::string share_text(double ratio) {
  return ratio > 0 ? fmt::format("{:.0f} %", 100 * ratio) : "-";
}

/// One row per interface; those without penetrations in one line. With `verbose` all of them, every
/// contact of a TYPE19 in a row of its own below, and what their sides and gaps are.
class InterfaceTable {
 public:
  InterfaceTable(const Scene& scene, const SceneView& view, const GapsTextOptions& options)
      : scene_(scene),
        view_(view),
        options_(options),
        table_(options.verbose
                   ? make_table({">id", "type", "title", ">Igap", ">Gapmin", "Gapmin from",
                                 ">nodes", ">segments", ">in reach", ">pairs", ">nodes in",
                                 ">edges in", ">deepest", ">of gap", "action"})
                   : make_table({">id", "type", "title", ">Gapmin", ">pairs", ">nodes", ">edges",
                                 ">deepest", ">of gap", "action"})) {}

  std::string run() {
    std::vector<std::int64_t> clean;
    for (const auto& list :
         by_interface(scene_.contacts, [](const Contact& c) { return c.inter; })) {
      std::vector<const Contact*> contacts;
      std::vector<ContactTotals> totals;
      bool open = false;
      for (const std::size_t i : list) {
        contacts.push_back(&scene_.contacts[i]);
        totals.push_back(view_.contacts[i]);
        open = open || !scene_.contacts[i].evaluated || !obstacle(scene_.contacts[i]).empty();
      }
      const ContactTotals sum = sum_of(totals);
      if (!options_.verbose && !open && sum.count.pairs + sum.tied.pairs + sum.untied == 0) {
        clean.push_back(contacts.front()->inter->id);
        continue;
      }
      row(contacts, sum, false);
      if (options_.verbose && contacts.size() > 1)
        for (std::size_t k = 0; k < contacts.size(); ++k) row({contacts[k]}, totals[k], true);
    }
    std::string out;
    if (table_.size() > 0) out = table_.fitted(options_.width, options_.color, 2);
    return out + folded_ids(clean, "clean interface", "clean interfaces");
  }

 private:
  void row(const std::vector<const Contact*>& contacts, const ContactTotals& t, bool part) {
    const Contact& c = *contacts.front();
    std::vector<TextTable::Cell> cells;
    const auto add = [&](std::string text) { cells.emplace_back(std::move(text)); };
    const auto number = [](std::uint64_t n) { return fmt::format("{}", n); };
    // Where nothing was evaluated no figure is known.
    const bool known = std::any_of(contacts.begin(), contacts.end(),
                                   [](const Contact* x) { return x->evaluated; });
    add(fmt::format("{}", c.inter->id));
    add(part ? kind_name(c) : fmt::format("TYPE{}", c.inter->type));
    add(part ? "" : c.inter->title);
    if (options_.verbose) add(fmt::format("{}", c.igap));
    add(is_modern(c.type) ? "-" : length_text(c.gapmin, 6, largest_));  // they have none
    if (options_.verbose) {
      const bool one = contacts.size() == 1, edges = c.kind == ContactKind::edge_edge;
      std::uint64_t reach = 0;
      for (const Contact* x : contacts) reach += x->candidates;
      add(is_modern(c.type) ? "-" : to_string(c.gapmin_origin));
      add(one ? number(edges ? c.secondary_edges.size() : c.secondary.size()) : "");
      add(one ? number(edges ? c.main_edges.size() : c.main.size()) : "");
      add(known ? number(reach) : "-");
      add(known ? number(t.count.pairs) : "-");
    } else {
      add(known ? number(t.count.pairs) : "-");
    }
    const auto has = [&](ContactKind kind) {
      return std::any_of(contacts.begin(), contacts.end(),
                         [&](const Contact* x) { return x->kind == kind && x->evaluated; });
    };
    add(has(ContactKind::node_segment) ? number(t.count.nodes) : "-");
    add(has(ContactKind::edge_edge) ? number(t.count.edges) : "-");
    add(t.count.pairs ? length_text(t.max_depth, 6, largest_) : "-");
    add(share_text(t.max_ratio));
    const bool tied = c.ties() && known && obstacle(c).empty() && t.solver_errors == 0;
    cells.emplace_back(tied ? tied_words(c, t) : action_words(contacts),
                       t.solver_errors > 0            ? Tone::red
                       : t.count.pairs + t.untied > 0 ? Tone::yellow
                                                      : Tone::plain);
    table_.row(std::move(cells));
  }

  const Scene& scene_;
  const SceneView& view_;
  const GapsTextOptions& options_;
  const double largest_ = largest_bounded_gap(*scene_.model);
  TextTable table_;
};

std::string part_name(const Model& model, std::int64_t id) {
  const auto it = model.part_of_id.find(id);
  if (it == model.part_of_id.end()) return id == 0 ? "(no part)" : fmt::format("{}", id);
  std::string title = model.parts[it->second].title;
  while (!title.empty() && title.back() == ' ') title.pop_back();
  return title.empty() ? fmt::format("{}", id) : fmt::format("{} {}", id, title);
}

std::string part_pairs_text(const Scene& scene, const SceneView& view,
                            const GapsTextOptions& options) {
  const Model& model = *scene.model;
  TextTable pairs = make_table(
      {"secondary", "main", ">pairs", ">nodes", ">edges", ">deepest", ">mean", ">p95", ">of gap"});
  const double largest = largest_bounded_gap(model);
  const std::size_t shown = std::min(options.part_pairs, view.part_pairs.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const PartPair& p = view.part_pairs[i];
    pairs.row({part_name(model, p.secondary), part_name(model, p.main),
               fmt::format("{}", p.count.pairs), fmt::format("{}", p.count.nodes),
               fmt::format("{}", p.count.edges), length_text(p.max_depth, 6, largest),
               length_text(p.mean_depth, 4, largest), length_text(p.p95_depth, 4, largest),
               share_text(p.max_ratio)});
  }
  std::string out = pairs.fitted(options.width, options.color, 2, 2);
  if (shown < view.part_pairs.size())
    out += fmt::format("  … and {} more\n", view.part_pairs.size() - shown);
  return out;
}

std::string worst_text(const Deck& deck, const Scene& scene, const SceneView& view,
                       const GapsTextOptions& options) {
  // Where a line has no room for all of it, elements and position give way to the rest.
  constexpr std::size_t room = 150;
  const bool all = options.verbose || options.width == 0 || options.width >= room;
  TextTable worst =
      all ? make_table({">interface", "node/edge", ">depth", ">gap", ">distance", "segment/edge",
                        "elements", "action", "position", "=defined at"})
          : make_table({">interface", "node/edge", ">depth", ">gap", ">distance", "segment/edge",
                        "action", "=defined at"});
  const std::size_t rows = std::min(options.worst, view.deepest_per_node.size());
  const double largest = largest_bounded_gap(*scene.model);
  std::vector<NodeIndex> nodes;
  for (std::size_t i = 0; i < rows; ++i)
    nodes.push_back(first_node(scene, view.penetrations[view.deepest_per_node[i]]));
  const std::vector<Span> spans = detail::node_spans(*scene.model, nodes);
  for (std::size_t i = 0; i < rows; ++i) {
    const NamedPenetration& p = view.penetrations[view.deepest_per_node[i]];
    const Contact& c = scene.contacts[p.contact];
    const PenetrationRow& row = row_of(scene, p);
    const bool stops = stops_solver(row.action);
    std::string action = action_words(row.action, 1);
    if (row.action == PenetrationAction::gap_reduced && !is_unbounded(row.gap0))
      action += fmt::format(" to {:.4g}", row.gap0);
    if (!row.in_contact) action += " (round-off)";
    const Tone tone = stops                                   ? Tone::red
                      : row.action == PenetrationAction::none ? Tone::plain
                                                              : Tone::yellow;
    std::vector<TextTable::Cell> cells{
        fmt::format("{}", c.inter->id),      secondary_text(p),
        length_text(row.depth, 6, largest),  length_text(row.gap, 6, largest),
        fmt::format("{:.6g}", row.distance), segment_text(p)};
    if (all) cells.emplace_back(fmt::format("{} / {}", p.secondary_element.id, p.main_element.id));
    cells.emplace_back(action, tone);
    if (all) cells.emplace_back(fmt::format("({:.5g}, {:.5g}, {:.5g})", p.at[0], p.at[1], p.at[2]));
    cells.emplace_back(deck.sources.where(spans[i]));
    worst.row(std::move(cells));
  }
  std::string out = rows == 0 ? std::string() : worst.fitted(options.width, options.color, 2, 2);
  if (rows < view.deepest_per_node.size())
    out += fmt::format("  … and {} more (--worst N, --csv, --json)\n",
                       view.deepest_per_node.size() - rows);
  return out;
}

}  // namespace

std::string gaps_text(const Deck& deck, const Scene& scene, const SceneView& view,
                      const GapsTextOptions& options) {
  std::string out;
  if (!options.name.empty())
    out += toned(terminal_text(options.name), Tone::cyan, options.color) + "\n";
  const auto heading = [&](const char* title) {
    return "\n" + toned(title, Tone::bold, options.color) + "\n";
  };
  if (!scene.contacts.empty()) {
    out += (out.empty() ? heading("Interfaces").substr(1) : heading("Interfaces")) +
           InterfaceTable(scene, view, options).run();
    if (!view.penetrations.empty()) {
      out += heading("Part pairs") + part_pairs_text(scene, view, options);
      out += heading("Deepest, one row per node or edge") + worst_text(deck, scene, view, options);
    }
    if (options.crossings != nullptr) out += crossings_text(scene, *options.crossings, options);
    if (const std::string text =
            decisions_text(scene, 5, options.verbose, options.color, options.width);
        !text.empty())
      out += "\n" + text;
    out += "\n";
  }
  if (!scene.ties.empty())
    out += heading("Ties").substr(1) + detail::tie_table(scene, options) + "\n";
  if (const std::string untied = detail::untied_text(deck, scene, options); !untied.empty())
    out += heading("Nodes that are not tied").substr(1) + untied + "\n";
  out += verdict_text(verdict_of(deck, scene, view), options.color);
  if (options.gate != nullptr) out += gate_text(*options.gate);
  return out;
}

std::string gaps_csv(const Deck& deck, const Scene& scene, const SceneView& view,
                     const TextDrain& drain) {
  std::string out =
      "interface,type,role,kind,secondary_1,secondary_2,main_1,main_2,main_3,main_4,depth,gap,"
      "distance,ratio,normal_x,normal_y,normal_z,on_surface,in_contact,action,gap0,p0,x,y,z,"
      "secondary_element,secondary_part,main_element,main_part,file,line\r\n";
  const std::vector<Span> spans =
      detail::node_spans(*scene.model, first_nodes(scene, view.penetrations));
  for (std::size_t row = 0; row < view.penetrations.size(); ++row) {
    const NamedPenetration& p = view.penetrations[row];
    const Contact& c = scene.contacts[p.contact];
    const PenetrationRow& r = row_of(scene, p);
    const Span& span = spans[row];
    const auto length = [](double v) { return is_unbounded(v) ? "" : fmt::format("{}", v); };
    const auto id = [](std::int64_t v) { return v == 0 ? std::string() : fmt::format("{}", v); };
    fmt::format_to(std::back_inserter(out), "{},{},{},{},{},{},{},{},{},{},{},{},{},{},",
                   c.inter->id, c.inter->type, to_string(c.role), to_string(c.kind), p.secondary[0],
                   id(p.secondary[1]), p.main[0], p.main[1], id(p.main[2]), id(p.main[3]),
                   length(r.depth), length(r.gap), length(r.distance),
                   r.gap > 0 ? r.depth / r.gap : 0.0);
    fmt::format_to(
        std::back_inserter(out), "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n",
        r.normal[0], r.normal[1], r.normal[2], r.on_surface ? 1 : 0, r.in_contact ? 1 : 0,
        to_string(r.action), r.has_gap0 ? length(r.gap0) : "", r.has_gap0 ? length(r.p0) : "",
        p.at[0], p.at[1], p.at[2], id(p.secondary_element.id), id(p.secondary_element.part),
        id(p.main_element.id), id(p.main_element.part),
        span.valid() ? csv_text(terminal_text(deck.sources[span.file].path())) : std::string(),
        span.valid() ? fmt::format("{}", deck.sources.position(span).line) : "");
    drain_text(drain, out);
  }
  return out;
}

}  // namespace deck
