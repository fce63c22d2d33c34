// Compares contacts of two decks (sides, gaps, stiffness, penetrations, actions, forces) and
// effective values of their interfaces.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "contact/shared/sides.hpp"
#include "deck/model.hpp"
#include "edit/verify/deck_comparison.hpp"

namespace deck::detail {
namespace {

std::string contact_name(const Contact& c) {
  return fmt::format("interface {}{}", c.inter->id,
                     c.inter->type == 19 ? fmt::format(" ({})", to_string(c.role)) : "");
}

std::vector<NodeIndex> side_nodes(const Contact& c, bool main) {
  std::vector<NodeIndex> out;
  if (c.kind == ContactKind::edge_edge)
    for (const ContactEdge& e : main ? c.main_edges : c.secondary_edges)
      out.insert(out.end(), e.nodes.begin(), e.nodes.end());
  else if (main)
    for (const MainSegment& s : c.main) out.insert(out.end(), s.nodes.begin(), s.nodes.end());
  else
    for (const SecondaryNode& s : c.secondary) out.push_back(s.node);
  return out;
}

/// Per contact of the second deck its index in the first; no_index if it has none.
std::vector<std::uint32_t> partners(const DeckComparison& c) {
  const auto &was = c.before.scene.contacts, &now = c.after.scene.contacts;
  std::vector<std::uint32_t> out(now.size(), no_index);
  const bool by_place = !c.relation.extract && !c.relation.expanded;
  std::vector<bool> taken(was.size());
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (by_place) {
      if (was.size() == now.size()) out[i] = c.old_contact(i);
      continue;
    }
    for (std::uint32_t k = 0; k < was.size(); ++k) {
      if (taken[k] || was[k].type != now[i].type || was[k].kind != now[i].kind) continue;
      const bool same = was[k].inter->id == now[i].inter->id && was[k].role == now[i].role &&
                        was[k].inter->type == now[i].inter->type;
      const bool part = c.relation.expanded && was[k].inter->type == 19 &&
                        side_nodes(was[k], true) == side_nodes(now[i], true) &&
                        side_nodes(was[k], false) == side_nodes(now[i], false);
      if (!same && !part) continue;
      taken[k] = true;
      out[i] = k;
      break;
    }
  }
  return out;
}

class ContactComparison {
 public:
  ContactComparison(const DeckComparison& c, const Contact& was, const Contact& now)
      : c_(c),
        was_(was),
        now_(now),
        length_(c.factor(0, 1, 0)),
        stiffness_(c.factor(1, 0, -2)),
        name_(contact_name(now)) {}

  DeckComparison::Difference run() {
    if (was_.evaluated != now_.evaluated || was_.dropped != now_.dropped)
      return name_ + " is examined in one of the decks only";
    for (const bool main : {false, true})
      if (auto d = side(main)) return d;
    if (auto d = c_.number(name_ + " Gapmin in force", was_.gapmin, now_.gapmin, length_)) return d;
    if (auto d = sizes()) return d;
    return penetrations();
  }

 private:
  DeckComparison::Difference side(bool main) {
    const auto a = side_nodes(was_, main), b = side_nodes(now_, main);
    const char* which = main ? "main" : "secondary";
    if (a.size() != b.size())
      return fmt::format("the {} side of {} has {} entries, expected {}", which, name_, b.size(),
                         a.size());
    std::vector<NodeIndex> old(b.size());
    for (std::size_t i = 0; i < b.size(); ++i) old[i] = c_.old_node(b[i]);
    if (old == a) return {};
    // The entries may be in another solver order.
    const std::size_t width = now_.kind == ContactKind::edge_edge ? 2 : main ? 4 : 1;
    const auto was = by_nodes(a, width), now = by_nodes(old, width);
    OldIndices& partner = main ? main_ : secondary_;
    partner.old.resize(now.size());
    for (std::size_t k = 0; k < now.size(); ++k) {
      if (was[k].first != now[k].first)
        return fmt::format("the {} side of {}: {} is in the place of another one", which, name_,
                           c_.node_name(b[now[k].second * width]));
      partner.old[now[k].second] = was[k].second;
    }
    return {};
  }

  /// Sorted node sets of a side's entries, with their positions.
  static std::vector<std::pair<std::array<NodeIndex, 4>, std::uint32_t>> by_nodes(
      const std::vector<NodeIndex>& side, std::size_t width) {
    std::vector<std::pair<std::array<NodeIndex, 4>, std::uint32_t>> out(side.size() / width);
    for (std::uint32_t i = 0; i < out.size(); ++i) {
      auto& [nodes, at] = out[i];
      std::copy_n(side.begin() + static_cast<std::ptrdiff_t>(i * width), width, nodes.begin());
      std::sort(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(width));
      at = i;
    }
    std::sort(out.begin(), out.end());
    return out;
  }

  template <class Entry>
  DeckComparison::Difference list(std::vector<Entry> Contact::*entries,
                                  const OldIndices& partner) const {
    // A segment of area 0 has the stiffness of the solver's absolute floor, in any unit: ignored
    // below this share of the stiffest.
    constexpr double negligible = 1e-12;
    const std::vector<Entry>&was = was_.*entries, &now = now_.*entries;
    double stiffest = 0;
    const auto stiffness = [&](const Contact& c, std::size_t i) {
      if constexpr (std::is_same_v<Entry, SecondaryNode>)
        return sweep::at(c.nodal_stiffness, i, 0);
      else
        return (c.*entries)[i].stiffness;
    };
    for (std::size_t i = 0; i < now.size(); ++i)
      stiffest = std::max(stiffest, std::abs(stiffness(now_, i)));
    for (std::size_t i = 0; i < now.size(); ++i) {
      const double g0 = was[partner[i]].gap, g1 = now[i].gap;
      if (!c_.same(g0, g1, length_)) return c_.number("a gap of " + name_, g0, g1, length_);
      // Only the sign of a negative one counts: constant stiffness.
      const double k0 = stiffness(was_, partner[i]), k1 = stiffness(now_, i);
      if (k0 < 0 && k1 < 0) continue;
      if (!c_.same(k0, k1, stiffness_, negligible * stiffest))
        return c_.number("a stiffness of " + name_, k0, k1, stiffness_, negligible * stiffest);
    }
    return {};
  }

  DeckComparison::Difference sizes() const {
    for (auto d : {c_.number("the factor of the stiffness of " + name_, was_.factor, now_.factor,
                             was_.factor < 0 ? stiffness_ : 1),
                   list(&Contact::main, main_), list(&Contact::secondary, secondary_),
                   list(&Contact::main_edges, main_), list(&Contact::secondary_edges, secondary_)})
      if (d) return d;
    return {};
  }

  std::string pair_name(const PenetrationRow& row) const {
    const NodeIndex node = now_.kind == ContactKind::edge_edge
                               ? now_.secondary_edges[row.secondary].nodes[0]
                               : now_.secondary[row.secondary].node;
    return fmt::format("{} at {}", name_, c_.node_name(node));
  }

  /// Effect of round-off in coordinates and gaps on a distance, in units of the second deck.
  double slack(double gap) const {
    constexpr double digits = 1e-12;
    return c_.tolerance * gap + digits * c_.after.extent;
  }

  /// A penetration, with its pair in the first deck.
  struct PairDepth {
    std::pair<std::uint32_t, std::uint32_t> pair;
    const PenetrationRow* row;
    bool operator<(const PairDepth& o) const { return pair < o.pair; }
    const PenetrationRow* operator->() const { return row; }
  };
  using PairDepths = std::vector<PairDepth>;
  static PairDepths sorted(const std::vector<PenetrationRow>& rows, const OldIndices& secondary,
                           const OldIndices& main) {
    PairDepths out;
    out.reserve(rows.size());
    for (const PenetrationRow& row : rows)
      out.push_back({{secondary[row.secondary], main[row.main]}, &row});
    if (!std::is_sorted(out.begin(), out.end())) std::sort(out.begin(), out.end());
    return out;
  }

  DeckComparison::Difference penetration(const PenetrationRow& old,
                                         const PenetrationRow& row) const {
    const double margin = slack(row.gap);
    const bool same = c_.same(old.gap, row.gap, length_, margin) &&
                      c_.same(old.depth, row.depth, length_, margin) &&
                      c_.same(old.gap0, row.gap0, length_, margin);
    const bool same_action =
        old.action == row.action || row.depth <= margin || row.distance <= margin;
    if (same && same_action) return {};
    const std::string at = " of " + pair_name(row);
    if (auto d = c_.number("the gap" + at, old.gap, row.gap, length_, margin)) return d;
    if (auto d = c_.number("the penetration" + at, old.depth, row.depth, length_, margin)) return d;
    if (!same_action)
      return fmt::format("the action{} is {}, expected {}", at, to_string(row.action),
                         to_string(old.action));
    return c_.number("the gap left" + at, old.gap0, row.gap0, length_, margin);
  }

  DeckComparison::Difference penetrations() const {
    const PairDepths was = sorted(was_.penetrations, {}, {}),
                     now = sorted(now_.penetrations, secondary_, main_);
    PairDepths gone, come;
    for (auto a = was.begin(), b = now.begin(); a != was.end() || b != now.end();) {
      if (b == now.end() || (a != was.end() && *a < *b)) {
        const PairDepth& row = *a++;
        if (row->depth * length_ > slack(row->gap * length_)) gone.push_back(row);
      } else if (a == was.end() || *b < *a) {
        const PairDepth& row = *b++;
        if (row->depth > slack(row->gap)) come.push_back(row);
      } else if (auto d = penetration(*(a++)->row, *(b++)->row)) {
        return d;
      }
    }
    leave_out_equally_near(gone, come);
    if (!gone.empty())
      return fmt::format("{}: a pair that penetrated by {:.9g} no longer penetrates", name_,
                         gone.front()->depth);
    if (!come.empty())
      return fmt::format("{} penetrates by {:.9g}; it did not before", pair_name(*come.front().row),
                         come.front()->depth);
    return {};
  }

  /// A node with two equally near segments chooses one by round-off: drops such pairs that differ
  /// only in the segment.
  void leave_out_equally_near(PairDepths& gone, PairDepths& come) const {
    std::erase_if(gone, [&](const PairDepth& old) {
      const auto other = std::find_if(come.begin(), come.end(), [&](const PairDepth& row) {
        return row.pair.first == old.pair.first && !penetration(*old.row, *row.row);
      });
      if (other == come.end()) return false;
      come.erase(other);
      return true;
    });
  }

  const DeckComparison& c_;
  const Contact &was_, &now_;
  double length_, stiffness_;
  std::string name_;
  OldIndices main_, secondary_;  ///< of the entries of the sides
};

}  // namespace

DeckComparison::Difference DeckComparison::contacts() const {
  const auto &was = before.scene.contacts, &now = after.scene.contacts;
  if (!relation.extract && was.size() != now.size())
    return fmt::format("the deck has {} contacts, expected {}", now.size(), was.size());
  const auto partner = partners(*this);
  const double force = factor(1, 1, -2);
  double largest = 0;
  for (const cycle::ContactOutcome& c : before.cycle.contacts)
    largest = std::max(largest, c.totals.total_abs);
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (relation.lossy.contains(now[i].inter->id) || relation.lossy_defaults) continue;
    if (partner[i] == no_index) return contact_name(now[i]) + " has no counterpart before";
    if (auto d = ContactComparison(*this, was[partner[i]], now[i]).run()) return d;
    const cycle::ContactOutcome &a = before.cycle.contacts[partner[i]],
                                &b = after.cycle.contacts[i];
    const double slack = tolerance * largest * force;
    if (auto d = number("the force of " + contact_name(now[i]) + " in the first cycle",
                        a.totals.total_abs, b.totals.total_abs, force, slack))
      return d;
    for (std::size_t k = 0; k < 3; ++k) {
      if (auto d = number("the normal force of " + contact_name(now[i]), a.totals.normal[k],
                          b.totals.normal[k], force, slack))
        return d;
      if (auto d = number("the tangential force of " + contact_name(now[i]), a.totals.tangential[k],
                          b.totals.tangential[k], force, slack))
        return d;
    }
  }
  if (relation.extract || !relation.lossy.empty() || relation.lossy_defaults) return {};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto &a = before.cycle.nodes.force[k], &b = after.cycle.nodes.force[k];
    const double slack = tolerance * before.cycle.largest_nodal_force * force;
    for (NodeIndex n = 0; n < std::min(a.size(), b.size()); ++n) {
      const double was_here = a[old_node(n)];
      if (!same(was_here, b[n], force, slack))
        return number("the contact force at " + node_name(n), was_here, b[n], force, slack);
    }
  }
  return {};
}

// ---- effective values --------------------------------------------------------------------------

namespace {

struct NamedValue {
  std::string_view name;
  std::string shown;  ///< for texts and numbers without unit
  double number = 0;
  bool real = false;
  bool written = true;  ///< in the deck, not built in
};

std::vector<NamedValue> values_of(const InterBase& inter) {
  std::vector<NamedValue> out;
  for_each_field(inter, [&]<class T>(std::string_view name, const Effective<T>& field) {
    NamedValue& value = out.emplace_back();
    value.name = name;
    value.real = std::is_same_v<T, double>;
    if constexpr (std::is_same_v<T, std::string>) {
      value.shown = field.value;
    } else if constexpr (std::is_same_v<T, double>) {
      value.number = field.value;
      value.written = field.origin != Origin::built_in;
    } else {
      value.shown = std::to_string(static_cast<std::int64_t>(field.value));
    }
  });
  return out;
}

const Field* cell_of(const InterBase& inter, std::string_view name) {
  if (inter.block == nullptr || inter.block->schema == nullptr) return nullptr;
  for (const CardSchema& card : inter.block->schema->cards)
    for (const Field& f : card.fields)
      if (f.name == name) return &f;
  return nullptr;
}

/// Possible dimensions of the cell: flags decide.
std::vector<Dimension> dimensions_of(const Field* field) {
  std::vector<Dimension> out;
  if (field == nullptr) return {Dimension{}};
  out.push_back(field->dimension);
  for (const auto& [when, dimension] : field->dimension_when) out.push_back(dimension);
  if (field->solver_dimension) out.push_back(*field->solver_dimension);
  return out;
}

}  // namespace

DeckComparison::Difference DeckComparison::values() const {
  const auto &was = before.context.interfaces().all, &now = after.context.interfaces().all;
  const bool by_place = !relation.extract && !relation.expanded;
  if (by_place && was.size() != now.size())
    return fmt::format("the deck has {} interfaces of {}, expected {}", now.size(),
                       examined_types(Examined::contacts_and_ties), was.size());
  for (std::size_t i = 0; i < now.size(); ++i) {
    const InterBase* old = by_place ? was[interfaces_[i]] : nullptr;
    if (!by_place)
      for (const InterBase* candidate : was)
        if (candidate->id == now[i]->id && candidate->type == now[i]->type) old = candidate;
    if (old == nullptr) {
      if (relation.expanded) continue;  // part of a TYPE19, whose contact is compared
      return fmt::format("there was no interface {}", now[i]->id);
    }
    if (relation.lossy.contains(old->id) || relation.lossy_defaults) continue;
    const std::string name = fmt::format("interface {}", now[i]->id);
    if (old->type != now[i]->type || (!relation.new_ids && old->id != now[i]->id))
      return fmt::format("{} is a TYPE{}, expected TYPE{} and id {}", name, now[i]->type, old->type,
                         old->id);
    const std::vector<NamedValue> a = values_of(*old), b = values_of(*now[i]);
    for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
      const NamedValue &value_was = a[k], &value_now = b[k];
      const auto what = [&] { return name + " " + std::string(value_was.name); };
      if (!value_was.real) {
        if (value_was.shown == value_now.shown) continue;
        const Field* field = cell_of(*old, value_was.name);
        if (relation.new_ids && field != nullptr && field->type == FieldType::id) continue;
        return fmt::format("{} is {}, expected {}", what(), value_now.shown, value_was.shown);
      }
      // A built-in default that is 1 of its unit in both systems acts on a function that is
      // missing; otherwise the conversion has written it out. 0 is 0 in any unit.
      const bool built_in = !value_was.written && !value_now.written;
      if (value_was.number == value_now.number && (built_in || value_was.number == 0)) continue;
      const auto dimensions = dimensions_of(cell_of(*old, value_was.name));
      if (std::none_of(dimensions.begin(), dimensions.end(), [&](const Dimension& d) {
            return same(value_was.number, value_now.number, conversion_factor(from, to, d));
          }))
        return number(what(), value_was.number, value_now.number,
                      conversion_factor(from, to, dimensions.front()));
    }
  }
  return {};
}

}  // namespace deck::detail
