// Verdict and tables of `deck gaps`.
#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <iterator>

#include "deck/base/escape.hpp"
#include "deck/report/gaps.hpp"
#include "deck/report/text_table.hpp"
#include "model/item_spans.hpp"
#include "report/accuracy_decisions.hpp"
#include "report/gaps_names.hpp"
#include "report/terminal/words.hpp"

namespace deck {
namespace {

const PenetrationRow& row_of(const Scene& scene, const NamedPenetration& p) {
  return scene.contacts[p.contact].penetrations[p.row];
}

/// What the solver does about the penetrations of a contact, in a few words.
std::string action_words(const Contact& c) {
  if (c.penetrations.empty()) return "-";
  std::size_t by_action[6] = {};
  for (const PenetrationRow& row : c.penetrations) ++by_action[static_cast<int>(row.action)];
  static constexpr const char* words[6] = {
      "nothing",     "nodes switched off", "segments switched off",
      "nodes moved", "gaps reduced",       "edges switched off"};
  std::string text;
  for (int a = 0; a < 6; ++a) {
    if (by_action[a] == 0) continue;
    if (!text.empty()) text += ", ";
    text += by_action[a] == c.penetrations.size() ? words[a]
                                                  : fmt::format("{} {}", by_action[a], words[a]);
  }
  return text;
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

/// Columns by title; a title that starts with '>' is aligned to the right.
std::string interface_table(const Scene& scene, const SceneView& view, bool color) {
  TextTable table = make_table({">interface", "kind", ">Igap", ">Gapmin", ">nodes", ">segments",
                                ">in reach", ">pairs", ">nodes in", ">edges in", ">deepest",
                                ">of gap", "the solver does", "Gapmin from"});
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const Contact& c = scene.contacts[i];
    const ContactTotals& t = view.contacts[i];
    const bool edges = c.kind == ContactKind::edge_edge;
    table.row({fmt::format("{}", c.inter->id), kind_name(c), fmt::format("{}", c.igap),
               fmt::format("{:.6g}", c.gapmin),
               fmt::format("{}", edges ? c.secondary_edges.size() : c.secondary.size()),
               fmt::format("{}", edges ? c.main_edges.size() : c.main.size()),
               fmt::format("{}", c.candidates), fmt::format("{}", t.count.pairs),
               edges ? "-" : fmt::format("{}", t.count.nodes),
               edges ? fmt::format("{}", t.count.edges) : "-",
               t.count.pairs ? fmt::format("{:.6g}", t.max_depth) : "-",
               t.count.pairs ? fmt::format("{:.0f} %", 100 * t.max_ratio) : "-", action_words(c),
               to_string(c.gapmin_origin)});
  }
  return table.render(color, 2);
}

std::string part_name(const Model& model, std::int64_t id) {
  const auto it = model.part_of_id.find(id);
  if (it == model.part_of_id.end()) return id == 0 ? "(no part)" : fmt::format("{}", id);
  std::string title = model.parts[it->second].title;
  if (title.size() > 30) {  // not through the middle of a character
    std::size_t end = 0;
    while (end < 30) end += text_unit_at(title, end).length;
    title.resize(end);
  }
  while (!title.empty() && title.back() == ' ') title.pop_back();
  return title.empty() ? fmt::format("{}", id) : fmt::format("{} {}", id, title);
}

}  // namespace

namespace {

/// "62 nodes and 12 edges", without what there is none of.
std::string items_text(const ItemCounts& c) {
  if (c.edges == 0) return count(c.nodes, "node", "nodes");
  if (c.nodes == 0) return count(c.edges, "edge", "edges");
  return count(c.nodes, "node", "nodes") + " and " + count(c.edges, "edge", "edges");
}

std::string penetration_sentence(const Scene& scene, const SceneView& view) {
  const ContactTotals& t = view.total;
  const auto unknown = static_cast<std::size_t>(std::count_if(
      scene.contacts.begin(), scene.contacts.end(), [](const Contact& c) { return !c.evaluated; }));
  const std::string open = unknown == 0
                               ? ""
                               : fmt::format("{} could not be evaluated, see the findings. ",
                                             count(unknown, "contact", "contacts"));
  if (t.count.pairs == 0)
    return open + fmt::format("No initial penetration in {}.",
                              count(scene.contacts.size() - unknown, "contact", "contacts"));
  // One figure for the deepest pair, one for the largest share of a gap.
  const PenetrationRow& deepest = row_of(scene, view.penetrations.front());
  std::string text =
      open +
      fmt::format("{} on {}, deepest {:.6g} of a gap of {:.6g}; worst share of a gap {:.1f} %.",
                  count(t.count.pairs, "initial penetration", "initial penetrations"),
                  items_text(t.count), deepest.depth, deepest.gap, 100 * t.max_ratio);
  if (t.solver_errors > 0)
    text += fmt::format(" The solver will stop: {} exactly on a segment (error 611/612).",
                        count(t.solver_errors, "node lies", "nodes lie"));
  else if (t.on_segment.pairs > 0)
    text += fmt::format(" Exactly on a segment: {}.", items_text(t.on_segment));
  return text;
}

}  // namespace

std::string gaps_verdict(const Deck& deck, const Scene& scene, const SceneView& view) {
  const Coverage coverage = coverage_of(deck, *scene.interfaces);
  std::string text = coverage_lead(coverage);
  if (text.empty()) {
    text = penetration_sentence(scene, view);
    if (const std::uint64_t n = view.total.crossed_elements.value_or(0); n > 0)
      text += fmt::format(" {}: an edge of the secondary side passes through a main segment.",
                          count(n, "crossed element", "crossed elements"));
  }
  return text + coverage_tail(coverage);
}

std::string gaps_text(const Deck& deck, const Scene& scene, const SceneView& view,
                      const GapsTextOptions& options) {
  const Model& model = *scene.model;
  const char* bold = options.color ? "\033[1m" : "";
  const char* plain = options.color ? "\033[0m" : "";
  std::string out =
      fmt::format("{}{}{}\n", bold, terminal_text(gaps_verdict(deck, scene, view)), plain);
  if (scene.contacts.empty()) return out;
  out +=
      fmt::format("\n{}Interfaces{}\n{}", bold, plain, interface_table(scene, view, options.color));
  const std::string decisions = decisions_text(scene, 5, options.color);
  if (!decisions.empty()) out += "\n" + decisions;
  if (view.penetrations.empty()) return out;

  TextTable pairs = make_table({"secondary part", "main part", ">pairs", ">nodes", ">edges",
                                ">deepest", ">mean", ">p95", ">of gap"});
  const std::size_t shown = std::min(options.part_pairs, view.part_pairs.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const PartPair& p = view.part_pairs[i];
    pairs.row({part_name(model, p.secondary), part_name(model, p.main),
               fmt::format("{}", p.count.pairs), fmt::format("{}", p.count.nodes),
               fmt::format("{}", p.count.edges), fmt::format("{:.6g}", p.max_depth),
               fmt::format("{:.6g}", p.mean_depth), fmt::format("{:.6g}", p.p95_depth),
               fmt::format("{:.0f} %", 100 * p.max_ratio)});
  }
  out += fmt::format("\n{}Part pairs{}\n{}", bold, plain, pairs.render(options.color, 2));
  if (shown < view.part_pairs.size())
    out += fmt::format("  … and {} more\n", view.part_pairs.size() - shown);

  TextTable worst = make_table({">depth", ">gap", ">distance", ">interface", "node/edge",
                                "segment/edge", "elements", "action", "position", "defined at"});
  const std::size_t rows = std::min(options.worst, view.deepest_per_node.size());
  for (std::size_t i = 0; i < rows; ++i) {
    const NamedPenetration& p = view.penetrations[view.deepest_per_node[i]];
    const Contact& c = scene.contacts[p.contact];
    const PenetrationRow& row = row_of(scene, p);
    const NodeIndex n = c.kind == ContactKind::node_segment
                            ? c.secondary[row.secondary].node
                            : c.secondary_edges[row.secondary].nodes[0];
    const bool stops = row.on_surface && on_surface_error(c) != 0;
    std::string action =
        stops ? fmt::format("error {}", on_surface_error(c)) : to_string(row.action);
    if (!stops && row.has_gap0) action += fmt::format(" to {:.4g}", row.gap0);
    worst.row({fmt::format("{:.6g}", row.depth), fmt::format("{:.6g}", row.gap),
               fmt::format("{:.6g}", row.distance), fmt::format("{}", c.inter->id),
               secondary_text(p), segment_text(p),
               fmt::format("{} / {}", p.secondary_element.id, p.main_element.id), action,
               fmt::format("({:.5g}, {:.5g}, {:.5g})", p.at[0], p.at[1], p.at[2]),
               deck.sources.where(model.node_span(n))});
  }
  out += fmt::format("\n{}Deepest, one row per node or edge{}\n{}", bold, plain,
                     worst.render(options.color, 2));
  if (rows < view.deepest_per_node.size())
    out += fmt::format("  … and {} more (--worst N, --csv, --json)\n",
                       view.deepest_per_node.size() - rows);
  return out;
}

std::string gaps_csv(const Deck& deck, const Scene& scene, const SceneView& view) {
  std::string out =
      "interface,type,role,kind,secondary_1,secondary_2,main_1,main_2,main_3,main_4,depth,gap,"
      "distance,ratio,normal_x,normal_y,normal_z,on_surface,action,gap0,p0,x,y,z,"
      "secondary_element,secondary_part,main_element,main_part,file,line\r\n";
  const auto quote = [](const std::string& s) {
    if (s.find_first_of(",\"\r\n") == std::string::npos) return s;
    std::string q = "\"";
    for (const char ch : s) q += ch == '"' ? std::string("\"\"") : std::string(1, ch);
    return q + '"';
  };
  const std::vector<Span> spans = detail::node_spans(*scene.model, first_nodes(scene, view));
  for (std::size_t row = 0; row < view.penetrations.size(); ++row) {
    const NamedPenetration& p = view.penetrations[row];
    const Contact& c = scene.contacts[p.contact];
    const PenetrationRow& r = row_of(scene, p);
    const Span& span = spans[row];
    const auto id = [](std::int64_t v) { return v == 0 ? std::string() : fmt::format("{}", v); };
    fmt::format_to(std::back_inserter(out), "{},{},{},{},{},{},{},{},{},{},{},{},{},{},",
                   c.inter->id, c.inter->type, to_string(c.role), to_string(c.kind), p.secondary[0],
                   id(p.secondary[1]), p.main[0], p.main[1], id(p.main[2]), id(p.main[3]), r.depth,
                   r.gap, r.distance, r.gap > 0 ? r.depth / r.gap : 0.0);
    fmt::format_to(
        std::back_inserter(out), "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n", r.normal[0],
        r.normal[1], r.normal[2], r.on_surface ? 1 : 0, to_string(r.action),
        r.has_gap0 ? fmt::format("{}", r.gap0) : "", r.has_gap0 ? fmt::format("{}", r.p0) : "",
        p.at[0], p.at[1], p.at[2], id(p.secondary_element.id), id(p.secondary_element.part),
        id(p.main_element.id), id(p.main_element.part),
        span.valid() ? quote(terminal_text(deck.sources[span.file].path())) : std::string(),
        span.valid() ? fmt::format("{}", deck.sources.position(span).line) : "");
  }
  return out;
}

}  // namespace deck
