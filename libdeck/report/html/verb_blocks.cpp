// Blocks that only some verbs write: crossed elements, nodes that a repair has moved, time steps as
// colours, the first cycle.
#include <algorithm>
#include <cmath>

#include "model/shared/mesh.hpp"
#include "report/html/parts.hpp"

namespace deck::detail {
namespace {

constexpr std::size_t most_crossings = 20000;
constexpr std::size_t most_moved = 100000;      // farthest first
constexpr std::size_t most_pair_rows = 100000;  // per contact, largest force first
constexpr std::size_t most_nodes = 100000;      // largest force first
constexpr int step_classes = 254;               // a byte a node, and 0 for none
/// Share of the nodes that the scale covers: a few springs with steps a thousand times as large as
/// all others would leave one colour for the rest.
constexpr double covered = 0.98;

/// {"total": ..., "rows": [...]}; `write` writes one row, and no more than `most` are written.
template <class Row, class Write>
std::string rows_block(const std::vector<Row>& all, std::size_t most, const Write& write) {
  std::string out;
  JsonWriter j(out);
  j.begin_object(true).field("total", all.size()).key("rows").begin_array(true);
  for (std::size_t i = 0; i < std::min(all.size(), most); ++i) write(j, all[i]);
  j.end_array().end_object();
  return packed_text(out);
}

struct Moved {
  NodeIndex node = 0;
  std::array<double, 3> by{};
  double length() const { return std::hypot(by[0], by[1], by[2]); }
};

/// Nodes that stand elsewhere than before, by id; farthest first, equal ones in the order of the
/// model.
std::vector<Moved> moved_nodes(const Model& model, const Model& before) {
  std::vector<Moved> out;
  const Nodes &now = model.nodes, &was = before.nodes;
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

/// Of every node the smallest step of its elements; infinite where none has one.
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

const char* because_of(cycle::StepLimit::Source source) {
  switch (source) {
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

double size_of(const std::array<double, 3>& force) { return norm(to_vec(force)); }

/// Infinite, which is written as null, where there is no limit.
double shown_step(double dt) { return dt < 1e30 ? dt : INFINITY; }

void write_contact(JsonWriter& j, const cycle::ContactOutcome& c) {
  std::string why;
  if (!c.complete) {
    for (const std::string& note : c.notes) why += (why.empty() ? "" : "; ") + note;
    if (why.empty()) why = "too many pairs";
  }
  j.begin_object(true).field("active", c.active).field("complete", c.complete);
  j.field("dt", shown_step(c.step.dt));
  j.field("because", c.complete ? because_of(c.step.source) : why);
  j.field("with_force", c.pairs_with_force);
  j.field("force", c.totals.total_abs).field("largest", c.largest_force);
  j.field("acceleration", c.largest_acceleration).field("elastic", c.totals.elastic_energy);
  std::vector<const cycle::PairOutcome*> rows;
  for (const cycle::PairOutcome& p : c.pairs) rows.push_back(&p);
  keep_largest(rows, most_pair_rows, [](const cycle::PairOutcome* p) { return size_of(p->force); });
  j.key("rows").begin_array(true);
  for (const cycle::PairOutcome* p : rows)
    write_row(j, p->at.secondary, p->at.main, size_of(p->force), p->k_nodal);
  j.end_array().end_object();
}

}  // namespace

void use_nodes(const std::vector<Crossing>& crossings, PageNodes& nodes) {
  for (const Crossing& c : crossings)
    for (const NodeIndex n : c.edge) nodes.use(n);
}

std::string crossings_block(const Model& model, const std::vector<Crossing>& crossings,
                            const PageNodes& nodes) {
  return rows_block(crossings, most_crossings, [&](JsonWriter& j, const Crossing& c) {
    write_row(j, c.contact, nodes[c.edge[0]], nodes[c.edge[1]], static_cast<int>(c.edge_kind),
              model.family(c.edge_kind).id[c.edge_element], c.main);
  });
}

void use_moved(const Model& model, const Model& before, PageNodes& nodes) {
  for (const Moved& m : moved_nodes(model, before)) nodes.use(m.node);
}

std::string moved_block(const Model& model, const Model& before, const PageNodes& nodes) {
  return rows_block(moved_nodes(model, before), most_moved, [&](JsonWriter& j, const Moved& m) {
    write_row(j, nodes[m.node], m.by[0], m.by[1], m.by[2]);
  });
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

void use_nodes(std::span<const cycle::ActedNode> acted, PageNodes& nodes) {
  for (const cycle::ActedNode& n : acted) nodes.use(n.node);
}

std::string cycle_block(const cycle::SceneOutcome& outcome, std::span<const cycle::ActedNode> acted,
                        const PageNodes& nodes, const Model& model) {
  const cycle::StructureStep& structure = outcome.structure;
  std::string out;
  JsonWriter j(out);
  j.begin_object(true).field("structure_dt", shown_step(structure.dt));
  j.field("contact_dt", shown_step(outcome.contact_dt)).key("structure_element");
  if (structure.element == no_index)
    j.null();
  else
    write_row(j, static_cast<int>(structure.kind),
              model.family(structure.kind).id[structure.element]);
  j.key("contacts").begin_array(true);
  for (const cycle::ContactOutcome& c : outcome.contacts) write_contact(j, c);
  j.end_array().key("nodes").begin_array(true);
  for (const cycle::ActedNode& n : acted)
    write_row(j, nodes[n.node], n.force[0], n.force[1], n.force[2], n.stiffness, shown_step(n.dt));
  j.end_array().end_object();
  return packed_text(out);
}

}  // namespace deck::detail

std::vector<deck::cycle::ActedNode> deck::acted_in_page(const cycle::State& state,
                                                        const cycle::SceneOutcome& outcome) {
  std::vector<cycle::ActedNode> all = cycle::acted_nodes(state, outcome);
  detail::keep_largest(all, detail::most_nodes,
                       [](const cycle::ActedNode& n) { return detail::size_of(n.force); });
  return all;
}
