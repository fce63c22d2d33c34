// Evaluates a deck; compares masses and time steps of two decks.
#include "edit/shared/conversion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "edit/verify/deck_comparison.hpp"
#include "inspect/shared/diff.hpp"
#include "model/shared/mesh.hpp"

namespace deck {
namespace {

/// 0 for unknown values and for steps without limit: independent of units.
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
namespace {

/// Items in deck order; `key`: the block of an item, or its first line.
template <class Key>
std::vector<std::uint32_t> as_written(std::size_t size, const Key& key) {
  std::vector<std::uint32_t> out(size);
  std::iota(out.begin(), out.end(), 0U);
  std::stable_sort(out.begin(), out.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  return out;
}

std::vector<std::uint32_t> written_items(std::vector<BulkBlock> runs) {
  std::stable_sort(runs.begin(), runs.end(),
                   [](const BulkBlock& a, const BulkBlock& b) { return a.block < b.block; });
  std::vector<std::uint32_t> out;
  for (const BulkBlock& run : runs)
    for (std::uint32_t i = 0; i < run.count; ++i) out.push_back(run.first + i);
  return out;
}

std::vector<std::uint32_t> written_elements(const Model& model, const Elements& family) {
  std::vector<BulkBlock> runs;
  for (std::uint32_t r = 0; r < model.element_blocks.size(); ++r) {
    const BulkBlock& run = model.element_blocks[r];
    if (run.count > 0 && run.first < family.size() && family.block[run.first] == r)
      runs.push_back(run);
  }
  return written_items(std::move(runs));
}

std::vector<std::uint32_t> written_parts(const LoadedDeck& loaded) {
  std::map<std::pair<std::uint32_t, std::uint64_t>, const Block*> block_at;
  for (const Block& b : loaded.deck().blocks)
    block_at.emplace(std::pair(b.header_span.file, b.header_span.offset), &b);
  const std::vector<Part>& parts = loaded.model().parts;
  return as_written(parts.size(), [&](std::uint32_t p) {
    return block_at.at({parts[p].span.file, parts[p].span.offset});
  });
}

OldIndices partners(const std::vector<std::uint32_t>& was, const std::vector<std::uint32_t>& now) {
  OldIndices out;
  if (was == now || was.size() != now.size()) return out;
  out.old.resize(now.size());
  for (std::size_t k = 0; k < now.size(); ++k) out.old[now[k]] = was[k];
  return out;
}

}  // namespace

DeckStart behaviour_of(const LoadedDeck& deck) {
  const Scene& scene = deck.scene();
  const FirstCycle& cycle = deck.cycle();
  const Mesh& mesh = deck.mesh();
  DeckStart out{deck, scene, cycle.state, cycle.outcome, {}, mesh.beam_factors, {}, 0};
  for (std::size_t k = 0; k < verified_kinds.size(); ++k)
    for (const double dt : mesh.of(verified_kinds[k]).dt) out.steps[k].push_back(known(dt));
  for (const PartFigures& part : mesh.parts) out.part_mass.push_back(known(part.mass));
  const Nodes& nodes = deck.model().nodes;
  for (const auto* axis : {&nodes.x, &nodes.y, &nodes.z})
    for (const double x : *axis)
      if (std::isfinite(x)) out.extent = std::max(out.extent, std::abs(x));
  return out;
}

DeckComparison::DeckComparison(const DeckStart& a, const DeckStart& b, const VerifyRelation& r,
                               std::vector<LossEntry>* accept)
    : before(a),
      after(b),
      relation(r),
      accepted(accept),
      from(a.context.deck().begin.working),
      to(b.context.deck().begin.working),
      // precision of a cell of ten or twenty columns
      tolerance(r.rounded ? 1e-4 : 1e-7) {
  const Model &was = before.context.model(), &now = after.context.model();
  nodes_ = partners(written_items(was.node_blocks), written_items(now.node_blocks));
  if (relation.extract && was.nodes.size() != now.nodes.size())
    for (const std::int64_t id : now.nodes.id) nodes_.old.push_back(was.nodes.map.find(id));
  const auto by_block = [](const auto& list) {
    return as_written(list.size(), [&](std::uint32_t i) { return list[i]->block; });
  };
  interfaces_ =
      partners(by_block(before.context.interfaces().all), by_block(after.context.interfaces().all));
  const auto by_interface = [](const std::vector<Contact>& list) {
    return as_written(list.size(), [&](std::uint32_t i) { return list[i].inter->block; });
  };
  contacts_ = partners(by_interface(before.scene.contacts), by_interface(after.scene.contacts));
}

double DeckComparison::factor(int mass, int length, int time) const {
  return conversion_factor(from, to,
                           {static_cast<std::int8_t>(mass), static_cast<std::int8_t>(length),
                            static_cast<std::int8_t>(time), 0});
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

/// Contact stiffness of springs: some cannot keep it under new working units. Called only after a
/// contact differs, because other springs do no harm.
DeckComparison::Difference DeckComparison::springs() const {
  const auto &was = before.context.model().properties, &now = after.context.model().properties;
  if (relation.extract) return {};
  if (was.size() != now.size())
    return fmt::format("the deck has {} properties, expected {}", now.size(), was.size());
  const double unit = factor(1, 0, -2);
  const auto written = [](const std::vector<Property>& list) {
    return as_written(list.size(), [&](std::uint32_t i) { return list[i].block; });
  };
  const OldIndices partner = partners(written(was), written(now));
  for (std::size_t i = 0; i < now.size(); ++i)
    for (std::size_t k = 0; k < now[i].stiffness.size(); ++k)
      if (!same(was[partner[i]].stiffness[k], now[i].stiffness[k], unit))
        return *number(fmt::format("the stiffness with which springs of {}/{} count in contacts",
                                   now[i].type, now[i].id),
                       was[partner[i]].stiffness[k], now[i].stiffness[k], unit) +
               "; the solver takes K / A for it, and one of the two is a force here, so that it "
               "depends on the units (--keep-working-units keeps it)";
  return {};
}

DeckComparison::Difference DeckComparison::masses() const {
  const auto &was = before.state.mass, &now = after.state.mass;
  if (relation.extract) return {};  // elements without contact are left out
  if (was.size() != now.size())
    return fmt::format("the deck has {} nodes, expected {}", now.size(), was.size());
  const double heaviest = was.empty() ? 0 : *std::max_element(was.begin(), was.end());
  const double unit = factor(1, 0, 0);
  const double slack = tolerance * heaviest * unit;
  for (NodeIndex n = 0; n < now.size(); ++n)
    if (const double old = was[old_node(n)]; !same(old, now[n], unit, slack))
      return number("the mass of " + node_name(n), old, now[n], unit, slack);
  const auto &parts = before.part_mass, &parts_now = after.part_mass;
  if (parts.size() != parts_now.size())
    return fmt::format("the deck has {} parts, expected {}", parts_now.size(), parts.size());
  const OldIndices partner = partners(written_parts(before.context), written_parts(after.context));
  for (std::size_t p = 0; p < parts_now.size(); ++p)
    if (const double old = parts[partner[p]]; !same(old, parts_now[p], unit, slack))
      return number(fmt::format("the mass of part {}", after.context.model().parts[p].id), old,
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
    const Model& model = before.context.model();
    const OldIndices partner = partners(written_elements(model, model.family(verified_kinds[k])),
                                        written_elements(after.context.model(), family));
    for (std::size_t e = 0; e < now.size(); ++e) {
      const auto old = partner[e];
      if (same(was[old], now[e], unit)) continue;
      auto d =
          number(fmt::format("the time step of element {}", family.id[e]), was[old], now[e], unit);
      if (verified_kinds[k] == ElementKind::beam)
        d = beam_step(old, static_cast<std::uint32_t>(e), std::move(d));
      if (d) return d;
    }
  }
  if (!relation.lossy.empty() || relation.lossy_defaults) return {};
  return number("the time step of the contacts", before.cycle.contact_dt, after.cycle.contact_dt,
                unit);
}

/// The solver multiplies the stiffness of a beam by length / (a + s) if that exceeds 1; a and s
/// have no unit. Accepts a difference of the step by this alone.
DeckComparison::Difference DeckComparison::beam_step(std::uint32_t old, std::uint32_t beam,
                                                     Difference difference) const {
  const auto without = [&](const DeckStart& of, std::uint32_t at) {
    return of.steps.back()[at] * std::sqrt(of.beam_factors[at]);
  };
  if (!same(without(before, old), without(after, beam), factor(0, 0, 1))) return difference;
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
  entry.old_text = fmt::format("{:.6g}", before.steps.back()[old] * factor(0, 0, 1));
  entry.new_text = fmt::format("{:.6g}", after.steps.back()[beam]);
  entry.note = why;
  accepted->push_back(std::move(entry));
  return {};
}

/// Cells, functions and members of groups, compared as in `deck diff`.
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
  const detail::DeckStart was = detail::behaviour_of(before), now = detail::behaviour_of(after);
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
