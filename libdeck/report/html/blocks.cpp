// Optional blocks of the page: ties, crossed elements, moved nodes, time steps as colours, first
// cycle. All are JSON, except the colours.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "contact/shared/node_elements.hpp"
#include "contact/shared/reported.hpp"
#include "model/shared/families.hpp"
#include "model/shared/item_spans.hpp"
#include "model/shared/mesh.hpp"
#include "report/html/page_steps.hpp"
#include "report/shared_records.hpp"

namespace deck::detail {
namespace {

constexpr std::size_t most_tie_rows = 20000;  // per tie, untied nodes first
constexpr std::size_t most_crossings = 20000;
constexpr std::size_t most_moved = 100000;      // farthest first
constexpr std::size_t most_pair_rows = 100000;  // per contact, largest force first
constexpr std::size_t most_nodes = 100000;      // largest force first
constexpr int step_classes = 254;               // a byte per node; 0: no step
/// Share of the nodes in the scale: a few springs with steps a thousand times larger would leave
/// one colour for all others.
constexpr double covered = 0.98;

// ---- ties of /INTER/TYPE2 and TYPE10 ----------------------------------------------------------

/// State of a node in the page; numbers as in tools/viewer/src/tied.ts.
enum class TiedState { tied = 0, lost = 1, beyond_rim = 2, elsewhere = 3 };

TiedState holds(const TiedNode& n) {
  if (n.tied) return n.message == 0 ? TiedState::tied : TiedState::beyond_rim;
  return n.lost() ? TiedState::lost : TiedState::elsewhere;
}

/// The segment of a tied node, else the nearest one.
std::uint32_t segment_of(const TiedNode& n) {
  return n.segment != no_index ? n.segment : n.nearest;
}

/// Positions in Tie::nodes for the table, untied nodes first.
std::vector<std::uint32_t> listed(const Tie& tie) {
  std::vector<std::uint32_t> out;
  for (const TiedState wanted : {TiedState::lost, TiedState::beyond_rim})
    for (std::uint32_t i = 0; i < tie.nodes.size() && out.size() < most_tie_rows; ++i)
      if (holds(tie.nodes[i]) == wanted) out.push_back(i);
  return out;
}

/// Positions of segments with a line, ascending.
std::vector<std::uint32_t> segments_of(const Tie& tie) {
  std::vector<std::uint8_t> marks(tie.main.size(), 0);
  for (const TiedNode& n : tie.nodes)
    if (const std::uint32_t s = segment_of(n); s != no_index) marks[s] = 1;
  return marked(marks);
}

/// An untied node in the page; distances that are not finite are unknown.
struct UntiedRow {
  std::uint32_t position = 0;  ///< in the tie
  NodeIndex node = 0;
  double distance = 0, search = 0;
  std::string reason, why;
};

/// A tie in the page.
struct TieLines {
  using Row = std::tuple<std::uint32_t, double, double, std::int64_t, std::string, std::string,
                         std::int64_t, std::size_t>;
  const Model& model;
  Connectivity& connectivity;
  std::vector<std::int64_t> main = {};     ///< nodes of the segments, segment by segment
  std::vector<std::int64_t> nodes = {};    ///< tied, or to be tied
  std::vector<std::int64_t> segment = {};  ///< per node: its segment; -1: none
  std::vector<int> holds = {};             ///< per node
  std::vector<UntiedRow> untied = {};

  void add(std::uint32_t node, std::int64_t to, TiedState how) {
    nodes.push_back(node);
    segment.push_back(to);
    holds.push_back(static_cast<int>(how));
  }
  std::vector<Row> rows() const {
    std::vector<NodeIndex> all;
    for (const UntiedRow& row : untied) all.push_back(row.node);
    const std::vector<Span> spans = node_spans(model, all);
    std::vector<Row> out;
    for (std::size_t k = 0; k < spans.size(); ++k) {
      const UntiedRow& u = untied[k];
      const bool placed = spans[k].valid();
      out.emplace_back(u.position, u.distance, u.search,
                       part_position(model, element_at(model, connectivity, u.node)), u.reason,
                       u.why, placed ? std::int64_t{spans[k].file} : -1,
                       placed ? model.deck->sources.position(spans[k]).line : 0);
    }
    return out;
  }
};
LINE_RECORD(
    TieLines, "tie_lines", "The block deck-ties has one for each of 'ties'; nodes by their number.",
    COLUMN("main", "Nodes of the segments, four a segment", r.main), COLUMN("nodes", "", r.nodes),
    COLUMN("segment", "Of each node: which segment it is tied to or nearest to; -1: none",
           r.segment),
    COLUMN("holds",
           "Of each node: 0 tied, 1 lost, 2 tied from beyond the rim of its segment, 3 held by "
           "something else",
           r.holds),
    COLUMN("rows",
           "Nodes that are not tied, then those tied from beyond the rim: position in 'nodes', "
           "distance, search distance, part, why in short and as a sentence, file (-1: not "
           "known) and line",
           r.rows()));

void add_lines(const Tie& tie, const PageNodes& nodes, TieLines& out) {
  const std::vector<std::uint32_t> segments = segments_of(tie);
  for (const std::uint32_t s : segments)
    for (const NodeIndex n : tie.main[s]) out.main.push_back(nodes[n]);
  for (const TiedNode& n : tie.nodes) {
    const std::uint32_t s = segment_of(n);
    const auto at = std::lower_bound(segments.begin(), segments.end(), s);
    out.add(nodes[n.node], s == no_index ? -1 : at - segments.begin(), holds(n));
  }
  for (const std::uint32_t i : listed(tie)) {
    const TiedNode& n = tie.nodes[i];
    const double search = n.search != 0 ? n.search : tie.search_distance;
    const double distance = n.segment != no_index   ? n.distance
                            : n.nearest != no_index ? n.nearest_distance
                                                    : INFINITY;
    out.untied.push_back({i, n.node, distance, search != 0 ? search : INFINITY,
                          short_reason(tie, n), why_text(tie, n)});
  }
}

/// TYPE10: each node to the nearest segment within the gap.
void add_lines(const Contact& c, const PageNodes& nodes, TieLines& out) {
  std::vector<const PenetrationRow*> nearest(c.secondary.size(), nullptr);
  for (const PenetrationRow& row : c.penetrations)
    if (const PenetrationRow*& known_row = nearest[row.secondary];
        known_row == nullptr || row.distance < known_row->distance)
      known_row = &row;
  std::int64_t segments = 0;
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    const bool found = nearest[i] != nullptr;
    if (found)
      for (const NodeIndex n : c.main[nearest[i]->main].nodes) out.main.push_back(nodes[n]);
    out.add(nodes[c.secondary[i].node], found ? segments++ : -1,
            found || !c.evaluated ? TiedState::tied : TiedState::lost);
  }
  for (const std::uint32_t i : untied_secondary(c)) {
    if (out.untied.size() == most_tie_rows) break;
    out.untied.push_back(
        {i, c.secondary[i].node, INFINITY, c.gapmin, "no segment",
         fmt::format("No segment is within the gap of {:.6g}: the node is not tied.", c.gapmin)});
  }
}

/// Calls use(node, close) for both ends of all lines; `close`: the node is not simply tied.
template <class Use>
void for_each_end(const Scene& scene, const Use& use) {
  for (const Tie& tie : scene.ties)
    for (const TiedNode& n : tie.nodes) {
      const bool close = holds(n) != TiedState::tied;
      use(n.node, close);
      if (const std::uint32_t s = segment_of(n); s != no_index)
        for (const NodeIndex corner : tie.main[s]) use(corner, close);
    }
}

// ---- crossed elements, moved nodes ------------------------------------------------------------

struct CrossingsBlock {
  using Row =
      std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, int, std::int64_t, std::uint32_t>;
  std::size_t total = 0;
  std::vector<Row> rows;
};
LINE_RECORD(CrossingsBlock, "crossings", "The block deck-crossed.", COLUMN("total", "", r.total),
            COLUMN("rows",
                   "Position of the contact, nodes of the edge by their number, kind and id of its "
                   "element, position of the segment",
                   r.rows));

struct MovedBlock {
  std::size_t total = 0;
  std::vector<std::tuple<std::uint32_t, double, double, double, std::int64_t>> rows;
};
LINE_RECORD(MovedBlock, "moved", "The block deck-moved: nodes that a repair has moved.",
            COLUMN("total", "", r.total),
            COLUMN("rows",
                   "Farthest first: node by its number, by how much, and the position of its part, "
                   "-1: none",
                   r.rows));

struct Moved {
  NodeIndex node = 0;
  std::array<double, 3> by{};
  double length() const { return std::hypot(by[0], by[1], by[2]); }
};

/// Moved nodes by id; farthest first, then in model order.
std::vector<Moved> moved_nodes(const Model& model, const Model& before) {
  std::vector<Moved> out;
  const deck::Nodes &now = model.nodes, &was = before.nodes;
  for (NodeIndex n = 0; n < now.size(); ++n) {
    const NodeIndex old = was.map.find(now.id[n]);
    if (old == no_index) continue;
    const Moved m{n, {now.x[n] - was.x[old], now.y[n] - was.y[old], now.z[n] - was.z[old]}};
    if (m.by != std::array<double, 3>{}) out.push_back(m);
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Moved& a, const Moved& b) { return a.length() > b.length(); });
  return out;
}

CrossingsBlock crossings_block(const Model& model, const std::vector<Crossing>& crossings,
                               const PageNodes& nodes) {
  CrossingsBlock out{crossings.size(), {}};
  for (const Crossing& c : std::span(crossings).first(std::min(crossings.size(), most_crossings)))
    out.rows.emplace_back(c.contact, nodes[c.edge[0]], nodes[c.edge[1]],
                          static_cast<int>(c.edge_kind),
                          model.family(c.edge_kind).id[c.edge_element], c.main);
  return out;
}

/// Position of the part of a node that has several as well, as `deck fix` names it; -1: none.
std::int64_t part_of(const Model& model, Connectivity& around, NodeIndex n) {
  for (const ElementKind kind : families_with_edges)
    for (const std::uint32_t e : around.elements(kind, n))
      if (const std::uint32_t part = model.family(kind).part[e]; part != no_index) return part;
  return -1;
}

MovedBlock moved_block(const Model& model, const std::vector<Moved>& all, const PageNodes& nodes) {
  MovedBlock out{all.size(), {}};
  Connectivity around(model);
  for (const Moved& m : std::span(all).first(std::min(all.size(), most_moved)))
    out.rows.emplace_back(nodes[m.node], m.by[0], m.by[1], m.by[2], part_of(model, around, m.node));
  return out;
}

// ---- time steps, first cycle ------------------------------------------------------------------

/// Smallest step of each node's elements; infinite if none.
std::vector<double> smallest_steps(const Model& model, const Mesh& mesh) {
  std::vector<double> out(model.nodes.size(), INFINITY);
  for (std::size_t k = 0; k < mesh.elements.size(); ++k) {
    const Elements& family = model.family(static_cast<ElementKind>(k));
    for (std::size_t e = 0; e < family.size(); ++e) {
      const double dt = mesh.elements[k].dt[e];
      if (!(dt > 0.0 && dt < 1e29)) continue;
      const NodeIndex* n = family.of(e);
      for (int i = 0; i < family.width; ++i)
        if (n[i] != no_index) out[n[i]] = std::min(out[n[i]], dt);
    }
  }
  return out;
}

double size_of(const std::array<double, 3>& force) { return norm(to_vec(force)); }

/// Infinity, written as null, if there is no limit.
double shown_step(double dt) { return dt < 1e30 ? dt : INFINITY; }

struct CyclePart {
  using Row = std::tuple<std::uint32_t, std::uint32_t, double, double>;
  const cycle::ContactOutcome& c;

  std::string because() const {
    if (!c.complete)
      return c.notes.empty() ? "too many pairs" : fmt::format("{}", fmt::join(c.notes, "; "));
    switch (c.step.source) {
      case cycle::StepLimit::Source::kinematic:
        return "closing speed";
      case cycle::StepLimit::Source::nodal:
        return "contact stiffness and nodal mass";
      case cycle::StepLimit::Source::velocity:
        return "speed of the interface";
      default:
        return "";
    }
  }
  std::vector<Row> rows() const {
    std::vector<const cycle::PairOutcome*> pairs;
    for (const cycle::PairOutcome& p : c.pairs) pairs.push_back(&p);
    keep_largest(pairs, most_pair_rows,
                 [](const cycle::PairOutcome* p) { return size_of(p->force); });
    std::vector<Row> out;
    for (const cycle::PairOutcome* p : pairs)
      out.emplace_back(p->at.secondary, p->at.main, size_of(p->force), p->k_nodal);
    return out;
  }
};
RECORD(CyclePart, "cycle_contact", "", COLUMN("active", "", r.c.active),
       COLUMN("complete", "", r.c.complete),
       COLUMN("dt", "null: no limit", shown_step(r.c.step.dt)),
       COLUMN("because", "What limits the step, or why it is not complete", r.because()),
       COLUMN("with_force", "Pairs", r.c.pairs_with_force),
       COLUMN("force", "Sum over pairs", r.c.totals.total_abs),
       COLUMN("largest", "", r.c.largest_force),
       COLUMN("acceleration", "", r.c.largest_acceleration),
       COLUMN("elastic", "Energy", r.c.totals.elastic_energy),
       COLUMN("rows", "Positions of secondary and main, force, stiffness", r.rows()));

struct CycleBlock {
  using Row = std::tuple<std::uint32_t, double, double, double, double, double>;
  const cycle::SceneOutcome& outcome;
  std::span<const cycle::ActedNode> acted;
  const PageNodes& numbers;
  const Model& model;

  std::optional<std::array<std::int64_t, 2>> element() const {
    const cycle::StructureStep& s = outcome.structure;
    if (s.element == no_index) return std::nullopt;
    return {{static_cast<int>(s.kind), model.family(s.kind).id[s.element]}};
  }
  std::vector<Row> nodes() const {
    std::vector<Row> out;
    for (const cycle::ActedNode& n : acted)
      out.emplace_back(numbers[n.node], n.force[0], n.force[1], n.force[2], n.stiffness,
                       shown_step(n.dt));
    return out;
  }
};
LINE_RECORD(CycleBlock, "first_cycle", "The block deck-cycle: forces with the deck's settings.",
            COLUMN("structure_dt", "null: nothing limits", shown_step(r.outcome.structure.dt)),
            COLUMN("contact_dt", "null: nothing limits", shown_step(r.outcome.contact_dt)),
            COLUMN("structure_element", "Kind and id of the one that limits", r.element()),
            COLUMN("contacts", "",
                   rows_of(r.outcome.contacts,
                           [](const cycle::ContactOutcome& c) { return CyclePart{c}; })),
            COLUMN("nodes", "By number: force on it, stiffness, time step (null: no limit)",
                   r.nodes()));

}  // namespace

void block_forms(SchemaDefinitions& definitions) {
  record_form<TieLines>(definitions);
  record_form<CrossingsBlock>(definitions);
  record_form<MovedBlock>(definitions);
  record_form<CycleBlock>(definitions);
}

std::vector<NodeIndex> use_nodes(const Scene& scene, PageNodes& nodes) {
  std::vector<NodeIndex> out;
  for_each_end(scene, [&](NodeIndex n, bool close) {
    if (close || !nodes.used(n)) out.push_back(n);
  });
  for_each_end(scene, [&](NodeIndex n, bool) { nodes.use(n); });
  // The sides of a TYPE10 are those of a contact.
  for (const Contact& c : scene.contacts)
    for (const std::uint32_t i : untied_secondary(c)) out.push_back(c.secondary[i].node);
  return out;
}

bool has_ties(const Scene& scene) {
  return !scene.ties.empty() || std::any_of(scene.contacts.begin(), scene.contacts.end(),
                                            [](const Contact& c) { return c.is_tied_contact(); });
}

std::string ties_block(const Scene& scene, const PageNodes& nodes) {
  Connectivity connectivity(*scene.model);
  return packed_text(block_json(Rows<TieLines>{[&](const auto& add) {
    const auto add_tie = [&](const auto& tie) {
      TieLines lines{*scene.model, connectivity};
      add_lines(tie, nodes, lines);
      add(lines);
    };
    for (const Tie& tie : scene.ties) add_tie(tie);
    for (const Contact& c : scene.contacts)
      if (c.is_tied_contact()) add_tie(c);
  }}));
}

std::string steps_block(const Model& model, const Mesh& mesh, const PageNodes& nodes) {
  const std::vector<double> step = smallest_steps(model, mesh);
  std::vector<double> sorted;
  for (const NodeIndex n : nodes.list())
    if (step[n] < INFINITY) sorted.push_back(step[n]);
  std::sort(sorted.begin(), sorted.end());
  double low = 0, high = 0, top = 0;
  if (!sorted.empty()) {
    low = sorted.front();
    top = sorted.back();
    high = sorted[static_cast<std::size_t>(covered * static_cast<double>(sorted.size() - 1))];
  }
  ByteStream out;
  const double ends[3] = {low, high, top};
  out.f64(ends);
  const double range = high > low ? std::log(high / low) : 1;
  for (const NodeIndex n : nodes.list()) {
    const double t = std::log(high / std::min(step[n], high)) / range;
    out.byte(step[n] < INFINITY ? 1 + static_cast<unsigned>(std::lround(step_classes * t)) : 0);
  }
  return std::move(out).text();
}

std::vector<DataBlock> optional_blocks(const HtmlInput& in, PageNodes& nodes) {
  const Model& model = *in.scene->model;
  std::vector<DataBlock> out;
  if (in.earlier != nullptr)
    out.push_back({"deck-earlier", [&in] { return packed_text(earlier_json(in)); }});
  if (in.before != nullptr) {
    std::vector<Moved> moved = moved_nodes(model, *in.before);
    for (const Moved& m : moved) nodes.use(m.node);
    out.push_back({"deck-moved", [&model, &nodes, moved = std::move(moved)] {
                     return packed_text(block_json(moved_block(model, moved, nodes)));
                   }});
  }
  if (!in.repair.empty()) out.push_back({"deck-repair", [&in] { return packed_text(in.repair); }});
  if (!in.changes.empty())
    out.push_back({"deck-changes", [&in] { return packed_text(in.changes); }});
  if (in.crossings != nullptr) {
    for (const Crossing& c : *in.crossings)
      for (const NodeIndex n : c.edge) nodes.use(n);
    out.push_back({"deck-crossed", [&in, &nodes, &model] {
                     return packed_text(block_json(crossings_block(model, *in.crossings, nodes)));
                   }});
  }
  for (const cycle::ActedNode& n : in.acted) nodes.use(n.node);
  if (in.cycle != nullptr)
    out.push_back({"deck-cycle", [&in, &nodes, &model] {
                     return packed_text(block_json(CycleBlock{*in.cycle, in.acted, nodes, model}));
                   }});
  return out;
}

}  // namespace deck::detail

std::vector<deck::cycle::ActedNode> deck::acted_in_page(const cycle::State& state,
                                                        const cycle::SceneOutcome& outcome) {
  std::vector<cycle::ActedNode> all = cycle::acted_nodes(state, outcome);
  detail::keep_largest(all, detail::most_nodes,
                       [](const cycle::ActedNode& n) { return detail::size_of(n.force); });
  return all;
}
