// Converts points of functions. The solver takes them as working units unless the block that uses
// the function has a scale.
#include <algorithm>

#include "deck/text.hpp"
#include "edit/convert/units/unit_system.hpp"
#include "keyword/shared/reader.hpp"

namespace deck::detail {
namespace {

using Use = UnitConversion::FunctionUse;

/// Factors of both axes for one use of a function.
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

/// True if an inner abscissa of a table, such as a strain rate, changes.
bool middle_changes(const UnitConversion& c, const Use& use) {
  for (std::size_t axis = 1; axis + 1 < use.points.size(); ++axis)
    if (!c.factors.of(use.points[axis]).one()) return true;
  return false;
}

/// Blocks that define a function (`moves` false), or scale and shift it.
std::vector<const Block*> blocks_of(const Deck& deck, std::int64_t id, bool moves) {
  std::vector<const Block*> found;
  for (const Block& b : deck.blocks)
    if (b.schema != nullptr &&
        (moves ? b.schema->keyword == "/MOVE_FUNCT" : b.schema->kind == "funct") &&
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
      else
        c.convert(place_of(b, card, cell), factor);
    }
}

std::string edited(const Deck& deck, const Block& b, std::vector<TextEdit> edits) {
  std::sort(edits.begin(), edits.end(),
            [](const TextEdit& x, const TextEdit& y) { return x.span.offset < y.span.offset; });
  std::string text;
  const auto append = [&](std::uint32_t file, std::uint64_t begin, std::uint64_t end) {
    const std::string_view bytes = deck.sources[file].bytes();
    for (const TextEdit& e : edits) {
      if (e.span.file != file || e.span.offset < begin || e.span.offset >= end) continue;
      text.append(bytes.substr(begin, e.span.offset - begin)).append(e.text);
      begin = e.span.offset + e.span.length;
    }
    text.append(bytes.substr(begin, end - begin));
    if (!text.ends_with('\n')) text += '\n';
  };
  const FilePiece& first = b.body.front();
  const std::uint64_t header_end = b.header_span.offset + b.header_span.length;
  append(b.header_span.file, b.header_span.offset,
         first.file == b.header_span.file ? first.begin : header_end);
  for (const FilePiece& piece : b.body) append(piece.file, piece.begin, piece.end);
  return text;
}

/// Functions and tables share ids.
std::int64_t free_id(const Deck& deck) {
  std::int64_t largest = 0;
  for (const Block& b : deck.blocks) {
    if (b.schema != nullptr && b.schema->kind == "funct")
      largest = std::max(largest, b.id.value + deck.offset_of(b, "funct"));
    if (!b.header.starts_with("/TABLE")) continue;
    for (std::string_view rest = b.header; !rest.empty();) {
      rest.remove_prefix(1);
      const auto field = rest.substr(0, rest.find('/'));
      const IntegerCell number = read_integer(field);
      if (number.status == NumberStatus::ok)
        largest = std::max(largest, number.value + deck.offset_of(b, "funct"));
      rest.remove_prefix(field.size());
    }
  }
  return largest + 1;
}

/// Writes copies of function `id` with converted points behind its blocks, and points `uses` to
/// them. False: a copy is not possible.
bool copy_function(UnitConversion& c, std::int64_t id, const std::vector<const Block*>& blocks,
                   const std::vector<const Use*>& uses) {
  const std::int64_t fresh = std::max(free_id(c.deck), c.last_copy + 1);
  const auto local = [&](const Block& b) {
    return std::to_string(fresh - c.deck.offset_of(b, "funct"));
  };
  constexpr std::size_t most_digits = 10;
  for (const Block* b : blocks)
    if (b->body.empty() || b->id.span.length == 0 || local(*b).size() > most_digits) return false;
  c.last_copy = fresh;
  const PointFactors factors = factors_of(c, *uses.front());
  for (const Block* b : blocks) {
    const auto made = c.out.edits.size();
    convert_points(c, *b, factors);
    std::vector<TextEdit> points(c.out.edits.begin() + static_cast<std::ptrdiff_t>(made),
                                 c.out.edits.end());
    c.out.edits.resize(made);
    points.push_back({b->id.span, local(*b)});
    const FilePiece& last = b->body.back();
    std::string text = edited(c.deck, *b, std::move(points));
    const std::string_view bytes = c.deck.sources[last.file].bytes();
    if (last.end > 0 && bytes[last.end - 1] != '\n') text.insert(0, 1, '\n');
    c.copies[{last.file, last.end}] += text;
  }
  for (const Use* use : uses) {
    const UnitConversion::OpenShare share(c, *use->block);
    const bool minus = c.deck.sources.text(use->span).find('-') != std::string_view::npos;
    if (!c.cells.put(*use, (minus ? "-" : "") + local(*use->block))) {
      c.undecided(*use->block, use->span, std::string(use->field),
                  "function " + std::to_string(id) + " needs a copy for this use, and its new id " +
                      "has no room here");
      continue;
    }
    c.out.losses.push_back(loss_entry(c.deck, Loss::kept, *use->block, use->span,
                                      {.field = std::string(use->field),
                                       .old_text = std::to_string(id),
                                       .new_text = local(*use->block),
                                       .note = "other uses read function " + std::to_string(id) +
                                               " in other units; this one has a converted copy"}));
  }
  return true;
}

void convert_function(UnitConversion& c, std::int64_t id, const std::vector<const Use*>& uses) {
  const bool between = std::any_of(uses.begin(), uses.end(), [](const Use* use) {
    return std::any_of(use->points.begin(), use->points.end(),
                       [](const Dimension& d) { return !d.dimensionless(); });
  });
  if (!between) return;
  // Uses with equal points, in deck order.
  std::vector<std::vector<const Use*>> groups;
  const std::vector<const Block*> blocks = blocks_of(c.deck, id, false);
  const std::vector<const Block*> moves = blocks_of(c.deck, id, true);
  bool as_they_are = c.deck.has("/TABLE");  // a table may use the unchanged points
  for (const Use* use : uses) {
    const PointFactors factors = factors_of(c, *use);
    if (blocks.empty() && middle_changes(c, *use)) {
      c.undecided(*use->block, use->span, std::string(use->field),
                  "an abscissa of this table has units, and tables are not read");
      continue;
    }
    if (factors.one()) {
      as_they_are = true;
      continue;
    }
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const auto& group) {
      const PointFactors other = factors_of(c, *group.front());
      return equal(factors.x, other.x) && equal(factors.y, other.y);
    });
    if (same == groups.end())
      groups.push_back({use});
    else
      same->push_back(use);
  }
  const auto refuse = [&](const std::vector<const Use*>& group, const std::string& why) {
    for (const Use* use : group) c.undecided(*use->block, use->span, std::string(use->field), why);
  };
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (blocks.empty()) {
      refuse(groups[i], "the points of this table have units, and tables are not read");
    } else if (std::any_of(blocks.begin(), blocks.end(),
                           [](const Block* b) { return b->schema->keyword == "/FUNCT_PYTHON"; })) {
      refuse(groups[i], "the function is computed by a script, which cannot be converted");
    } else if (as_they_are || i > 0) {
      std::vector<const Block*> all = blocks;
      all.insert(all.end(), moves.begin(), moves.end());
      if (!copy_function(c, id, all, groups[i]))
        refuse(groups[i], "function " + std::to_string(id) +
                              " is used in several units, and a copy of it cannot be made; give "
                              "this use a function of its own");
    } else {
      const PointFactors factors = factors_of(c, *groups[i].front());
      for (const Block* b : blocks) {
        const UnitConversion::OpenShare share(c, *b);
        convert_points(c, *b, factors);
      }
      for (const Block* b : moves) convert_points(c, *b, factors);
    }
  }
}

}  // namespace

void convert_functions(UnitConversion& c) {
  if (!c.working_changes) return;
  std::map<std::int64_t, std::vector<const Use*>> by_id;
  for (const Use& use : c.function_uses)
    by_id[use.id + c.deck.offset_of(*use.block, "funct")].push_back(&use);
  for (const auto& [id, uses] : by_id) convert_function(c, id, uses);
  for (auto& [place, text] : c.copies)
    c.out.edits.push_back({Span{place.first, 0, place.second}, std::move(text)});
}

}  // namespace deck::detail
