// The first cycle in the page: one entry per contact, one row per pair with a penetration or force.
#include <algorithm>
#include <cmath>

#include "report/html/parts.hpp"

namespace deck::detail {
namespace {

constexpr std::size_t most_pair_rows = 100000;  // per contact, largest force first
constexpr std::size_t most_nodes = 100000;      // largest force first

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

double size_of(const std::array<double, 3>& f) {
  return std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
}

void step_field(JsonWriter& j, std::string_view name, double dt) {
  j.key(name);
  dt < 1e30 ? j.value(dt) : j.null();
}

void write_contact(JsonWriter& j, const cycle::ContactOutcome& c) {
  j.begin_object(true).field("active", c.active).field("complete", c.complete);
  step_field(j, "dt", c.step.dt);
  std::string why;
  if (!c.complete)
    for (const std::string& note : c.notes) why += (why.empty() ? "" : "; ") + note;
  if (!c.complete && why.empty()) why = "too many pairs";
  j.field("because", c.complete ? because_of(c.step.source) : why);
  j.field("with_force", c.pairs_with_force);
  j.field("force", c.totals.total_abs).field("largest", c.largest_force);
  j.field("acceleration", c.largest_acceleration).field("elastic", c.totals.elastic_energy);
  std::vector<const cycle::PairOutcome*> rows;
  for (const cycle::PairOutcome& p : c.pairs) rows.push_back(&p);
  if (rows.size() > most_pair_rows) {
    std::stable_sort(rows.begin(), rows.end(),
                     [](const cycle::PairOutcome* a, const cycle::PairOutcome* b) {
                       return size_of(a->force) > size_of(b->force);
                     });
    rows.resize(most_pair_rows);
  }
  j.key("rows").begin_array(true);
  for (const cycle::PairOutcome* p : rows) {
    j.begin_array(true).value(p->at.secondary).value(p->at.main);
    j.value(size_of(p->force)).value(p->k_nodal).end_array();
  }
  j.end_array().end_object();
}

void write_nodes(JsonWriter& j, std::span<const cycle::ActedNode> all, const PageNodes& nodes) {
  j.key("nodes").begin_array(true);
  for (const cycle::ActedNode& n : all) {
    j.begin_array(true).value(nodes[n.node]);
    for (const double f : n.force) j.value(f);
    j.value(n.stiffness);
    n.dt < 1e30 ? j.value(n.dt) : j.null();
    j.end_array();
  }
  j.end_array();
}

}  // namespace

void use_nodes(std::span<const cycle::ActedNode> acted, PageNodes& nodes) {
  for (const cycle::ActedNode& n : acted) nodes.use(n.node);
}

std::string cycle_block(const cycle::SceneOutcome& outcome, std::span<const cycle::ActedNode> acted,
                        const PageNodes& nodes, const Model& model) {
  std::string out;
  JsonWriter j(out);
  j.begin_object(true);
  step_field(j, "structure_dt", outcome.structure.dt);
  step_field(j, "contact_dt", outcome.contact_dt);
  j.key("structure_element");
  if (const cycle::StructureStep& s = outcome.structure; s.element == no_index)
    j.null();
  else
    j.begin_array(true)
        .value(static_cast<int>(s.kind))
        .value(model.family(s.kind).id[s.element])
        .end_array();
  j.key("contacts").begin_array(true);
  for (const cycle::ContactOutcome& c : outcome.contacts) write_contact(j, c);
  j.end_array();
  write_nodes(j, acted, nodes);
  j.end_object();
  return packed_text(out);
}

}  // namespace deck::detail

std::vector<deck::cycle::ActedNode> deck::acted_in_page(const cycle::State& state,
                                                        const cycle::SceneOutcome& outcome) {
  std::vector<cycle::ActedNode> all = cycle::acted_nodes(state, outcome);
  if (all.size() <= detail::most_nodes) return all;
  std::stable_sort(all.begin(), all.end(),
                   [](const cycle::ActedNode& a, const cycle::ActedNode& b) {
                     return detail::size_of(a.force) > detail::size_of(b.force);
                   });
  return {all.begin(), all.begin() + detail::most_nodes};
}
