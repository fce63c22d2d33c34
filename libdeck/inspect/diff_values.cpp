// Compares values of interfaces, cells of other keywords, and lines without a schema.
#include "inspect/differ.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <type_traits>

#include "deck/text.hpp"
#include "keyword/shared/references.hpp"
#include "model/shared/constant_stiffness.hpp"

namespace deck::detail {

namespace {

/// True if the field of that name scales an axis of a function.
bool is_scale(const Schema& schema, std::string_view name) {
  for (const CardSchema& card : schema.cards)
    for (const Field& f : card.fields)
      for (const Axis& axis : f.axes)
        if (std::find(axis.scales.begin(), axis.scales.end(), name) != axis.scales.end())
          return true;
  return false;
}

/// Product of a number and the cell by which the solver multiplies it (Field::over).
std::optional<double> product_of(const DecodedBlock& d, const DecodedCard& card, const Cell& cell,
                                 double value) {
  const Field& f = *cell.field;
  if (f.over.empty() || !is_met(f.over_when, d, &card)) return std::nullopt;
  const Cell* scale = cell_beside(d, card, cell, f.over);
  return scale == nullptr || scale->real == 0 ? value : value * scale->real;
}

std::string field_name(const CellKey& key) {
  const auto& [field, round, which] = key;
  std::string out = field;
  if (round > 1) out += fmt::format(" [{}]", round);
  if (which > 0) out += fmt::format(" ({})", which + 1);
  return out;
}

/// Number as used by the solver, in working units. Blank may be 1 in the units of the block; other
/// defaults are in working units already and matter only if these differ.
double real_of(const Deck& deck, const DecodedBlock& d, const DecodedCard& card, const Cell& cell,
               bool one, bool other_units) {
  Cell c = cell;
  if (c.real == 0 && one) c.real = 1;
  if (c.real != 0 || !other_units) return working_value(deck, d, c, &card);
  return ordinary_default(*c.field).value_or(0);
}

using Words = std::vector<std::pair<std::string, Span>>;

void words_of(const Line& line, Words& out) {
  const std::string_view text = line.text;
  for (std::size_t at = 0; at < text.size();) {
    const auto begin = text.find_first_not_of(" \t,", at);
    if (begin == text.npos) break;
    const auto end = std::min(text.find_first_of(" \t,", begin), text.size());
    out.emplace_back(text.substr(begin, end - begin),
                     line.columns(static_cast<int>(begin) + 1, static_cast<int>(end)));
    at = end;
  }
}

}  // namespace

auto Differ::fields_of(const DiffSide& side, const InterBase& inter) const
    -> std::vector<FieldValue> {
  std::vector<FieldValue> out;
  const DecodedBlock d = decode(side.loaded.deck(), *inter.block);
  const ImpliedOnes ones = implied_ones(d);
  visit_any_interface(inter, [&](const auto& t) {
    DecodedBlock counting = d;  // with effective flags
    t.for_each([&](std::string_view name, const auto& e) {
      if constexpr (std::is_integral_v<std::remove_cvref_t<decltype(e.value)>>)
        for (DecodedCard& card : counting.cards)
          for (Cell& cell : card.cells)
            if (cell.field->name == name) cell.integer = e.value;
    });
    t.for_each([&](std::string_view name, const auto& e) {
      FieldValue f;
      f.name = name;
      f.has_input = e.has_input;
      if (e.has_input) f.input = e.input;
      // empty if it depends on a mesh that was not evaluated
      const bool waits = e.origin == Origin::geometry && !inter.resolved;
      f.effective = waits ? DiffValue() : DiffValue(e.value);
      f.why = to_string(e.origin);
      f.span = e.span;
      if (const Field* field = inter.block->schema->find_field(name)) {
        f.ref = field->type == FieldType::id ? field->ref : "";
        if (field->type == FieldType::real)
          f.dimension = name == "Stfac" && constant_stiffness(inter) ? stiffness_dimension
                        : name == "Stfac"                            ? Dimension{}
                                                                     : dimension_of(*field, d);
        f.effective_dimension = name == "Stfac" ? f.dimension : dimension_of(*field, counting);
        const Cell* cell = d.find(name);
        const bool scale = !field->unit_for.empty() || is_scale(*inter.block->schema, name);
        f.counts = scale ? ones.cells.contains(cell) || ones.absent.contains(field->name)
                         : ordinary_default(*field).has_value();
      }
      out.push_back(std::move(f));
    });
  });
  return out;
}

DiffValue Differ::in_first_units(DiffValue v, const Dimension& d) const {
  double* x = std::get_if<double>(&v);
  if (x != nullptr && other_units_) *x *= conversion_factor(units_b_, units_a_, d);
  return v;
}

double Differ::size_of(const Dimension& d) const { return d == length_dimension ? extent_ : 0; }

bool Differ::same_value(const DiffValue& x, const DiffValue& y, std::string_view ref, double size,
                        bool rounded) {
  if (!ref.empty()) {
    const auto* i = std::get_if<std::int64_t>(&x);
    const auto* j = std::get_if<std::int64_t>(&y);
    if (i != nullptr && j != nullptr) return same_id(ref, *i, *j);
  }
  const double* u = std::get_if<double>(&x);
  const double* v = std::get_if<double>(&y);
  return u != nullptr && v != nullptr ? equal_(*u, *v, size, rounded) : x == y;
}

bool Differ::same_id(std::string_view kind, std::int64_t x, std::int64_t y) const {
  if (x == 0 || y == 0) return x == y;
  if ((x < 0) != (y < 0)) return false;
  const std::int64_t to = pairs_.mapped(a_, b_, kind, std::abs(x));
  // Ids of missing entities are compared as written.
  return to != 0 ? to == std::abs(y) : x == y;
}

void Differ::contact(const DeckItem& a, const DeckItem& b, const InterBase& ia,
                     const InterBase& ib) {
  const std::vector<FieldValue> fa = fields_of(a_, ia), fb = fields_of(b_, ib);
  for (std::size_t i = 0; i < fa.size() && i < fb.size(); ++i) {
    const DiffValue input = in_first_units(fb[i].input, fb[i].dimension);
    const DiffValue effective = in_first_units(fb[i].effective, fb[i].effective_dimension);
    // Values from the mesh are sums, which may have another order.
    if (same_value(fa[i].effective, effective, fa[i].ref, size_of(fa[i].dimension), true)) continue;
    if (functions_.same_cell(*a.block, {fa[i].name, 0, 0})) continue;
    // Built-in values have no unit: 1e30 for "no bound" and 1 for an unused scale are equal in
    // every unit system; the bound also if written on a card.
    constexpr double no_bound = 1e30;
    const bool on_card =
        (fa[i].why == "card" || fb[i].why == "card") && fa[i].effective != DiffValue(no_bound);
    const bool counts = fa[i].counts || fb[i].counts;
    if (!on_card && !counts && fa[i].effective == fb[i].effective) continue;
    Change& c = add(ChangeKind::changed, a, &b, fa[i].name);
    if (fa[i].has_input) c.old_value = fa[i].input;
    if (fb[i].has_input) c.new_value = input;
    c.evaluated = true;
    c.effective_old = fa[i].effective;
    c.effective_new = effective;
    c.why = fb[i].why;
    if (fa[i].effective == fb[i].effective && !fa[i].ref.empty()) c.why += ", another entity";
    c.a = fa[i].span.valid() ? fa[i].span : ia.span;
    c.b = fb[i].span.valid() ? fb[i].span : ib.span;
  }
}

void Differ::absent_ones(const DiffSide& side, const DecodedBlock& d, const ImpliedOnes& ones,
                         bool rounded, Contents& out) const {
  for (const CardSchema& card : d.block->schema->cards) {
    if (ones.absent.empty() || !card.in_version(d.block->version)) continue;
    for (const Field& f : card.fields) {
      if (!ones.absent.contains(f.name) || f.type != FieldType::real ||
          !f.in_version(d.block->version) || !is_met(card.when, d) || !is_met(f.when, d))
        continue;
      Cell one;
      one.field = &f;
      one.real = 1;
      const double x = working_value(side.loaded.deck(), d, one);
      CellKey key{f.name, 0, 0};
      CellValue v;
      v.span = d.block->header_span;
      v.rounded = rounded;
      v.field = &f;
      v.value = &side == &b_ ? in_first_units(x, dimension_of(f, d)) : DiffValue(x);
      out.order.push_back(key);
      out.cells.emplace(std::move(key), std::move(v));
    }
  }
}

auto Differ::contents_of(const DiffSide& side, const Block& block) const -> Contents {
  Contents out;
  const Deck& deck = side.loaded.deck();
  if (block.opaque || block.schema == nullptr) {
    LineCursor cursor(deck.sources, block);
    for (Line line = cursor.next(); line.valid(); line = cursor.next()) words_of(line, out.words);
    return out;
  }
  const DecodedBlock d = decode(deck, block);
  const UnitSystem* units = deck.units_of(block);
  const bool rounded = other_units_ || (units != nullptr && !(*units == deck.begin.working));
  const ImpliedOnes ones = implied_ones(d);
  const auto keys = cell_keys(d);
  for (const DecodedCard& card : d.cards) {
    const bool list = card.schema->repeat == Repeat::ids;
    for (const Cell& cell : card.cells) {
      const Field& f = *cell.field;
      const bool ordered = f.type == FieldType::real || f.type == FieldType::text ||
                           f.ref == "funct" || f.ref == "table";
      if (list && !ordered && &f == &card.schema->fields.back()) {
        const std::int64_t sign = cell.integer < 0 ? -1 : 1;
        if (cell.integer != 0)
          out.lists[f.name].emplace_back(
              cell.integer + (f.type == FieldType::id ? sign * deck.offset_of(block, f.ref) : 0),
              f.ref);
        continue;
      }
      CellValue v;
      v.span = cell.span;
      v.field = &f;
      if (f.type == FieldType::real) {
        const double x = real_of(deck, d, card, cell, ones.cells.contains(&cell), other_units_);
        if (x == 0) continue;  // equal to blank
        v.rounded = rounded;
        const Dimension dimension = dimension_of(f, d, &card);
        v.size = size_of(dimension);
        v.value = &side == &b_ ? in_first_units(x, dimension) : DiffValue(x);
        v.product = product_of(d, card, cell, std::get<double>(v.value));
      } else if (f.type == FieldType::text) {
        if (cell.text.empty()) continue;
        v.value = std::string(cell.text);
      } else {
        if (cell.integer == 0) continue;
        const std::int64_t sign = cell.integer < 0 ? -1 : 1;
        v.ref = f.type == FieldType::id ? f.ref : "";
        v.value = cell.integer + (v.ref.empty() ? 0 : sign * deck.offset_of(block, f.ref));
      }
      const CellKey& key = keys.at(&cell);
      out.order.push_back(key);
      out.cells.emplace(key, std::move(v));
    }
    if (!block.schema->layout_known() && card.cells.empty() && !card.missing())
      words_of(card.line, out.words);
  }
  absent_ones(side, d, ones, rounded, out);
  for (const Line& line : d.extra) words_of(line, out.words);
  return out;
}

bool Differ::is_default(const CellValue& v) {
  const Field& f = *v.field;
  if (f.default_varies != DefaultVaries::no) return false;
  if (const auto* text = std::get_if<std::string>(&v.value))
    return !text->empty() && *text == f.default_text;
  const auto* i = std::get_if<std::int64_t>(&v.value);
  const auto* x = std::get_if<double>(&v.value);
  return f.default_value && ((i != nullptr && static_cast<double>(*i) == *f.default_value) ||
                             (x != nullptr && *x == *f.default_value));
}

bool Differ::same_cell(const CellValue& x, const CellValue& y) {
  const bool rounded = x.rounded || y.rounded;
  const std::string& ref = x.ref.empty() ? y.ref : x.ref;
  const double size = std::max(x.size, y.size);
  if (x.product && y.product) return equal_(*x.product, *y.product, size, true);
  if (same_value(x.value, y.value, ref, size, rounded)) return true;
  const bool ignored = x.field != nullptr ? x.field->ignored : y.field->ignored;
  if (ignored) ++ignored_;
  return ignored || (y.field == nullptr && is_default(x)) || (x.field == nullptr && is_default(y));
}

void Differ::cells(const DeckItem& a, const DeckItem& b) {
  const Contents ca = contents_of(a_, *a.block), cb = contents_of(b_, *b.block);
  const auto place = [](const Contents& c, const CellKey& key, const DeckItem& item) {
    const auto it = c.cells.find(key);
    return it == c.cells.end() ? item.block->header_span : it->second.span;
  };
  const auto report = [&](const CellKey& key) {
    const auto x = ca.cells.find(key), y = cb.cells.find(key);
    const CellValue none;
    const CellValue& va = x == ca.cells.end() ? none : x->second;
    const CellValue& vb = y == cb.cells.end() ? none : y->second;
    if (same_cell(va, vb) || functions_.same_cell(*a.block, key)) return;
    Change& c = add(ChangeKind::changed, a, &b, field_name(key));
    const bool shown_alike = va.value == vb.value && va.product && vb.product;
    c.old_value = shown_alike ? DiffValue(*va.product) : va.value;
    c.new_value = shown_alike ? DiffValue(*vb.product) : vb.value;
    c.a = place(ca, key, a);
    c.b = place(cb, key, b);
  };
  for (const CellKey& key : ca.order) report(key);
  for (const CellKey& key : cb.order)
    if (!ca.cells.contains(key)) report(key);
  std::set<std::string> names;
  for (const auto& [name, list] : ca.lists) names.insert(name);
  for (const auto& [name, list] : cb.lists) names.insert(name);
  for (const std::string& name : names) id_lists(a, b, name, ca, cb);
  // Lines beyond a known layout are ignored: a conversion blanks those that its version would read.
  const Schema* const schema = a.block->schema;
  if (schema != nullptr && schema->layout_known() && a.block->version != b.block->version) return;
  const auto [x, y] = std::mismatch(
      ca.words.begin(), ca.words.end(), cb.words.begin(), cb.words.end(),
      [&](const auto& one, const auto& other) { return same_word(one.first, other.first); });
  if (x == ca.words.end() && y == cb.words.end()) return;
  Change& c = add(ChangeKind::changed, a, &b, "(undescribed text)");
  c.a = x != ca.words.end() ? x->second : a.block->header_span;
  c.b = y != cb.words.end() ? y->second : b.block->header_span;
  if (x != ca.words.end()) c.old_value = x->first;
  if (y != cb.words.end()) c.new_value = y->first;
}

bool Differ::same_word(const std::string& x, const std::string& y) {
  if (x == y) return true;
  const RealCell u = read_real(x), v = read_real(y);
  const auto number = [](const RealCell& n) {
    return n.status == NumberStatus::ok || n.status == NumberStatus::implicit_exponent;
  };
  return number(u) && number(v) && equal_(u.value, v.value, 0, false);
}

void Differ::id_lists(const DeckItem& a, const DeckItem& b, const std::string& name,
                      const Contents& ca, const Contents& cb) {
  std::multiset<std::int64_t> now;
  if (const auto it = cb.lists.find(name); it != cb.lists.end())
    for (const auto& [id, kind] : it->second) now.insert(id);
  std::vector<std::int64_t> lost;
  if (const auto it = ca.lists.find(name); it != ca.lists.end())
    for (const auto& [id, kind] : it->second) {
      const std::int64_t to =
          kind.empty() ? std::abs(id) : pairs_.mapped(a_, b_, kind, std::abs(id));
      const std::int64_t there = (to == 0 ? std::abs(id) : to) * (id < 0 ? -1 : 1);
      if (const auto same = now.find(there); same != now.end())
        now.erase(same);
      else
        lost.push_back(id);
    }
  if (lost.empty() && now.empty()) return;
  Change& c = add(ChangeKind::changed, a, &b, name);
  c.lost = std::move(lost);
  c.gained.assign(now.begin(), now.end());
}

}  // namespace deck::detail
