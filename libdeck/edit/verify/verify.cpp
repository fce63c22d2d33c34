// Evaluates a deck, and compares masses and time steps of two.
#include "edit/shared/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "edit/verify/verify_parts.hpp"
#include "inspect/shared/diff.hpp"
#include "model/shared/mesh.hpp"

namespace deck {
namespace {

/// 0 where nothing is known, or nothing limits: the same in all units.
double known(double v) { return std::isfinite(v) && v < 1e15 ? v : 0.0; }

}  // namespace

VerifyRelation relation_of(std::string_view step, const std::vector<LossEntry>& losses) {
  VerifyRelation r;
  r.new_ids = step == "--renumber";
  r.extract = step == "--extract-contacts";
  r.expanded = step == "--expand-type19";
  r.cells = step == "--units" || step == "--version";
  for (const LossEntry& e : losses) {
    r.rounded = r.rounded || e.loss == Loss::approximated;
    if ((e.loss != Loss::dropped && e.loss != Loss::undecided) || e.without_effect) continue;
    r.cells = false;
    if (e.keyword.starts_with("/INTER/")) r.lossy.insert(e.id);
    r.lossy_defaults = r.lossy_defaults || e.keyword.starts_with("/DEFAULT/INTER");
  }
  return r;
}

namespace detail {

Behaviour behaviour_of(const LoadedDeck& deck) {
  const Scene& scene = deck.scene();
  const FirstCycle& cycle = deck.cycle();
  const Mesh& mesh = deck.mesh();
  Behaviour out{deck, scene, cycle.state, cycle.outcome, {}, mesh.beam_factors, {}, 0};
  for (std::size_t k = 0; k < verified_kinds.size(); ++k)
    for (const double dt : mesh.of(verified_kinds[k]).dt) out.steps[k].push_back(known(dt));
  for (const PartFigures& part : mesh.parts) out.part_mass.push_back(known(part.mass));
  const Nodes& nodes = deck.model().nodes;
  for (const auto* axis : {&nodes.x, &nodes.y, &nodes.z})
    for (const double x : *axis)
      if (std::isfinite(x)) out.extent = std::max(out.extent, std::abs(x));
  return out;
}

DeckComparison::DeckComparison(const Behaviour& a, const Behaviour& b, const VerifyRelation& r,
                               std::vector<LossEntry>* accept)
    : before(a),
      after(b),
      relation(r),
      accepted(accept),
      from(a.context.deck().begin.working),
      to(b.context.deck().begin.working),
      // What a cell of ten columns holds, or one of twenty.
      tolerance(r.rounded ? 1e-4 : 1e-7) {
  const Nodes &was = before.context.model().nodes, &now = after.context.model().nodes;
  if (!relation.extract || was.size() == now.size()) return;
  for (const std::int64_t id : now.id) old_nodes_.push_back(was.map.find(id));
}

double DeckComparison::factor(int mass, int length, int time) const {
  return conversion_factor(from, to,
                           {static_cast<std::int8_t>(mass), static_cast<std::int8_t>(length),
                            static_cast<std::int8_t>(time), 0});
}

NodeIndex DeckComparison::old_node(NodeIndex node) const {
  return node == no_index || old_nodes_.empty() ? node : old_nodes_[node];
}

std::string DeckComparison::node_name(NodeIndex node) const {
  return "node " + std::to_string(after.context.model().node_id(node));
}

bool DeckComparison::same(double was, double now, double unit, double slack) const {
  const auto endless = [](double x) { return !(std::abs(x) < 1e29); };
  const double expected = was * unit;
  return now == expected || (endless(was) && endless(now)) ||
         std::abs(now - expected) <= tolerance * std::abs(expected) + slack;
}

DeckComparison::Difference DeckComparison::number(const std::string& what, double was, double now,
                                                  double unit, double slack) const {
  if (same(was, now, unit, slack)) return {};
  const double expected = was * unit;
  return fmt::format("{} is {:.9g}, expected {:.9g}{}", what, now, expected,
                     unit == 1 ? "" : fmt::format(" ({:.9g} in the units before)", was));
}

/// What springs count with in contacts: of some, no conversion of the working units can keep it.
/// Only asked where a contact has become another one; a spring that is in none does no harm.
DeckComparison::Difference DeckComparison::springs() const {
  const auto &was = before.context.model().properties, &now = after.context.model().properties;
  if (relation.extract) return {};
  if (was.size() != now.size())
    return fmt::format("the deck has {} properties, expected {}", now.size(), was.size());
  const double unit = factor(1, 0, -2);
  for (std::size_t i = 0; i < now.size(); ++i)
    for (std::size_t k = 0; k < now[i].stiffness.size(); ++k)
      if (!same(was[i].stiffness[k], now[i].stiffness[k], unit))
        return *number(fmt::format("the stiffness with which springs of {}/{} count in contacts",
                                   now[i].type, now[i].id),
                       was[i].stiffness[k], now[i].stiffness[k], unit) +
               "; the solver takes K / A for it, and one of the two is a force here, so that it "
               "depends on the units (--keep-working-units keeps it)";
  return {};
}

DeckComparison::Difference DeckComparison::masses() const {
  const auto &was = before.state.mass, &now = after.state.mass;
  if (relation.extract) return {};  // elements that no contact needs are left out
  if (was.size() != now.size())
    return fmt::format("the deck has {} nodes, expected {}", now.size(), was.size());
  const double heaviest = was.empty() ? 0 : *std::max_element(was.begin(), was.end());
  const double unit = factor(1, 0, 0);
  const double slack = tolerance * heaviest * unit;
  for (NodeIndex n = 0; n < now.size(); ++n)
    if (!same(was[n], now[n], unit, slack))
      return number("the mass of " + node_name(n), was[n], now[n], unit, slack);
  const auto &parts = before.part_mass, &parts_now = after.part_mass;
  if (parts.size() != parts_now.size())
    return fmt::format("the deck has {} parts, expected {}", parts_now.size(), parts.size());
  for (std::size_t p = 0; p < parts_now.size(); ++p)
    if (!same(parts[p], parts_now[p], unit, slack))
      return number(fmt::format("the mass of part {}", after.context.model().parts[p].id), parts[p],
                    parts_now[p], unit, slack);
  return {};
}

DeckComparison::Difference DeckComparison::time_steps() const {
  if (relation.extract) return {};
  const double unit = factor(0, 0, 1);
  for (std::size_t k = 0; k < verified_kinds.size(); ++k) {
    const auto &was = before.steps[k], &now = after.steps[k];
    const Elements& family = after.context.model().family(verified_kinds[k]);
    if (was.size() != now.size())
      return fmt::format("the deck has {} elements of one kind, expected {}", now.size(),
                         was.size());
    for (std::size_t e = 0; e < now.size(); ++e) {
      if (same(was[e], now[e], unit)) continue;
      auto d =
          number(fmt::format("the time step of element {}", family.id[e]), was[e], now[e], unit);
      if (verified_kinds[k] == ElementKind::beam)
        d = beam_step(static_cast<std::uint32_t>(e), std::move(d));
      if (d) return d;
    }
  }
  if (!relation.lossy.empty() || relation.lossy_defaults) return {};
  return number("the time step of the contacts", before.cycle.contact_dt, after.cycle.contact_dt,
                unit);
}

/// The solver multiplies the stiffness of a beam by length / (a + s) where that is above 1, and a
/// and s have no unit. A step that differs by this alone is no fault of a conversion.
DeckComparison::Difference DeckComparison::beam_step(std::uint32_t beam,
                                                     Difference difference) const {
  const auto without = [&](const Behaviour& of) {
    return of.steps.back()[beam] * std::sqrt(of.beam_factors[beam]);
  };
  if (!same(without(before), without(after), factor(0, 0, 1))) return difference;
  constexpr std::string_view why =
      "the solver's own formula of a beam's stiffness, length / (a + s), depends on the unit of "
      "length";
  if (accepted == nullptr)
    return *difference + "; " + std::string(why) +
           " (--keep-working-units keeps it, --allow-loss accepts it)";
  const Model& model = after.context.model();
  const Block& block = *model.element_blocks[model.beam.block[beam]].block;
  LossEntry entry = loss_entry(after.context.deck(), Loss::approximated, block, {});
  entry.id = model.beam.id[beam];
  entry.field = "time step";
  entry.old_text = fmt::format("{:.6g}", before.steps.back()[beam] * factor(0, 0, 1));
  entry.new_text = fmt::format("{:.6g}", after.steps.back()[beam]);
  entry.note = why;
  accepted->push_back(std::move(entry));
  return {};
}

/// Every cell, function and member of a group, as `deck diff` compares them.
DeckComparison::Difference DeckComparison::cells() const {
  if (!relation.cells) return {};
  const DeckDiff diff = diff_decks({before.context}, {after.context}, MatchBy::id,
                                   relation.rounded ? tolerance : diff_tolerance);
  if (diff.changes.empty()) return {};
  const Change& c = diff.changes.front();
  const std::string others =
      diff.changes.size() == 1 ? "" : fmt::format(" ({} differences in all)", diff.changes.size());
  if (c.field.empty())
    return fmt::format("{}/{} is {}{}", c.keyword, c.id, to_string(c.kind), others);
  return fmt::format("{} of {}/{} means something else{}", c.field, c.keyword, c.id, others);
}

}  // namespace detail

std::optional<std::string> first_difference(const LoadedDeck& before, const LoadedDeck& after,
                                            const VerifyRelation& relation,
                                            std::vector<LossEntry>* accepted) {
  const detail::Behaviour was = detail::behaviour_of(before), now = detail::behaviour_of(after);
  const detail::DeckComparison c(was, now, relation, accepted);
  if (auto d = c.values()) return d;
  if (auto d = c.contacts()) {
    const auto cause = c.springs();
    return cause ? cause : d;
  }
  if (auto d = c.masses()) return d;
  if (auto d = c.time_steps()) return d;
  return c.cells();
}

}  // namespace deck
