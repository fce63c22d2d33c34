// `deck gaps` as text: verdict and tables of interfaces, part pairs, deepest penetrations, ties,
// crossed elements and decisions; penetrations and ties as CSV.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "base/shared/shown_text.hpp"
#include "base/shared/words.hpp"
#include "contact/shared/node_elements.hpp"
#include "contact/shared/reported.hpp"
#include "deck/report.hpp"
#include "model/shared/families.hpp"
#include "model/shared/item_spans.hpp"
#include "report/shared/gate.hpp"
#include "report/shared/text_table.hpp"
#include "report/shared_records.hpp"
#include "report/terminal/words.hpp"

namespace deck {
namespace {

const PenetrationRow& row_of(const Scene& scene, const NamedPenetrations::Place& p) {
  return scene.contacts[p.contact].penetrations[p.row];
}

}  // namespace

std::string ids_text(const Model& model, std::span<const NodeIndex> nodes, char between) {
  std::string out;
  NodeIndex last = no_index;
  for (const NodeIndex n : nodes) {
    if (n == last) continue;
    last = n;
    if (!out.empty()) out += between;
    out += std::to_string(model.node_id(n));
  }
  return out;
}

PairNodes pair_nodes(const Contact& c, std::uint32_t secondary, std::uint32_t main) {
  if (!c.points.empty()) return {c.secondary_edges[secondary].nodes, c.main[main].nodes};
  if (c.kind == ContactKind::edge_edge)
    return {c.secondary_edges[secondary].nodes, c.main_edges[main].nodes};
  return {std::span(&c.secondary[secondary].node, 1), c.main[main].nodes};
}

NodeIndex first_node(const Scene& scene, const NamedPenetrations::Place& p) {
  const PenetrationRow& row = row_of(scene, p);
  return pair_nodes(scene.contacts[p.contact], row.secondary, row.main).secondary[0];
}

std::vector<NodeIndex> first_nodes(const Scene& scene, const NamedPenetrations& list) {
  std::vector<NodeIndex> out;
  out.reserve(list.size());
  for (const auto& p : list.places) out.push_back(first_node(scene, p));
  return out;
}

ElementName edge_element(const Model& model, const Crossing& x) {
  const Elements& family = model.family(x.edge_kind);
  const std::uint32_t part = family.part[x.edge_element];
  return {x.edge_kind, x.edge_element, family.id[x.edge_element],
          part == no_index ? 0 : model.parts[part].id};
}

ElementName segment_element(const Scene& scene, const Crossing& x) {
  const MainSegment& m = scene.contacts[x.contact].main[x.main];
  return carrier_name(*scene.model, m.carrier, m.element);
}

std::string crossings_text(const Scene& scene, const std::vector<Crossing>& crossings,
                           const GapsTextOptions& options) {
  if (crossings.empty()) return "\nNo edge of the secondary side passes through a main segment.\n";
  const Model& model = *scene.model;
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<const Crossing*>> by_parts;
  for (const Crossing& x : crossings)
    by_parts[{edge_element(model, x).part, segment_element(scene, x).part}].push_back(&x);
  TextTable table({">part", ">through part", ">crossings", ">interface", "for example edge",
                   ">of element", "through segment", ">of element"});
  for (const auto& [parts, list] : by_parts) {
    const Crossing& x = *list.front();
    const Contact& c = scene.contacts[x.contact];
    table.row({parts.first, parts.second, list.size(), c.inter->id, ids_text(model, x.edge, ' '),
               edge_element(model, x).id, ids_text(model, c.main[x.main].nodes, ' '),
               segment_element(scene, x).id});
  }
  return fmt::format("\nCrossed elements: {}\n{}", crossings.size(),
                     table.fitted(options.width, options.color, 2, 2));
}

std::string decisions_text(const Scene& scene, bool always) {
  const DecisionReport& r = scene.decisions;
  if (r.pairs == 0 || (!always && r.contact_differs == 0)) return {};
  std::string out = fmt::format("Decisions ({}): {} pairs searched", to_string(r.mode), r.pairs);
  if (r.mode != Accuracy::robust && r.mode != Accuracy::exact) return out + " in plain double.\n";
  out +=
      fmt::format(", {} ({:.2g} %) needed more than double, {} exact arithmetic.", r.fallback,
                  100.0 * static_cast<double>(r.fallback) / static_cast<double>(r.pairs), r.exact);
  const std::uint64_t differ = r.contact_differs + r.surface_differs;
  if (differ == 0) return out + " The solver's arithmetic decides all of them alike.\n";
  return out + fmt::format(
                   " The solver's arithmetic decides {} otherwise: {} about contact, {} "
                   "about nodes exactly on a segment (--json lists them).\n",
                   differ, r.contact_differs, r.surface_differs);
}

namespace {

/// Reason why a contact with 0 penetrations is not reported as clean; empty if it is.
std::string obstacle(const Contact& c) {
  static constexpr const char* words[] = {"",
                                          "main side is empty",
                                          "secondary side is empty",
                                          "there is no gap",
                                          "without area",
                                          "segments or edges without element",
                                          "main side has no stiffness"};
  const NotCleanReason why = not_clean_reason(c);
  const std::string text = words[static_cast<std::size_t>(why)];
  if (why != NotCleanReason::no_area) return text;
  return count(static_cast<std::uint64_t>(c.degenerate_segments), "segment ", "segments ") + text;
}

/// State of a tied contact.
std::string tied_words(const Contact& c, const ContactTotals& t) {
  if (t.untied == 0) return count(t.tied.pairs, "pair tied", "pairs tied");
  if (t.untied == c.secondary.size()) return fmt::format("none of {} tied", t.untied);
  return fmt::format("{} of {} not tied", t.untied, count(c.secondary.size(), "node", "nodes"));
}

/// Actions of the solver on penetrations, in a few words; stops first.
std::string action_words(const std::vector<const Contact*>& contacts) {
  std::size_t by_action[penetration_actions] = {}, all = 0;
  std::string why, left_out;
  std::set<std::pair<PenetrationAction, NodeIndex>> stopped;
  for (const Contact* c : contacts) {
    if (!c->evaluated) {
      if (contacts.size() == 1) return "not evaluated";
      append(left_out, ", ", c->role == ContactRole::primary ? "nodes" : to_string(c->role));
      left_out += " not evaluated";
      continue;
    }
    if (why.empty()) why = obstacle(*c);
    all += c->penetrations.size();
    for (const PenetrationRow& row : c->penetrations) {
      ++by_action[static_cast<std::size_t>(row.action)];
      if (stops_solver(row.action))
        stopped.emplace(row.action, pair_nodes(*c, row.secondary, row.main).secondary[0]);
    }
  }
  if (all == 0) return !left_out.empty() ? left_out : why.empty() ? "-" : why;
  std::string text;
  for (const bool stops : {true, false})
    for (std::size_t a = 0; a < std::size(by_action); ++a) {
      const auto action = static_cast<PenetrationAction>(a);
      if (by_action[a] == 0 || stops_solver(action) != stops) continue;
      const auto nodes = static_cast<std::size_t>(std::count_if(
          stopped.begin(), stopped.end(), [&](const auto& s) { return s.first == action; }));
      const char* const words = action_words(action, stops ? nodes : by_action[a]);
      append(text, ", ",
             stops                 ? count(nodes, "node ", "nodes ") + words
             : by_action[a] == all ? words
                                   : fmt::format("{} {}", by_action[a], words));
    }
  return text + (left_out.empty() ? "" : "; " + left_out);
}

/// Totals of the contacts of one interface: a node in two contacts counts twice.
ContactTotals sum_of(const Scene& scene, const SceneView& view,
                     const std::vector<const Contact*>& contacts) {
  ContactTotals sum;
  for (const Contact* c : contacts) {
    const ContactTotals& t = view.contacts[static_cast<std::size_t>(c - scene.contacts.data())];
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

/// Depth in percent of the gap; "-" if the gap is 0.
std::string ratio_text(double ratio) {
  return ratio > 0 ? fmt::format("{:.0f} %", 100 * ratio) : "-";
}

/// Row of some contacts of an interface; `part`: one of several.
std::vector<TextTable::Cell> interface_row(const std::vector<const Contact*>& contacts,
                                           const ContactTotals& t, bool part, double largest) {
  const Contact& c = *contacts.front();
  const bool modern = is_type24_or_25(c.type), one = contacts.size() == 1;
  const bool edges = c.kind == ContactKind::edge_edge;
  std::uint64_t reach = 0;
  bool of_nodes = false, of_edges = false;  // where nothing was evaluated no figure is known
  for (const Contact* x : contacts) {
    reach += x->candidates;
    bool& of_kind = x->kind == ContactKind::edge_edge ? of_edges : of_nodes;
    of_kind = of_kind || x->evaluated;
  }
  const bool known = of_nodes || of_edges;
  const auto size = [&](std::size_t n) { return one ? TextTable::Cell(n) : TextTable::Cell(""); };
  const bool tied = c.is_tied_contact() && known && obstacle(c).empty() && t.solver_errors == 0;
  const Tone tone = t.solver_errors > 0            ? Tone::red
                    : t.count.pairs + t.untied > 0 ? Tone::yellow
                                                   : Tone::plain;
  return {c.inter->id,
          part ? kind_name(c) : type_name(*c.inter),
          c.igap,
          modern ? "-" : length_text(c.gapmin, 6, largest),  // they have none
          modern ? "-" : to_string(c.gapmin_origin),
          size(edges ? c.secondary_edges.size() : c.secondary.size()),
          size(edges ? c.main_edges.size() : c.main.size()),
          known_cell(known, reach),
          known_cell(known, t.count.pairs),
          known_cell(of_nodes, t.count.nodes),
          known_cell(of_edges, t.count.edges),
          t.count.pairs ? length_text(t.max_depth, 4, largest) : "-",
          ratio_text(t.max_ratio),
          {tied ? tied_words(c, t) : action_words(contacts), tone},
          part ? "" : c.inter->title};
}

/// The columns that have room; the others are named below.
std::string one_table(const TextTable& table, const GapsTextOptions& options,
                      std::size_t keys = 2) {
  if (options.verbose || table.size() == 0) return table.below_heading(options, keys);
  std::vector<std::string> left;
  const std::string out = table.fitted(options.width, options.color, 2, keys, &left);
  if (left.empty()) return out;
  return out + fmt::format("  columns without room: {} (-v)\n", fmt::join(left, ", "));
}

/// One row per interface; interfaces without penetrations share a line. `verbose`: all interfaces,
/// a row per contact of a TYPE19, and columns for sides and gaps.
std::string interface_table(const Scene& scene, const SceneView& view,
                            const GapsTextOptions& options) {
  const bool all = options.verbose;
  const double largest = view.largest_gap;
  TextTable table(
      {">id", "type", "+>Igap", "+>Gapmin", "+Gapmin from", "+>nodes", "+>segments", "+>in reach",
       ">pairs", all ? ">penetrating nodes" : ">nodes", all ? ">penetrating edges" : ">edges",
       ">deepest", ">of gap", "action", "~title"},
      all);
  std::vector<std::int64_t> clean;
  for (const auto& contacts :
       by_interface(scene.contacts, [](const Contact& c) { return c.inter; })) {
    const bool open = std::any_of(contacts.begin(), contacts.end(), [](const Contact* c) {
      return !c->evaluated || !obstacle(*c).empty();
    });
    const ContactTotals sum = sum_of(scene, view, contacts);
    if (!all && !open && sum.count.pairs + sum.tied.pairs + sum.untied == 0) {
      clean.push_back(contacts.front()->inter->id);
      continue;
    }
    table.row(interface_row(contacts, sum, false, largest));
    if (all && contacts.size() > 1)
      for (const Contact* c : contacts)
        table.row(interface_row({c}, sum_of(scene, view, {c}), true, largest));
  }
  return one_table(table, options, 1) +
         folded_ids(clean, "interface without penetrations", "interfaces without penetrations");
}

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
  TextTable pairs({"~secondary", "~main", ">pairs", ">nodes", ">edges", ">deepest", ">of gap",
                   ">mean", ">95 % ≤"});
  const double largest = view.largest_gap;
  const std::size_t shown = std::min(options.part_pairs, view.part_pairs.size());
  for (const PartPair& p : std::span(view.part_pairs).first(shown))
    pairs.row({part_name(model, p.secondary), part_name(model, p.main), p.count.pairs,
               p.count.nodes, p.count.edges, length_text(p.max_depth, 4, largest),
               ratio_text(p.max_ratio), length_text(p.mean_depth, 4, largest),
               length_text(p.p95_depth, 4, largest)});
  return one_table(pairs, options) + more_line(view.part_pairs.size(), shown);
}

/// Positions in view.penetrations of the worst nodes and edges: three of each interface, then the
/// deepest of all, `most` at most; deepest first.
std::vector<std::uint32_t> worst_rows(const Scene& scene, const SceneView& view, std::size_t most) {
  std::map<const InterBase*, int> of_interface;
  std::vector<std::uint32_t> rows = view.deepest_per_node;
  std::stable_partition(rows.begin(), rows.end(), [&](std::uint32_t i) {
    return of_interface[scene.contacts[view.penetrations.places[i].contact].inter]++ < 3;
  });
  rows.resize(std::min(most, rows.size()));
  std::sort(rows.begin(), rows.end());
  return rows;
}

std::string worst_text(const Deck& deck, const Scene& scene, const SceneView& view,
                       const GapsTextOptions& options) {
  // On short lines elements and positions give way first.
  constexpr std::size_t room = 150;
  TextTable worst({">interface", "node/edge", ">depth", ">gap", "+>distance", "~segment/edge",
                   "+elements", "action", "+position", "=defined at"},
                  options.verbose || options.width == 0 || options.width >= room);
  const std::vector<std::uint32_t> rows = worst_rows(scene, view, options.worst);
  const double largest = view.largest_gap;
  std::vector<NodeIndex> nodes;
  for (const std::uint32_t row : rows)
    nodes.push_back(first_node(scene, view.penetrations.places[row]));
  const std::vector<Span> spans = detail::node_spans(*scene.model, nodes);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const NamedPenetration& p = view.penetrations[rows[i]];
    const PenetrationRow& row = row_of(scene, view.penetrations.places[rows[i]]);
    const PairNodes ids = pair_nodes(scene.contacts[p.contact], row.secondary, row.main);
    std::string action = action_words(row.action, 1);
    if (options.verbose && row.action == PenetrationAction::gap_reduced && !is_unbounded(row.gap0))
      action += fmt::format(" to {:.4g}", row.gap0);
    if (!row.in_contact) action += " (round-off)";
    const Tone tone = stops_solver(row.action)                ? Tone::red
                      : row.action == PenetrationAction::none ? Tone::plain
                                                              : Tone::yellow;
    worst.row({scene.contacts[p.contact].inter->id,
               ids_text(*scene.model, ids.secondary, '-'),
               length_text(row.depth, 6, largest),
               length_text(row.gap, 6, largest),
               row.distance,
               ids_text(*scene.model, ids.main, ' '),
               fmt::format("{} / {}", p.secondary_element.id, p.main_element.id),
               {action, tone},
               fmt::format("({:.5g}, {:.5g}, {:.5g})", p.at[0], p.at[1], p.at[2]),
               deck.sources.where(spans[i])});
  }
  return one_table(worst, options) +
         more_line(view.deepest_per_node.size(), rows.size(), " (--worst N, --csv, --json)");
}

// ---- ties -------------------------------------------------------------------------------------

/// One row per tie; complete ties share a line, unless `verbose`.
std::string tie_table(const Scene& scene, const GapsTextOptions& options) {
  TextTable table({">id", "type", "~title", ">nodes", ">tied", ">not tied", ">search distance",
                   ">farthest", "what happens"});
  std::vector<std::int64_t> clean;
  for (const Tie& tie : scene.ties) {
    const TieCounts n = count_ties(tie);
    const std::string happens = losses_text(tie);
    if (!options.verbose && happens == "-" && n.nodes > 0) {
      clean.push_back(tie.inter->id);
      continue;
    }
    double farthest = 0;
    for (const TiedNode& node : tie.nodes)
      if (node.tied) farthest = std::max(farthest, node.distance);
    const double search = tie.search_distance;
    table.row({tie.inter->id, "TYPE2", tie.inter->title, n.nodes, n.tied, n.lost(),
               search != 0 ? TextTable::Cell(search) : TextTable::Cell("by pair"),
               known_cell(n.tied > 0, farthest), happens});
  }
  return table.below_heading(options) + folded_ids(clean, "complete tie", "complete ties");
}

struct UntiedNode {
  const InterBase* inter = nullptr;
  NodeIndex node = no_index;
  std::string segment;
  TextTable::Cell distance, search;
  std::string why;
};

UntiedNode untied_node(const Model& model, const Tie& tie, const TiedNode& n) {
  const bool found = n.segment != no_index;
  const std::uint32_t segment = found ? n.segment : n.nearest;
  const bool known = segment != no_index;
  const double search = n.search != 0 ? n.search : tie.search_distance;
  return {tie.inter,
          n.node,
          known ? ids_text(model, tie.main[segment], ' ') : "-",
          known_cell(known, found ? n.distance : n.nearest_distance),
          known_cell(search != 0, search),
          short_reason(tie, n)};
}

/// The first three of each tie, `most` in all (with `verbose` the first of all); `all`: how many
/// there are.
std::vector<UntiedNode> untied_nodes(const Scene& scene, const GapsTextOptions& options,
                                     std::size_t& all) {
  std::vector<UntiedNode> out;
  std::map<const InterBase*, int> of_interface;
  const auto wanted = [&](const InterBase* inter) {
    return ++all > 0 && out.size() < options.worst &&
           (options.verbose || of_interface[inter]++ < 3);
  };
  for (const Tie& tie : scene.ties)
    for (const TiedNode& n : tie.nodes)
      if (tie.not_evaluated.empty() && n.lost() && wanted(tie.inter))
        out.push_back(untied_node(*scene.model, tie, n));
  for (const Contact& c : scene.contacts)
    for (const std::uint32_t i : untied_secondary(c))
      if (wanted(c.inter))
        out.push_back({c.inter, c.secondary[i].node, "-", "-", c.gapmin, "no segment"});
  return out;
}

/// Untied nodes: nearest segment, its distance, search distance.
std::string untied_text(const Deck& deck, const Scene& scene, const GapsTextOptions& options) {
  const Model& model = *scene.model;
  std::size_t all = 0;
  const std::vector<UntiedNode> rows = untied_nodes(scene, options, all);
  TextTable table({">interface", ">node", ">part", "why", ">distance", ">search distance",
                   "=nearest segment", "=defined at"});
  std::vector<NodeIndex> nodes;
  for (const UntiedNode& row : rows) nodes.push_back(row.node);
  const std::vector<Span> spans = detail::node_spans(model, nodes);
  Connectivity connectivity(model);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const UntiedNode& row = rows[i];
    const std::int64_t part = element_at(model, connectivity, row.node).part;
    table.row({row.inter->id, model.node_id(row.node), known_cell(part != 0, part), row.why,
               row.distance, row.search, row.segment, deck.sources.where(spans[i])});
  }
  return one_table(table, options) + more_line(all, rows.size(), " (--worst N, --json)");
}

}  // namespace

std::string gaps_text(const Deck& deck, const Scene& scene, const SceneView& view,
                      const GapsTextOptions& options) {
  const bool color = options.color;
  std::string out;
  if (!options.name.empty()) out += toned(terminal_text(options.name), Tone::cyan, color) + "\n";
  const std::size_t head = out.size();
  if (!scene.contacts.empty()) {
    const std::string interfaces = titled("Interfaces, in " + units_text(deck.begin.working),
                                          interface_table(scene, view, options), color);
    out += out.empty() ? interfaces.substr(1) : interfaces;
    if (!view.penetrations.empty())
      out += titled("Part pairs", part_pairs_text(scene, view, options), color) +
             titled("Deepest, three of each interface first",
                    worst_text(deck, scene, view, options), color);
    if (options.crossings != nullptr) out += crossings_text(scene, *options.crossings, options);
    // What only round-off brings into contact is in the verdict.
    if (scene.decisions.pairs > 0 &&
        (options.verbose || scene.decisions.contact_differs > view.total.round_off))
      out += "\n" + decisions_text(scene, options.verbose);
    out += "\n";
  }
  if (!scene.ties.empty()) out += titled("Ties", tie_table(scene, options), color).substr(1) + "\n";
  if (const std::string untied = untied_text(deck, scene, options); !untied.empty())
    out += titled("Nodes that are not tied", untied, color).substr(1) + "\n";
  const std::string verdict = verdict_text(verdict_of(deck, scene, view), color);
  constexpr auto screen = 50;  // lines: behind more the verdict is out of sight
  if (std::count(out.begin(), out.end(), '\n') > screen)
    out.insert(head, verdict + (head == 0 ? "\n" : ""));
  out += verdict;
  if (options.gate != nullptr) out += gate_text(*options.gate);
  return out;
}

namespace {

std::optional<std::int64_t> known_id(std::int64_t id) { return known(id != 0, id); }
std::optional<double> known_length(double v, bool is_there = true) {
  return known(is_there && !is_unbounded(v), v);
}

/// "file,line"
std::array<std::string, 2> place_cells(const Deck& deck, const Span& span) {
  if (!span.valid()) return {};
  return {terminal_text(deck.sources[span.file].path()),
          std::to_string(deck.sources.position(span).line)};
}

struct PenetrationLine {
  const NamedPenetration& pair;
  const Span& span;
  const Contact& contact;
  const PenetrationRow& row;
};

struct TieLine {
  const Tie& tie;
  const TiedNode& node;
  const Span& span;
  bool found() const { return node.segment != no_index; }
  /// Corners of the tied segment, else of the nearest one.
  std::array<std::optional<std::int64_t>, 4> corners(const Model& model) const {
    std::array<std::optional<std::int64_t>, 4> out;
    const std::uint32_t segment = found() ? node.segment : node.nearest;
    for (std::size_t k = 0; k < 4 && segment != no_index; ++k)
      out[k] = model.node_id(tie.main[segment][k]);
    return out;
  }
};

}  // namespace

std::string gaps_csv(const Deck& deck, const Scene& scene, const SceneView& view,
                     const TextDrain& drain) {
  CsvTable<PenetrationLine> table(
      drain, CSV("interface", r.contact.inter->id), CSV("type", r.contact.inter->type),
      CSV("role", to_string(r.contact.role)), CSV("kind", to_string(r.contact.kind)),
      CSV("secondary_1", r.pair.secondary[0]), CSV("secondary_2", known_id(r.pair.secondary[1])),
      CSV("main_1", r.pair.main[0]), CSV("main_2", r.pair.main[1]),
      CSV("main_3", known_id(r.pair.main[2])), CSV("main_4", known_id(r.pair.main[3])),
      CSV("depth", known_length(r.row.depth)), CSV("gap", known_length(r.row.gap)),
      CSV("distance", known_length(r.row.distance)),
      CSV("ratio", r.row.gap > 0 ? r.row.depth / r.row.gap : 0.0),
      CSV("normal_x,normal_y,normal_z", r.row.normal), CSV("on_surface", r.row.on_surface),
      CSV("in_contact", r.row.in_contact), CSV("action", to_string(r.row.action)),
      CSV("gap0", known_length(r.row.gap0, r.row.has_gap0)),
      CSV("p0", known_length(r.row.p0, r.row.has_gap0)), CSV("x,y,z", r.pair.at),
      CSV("secondary_element", known_id(r.pair.secondary_element.id)),
      CSV("secondary_part", known_id(r.pair.secondary_element.part)),
      CSV("main_element", known_id(r.pair.main_element.id)),
      CSV("main_part", known_id(r.pair.main_element.part)),
      CSV("file,line", place_cells(deck, r.span)));
  const std::vector<Span> spans =
      detail::node_spans(*scene.model, first_nodes(scene, view.penetrations));
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const NamedPenetration& p = view.penetrations[i];
    table.add({p, spans[i], scene.contacts[p.contact], row_of(scene, view.penetrations.places[i])});
  }
  return table.text();
}

std::string ties_csv(const Deck& deck, const Scene& scene, const TextDrain& drain) {
  const Model& model = *scene.model;
  const Nodes& nodes = model.nodes;
  Connectivity connectivity(model);
  CsvTable<TieLine> table(
      drain, CSV("interface", r.tie.inter->id), CSV("node", model.node_id(r.node.node)),
      CSV("part", known_id(element_at(model, connectivity, r.node.node).part)),
      CSV("tied", r.node.tied), CSV("penalty", r.node.penalty),
      CSV("message", known_id(r.node.message)),
      CSV("main_1,main_2,main_3,main_4", r.corners(model)), CSV("s", known(r.found(), r.node.s)),
      CSV("t", known(r.found(), r.node.t)), CSV("distance", known(r.found(), r.node.distance)),
      CSV("search", known(r.node.search != 0, r.node.search)),
      CSV("nearest_distance", known(r.node.nearest != no_index, r.node.nearest_distance)),
      CSV("why", short_reason(r.tie, r.node)), CSV("x", nodes.x[r.node.node]),
      CSV("y", nodes.y[r.node.node]), CSV("z", nodes.z[r.node.node]),
      CSV("file,line", place_cells(deck, r.span)));
  for (const Tie& tie : scene.ties) {
    std::vector<NodeIndex> list;
    for (const TiedNode& n : tie.nodes) list.push_back(n.node);
    const std::vector<Span> spans = detail::node_spans(model, list);
    for (std::size_t i = 0; i < tie.nodes.size(); ++i) table.add({tie, tie.nodes[i], spans[i]});
  }
  return table.text();
}

}  // namespace deck
