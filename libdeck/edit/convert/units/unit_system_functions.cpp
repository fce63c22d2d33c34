// Points of functions in another unit system. The solver never converts them: they are numbers in
// working units wherever no scale stands between them and the block that uses the function.
#include <algorithm>

#include "edit/convert/units/unit_system_state.hpp"
#include "keyword/reader.hpp"

namespace deck::detail {
namespace {

using Use = UnitConversion::FunctionUse;

/// Factors of the two axes of a function for one of its uses.
struct PointFactors {
  UnitFactor x, y;
  bool one() const { return x.one() && y.one(); }
};

bool equal(const UnitFactor& a, const UnitFactor& b) {
  return a.power && b.power ? *a.power == *b.power : a.value == b.value;
}

PointFactors factors_of(const UnitConversion& c, const Use& use) {
  UnitFactor one;
  one.power = 0;
  if (use.points.empty()) return {one, one};
  return {c.factors.of(use.points.front()), c.factors.of(use.points.back())};
}

std::vector<const Block*> definitions(const Deck& deck, std::int64_t id) {
  std::vector<const Block*> found;
  for (const Block& b : deck.blocks)
    if (b.schema != nullptr && b.schema->kind == "funct" &&
        b.id.value + deck.offset_of(b, "funct") == id)
      found.push_back(&b);
  return found;
}

/// Scales and shifts of the function by a block of its own.
std::vector<const Block*> moves(const Deck& deck, std::int64_t id) {
  std::vector<const Block*> found;
  for (const Block& b : deck.blocks)
    if (b.schema != nullptr && b.schema->keyword == "/MOVE_FUNCT" &&
        b.id.value + deck.offset_of(b, "funct") == id)
      found.push_back(&b);
  return found;
}

void convert_points(UnitConversion& c, const Block& b, const PointFactors& factors) {
  const DecodedBlock d = decode(c.deck, b);
  for (const DecodedCard& card : d.cards)
    for (const Cell& cell : card.cells) {
      const std::string_view name = cell.field->name;
      const bool x = name == "X" || name == "Ashift_x";
      if (!x && name != "Y" && name != "Ashift_y") continue;
      const UnitFactor& factor = x ? factors.x : factors.y;
      if (factor.one() || cell.blank()) continue;
      if (cell.parameter)
        c.undecided(b, cell.span, std::string(name), "a point of the function is a parameter");
      else if (card.free_format)
        c.convert_free(b, card.line, cell.span, name, factor);
      else
        c.convert_fixed(b, card.line, cell.field->first, cell.field->last, name, factor);
    }
}

bool has_tables(const Deck& deck) {
  return std::any_of(deck.blocks.begin(), deck.blocks.end(),
                     [](const Block& b) { return b.header.starts_with("/TABLE"); });
}

void convert_function(UnitConversion& c, std::int64_t id, const std::vector<const Use*>& uses) {
  const PointFactors factors = factors_of(c, *uses.front());
  const bool alike = std::all_of(uses.begin(), uses.end(), [&](const Use* use) {
    const PointFactors other = factors_of(c, *use);
    return equal(factors.x, other.x) && equal(factors.y, other.y);
  });
  const bool between = std::any_of(uses.begin(), uses.end(), [](const Use* use) {
    return std::any_of(use->points.begin(), use->points.end(),
                       [](const Dimension& d) { return !d.dimensionless(); });
  });
  if (!between || (alike && factors.one())) return;
  const auto refuse = [&](const std::string& why) {
    for (const Use* use : uses)
      if (!factors_of(c, *use).one()) c.undecided(*use->block, use->span, use->field, why);
  };
  const auto blocks = definitions(c.deck, id);
  if (blocks.empty()) return refuse("the points of this table have units, and tables are not read");
  if (!alike)
    return refuse("function " + std::to_string(id) +
                  " is used in several units, and this use has no scale for its points; give it a "
                  "function of its own");
  if (has_tables(c.deck))
    return refuse("the points of function " + std::to_string(id) +
                  " would have to change, and a table may use them; write the table's function "
                  "under another id");
  for (const Block* b : blocks) {
    if (b->schema->keyword == "/FUNCT_PYTHON")
      return refuse("the function is computed by a script, which cannot be converted");
    UnitConversion::Share share;
    share.edits = c.out.edits.size();
    share.losses = c.out.losses.size();
    convert_points(c, *b, factors);
    share.edits_end = c.out.edits.size();
    share.losses_end = c.out.losses.size();
    c.shares[b] = share;
  }
  for (const Block* b : moves(c.deck, id)) convert_points(c, *b, factors);
}

}  // namespace

void convert_functions(UnitConversion& c) {
  if (!c.working_changes) return;
  std::map<std::int64_t, std::vector<const Use*>> by_id;
  for (const Use& use : c.function_uses)
    by_id[use.id + c.deck.offset_of(*use.block, "funct")].push_back(&use);
  for (const auto& [id, uses] : by_id) convert_function(c, id, uses);
}

}  // namespace deck::detail
