// Pairs the uses of functions in two decks and compares the resulting curves.
#include "inspect/match.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "keyword/shared/decode_parts.hpp"
#include "keyword/shared/references.hpp"

namespace deck::detail {
namespace {

Dimension plus(Dimension a, const Dimension& b, int sign = 1) {
  a.mass = static_cast<std::int8_t>(a.mass + sign * b.mass);
  a.length = static_cast<std::int8_t>(a.length + sign * b.length);
  a.time = static_cast<std::int8_t>(a.time + sign * b.time);
  return a;
}

bool worth_reading(const Schema& s) {
  for (const CardSchema& card : s.cards)
    for (const Field& f : card.fields)
      if (f.type == FieldType::id && f.ref == "funct") return true;
  return false;
}

}  // namespace

/// A number in working units of its deck.
struct FunctionUses::Quantity {
  double value = 1;
  Dimension dimension;
  bool scaled = false;  ///< by a cell; else 1 in the working units of each deck

  void times(const Quantity& q) {
    scaled = true;
    value *= q.value;
    dimension = plus(dimension, q.dimension);
  }
  void over(const Quantity& q) {
    scaled = true;
    value /= q.value;
    dimension = plus(dimension, q.dimension, -1);
  }
};

/// A block with names for its cells.
struct FunctionUses::Named {
  Named(const Deck& from, const Block& b)
      : deck(from), decoded(decode(from, b)), keys(cell_keys(decoded)) {
    for (const DecodedCard& card : decoded.cards)
      for (const Cell& cell : card.cells) cells.emplace(keys.at(&cell), std::pair(&card, &cell));
  }

  /// A scale: 0, blank and a missing line mean 1 in the units of the block.
  Quantity scale(const Field& f, const Cell* cell, const DecodedCard* card) const {
    Cell one;
    one.field = &f;
    if (cell != nullptr) one = *cell;
    if (one.real == 0) one.real = 1;
    Dimension d = dimension_of(f, decoded, card);
    d.temperature = 0;
    return {working_value(deck, decoded, one, card), d, true};
  }
  using Place = std::pair<const DecodedCard*, const Cell*>;
  double number(std::map<CellKey, Place>::const_iterator it) const {
    return working_value(deck, decoded, *it->second.second, it->second.first);
  }
  std::optional<Quantity> scale(const std::string& name) const {
    const auto it = cells.find({name, 0, 0});
    if (it == cells.end()) return std::nullopt;
    return scale(*it->second.second->field, it->second.second, it->second.first);
  }

  const Deck& deck;
  DecodedBlock decoded;
  std::map<const Cell*, CellKey> keys;
  std::map<CellKey, Place> cells;
};

/// The force of a spring is f(x) (A + B ln(v / D) + E g(v / F)): with a function f, A scales f, and
/// only the ratios of B and E to A count.
struct FunctionUses::SpringRow {
  std::string row;  ///< suffix of the coefficients' names: "", "1" ... "6"
  std::string function, second;

  static std::vector<SpringRow> of(const Named& n) {
    std::vector<SpringRow> rows;
    if (n.decoded.block->schema->kind != "prop") return rows;
    for (const char* number : {"1", "2", "3", "4", "5", "6"}) {
      const std::string f = std::string("fct_ID1") + number;
      if (n.decoded.integer(f) == 0) continue;
      for (const std::string& row : {std::string(), std::string(number)})
        if (n.cells.contains({"A" + row, 0, 0}) && (row == number || number[0] == '1'))
          rows.push_back({row, f, std::string("fct_ID2") + number});
    }
    return rows;
  }
  /// Named after the second function.
  std::string e() const { return "E" + function.substr(7); }
};

struct FunctionUses::Use {
  CellKey key;
  std::int64_t id = 0;
  Quantity x, y;
  std::vector<CellKey> scales;
};

/// Factor of an axis of the points.
FunctionUses::Quantity FunctionUses::axis_of(const Named& n, const DecodedCard& card,
                                             const Cell& cell, const Axis& axis,
                                             std::vector<CellKey>& scales) {
  Quantity q;
  if (axis.scales.empty()) {
    q.dimension = axis.dimension;
    for (const auto& [when, dimension] : axis.dimension_when)
      if (is_met(when, n.decoded, &card)) {
        q.dimension = dimension;
        break;
      }
    q.dimension.temperature = 0;
    return q;
  }
  for (const std::string& name : axis.scales) {
    const AxisScale scale = axis_scale(n.decoded, card, cell, name);
    if (!scale.counts()) continue;
    const Field* f =
        scale.cell != nullptr ? scale.cell->field : n.decoded.block->schema->find_field(name);
    const CellKey key = scale.cell != nullptr ? n.keys.at(scale.cell) : CellKey{name, 0, 0};
    const auto place = n.cells.find(key);
    q.times(n.scale(*f, scale.cell, place == n.cells.end() ? nullptr : place->second.first));
    scales.push_back(key);
  }
  // Without a cell for the scale it is 1 and the points have its dimension.
  if (!q.scaled)
    if (const Field* f = n.decoded.block->schema->find_field(axis.scales.front()))
      q.dimension = dimension_of(*f, n.decoded, &card);
  q.dimension.temperature = 0;
  return q;
}

FunctionUses::FunctionUses(const DiffSide& a, const DiffSide& b, const Counterparts& pairs,
                           double tolerance)
    : a_(a),
      b_(b),
      equal_(tolerance),
      tables_(a.loaded.deck().has("/TABLE") || b.loaded.deck().has("/TABLE")) {
  for (std::size_t i = 0; i < pairs.items_a.size(); ++i) {
    if (pairs.block_to_b[i] == no_index) continue;
    const Block& x = *pairs.items_a[i].block;
    const Block& y = *pairs.items_b[pairs.block_to_b[i]].block;
    if (x.schema == nullptr || x.schema != y.schema || x.opaque || y.opaque) continue;
    if (worth_reading(*x.schema)) compare(x, y);
  }
}

bool FunctionUses::same_points(std::int64_t id_a, std::int64_t id_b) const {
  if (tables_) return false;
  const auto a = states_a_.find(id_a), b = states_b_.find(id_b);
  const bool known_a = a != states_a_.end(), known_b = b != states_b_.end();
  return (known_a || known_b) && (!known_a || !a->second.points_differ) &&
         (!known_b || !b->second.points_differ);
}

bool FunctionUses::only_a_copy(std::int64_t id, bool of_second) const {
  const States& states = of_second ? states_b_ : states_a_;
  const auto it = states.find(id);
  return it != states.end() && it->second.used && it->second.all_equal;
}

double FunctionUses::in_first(const Quantity& q) const {
  return q.value * conversion_factor(b_.loaded.deck().begin.working, a_.loaded.deck().begin.working,
                                     q.dimension);
}

bool FunctionUses::same_curve(const Use& a, const Use& b) {
  const auto &curves_a = a_.loaded.model().curves, &curves_b = b_.loaded.model().curves;
  const auto ca = curves_a.find(a.id), cb = curves_b.find(b.id);
  if (ca == curves_a.end() || cb == curves_b.end()) return false;
  const auto same_axis = [&](const std::vector<double>& x, const std::vector<double>& y,
                             const Quantity& qx, const Quantity& qy) {
    if (x.size() != y.size()) return false;
    const double to_a = in_first(qy);
    double largest = 0;
    for (const double p : x) largest = std::max(largest, std::abs(p * qx.value));
    const bool rounded = qx.value != to_a;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (!equal_(x[i] * qx.value, y[i] * to_a, largest, rounded)) return false;
    return true;
  };
  return same_axis(ca->second.x, cb->second.x, a.x, b.x) &&
         same_axis(ca->second.y, cb->second.y, a.y, b.y);
}

std::vector<FunctionUses::Use> FunctionUses::uses_of(const Named& n) {
  std::vector<Use> out;
  const std::vector<SpringRow> rows = SpringRow::of(n);
  for (const DecodedCard& card : n.decoded.cards) {
    if (card.missing() || card.schema->repeat == Repeat::ids) continue;
    for (const Cell& cell : card.cells) {
      const Field& f = *cell.field;
      if (f.type != FieldType::id || f.ref != "funct" || cell.integer == 0) continue;
      Use use;
      use.key = n.keys.at(&cell);
      use.id = std::abs(cell.integer) + n.deck.offset_of(*n.decoded.block, "funct");
      if (!f.axes.empty()) {
        use.x = axis_of(n, card, cell, f.axes.front(), use.scales);
        use.y = axis_of(n, card, cell, f.axes.back(), use.scales);
      }
      for (const SpringRow& row : rows)
        if (f.name == row.second)
          if (const auto a = n.scale("A" + row.row)) {
            use.y.over(*a);
            use.scales.emplace_back("A" + row.row, 0, 0);
          }
      out.push_back(std::move(use));
    }
  }
  return out;
}

/// Curves that the first coefficient of a spring scales: see SpringRow.
void FunctionUses::compare_springs(const Named& na, const Named& nb,
                                   std::map<CellKey, bool>& scales) {
  const auto same = [&](double x, double y) { return equal_(x, y, 0, true); };
  const std::vector<SpringRow> rows_a = SpringRow::of(na), rows_b = SpringRow::of(nb);
  for (const SpringRow& row : rows_a) {
    if (std::none_of(rows_b.begin(), rows_b.end(),
                     [&](const SpringRow& r) { return r.row == row.row; }))
      continue;
    const CellKey key{"A" + row.row, 0, 0};
    const auto a = na.scale("A" + row.row), b = nb.scale("A" + row.row);
    if (!a || !b) continue;
    // K / A acts in contacts: then the number of A itself counts.
    const std::string k = na.cells.contains({"K", 0, 0}) ? "K" : "K" + row.row;
    if (na.decoded.real(k) != 0 && !same(a->value, b->value) && !same(a->value, in_first(*b)))
      scales[key] = false;
    const std::string of_speed = nb.cells.contains({"B" + row.row, 0, 0}) ? "B" + row.row : "B1";
    for (const std::string& name : {of_speed, row.e()}) {
      const CellKey other{name, 0, 0};
      const auto x = na.cells.find(other), y = nb.cells.find(other);
      if (x == na.cells.end() || y == nb.cells.end() || scales.contains(other)) continue;
      scales[other] = same(na.number(x) / a->value, nb.number(y) / b->value);
      const bool counts = name == of_speed || na.decoded.integer(row.second) != 0 ||
                          nb.decoded.integer(row.second) != 0;
      if (!scales[other] && counts) scales[key] = false;
    }
  }
}

void FunctionUses::compare(const Block& block_a, const Block& block_b) {
  const Named na(a_.loaded.deck(), block_a), nb(b_.loaded.deck(), block_b);
  const std::vector<Use> uses_a = uses_of(na), uses_b = uses_of(nb);
  const auto same_scale = [&](const Quantity& x, const Quantity& y) {
    return (!x.scaled && !y.scaled) || equal_(x.value, in_first(y), 0, true);
  };
  std::map<CellKey, bool> scales;  // true if all curves that it scales are equal
  for (const Use& use : uses_a) {
    const auto other =
        std::find_if(uses_b.begin(), uses_b.end(), [&](const Use& u) { return u.key == use.key; });
    if (other == uses_b.end()) {
      for (const CellKey& key : use.scales) scales[key] = false;
      continue;
    }
    const bool same = same_curve(use, *other);
    const bool scales_same = same_scale(use.x, other->x) && same_scale(use.y, other->y);
    for (State* state : {&states_a_[use.id], &states_b_[other->id]}) {
      state->used = true;
      state->all_equal = state->all_equal && same;
      state->points_differ = state->points_differ || (!same && scales_same);
    }
    if (same) same_cells_.insert({&block_a, use.key});
    for (const CellKey& key : use.scales) {
      const auto it = scales.try_emplace(key, true).first;
      it->second = it->second && same;
    }
  }
  compare_springs(na, nb, scales);
  for (const auto& [key, same] : scales)
    if (same) same_cells_.insert({&block_a, key});
}

}  // namespace deck::detail
