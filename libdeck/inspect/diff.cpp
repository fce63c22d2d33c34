// Compares two decks entity by entity, after every id of the first was translated.
// Over 600 lines: one step a kind of entity, all on the same translation of ids and list of
// changes.
#include "deck/inspect/diff.hpp"
#include "deck/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>

#include "deck/keyword/decode.hpp"
#include "deck/keyword/references.hpp"
#include "deck/model/connectivity.hpp"
#include "deck/model/selection.hpp"
#include "deck/text/number.hpp"
#include "inspect/element_cells.hpp"
#include "inspect/equal_numbers.hpp"
#include "inspect/function_uses.hpp"
#include "inspect/match.hpp"
#include "keyword/decode/implied_one.hpp"
#include "model/constant_stiffness.hpp"
#include "model/shared/families.hpp"

namespace deck {

const char* to_string(ChangeKind kind) {
  switch (kind) {
    case ChangeKind::added:
      return "added";
    case ChangeKind::removed:
      return "removed";
    case ChangeKind::changed:
      return "changed";
    case ChangeKind::moved:
      break;
  }
  return "moved";
}

namespace {

using detail::Counterparts;
using detail::Item;

/// Largest coordinate of a model.
double extent_of(const Nodes& nodes) {
  double extent = 0;
  for (const auto* axis : {&nodes.x, &nodes.y, &nodes.z})
    for (const double x : *axis)
      if (std::isfinite(x)) extent = std::max(extent, std::abs(x));
  return extent;
}

constexpr std::string_view selections[] = {"grnod",  "surf",   "line",   "set",    "grpart",
                                           "grshel", "grsh3n", "grbric", "grquad", "grtria",
                                           "grtrus", "grbeam", "grspri"};
bool is_selection_kind(std::string_view kind) {
  return std::find(std::begin(selections), std::end(selections), kind) != std::end(selections);
}

std::string group_of_kind(std::string_view kind) {
  if (kind == "inter" || kind == "default_inter" || kind == "friction") return "interface";
  if (is_selection_kind(kind) || kind == "box" || kind == "subset") return "group";
  if (kind == "part") return "part";
  if (kind == "prop") return "property";
  if (kind == "mat") return "material";
  return "other";
}

class Differ {
 public:
  Differ(const DiffSide& a, const DiffSide& b, MatchBy match, double tolerance)
      : a_(a),
        b_(b),
        units_a_(a.loaded.deck().begin.working),
        units_b_(b.loaded.deck().begin.working),
        other_units_(!(units_a_ == units_b_)),
        length_(conversion_factor(units_a_, units_b_, length_dimension)),
        extent_(std::max(extent_of(a.loaded.model().nodes),
                         extent_of(b.loaded.model().nodes) / length_)),
        equal_(tolerance),
        pairs_(detail::find_counterparts(a, b, match, length_)),
        functions_(a, b, pairs_, tolerance) {}

  DeckDiff run() {
    if (other_units_)
      out_.notes.push_back(
          "the working units differ: values of the second deck are shown in those of "
          "the first");
    if (a_.loaded.deck().version != b_.loaded.deck().version)
      out_.notes.push_back(fmt::format("input version {} here, {} there: no difference in itself",
                                       a_.loaded.deck().version, b_.loaded.deck().version));
    came_and_went();
    for (std::size_t i = 0; i < pairs_.items_a.size(); ++i)
      if (pairs_.block_to_b[i] != no_index)
        item(pairs_.items_a[i], pairs_.items_b[pairs_.block_to_b[i]]);
    nodes();
    elements();
    const auto stops = [](const DiffSide& side) {
      return side.verdict != nullptr && side.verdict->level == VerdictLevel::stops;
    };
    out_.stops_a = stops(a_);
    out_.stops_b = stops(b_);
    if (a_.view != nullptr && b_.view != nullptr) penetrations();
    hint();
    tell_of_numbers();
    return std::move(out_);
  }

 private:
  static constexpr Dimension length_dimension{0, 1, 0, 0};

  Change& add(ChangeKind kind, const Item& a, const Item* b, std::string field) {
    Change c;
    c.kind = kind;
    c.group = a.block->schema != nullptr ? group_of_kind(a.block->schema->kind) : "other";
    c.keyword =
        a.block->schema != nullptr ? a.block->schema->keyword : std::string(a.block->keyword);
    c.id = a.id;
    if (b != nullptr && b->id != a.id) c.id_b = b->id;
    c.title = a.title;
    c.field = std::move(field);
    out_.changes.push_back(std::move(c));
    return out_.changes.back();
  }

  void came_and_went() {
    std::vector<std::uint8_t> used(pairs_.items_b.size(), 0);
    for (std::size_t i = 0; i < pairs_.items_a.size(); ++i) {
      if (pairs_.block_to_b[i] != no_index)
        used[pairs_.block_to_b[i]] = 1;
      else if (!only_a_copy(a_, pairs_.items_a[i]))
        add(ChangeKind::removed, pairs_.items_a[i], nullptr, "").a =
            pairs_.items_a[i].block->header_span;
    }
    for (std::size_t i = 0; i < pairs_.items_b.size(); ++i)
      if (used[i] == 0 && !only_a_copy(b_, pairs_.items_b[i]))
        add(ChangeKind::added, pairs_.items_b[i], nullptr, "").b =
            pairs_.items_b[i].block->header_span;
  }

  static bool is_function(const Block& b) {
    return b.schema != nullptr && (b.schema->kind == "funct" || b.schema->keyword == "/MOVE_FUNCT");
  }

  static std::int64_t function_id(const DiffSide& side, const Block& b) {
    return b.id.value + side.loaded.deck().offset_of(b, "funct");
  }

  /// A function that only one deck has, for uses that the other gives the same curve by another.
  bool only_a_copy(const DiffSide& side, const Item& item) const {
    return is_function(*item.block) &&
           functions_.only_a_copy(function_id(side, *item.block), &side == &b_);
  }

  // ---- one entity -----------------------------------------------------------------------------

  void item(const Item& a, const Item& b) {
    if (a.title != b.title) {
      Change& c = add(ChangeKind::changed, a, &b, "title");
      c.old_value = a.title;
      c.new_value = b.title;
      c.a = a.block->header_span;
      c.b = b.block->header_span;
    }
    const std::string kind = a.block->schema != nullptr ? a.block->schema->kind : "";
    if (is_selection_kind(kind)) return members(a, b, kind);
    if (a.block->schema != b.block->schema) {
      Change& c = add(ChangeKind::changed, a, &b, "keyword");
      c.old_value =
          a.block->schema != nullptr ? a.block->schema->keyword : std::string(a.block->keyword);
      c.new_value =
          b.block->schema != nullptr ? b.block->schema->keyword : std::string(b.block->keyword);
      c.a = a.block->header_span;
      c.b = b.block->header_span;
      return;
    }
    if (is_function(*a.block) &&
        functions_.same_points(function_id(a_, *a.block), function_id(b_, *b.block)))
      return;
    const InterBase* ia = inter_of(a_, *a.block);
    const InterBase* ib = inter_of(b_, *b.block);
    if (ia != nullptr && ib != nullptr && ia->type == ib->type) return contact(a, b, *ia, *ib);
    cells(a, b);
  }

  static const InterBase* inter_of(const DiffSide& side, const Block& block) {
    for (const InterBase* i : side.loaded.interfaces().all)
      if (i->block == &block) return i;
    return nullptr;
  }

  // ---- contacts -------------------------------------------------------------------------------

  struct FieldValue {
    std::string name;
    DiffValue input, effective;
    bool has_input = false;
    std::string why;
    Span span;
    Dimension dimension;
    std::string ref;
    bool counts = false;  ///< its default is a number that other units change
  };

  static DiffValue value_of(std::int64_t v) { return v; }
  static DiffValue value_of(double v) { return v; }
  static DiffValue value_of(const std::string& v) { return v; }

  /// Some axis of a function is scaled by the field of that name.
  static bool is_scale(const Schema& schema, std::string_view name) {
    for (const CardSchema& card : schema.cards)
      for (const Field& f : card.fields)
        for (const Axis& axis : f.axes)
          if (std::find(axis.scales.begin(), axis.scales.end(), name) != axis.scales.end())
            return true;
    return false;
  }

  std::vector<FieldValue> fields_of(const DiffSide& side, const InterBase& inter) const {
    std::vector<FieldValue> out;
    const DecodedBlock d = decode(side.loaded.deck(), *inter.block);
    const detail::ImpliedOnes ones = detail::implied_ones(d);
    visit_any_interface(inter, [&](const auto& t) {
      t.for_each([&](std::string_view name, const auto& e) {
        FieldValue f;
        f.name = name;
        f.has_input = e.has_input;
        if (e.has_input) f.input = value_of(e.input);
        // Nothing, where the mesh decides and was not asked.
        const bool waits = e.origin == Origin::geometry && !inter.resolved;
        f.effective = waits ? DiffValue() : value_of(e.value);
        f.why = to_string(e.origin);
        f.span = e.span;
        if (const Field* field = inter.block->schema->find_field(name)) {
          f.ref = field->type == FieldType::id ? field->ref : "";
          if (field->type == FieldType::real)
            f.dimension = name == "Stfac" && detail::constant_stiffness(inter)
                              ? detail::stiffness_dimension
                          : name == "Stfac" ? Dimension{}
                                            : dimension_of(*field, d);
          const Cell* cell = d.find(name);
          const bool scale = !field->unit_for.empty() || is_scale(*inter.block->schema, name);
          f.counts = scale ? ones.cells.contains(cell) || ones.absent.contains(field->name)
                           : detail::ordinary_default(*field).has_value();
        }
        out.push_back(std::move(f));
      });
    });
    return out;
  }

  /// A value of the second deck in the working units of the first.
  DiffValue in_first_units(DiffValue v, const Dimension& d) const {
    double* x = std::get_if<double>(&v);
    if (x != nullptr && other_units_) *x *= conversion_factor(units_b_, units_a_, d);
    return v;
  }

  /// What values of a dimension are measured against: lengths against the model.
  double size_of(const Dimension& d) const { return d == length_dimension ? extent_ : 0; }

  bool same_value(const DiffValue& x, const DiffValue& y, std::string_view ref, double size,
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

  bool same_id(std::string_view kind, std::int64_t x, std::int64_t y) const {
    if (x == 0 || y == 0) return x == y;
    if ((x < 0) != (y < 0)) return false;
    const std::int64_t to = pairs_.mapped(a_, b_, kind, std::abs(x));
    // What exists nowhere is compared as it is written.
    return to != 0 ? to == std::abs(y) : x == y;
  }

  void contact(const Item& a, const Item& b, const InterBase& ia, const InterBase& ib) {
    const std::vector<FieldValue> fa = fields_of(a_, ia), fb = fields_of(b_, ib);
    for (std::size_t i = 0; i < fa.size() && i < fb.size(); ++i) {
      const DiffValue input = in_first_units(fb[i].input, fb[i].dimension);
      const DiffValue effective = in_first_units(fb[i].effective, fb[i].dimension);
      // Values from the mesh are sums that may have another order.
      if (same_value(fa[i].effective, effective, fa[i].ref, size_of(fa[i].dimension), true))
        continue;
      if (functions_.same_cell(*a.block, {fa[i].name, 0, 0})) continue;
      // A built-in value has no unit: 1e30 for "no bound" and 1 for an unused scale are the same
      // numbers in every unit system.
      const bool on_card = fa[i].why == "card" || fb[i].why == "card";
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

  // ---- cells ----------------------------------------------------------------------------------

  struct CellValue {
    DiffValue value;
    std::string ref;
    Span span;
    bool rounded = false;
    double size = 0;                ///< what the number is measured against
    std::optional<double> product;  ///< with what the solver multiplies it by
    const Field* field = nullptr;
  };
  using CellKey = detail::CellKey;
  struct Contents {
    std::map<CellKey, CellValue> cells;
    std::vector<CellKey> order;
    std::map<std::string, std::vector<std::pair<std::int64_t, std::string>>> lists;  // id, kind
    std::vector<std::pair<std::string, Span>> words;  ///< of lines that no schema describes
  };

  void words_of(const Line& line, Contents& out) const {
    const std::string_view text = line.text;
    for (std::size_t at = 0; at < text.size();) {
      const auto begin = text.find_first_not_of(" \t,", at);
      if (begin == text.npos) break;
      const auto end = std::min(text.find_first_of(" \t,", begin), text.size());
      out.words.emplace_back(text.substr(begin, end - begin),
                             line.columns(static_cast<int>(begin) + 1, static_cast<int>(end)));
      at = end;
    }
  }

  /// The number that counts, in working units. Blank may be 1 in the units of the block; other
  /// defaults are in working units already, and matter where these differ.
  double real_of(const Deck& deck, const DecodedBlock& d, const DecodedCard& card, const Cell& cell,
                 bool one) const {
    Cell c = cell;
    if (c.real == 0 && one) c.real = 1;
    if (c.real != 0 || !other_units_) return working_value(deck, d, c, &card);
    return detail::ordinary_default(*c.field).value_or(0);
  }

  /// Scales whose line is missing are 1 as well.
  void absent_ones(const DiffSide& side, const DecodedBlock& d, const detail::ImpliedOnes& ones,
                   bool rounded, Contents& out) const {
    for (const CardSchema& card : d.block->schema->cards) {
      if (ones.absent.empty() || !card.in_version(d.block->version)) continue;
      for (const Field& f : card.fields) {
        if (!ones.absent.contains(f.name) || f.type != FieldType::real ||
            !f.in_version(d.block->version) || !holds(card.when, d) || !holds(f.when, d))
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

  Contents contents_of(const DiffSide& side, const Block& block) const {
    Contents out;
    const Deck& deck = side.loaded.deck();
    if (block.opaque || block.schema == nullptr) {
      LineCursor cursor(deck.sources, block);
      for (Line line = cursor.next(); line.valid(); line = cursor.next()) words_of(line, out);
      return out;
    }
    const DecodedBlock d = decode(deck, block);
    const UnitSystem* units = deck.units_of(block);
    const bool rounded = other_units_ || (units != nullptr && !(*units == deck.begin.working));
    const detail::ImpliedOnes ones = detail::implied_ones(d);
    const auto keys = detail::cell_keys(d);
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
          const double x = real_of(deck, d, card, cell, ones.cells.contains(&cell));
          if (x == 0) continue;  // the same as blank
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
        words_of(card.line, out);
    }
    absent_ones(side, d, ones, rounded, out);
    for (const Line& line : d.extra) words_of(line, out);
    return out;
  }

  /// A number that the solver multiplies by that of another cell, with it (Field::over).
  static std::optional<double> product_of(const DecodedBlock& d, const DecodedCard& card,
                                          const Cell& cell, double value) {
    const Field& f = *cell.field;
    if (f.over.empty() || !holds(f.over_when, d, &card)) return std::nullopt;
    const Cell* scale = detail::cell_beside(d, card, cell, f.over);
    return scale == nullptr || scale->real == 0 ? value : value * scale->real;
  }

  static std::string field_name(const CellKey& key) {
    const auto& [field, round, which] = key;
    std::string out = field;
    if (round > 1) out += fmt::format(" [{}]", round);
    if (which > 0) out += fmt::format(" ({})", which + 1);
    return out;
  }

  /// The version of the block has no such cell.
  static bool has_no_cell(const CellValue& v, const Block& other) {
    return v.field != nullptr && !detail::has_field(other, v.field->name);
  }

  /// The number that the solver uses where nothing is written.
  static bool is_default(const CellValue& v) {
    const auto number = detail::ordinary_default(*v.field);
    const auto* i = std::get_if<std::int64_t>(&v.value);
    const auto* x = std::get_if<double>(&v.value);
    return number && ((i != nullptr && static_cast<double>(*i) == *number) ||
                      (x != nullptr && *x == *number));
  }

  bool same_cell(const CellValue& x, const CellValue& y, const Block& in_a, const Block& in_b) {
    const bool rounded = x.rounded || y.rounded;
    const std::string& ref = x.ref.empty() ? y.ref : x.ref;
    const double size = std::max(x.size, y.size);
    if (x.product && y.product) return equal_(*x.product, *y.product, size, true);
    if (same_value(x.value, y.value, ref, size, rounded)) return true;
    const bool ignored = x.field != nullptr ? x.field->ignored : y.field->ignored;
    if (ignored) ++ignored_;
    return ignored || (y.field == nullptr && has_no_cell(x, in_b) && is_default(x)) ||
           (x.field == nullptr && has_no_cell(y, in_a) && is_default(y));
  }

  void cells(const Item& a, const Item& b) {
    const Contents ca = contents_of(a_, *a.block), cb = contents_of(b_, *b.block);
    const auto place = [](const Contents& c, const CellKey& key, const Item& item) {
      const auto it = c.cells.find(key);
      return it == c.cells.end() ? item.block->header_span : it->second.span;
    };
    const auto report = [&](const CellKey& key) {
      const auto x = ca.cells.find(key), y = cb.cells.find(key);
      const CellValue none;
      const CellValue& va = x == ca.cells.end() ? none : x->second;
      const CellValue& vb = y == cb.cells.end() ? none : y->second;
      if (same_cell(va, vb, *a.block, *b.block) || functions_.same_cell(*a.block, key)) return;
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
    const bool same =
        std::equal(ca.words.begin(), ca.words.end(), cb.words.begin(), cb.words.end(),
                   [&](const auto& x, const auto& y) { return same_word(x.first, y.first); });
    if (same) return;
    std::size_t at = 0;
    while (at < ca.words.size() && at < cb.words.size() &&
           same_word(ca.words[at].first, cb.words[at].first))
      ++at;
    Change& c = add(ChangeKind::changed, a, &b, "(undescribed text)");
    c.a = at < ca.words.size() ? ca.words[at].second : a.block->header_span;
    c.b = at < cb.words.size() ? cb.words[at].second : b.block->header_span;
    if (at < ca.words.size()) c.old_value = ca.words[at].first;
    if (at < cb.words.size()) c.new_value = cb.words[at].first;
  }

  bool same_word(const std::string& x, const std::string& y) {
    if (x == y) return true;
    const RealCell u = read_real(x), v = read_real(y);
    const auto number = [](const RealCell& n) {
      return n.status == NumberStatus::ok || n.status == NumberStatus::implicit_exponent;
    };
    return number(u) && number(v) && equal_(u.value, v.value, 0, false);
  }

  void id_lists(const Item& a, const Item& b, const std::string& name, const Contents& ca,
                const Contents& cb) {
    std::set<std::int64_t> now;
    if (const auto it = cb.lists.find(name); it != cb.lists.end())
      for (const auto& [id, kind] : it->second) now.insert(id);
    std::vector<std::int64_t> lost;
    if (const auto it = ca.lists.find(name); it != ca.lists.end())
      for (const auto& [id, kind] : it->second) {
        const std::int64_t to =
            kind.empty() ? std::abs(id) : pairs_.mapped(a_, b_, kind, std::abs(id));
        const std::int64_t there = (to == 0 ? std::abs(id) : to) * (id < 0 ? -1 : 1);
        if (now.erase(there) == 0) lost.push_back(id);
      }
    if (lost.empty() && now.empty()) return;
    Change& c = add(ChangeKind::changed, a, &b, name);
    c.lost = std::move(lost);
    c.gained.assign(now.begin(), now.end());
    c.a = a.block->header_span;
    c.b = b.block->header_span;
  }

  // ---- members --------------------------------------------------------------------------------

  using Tuple = std::vector<NodeIndex>;  ///< nodes of a member, in the second deck's indices

  NodeIndex to_b(NodeIndex n) const { return n == no_index ? no_index : pairs_.node_to_b[n]; }

  /// A segment with its sense of rotation, whatever node it begins with.
  static Tuple turned(Tuple t) {
    if (t.size() == 4 && t[3] == t[2]) t.pop_back();
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
  }

  struct Member {
    Tuple nodes;
    std::int64_t id = 0;  ///< for people: of the node or of the element behind it
    friend bool operator<(const Member& x, const Member& y) { return x.nodes < y.nodes; }
  };

  std::int64_t element_id(const Model& m, Carrier carrier, std::uint32_t e) const {
    const Elements* elements = elements_of(m, carrier);
    return elements == nullptr || e >= elements->size() ? 0 : elements->id[e];
  }

  std::vector<Member> segments(const DiffSide& side, const std::vector<Segment>& list) const {
    std::vector<Member> out;
    for (const Segment& s : list) {
      Tuple t(s.nodes.begin(), s.nodes.end());
      if (&side == &a_)
        std::transform(t.begin(), t.end(), t.begin(), [&](NodeIndex n) { return to_b(n); });
      out.push_back({turned(std::move(t)), element_id(side.loaded.model(), s.carrier, s.element)});
    }
    return out;
  }
  std::vector<Member> edges(const DiffSide& side, const std::vector<Edge>& list) const {
    std::vector<Member> out;
    for (const Edge& s : list) {
      Tuple t(s.nodes.begin(), s.nodes.end());
      if (&side == &a_)
        std::transform(t.begin(), t.end(), t.begin(), [&](NodeIndex n) { return to_b(n); });
      std::sort(t.begin(), t.end());
      out.push_back({std::move(t), element_id(side.loaded.model(), s.carrier, s.element)});
    }
    return out;
  }
  std::vector<Member> nodes(const DiffSide& side, const std::vector<NodeIndex>& list) const {
    std::vector<Member> out;
    for (const NodeIndex n : list)
      out.push_back({{&side == &a_ ? to_b(n) : n}, side.loaded.model().node_id(n)});
    return out;
  }
  std::vector<Member> items(const DiffSide& side, ElementKind kind,
                            const std::vector<std::uint32_t>& list) const {
    std::vector<Member> out;
    for (const std::uint32_t e : list)
      out.push_back({{&side == &a_ ? pairs_.element_to_b[static_cast<std::size_t>(kind)][e] : e},
                     side.loaded.model().family(kind).id[e]});
    return out;
  }
  std::vector<Member> parts(const DiffSide& side, const std::vector<std::uint32_t>& list) const {
    std::vector<Member> out;
    for (const std::uint32_t p : list) {
      const std::int64_t id = side.loaded.model().parts[p].id;
      const std::int64_t to = &side == &a_ ? pairs_.mapped(a_, b_, "part", id) : id;
      const auto it = b_.loaded.model().part_of_id.find(to);
      out.push_back({{it == b_.loaded.model().part_of_id.end() ? no_index : it->second}, id});
    }
    return out;
  }

  /// What the group comes to, by name of the list.
  std::vector<std::pair<std::string, std::vector<Member>>> lists_of(const DiffSide& side,
                                                                    const Item& item,
                                                                    std::string_view kind) const {
    Selections& s = *side.loaded.model().selections;
    if (kind == "grnod") {
      const NodeSet* g = s.node_group(item.id);
      return {{"nodes", g == nullptr ? std::vector<Member>() : nodes(side, g->nodes)}};
    }
    if (kind == "surf") {
      const Surface* g = s.surface(item.id);
      return {{"segments", g == nullptr ? std::vector<Member>() : segments(side, g->segments)}};
    }
    if (kind == "line") {
      const LineSet* g = s.line(item.id);
      return {{"edges", g == nullptr ? std::vector<Member>() : edges(side, g->edges)}};
    }
    if (kind == "grpart") {
      const auto* g = s.part_group(item.id);
      return {{"parts", g == nullptr ? std::vector<Member>() : parts(side, *g)}};
    }
    if (kind == "set") {
      const SetGeneral* g = s.set(item.id);
      if (g == nullptr) return {};
      return {{"nodes", nodes(side, g->nodes)},
              {"segments", segments(side, g->segments)},
              {"edges", edges(side, g->edges)},
              {"parts", parts(side, g->parts)}};
    }
    if (const auto family = detail::family_of_group(kind)) {
      const auto* g = s.element_group(kind, item.id);
      return {{"elements", g == nullptr ? std::vector<Member>() : items(side, *family, *g)}};
    }
    return {};
  }

  void members(const Item& a, const Item& b, std::string_view kind) {
    auto la = lists_of(a_, a, kind), lb = lists_of(b_, b, kind);
    for (std::size_t i = 0; i < std::max(la.size(), lb.size()); ++i) {
      const std::string name = i < la.size() ? la[i].first : lb[i].first;
      std::vector<Member> none;
      auto& x = i < la.size() ? la[i].second : none;
      auto& y = i < lb.size() ? lb[i].second : none;
      const auto nx = static_cast<std::int64_t>(x.size()), ny = static_cast<std::int64_t>(y.size());
      std::sort(x.begin(), x.end());
      std::sort(y.begin(), y.end());
      std::vector<Member> lost, gained;
      std::set_difference(x.begin(), x.end(), y.begin(), y.end(), std::back_inserter(lost));
      std::set_difference(y.begin(), y.end(), x.begin(), x.end(), std::back_inserter(gained));
      if (lost.empty() && gained.empty()) continue;
      Change& c = add(ChangeKind::changed, a, &b, name);
      c.old_value = nx;
      c.new_value = ny;
      const auto ids = [](const std::vector<Member>& list) {
        std::vector<std::int64_t> out;
        for (const Member& m : list) out.push_back(m.id);
        std::sort(out.begin(), out.end());
        return out;
      };
      c.lost = ids(lost);
      c.gained = ids(gained);
      c.a = a.block->header_span;
      c.b = b.block->header_span;
    }
  }

  // ---- nodes and elements ---------------------------------------------------------------------

  Change& loose(ChangeKind kind, std::string group, std::string keyword, std::int64_t id) {
    Change c;
    c.kind = kind;
    c.group = std::move(group);
    c.keyword = std::move(keyword);
    c.id = id;
    out_.changes.push_back(std::move(c));
    return out_.changes.back();
  }

  void nodes() {
    const Nodes& na = a_.loaded.model().nodes;
    const Nodes& nb = b_.loaded.model().nodes;
    std::vector<std::uint8_t> used(nb.size(), 0);
    std::vector<std::int64_t> lost, gained;
    for (NodeIndex n = 0; n < na.size(); ++n) {
      const NodeIndex m = pairs_.node_to_b[n];
      if (m == no_index) {
        lost.push_back(na.id[n]);
        continue;
      }
      used[m] = 1;
      const bool same = same_length(na.x[n], nb.x[m]) && same_length(na.y[n], nb.y[m]) &&
                        same_length(na.z[n], nb.z[m]);
      if (same) continue;
      Change& c = loose(ChangeKind::moved, "node", "/NODE", na.id[n]);
      if (nb.id[m] != na.id[n]) c.id_b = nb.id[m];
      c.field = "position";
      c.old_value = std::array{na.x[n], na.y[n], na.z[n]};
      c.new_value = std::array{nb.x[m] / length_, nb.y[m] / length_, nb.z[m] / length_};
      if (placed_++ < most_places) {
        c.a = a_.loaded.model().node_span(n);
        c.b = b_.loaded.model().node_span(m);
      }
    }
    for (NodeIndex m = 0; m < nb.size(); ++m)
      if (used[m] == 0) gained.push_back(nb.id[m]);
    tolerances();
    if (lost.empty() && gained.empty()) return;
    Change& c = loose(ChangeKind::changed, "node", "/NODE", 0);
    c.field = "nodes";
    c.old_value = static_cast<std::int64_t>(na.size());
    c.new_value = static_cast<std::int64_t>(nb.size());
    c.lost = std::move(lost);
    c.gained = std::move(gained);
  }

  /// A length of either deck, each in its own units.
  bool same_length(double x, double y) {
    return equal_(x * length_, y, extent_ * length_, other_units_);
  }

  struct Tolerance {
    double length = 0;  ///< in working units of the first deck
    Span place;
  };

  /// Within these distances /CNODE merges its nodes with others.
  std::vector<Tolerance> tolerances_of(const DiffSide& side) const {
    std::vector<Tolerance> out;
    for (const Block& b : side.loaded.deck().blocks) {
      constexpr std::string_view keyword = "/CNODE/";
      if (!b.header.starts_with(keyword)) continue;
      const double x = read_real(b.header.substr(keyword.size())).value;
      const UnitSystem* units = side.loaded.deck().units_of(b);
      out.push_back(
          {x * conversion_factor(units == nullptr ? units_a_ : *units, units_a_, length_dimension),
           b.header_span});
    }
    return out;
  }

  void tolerances() {
    const auto ta = tolerances_of(a_), tb = tolerances_of(b_);
    for (std::size_t i = 0; i < ta.size() && i < tb.size(); ++i) {
      if (equal_(ta[i].length, tb[i].length, extent_, true)) continue;
      Change& c = loose(ChangeKind::changed, "node", "/CNODE", 0);
      c.field = "tolerance";
      c.old_value = ta[i].length;
      c.new_value = tb[i].length;
      c.a = ta[i].place;
      c.b = tb[i].place;
    }
  }

  struct PartElements {
    std::vector<std::int64_t> lost, gained, altered;
    std::int64_t before = 0, after = 0;
  };

  /// Elements by the part that has them, in the first deck where it is there.
  void elements() {
    std::map<std::pair<std::int64_t, const char*>, PartElements> parts;
    std::map<std::int64_t, std::int64_t> part_to_a;
    for (const Part& p : a_.loaded.model().parts)
      if (const std::int64_t to = pairs_.mapped(a_, b_, "part", p.id); to != 0)
        part_to_a.emplace(to, p.id);
    const auto part_a = [&](const Elements& f, std::uint32_t e) {
      return f.part[e] == no_index ? 0 : a_.loaded.model().parts[f.part[e]].id;
    };
    const auto part_b = [&](const Elements& f, std::uint32_t e) {
      if (f.part[e] == no_index) return std::int64_t{0};
      const std::int64_t id = b_.loaded.model().parts[f.part[e]].id;
      const auto it = part_to_a.find(id);
      return it == part_to_a.end() ? id : it->second;
    };
    const detail::ElementCells cells_a = detail::element_cells(a_.loaded.deck(), a_.loaded.model());
    const detail::ElementCells cells_b = detail::element_cells(b_.loaded.deck(), b_.loaded.model());
    for (const ElementKind kind : detail::all_families) {
      const char* keyword = detail::keyword_of_family(kind);
      const Elements& fa = a_.loaded.model().family(kind);
      const Elements& fb = b_.loaded.model().family(kind);
      const auto& to = pairs_.element_to_b[static_cast<std::size_t>(kind)];
      std::vector<std::uint8_t> used(fb.size(), 0);
      for (std::uint32_t e = 0; e < fa.size(); ++e) {
        PartElements& p = parts[{part_a(fa, e), keyword}];
        ++p.before;
        const std::uint32_t f = to[e];
        if (f != no_index) used[f] = 1;
        if (f == no_index || part_a(fa, e) != part_b(fb, f)) {
          p.lost.push_back(fa.id[e]);
          if (f != no_index) parts[{part_b(fb, f), keyword}].gained.push_back(fb.id[f]);
        } else if (!same_element(fa, e, fb, f) ||
                   !same_cells(cells_of(cells_a, kind, e), cells_of(cells_b, kind, f))) {
          p.altered.push_back(fa.id[e]);
        }
      }
      for (std::uint32_t f = 0; f < fb.size(); ++f) {
        PartElements& p = parts[{part_b(fb, f), keyword}];
        ++p.after;
        if (used[f] == 0) p.gained.push_back(fb.id[f]);
      }
    }
    for (auto& [key, p] : parts) {
      if (p.lost.empty() && p.gained.empty() && p.altered.empty()) continue;
      Change& c = loose(ChangeKind::changed, "part", "/PART", key.first);
      const auto title = [id = key.first](const Model& m) {
        const auto it = m.part_of_id.find(id);
        return it == m.part_of_id.end() ? std::string() : m.parts[it->second].title;
      };
      c.title = title(a_.loaded.model());
      if (c.title.empty()) c.title = title(b_.loaded.model());
      c.field = std::string(key.second) + " elements";
      c.old_value = p.before;
      c.new_value = p.after;
      c.lost = std::move(p.lost);
      c.gained = std::move(p.gained);
      c.altered = std::move(p.altered);
    }
  }

  bool same_element(const Elements& fa, std::uint32_t e, const Elements& fb, std::uint32_t f) {
    for (int i = 0; i < fa.width; ++i)
      if (to_b(fa.of(e)[i]) != fb.of(f)[i]) return false;
    if (!fa.shape.empty() && (fa.shape[e] != fb.shape[f] || !same_mid_nodes(fa, e, fb, f)))
      return false;
    const auto thickness = [](const Elements& x, std::uint32_t i) {
      return i < x.thickness.size() ? x.thickness[i] : 0;
    };
    return same_length(thickness(fa, e), thickness(fb, f));
  }

  bool same_mid_nodes(const Elements& fa, std::uint32_t e, const Elements& fb,
                      std::uint32_t f) const {
    const auto mid = [](const Elements& x, std::uint32_t i) {
      return x.extra.empty() || x.extra[i] == no_index ? nullptr
                                                       : x.extra_nodes.data() + x.extra[i];
    };
    const NodeIndex *x = mid(fa, e), *y = mid(fb, f);
    for (int i = 0; i < extra_node_count(fa.shape[e]); ++i)
      if ((x == nullptr ? no_index : to_b(x[i])) != (y == nullptr ? no_index : y[i])) return false;
    return true;
  }

  using RowCells = std::vector<detail::ElementCell>;

  static const RowCells& cells_of(const detail::ElementCells& all, ElementKind kind,
                                  std::uint32_t e) {
    static const RowCells none;
    const auto& of_kind = all[static_cast<std::size_t>(kind)];
    const auto it = of_kind.find(e);
    return it == of_kind.end() ? none : it->second;
  }

  /// Angles and directions have no dimension.
  bool same_cells(const RowCells& x, const RowCells& y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                      [&](const detail::ElementCell& u, const detail::ElementCell& v) {
                        return u.field->name == v.field->name && equal_(u.real, v.real, 0, false) &&
                               same_id(u.field->ref, u.id, v.id);
                      });
  }

  // ---- penetrations ---------------------------------------------------------------------------

  struct Depth {
    std::int64_t interface_id = 0;
    std::array<std::int64_t, 2> secondary{};
    double depth = 0, gap = 0;
  };
  using PenetrationKey = std::tuple<std::int64_t, std::string, std::array<std::int64_t, 2>>;

  std::map<PenetrationKey, Depth> deepest(const DiffSide& side) const {
    std::map<PenetrationKey, Depth> out;
    for (const std::uint32_t i : side.view->deepest_per_node) {
      const NamedPenetration& p = side.view->penetrations[i];
      const Contact& c = side.loaded.scene().contacts[p.contact];
      const PenetrationRow& row = c.penetrations[p.row];
      Depth d{c.inter->id, p.secondary, row.depth, row.gap};
      std::int64_t id = c.inter->id;
      std::array<std::int64_t, 2> nodes = p.secondary;
      if (&side == &a_) {
        id = pairs_.mapped(a_, b_, "inter", id);
        for (std::int64_t& n : nodes)
          if (n != 0) n = pairs_.mapped(a_, b_, "node", n);
        // Nothing there that could penetrate: keys that the other side cannot have.
        if (id == 0) id = -c.inter->id;
        if (nodes[0] == 0 || (nodes[1] == 0 && p.secondary[1] != 0))
          nodes = {-p.secondary[0], -p.secondary[1]};
      }
      if (nodes[1] != 0 && nodes[0] > nodes[1]) std::swap(nodes[0], nodes[1]);
      out.try_emplace({id, to_string(c.role), nodes}, d);
    }
    return out;
  }

  void penetrations() {
    const auto before = deepest(a_), now = deepest(b_);
    // Depths are differences of coordinates.
    const double nothing = equal_.tolerance() * extent_ * length_;
    for (const auto& [key, d] : before) {
      const auto it = now.find(key);
      if (it == now.end() && d.depth * length_ <= nothing) continue;
      if (it == now.end()) {
        out_.gone.push_back({d.interface_id, std::get<1>(key), d.secondary, d.depth, 0, d.gap, 0});
        continue;
      }
      const Depth& n = it->second;
      const double was = d.depth * length_;
      PenetrationChange p{n.interface_id, std::get<1>(key), n.secondary, d.depth, n.depth, d.gap,
                          n.gap};
      const double noise = std::max(nothing, 1e-9 * std::max(d.gap * length_, n.gap));
      if (n.depth > was + noise)
        out_.worse.push_back(p);
      else if (n.depth < was - noise)
        out_.better.push_back(p);
      else
        ++out_.same_penetrations;
    }
    for (const auto& [key, n] : now)
      if (!before.contains(key) && n.depth > nothing)
        out_.appeared.push_back(
            {n.interface_id, std::get<1>(key), n.secondary, 0, n.depth, 0, n.gap});
    const auto sort = [](std::vector<PenetrationChange>& list, auto&& depth) {
      std::stable_sort(list.begin(), list.end(),
                       [&](const auto& x, const auto& y) { return depth(x) > depth(y); });
    };
    sort(out_.appeared, [](const PenetrationChange& p) { return p.depth_new; });
    sort(out_.gone, [](const PenetrationChange& p) { return p.depth_old; });
    sort(out_.worse, [](const PenetrationChange& p) { return p.depth_new - p.depth_old; });
    sort(out_.better, [](const PenetrationChange& p) { return p.depth_old - p.depth_new; });
  }

  /// A deck that was renumbered is compared in vain by ids.
  void hint() {
    std::size_t lost = 0;
    for (const std::uint32_t n : pairs_.node_to_b) lost += n == no_index ? 1 : 0;
    if (2 * lost > pairs_.node_to_b.size())
      out_.notes.push_back(
          fmt::format("{} of {} nodes have no counterpart; decks with other ids are "
                      "compared with --match position",
                      lost, pairs_.node_to_b.size()));
  }

  void tell_of_numbers() {
    const auto values = [](std::size_t n) {
      return fmt::format("{} {}", n, n == 1 ? "value differs" : "values differ");
    };
    const std::size_t within = equal_.used() + functions_.within_tolerance();
    if (within > 0)
      out_.notes.push_back(fmt::format(
          "{} by less than {:g} of its size (coordinates and lengths: of the model's size) and "
          "count as equal (--tolerance)",
          values(within), equal_.tolerance()));
    if (equal_.nearly_equal() > 0)
      out_.notes.push_back(
          fmt::format("{0} by less than {1:g} of its size; with --tolerance {1:g} they count as "
                      "equal",
                      values(equal_.nearly_equal()), detail::EqualNumbers::nearly));
    if (ignored_ > 0)
      out_.notes.push_back(fmt::format(
          "{} that the reference solver does not use: no difference in itself", values(ignored_)));
  }

  static constexpr std::size_t most_places =
      1000;  ///< lines of moved nodes: found by reading again

  const DiffSide& a_;
  const DiffSide& b_;
  const UnitSystem& units_a_;
  const UnitSystem& units_b_;
  bool other_units_;
  double length_;
  double extent_;  ///< of both models, in working units of the first
  detail::EqualNumbers equal_;
  Counterparts pairs_;
  detail::FunctionUses functions_;
  std::size_t ignored_ = 0;  ///< values that differ and are not used
  std::size_t placed_ = 0;
  DeckDiff out_;
};

}  // namespace

DeckDiff diff_decks(const DiffSide& a, const DiffSide& b, MatchBy match, double tolerance) {
  return Differ(a, b, match, tolerance).run();
}

}  // namespace deck
