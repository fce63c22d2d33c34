// Effects of other options on nodal sums, in the solver's order: added masses, walls, rigid bodies,
// rigid elements, ties, damping; then the steps. A body comes before the body that has its main
// node as secondary node, so masses and stiffness move upwards. Not-a-number marks values whose
// rule is unknown; it spreads to everything that is computed from them.
#include "model/mesh/mesh_parts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "deck/keyword.hpp"
#include "deck/model.hpp"
#include "deck/text.hpp"
#include "keyword/shared/solver_order.hpp"

namespace deck::detail {
namespace {

/// Smallest eigenvalue of a symmetric tensor xx yy zz xy yz zx.
double smallest_principal(const std::array<double, 6>& t) {
  const double mean = (t[0] + t[1] + t[2]) / 3.0;
  const double off = t[3] * t[3] + t[4] * t[4] + t[5] * t[5];
  const double a = t[0] - mean, b = t[1] - mean, c = t[2] - mean;
  const double p = std::sqrt((a * a + b * b + c * c + 2.0 * off) / 6.0);
  if (!(p > 0.0)) return mean;
  const double det =
      a * (b * c - t[4] * t[4]) - t[3] * (t[3] * c - t[4] * t[5]) + t[5] * (t[3] * t[4] - b * t[5]);
  const double r = std::clamp(det / (2.0 * p * p * p), -1.0, 1.0);
  return mean + 2.0 * p * std::cos(std::acos(r) / 3.0 + 2.0 * std::numbers::pi / 3.0);
}

}  // namespace

NodeSums::NodeSums(const Model& model, const MeshOptions& options, NodeFigures& to)
    : model_(model),
      options_(options),
      to_(to),
      bodies_(rigid_bodies(model)),
      on_body_(model.nodes.size(), 0) {
  const std::size_t n = model.nodes.size();
  to_.mass.assign(n, 0.0);
  to_.inertia.assign(n, 0.0);
  to_.stiffness.assign(n, no_stiffness);
  to_.rotational_stiffness.assign(n, no_stiffness);
  for (const RigidBody& b : bodies_)
    for (const NodeIndex s : b.nodes) on_body_[s] = 1;
}

void NodeSums::complete(const Places& places) {
  added_masses();
  walls();
  to_.lumped_mass = to_.mass;
  std::map<NodeIndex, std::vector<std::size_t>> below;
  for (std::size_t i = 0; i < bodies_.size(); ++i) below[bodies_[i].main].push_back(i);
  std::vector<char> done(bodies_.size(), 0);
  const auto visit = [&](auto&& self, std::size_t i) -> void {
    if (done[i] != 0) return;
    done[i] = 1;
    for (const NodeIndex s : bodies_[i].nodes)
      if (const auto it = below.find(s); it != below.end())
        for (const std::size_t k : it->second) self(self, k);
    if (!bodies_[i].lagrange && bodies_[i].main != no_index) body(bodies_[i], places);
  };
  for (std::size_t i = 0; i < bodies_.size(); ++i) visit(visit, i);
  if (massless_ > 0) left_out.push_back({"steps of nodes", "a rigid body without mass", massless_});
  rigid_elements(places);
  ties(options_.ties, places);
  damping();
  steps();
}

/// /ADMAS types: 0 adds the mass to each node of the group, 1 spreads it evenly, 5 names nodes; 10
/// and 15 are like 0 and 5 with inertia, without negative values.
void NodeSums::added_masses() {
  const Deck& deck = *model_.deck;
  for (const Block* const at : in_solver_order(deck, "/ADMAS")) {
    const Block& block = *at;
    if (!block.header.starts_with("/ADMAS/") || block.schema == nullptr || block.opaque) continue;
    const std::string type(block.header.substr(7, block.header.find('/', 7) - 7));
    const auto left = [&](const char* why) {
      left_out.push_back(
          {std::string(block.header) + " (" + deck.sources.where(block.header_span) + ")", why, 1});
    };
    if (type != "0" && type != "1" && type != "5" && type != "10" && type != "15") {
      left("only types 0, 1, 5, 10 and 15 of added mass are evaluated");
      continue;
    }
    const DecodedBlock d = decode(deck, block);
    for (const DecodedCard& card : d.cards) {
      double m = 0, j = 0;
      std::int64_t id = 0;
      for (const Cell& c : card.cells) {
        if (c.field->name == "MASS") m = working_value(deck, d, c);
        if (c.field->name == "IXX") j = std::max(working_value(deck, d, c), 0.0);
        if (c.field->name == "grnd_ID" || c.field->name == "node_ID") id = c.integer;
      }
      if (id == 0) continue;
      if (type.size() > 1) m = std::max(m, 0.0);
      const auto add = [&](NodeIndex n) {
        if (n == no_index) return;
        to_.mass[n] += m;
        to_.inertia[n] += j;
      };
      if (type.back() == '5') {
        add(model_.find_node(deck.shifted_id(block, "node", id)));
        continue;
      }
      const NodeSet* set = group_of(model_, block, id);
      if (set == nullptr || set->nodes.empty()) {
        left("its node group does not exist");
        continue;
      }
      if (type == "1") m /= static_cast<double>(set->nodes.size());
      for (const NodeIndex n : set->nodes) add(n);
    }
  }
}

/// Unknown: the effect of a moving wall's mass on its node, and the body of a rigid part.
void NodeSums::walls() {
  const Deck& deck = *model_.deck;
  std::uint64_t count = 0, rigid = 0;
  for (const Block& block : deck.blocks)
    if (block.header.starts_with("/PART/") && decode(deck, block).integer("Irigid") == 1) ++rigid;
  if (rigid > 0)
    left_out.push_back(
        {"masses and steps of nodes", "the solver makes a rigid body of a part", rigid});
  for (const Block& block : deck.blocks) {
    if (!block.header.starts_with("/RWALL/") || block.schema == nullptr || block.opaque) continue;
    const DecodedBlock d = decode(deck, block);
    const NodeIndex n = node_of(model_, block, d.integer("node_ID"));
    if (n == no_index || working_value(deck, d, "Mass") == 0.0) continue;
    to_.mass[n] = not_known;
    ++count;
  }
  if (count > 0) left_out.push_back({"masses of nodes", "a moving wall has a mass", count});
}

/// The stiffness of the secondary nodes is added to the main node, which has the mass of the body;
/// with ICoG 4 only the mass on the card.
void NodeSums::body(const RigidBody& b, const Places& places) {
  if (b.nodes.empty()) return;
  const Vec main = places.at(b.main);
  const double own = to_.mass[b.main];
  const double added = own + b.mass, share = b.centre == 4 ? 0.0 : 1.0;
  double mass = 0;
  Vec first{};
  for (const NodeIndex n : b.nodes) {
    mass += share * to_.mass[n];
    first = first + to_.mass[n] * (places.at(n) - main);
  }
  Vec centre = main;
  if (b.centre == 1 && mass + added > 0.0) centre = main + (1.0 / (mass + added)) * first;
  if (b.centre == 2 && mass > 0.0) centre = main + (1.0 / mass) * first;
  std::array<double, 6> inertia = b.inertia;
  double k = 0, kr = 0, spin = to_.inertia[b.main];
  for (const NodeIndex n : b.nodes) {
    const Vec d = places.at(n) - centre;
    add_point(inertia, share * to_.mass[n], d);
    spin += share * to_.inertia[n];
    k += to_.stiffness[n];
    kr += to_.rotational_stiffness[n] + to_.stiffness[n] * dot(d, d);
    to_.stiffness[n] = to_.rotational_stiffness[n] = no_stiffness;
  }
  if (b.centre == 1) add_point(inertia, added, main - centre);
  for (std::size_t i = 0; i < 3; ++i) inertia[i] += spin;
  to_.mass[b.main] = mass + added;
  to_.inertia[b.main] =
      b.spherical ? (inertia[0] + inertia[1] + inertia[2]) / 3.0 : smallest_principal(inertia);
  to_.stiffness[b.main] += k;
  to_.rotational_stiffness[b.main] += kr;
  if (b.centre == 4) to_.mass[b.main] = std::max(to_.mass[b.main], 1e-20);
  if (to_.mass[b.main] != 0.0) return;
  // The solver refuses the body or gives it its own mass.
  to_.mass[b.main] = to_.inertia[b.main] = not_known;
  ++massless_;
}

void NodeSums::forget(NodeIndex n, std::uint64_t& count) {
  if (n == no_index) return;
  if (!std::isnan(to_.stiffness[n])) ++count;
  to_.mass[n] = to_.inertia[n] = to_.stiffness[n] = to_.rotational_stiffness[n] = not_known;
}

/// The main node gets the sums of the secondary nodes, through rigid arms.
void NodeSums::rigid_element(const RigidElement& e, const Places& places, std::uint64_t& left) {
  constexpr unsigned translations = 0b000111, rotations = 0b111000;
  if (e.main == no_index) return;
  const unsigned moves = e.directions & translations, turns = e.directions & rotations;
  const bool whole = (moves == 0 || moves == translations) && (turns == 0 || turns == rotations);
  if (!whole || (moves == 0 && turns != 0)) {
    // Only some directions: the solver's rule is unknown.
    forget(e.main, left);
    for (const NodeIndex n : e.nodes) forget(n, left);
    return;
  }
  if (moves == 0) return;
  const Vec main = places.at(e.main);
  for (const NodeIndex n : e.nodes) {
    const Vec arm = places.at(n) - main;
    const double d = dot(arm, arm), m = to_.mass[n], k = to_.stiffness[n];
    to_.mass[e.main] += m;
    to_.stiffness[e.main] += k;
    to_.inertia[e.main] += 2.0 * m * d + (turns != 0 ? to_.inertia[n] : 0.0);
    to_.rotational_stiffness[e.main] += k * d + (turns != 0 ? to_.rotational_stiffness[n] : 0.0);
    to_.stiffness[n] = no_stiffness;
    if (turns != 0) to_.rotational_stiffness[n] = no_stiffness;
  }
}

void NodeSums::rigid_elements(const Places& places) {
  std::uint64_t count = 0;
  for (const Block& block : model_.deck->blocks) {
    if (block.schema == nullptr || block.opaque || block.schema->keyword != "/RBE2") continue;
    if (const auto element = detail::rigid_element(model_, block))
      rigid_element(*element, places, count);
  }
  if (count > 0)
    left_out.push_back({"steps of nodes", "a rigid element /RBE2 changes them", count});
}

/// The smallest nodal step that Engine files ask to keep; 0: none.
double NodeSums::least_step() const {
  if (options_.engine == nullptr) return 0.0;
  double most = 0.0;
  for (const EngineFile& file : options_.engine->files)
    for (const EngineBlock& b : file.blocks) {
      if (b.part(0) != "DT" || b.part(1) != "NODA" || b.lines.empty()) continue;
      const auto cells = engine_cells(model_.deck->sources, b.lines.front());
      if (cells.size() < 2) continue;
      const RealCell v = read_real(model_.deck->sources.text(cells[1]));
      if (v.status == NumberStatus::ok) most = std::max(most, v.value);
    }
  return most;
}

/// /DAMP: stiffness increases as damping shortens the step.
void NodeSums::damping() {
  if (model_.selections == nullptr) return;
  const Deck& deck = *model_.deck;
  for (const Block& block : deck.blocks) {
    if (block.schema == nullptr || block.schema->keyword != "/DAMP" || block.opaque) continue;
    const DecodedBlock d = decode(deck, block);
    const NodeSet* set = group_of(model_, block, d.integer("grnod_id"));
    double alpha = 0, beta = 0;
    for (const DecodedCard& card : d.cards)
      for (const Cell& c : card.cells) {
        const double v = working_value(deck, d, c);
        if (c.field->name.starts_with("Alpha")) alpha = std::max(alpha, v);
        if (c.field->name.starts_with("Beta")) beta = std::max(beta, v);
      }
    if (set == nullptr || (alpha <= 0.0 && beta <= 0.0)) continue;
    damp(*set, alpha, beta);
  }
}

void NodeSums::damp(const NodeSet& group, double alpha, double beta) {
  double shortest = no_step;
  bool known = true;
  for (const NodeIndex n : group.nodes) {
    if (n == no_index) continue;
    const double dt = step(n);
    known = known && !std::isnan(dt);
    if (dt < shortest) shortest = dt;
  }
  beta = std::min(beta, shortest);
  const double least = least_step();
  std::uint64_t left = 0;
  for (const NodeIndex n : group.nodes) {
    if (n == no_index || on_body_[n] != 0) continue;
    const double dt = std::max(step(n), least), x = beta / dt + 0.5 * alpha * dt;
    if (!known) {
      ++left;
      to_.stiffness[n] = to_.rotational_stiffness[n] = not_known;
    } else if (dt < no_step) {
      const double f = damping_factor(x) * damping_factor(x);
      to_.stiffness[n] /= f;
      to_.rotational_stiffness[n] /= f;
    }
  }
  if (left > 0)
    left_out.push_back(
        {"stiffness of nodes", "damping /DAMP follows from steps that are not computed", left});
}

double NodeSums::step(std::size_t i) const {
  const double m = to_.mass[i], k = to_.stiffness[i], j = to_.inertia[i],
               r = to_.rotational_stiffness[i];
  if (std::isnan(m) || std::isnan(k) || std::isnan(j) || std::isnan(r)) return not_known;
  double least = 1e60;
  if (m != 0.0 && k > no_stiffness) least = std::min(least, m / k);
  if (j != 0.0) least = std::min(least, j / r);
  return least < 1e60 ? std::sqrt(2.0 * least) : no_step;
}

void NodeSums::steps() {
  to_.dt.resize(to_.mass.size());
  for (std::size_t i = 0; i < to_.dt.size(); ++i) to_.dt[i] = step(i);
}

}  // namespace deck::detail
