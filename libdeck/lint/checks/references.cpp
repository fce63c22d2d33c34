// Targets of interfaces and frictions (groups, surfaces, lines, sensors, functions, parts), and
// unused groups, surfaces, lines and frictions.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <map>
#include <tuple>
#include <unordered_set>

#include "lint/check.hpp"

namespace deck::detail {
namespace {

struct ContactSide {
  std::string_view field, kind;
  bool secondary;
};

/// Cells of the sides, main side last.
std::vector<ContactSide> sides_of(const ContactCard& card) {
  constexpr std::array<std::string_view, 4> secondary = {"grnd_IDs", "surf_IDs", "line_IDs",
                                                         "surf_ID1"};
  constexpr std::array<std::string_view, 3> main = {"surf_IDm", "line_IDm", "surf_ID2"};
  std::vector<ContactSide> out;
  const auto is_in = [](const auto& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const int version = card.block->version;
  for (const CardSchema& line : card.block->schema->cards)
    for (const Field& f : line.fields) {
      if (!line.in_version(version) || !f.in_version(version)) continue;
      // With Ists the node group is a surface, which is not evaluated. A tie of surfaces has no
      // node group.
      const bool none = f.name == "grnd_IDs" && (card.given("Ists") || card.given("surf_IDs"));
      if (is_in(secondary, f.name) && !none) out.insert(out.begin(), {f.name, f.ref, true});
      if (is_in(main, f.name)) out.push_back({f.name, f.ref, false});
    }
  return out;
}

/// Id of a side as in the model; 0: blank.
std::int64_t side_id(const LintContext& c, const ContactCard& card, const ContactSide& side) {
  const auto id = static_cast<std::int64_t>(card.input(side.field));
  // Typed interfaces include the submodel offset.
  return card.inter != nullptr ? id : c.resolved(*card.block, side.kind, id);
}

constexpr std::array<std::string_view, 3> side_kinds = {"grnod", "surf", "line"};

/// Another kind of entity with that id; empty: none.
std::string_view other_kind(const LintContext& c, std::string_view kind, std::int64_t id) {
  for (const std::string_view k : side_kinds)
    if (k != kind && c.selections->is_plain(k, id)) return k;
  return {};
}

template <class F>
void for_each_side(const LintContext& c, F&& f) {
  for (const ContactCard& card : c.contacts)
    for (const ContactSide& side : sides_of(card))
      if (const std::int64_t id = side_id(c, card, side); id != 0) f(card, side, id);
}

/// Uses the cells of the card, to include types without typed struct.
void check_missing_entity(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const ContactCard& card : c.contacts)
    for (const FieldView& f : card.fields) {
      const std::string_view kind = f.field != nullptr ? f.field->ref : std::string_view();
      if (std::find(side_kinds.begin(), side_kinds.end(), kind) == side_kinds.end()) continue;
      // With Ists the node group is a surface.
      const std::int64_t id = card.given("Ists") ? 0 : side_id(c, card, {f.name, kind, false});
      if (id > 0 && !selection_exists(c, kind, id) && other_kind(c, kind, id).empty())
        report_at(r, rule, card, f.name, missing_text(c, card.decoded, f.name, kind, id));
    }
}

void check_kind(const LintContext& c, const Rule& rule, Reporter& r) {
  for_each_side(c, [&](const ContactCard& card, const ContactSide& side, std::int64_t id) {
    if (id < 0 || selection_exists(c, side.kind, id)) return;
    const std::string_view other = other_kind(c, side.kind, id);
    if (other.empty()) return;
    Finding& d = report_at(
        r, rule, card, side.field,
        fmt::format("{} of {} is {}: there is a {} of that id, but a {} is expected here",
                    side.field, name_of(card), id, kind_name(other), kind_name(side.kind)));
    if (const auto at = c.selections->where(other, id))
      d.notes.emplace_back(
          *at, std::string(kind_name(other)) + " " + std::to_string(id) + " is defined here");
    if (side.kind == "grnod" && other == "surf")
      d.help = fmt::format("Define a /GRNOD/SURF of surface {} and refer to that.", id);
  });
}

/// True if the side uses only the nodes of this set.
bool has_nodes_only(const LintContext& c, std::string_view kind, std::int64_t id) {
  return kind != "grnod" && !c.selections->is_plain(kind, id) && selection_size(c, "grnod", id) > 0;
}

void check_empty(const LintContext& c, const Rule& rule, Reporter& r) {
  const bool secondary = rule.id == RuleId::DK172;
  for_each_side(c, [&](const ContactCard& card, const ContactSide& side, std::int64_t id) {
    if (side.secondary != secondary || id < 0 || !selection_exists(c, side.kind, id)) return;
    if (!selection_is_empty(c, side.kind, id)) return;
    Finding& d =
        report_at(r, rule, card, side.field,
                  fmt::format("the {} side of {}, {}, is empty{}", secondary ? "secondary" : "main",
                              name_of(card), selection_name(c, side.kind, id),
                              has_nodes_only(c, side.kind, id)
                                  ? ": the set has nodes, and no " +
                                        std::string(side.kind == "surf" ? "segments" : "edges")
                                  : ""));
    note_definition(c, d, side.kind, id);
    if (secondary && side.kind != "grnod") {
      d.severity = Severity::error;
      d.reference = rule.message(118);
    }
    if (!secondary && (card.type == 7 || card.type == 19)) d.reference = rule.message(3160);
  });
}

void check_analytical(const LintContext& c, const Rule& rule, Reporter& r) {
  for_each_side(c, [&](const ContactCard& card, const ContactSide& side, std::int64_t id) {
    if (side.kind != "surf") return;
    const auto s = c.selections->outline(id);
    if (!s || !s->analytical) return;
    Finding& d = report_at(r, rule, card, side.field,
                           fmt::format("{} of {}: surface {} is analytical and has no segments",
                                       side.field, name_of(card), id));
    note_definition(c, d, side.kind, id);
  });
}

/// Negative ids of sides, sensors and nodes are searched and not found; functions and frictions are
/// searched only for positive ids.
void negative_reference(Reporter& r, const Rule& rule, const ContactCard& card,
                        const FieldView& f) {
  Finding& d = report_at(r, rule, card, f.name,
                         fmt::format("{} of {} is negative: {}", f.name, name_of(card), f.text));
  if (f.field->ref == "sensor") d.reference = rule.message(1010);
  if (f.field->ref == "node") d.reference = rule.message(78);
  if (f.field->ref != "funct" && f.field->ref != "friction") return;
  d.severity = Severity::warning;
  d.reference.reset();
  d.reference_behaviour = "It continues silently, as if the cell were blank.";
}

void check_negative(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const ContactCard& card : c.contacts)
    for (const FieldView& f : card.fields)
      if (f.field != nullptr && f.field->type == FieldType::id && f.input < 0)
        negative_reference(r, rule, card, f);
}

void check_ambiguous(const LintContext& c, const Rule& rule, Reporter& r) {
  for_each_side(c, [&](const ContactCard& card, const ContactSide& side, std::int64_t id) {
    if (!c.selections->is_plain(side.kind, id)) return;
    const auto set = c.selections->where("set", id);
    if (!set) return;
    Finding& d = report_at(r, rule, card, side.field,
                           fmt::format("{} of {}: {} {} and /SET {} both exist", side.field,
                                       name_of(card), kind_name(side.kind), id, id));
    d.notes.emplace_back(*set, "the set that is not used");
  });
}

void check_no_main(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const ContactCard& card : c.contacts) {
    const auto sides = sides_of(card);
    if (sides.empty() || card.type == 11) continue;
    const std::string_view main = sides.back().field;
    if (card.given(main) || (card.type == 19 && card.given("surf_IDs"))) continue;
    if (is_type24_or_25(card.type) && card.given("surf_ID1")) continue;
    Finding& d = report_at(r, rule, card, main, name_of(card) + " has no main surface");
    if (card.type == 0) d.reference = rule.message(119);
  }
}

// ---- pairs of parts of a /FRICTION, and unused entities
// ------------------------------------------

/// Calls f(block, card) for the first line of every part pair.
template <class F>
void for_each_pair(const LintContext& c, F&& f) {
  for (const ContactCard& friction : c.frictions)
    for (const DecodedCard& card : friction.decoded.cards)
      if (cell_named(card, "part_ID1") != nullptr && !card.missing()) f(friction.decoded, card);
}

void check_parts(const LintContext& c, const Rule& rule, Reporter& r) {
  for_each_pair(c, [&](const DecodedBlock& block, const DecodedCard& card) {
    for (const Cell& cell : card.cells) {
      if (cell.field->type != FieldType::id || cell.integer <= 0) continue;
      const bool part = cell.field->ref == "part";
      const std::int64_t id = c.resolved(*block.block, cell.field->ref, cell.integer);
      const bool known =
          part ? c.model->part_of_id.count(id) > 0 : c.selections->part_group(id) != nullptr;
      if (!known)
        r.report(rule, *block.block, cell.span,
                 fmt::format("{} of {} is {}, and there is no {} of that id", cell.field->name,
                             name_of(block), id, part ? "/PART" : "/GRPART or /SET"));
    }
  });
}

void check_repeated(const LintContext& c, const Rule& rule, Reporter& r) {
  using Key = std::tuple<const Block*, std::int64_t, std::int64_t, std::int64_t, std::int64_t>;
  std::map<Key, Span> seen;
  for_each_pair(c, [&](const DecodedBlock& block, const DecodedCard& card) {
    const auto id = [&](std::string_view name) {
      const Cell* cell = cell_named(card, name);
      return cell ? cell->integer : 0;
    };
    auto one = std::pair{id("grpart_ID1"), id("part_ID1")};
    auto two = std::pair{id("grpart_ID2"), id("part_ID2")};
    if (two < one) std::swap(one, two);
    const auto [it, fresh] = seen.emplace(
        Key{block.block, one.first, one.second, two.first, two.second}, card.line.whole());
    if (fresh) return;
    Finding& d = r.report(rule, *block.block, card.line.whole(),
                          name_of(block) + " gives the same pair of parts twice");
    d.notes.emplace_back(it->second, "first given here");
  });
}

void check_incomplete(const LintContext& c, const Rule& rule, Reporter& r) {
  for_each_pair(c, [&](const DecodedBlock& block, const DecodedCard& card) {
    const auto given = [&](const std::string& side) {
      const Cell* group = cell_named(card, "grpart_ID" + side);
      const Cell* part = cell_named(card, "part_ID" + side);
      return (group != nullptr && group->integer != 0) || (part != nullptr && part->integer != 0);
    };
    const bool first = given("1"), second = given("2");
    if (first && second) return;
    if (!first && !second) {
      Finding& d = r.report(rule, *block.block, card.line.whole(),
                            "a pair of " + name_of(block) + " names no parts");
      d.severity = Severity::warning;
      d.reference.reset();
      d.reference_behaviour = "It continues silently.";
      return;
    }
    const char* side = first ? "2" : "1";
    r.report(rule, *block.block, card.line.whole(),
             fmt::format("a pair of {} has neither grpart_ID{} nor part_ID{}", name_of(block), side,
                         side));
  });
}

/// What may be referred to.
class References {
 public:
  explicit References(const LintContext& c) : c_(c) {}
  bool name(std::string_view kind, std::int64_t id) {
    const auto it = c_.referenced.find(kind);
    if (it != c_.referenced.end() && it->second.contains(id)) return true;
    if (!numbers_) look_through_raw_blocks();
    return numbers_->contains(id);
  }

 private:
  /// Every whole number in blocks whose cards are not described may be a reference.
  void look_through_raw_blocks() {
    numbers_.emplace();
    for (const Block& b : c_.deck.blocks)
      if (const Schema* s = b.schema; !b.opaque && !(s != nullptr && s->bulk))
        if (s == nullptr || s->opaque_tail || s->kind == "set") add_numbers(b);
  }
  /// As written and with the submodel's offset.
  void add_numbers(const Block& block) {
    const std::int64_t offset = c_.deck.offset_of(block, "");
    LineCursor cursor(c_.deck.sources, block);
    for (Line line = cursor.next(); line.valid(); line = cursor.next()) {
      // Only words of digits: "7.8e-06" is no reference to 6.
      constexpr std::string_view blanks = " \t,";
      std::string_view rest = line.text;
      while (!rest.empty()) {
        rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
        const std::string_view word = rest.substr(0, rest.find_first_of(blanks));
        rest.remove_prefix(word.size());
        std::int64_t value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (word.empty() || error != std::errc() || end != word.data() + word.size()) continue;
        value = std::abs(value);
        numbers_->insert(value);
        if (offset != 0) numbers_->insert(value + offset);
      }
    }
  }

  const LintContext& c_;
  std::optional<std::unordered_set<std::int64_t>> numbers_;
};

void check_unused_friction(const LintContext& c, const Rule& rule, Reporter& r) {
  References references(c);
  for (const ContactCard& friction : c.frictions) {
    const Block& block = *friction.block;
    if (!references.name("friction", c.resolved(block, "friction", block.id.value)))
      r.report(rule, block, block.header_span, "no interface uses " + name_of(friction));
  }
}

void check_unused_groups(const LintContext& c, const Rule& rule, Reporter& r) {
  References references(c);
  for (const std::string_view kind : {"grnod", "surf", "line"}) {
    const auto all = c.defined.find(kind);
    if (all == c.defined.end()) continue;
    for (const auto& [id, block] : all->second)
      if (!references.name(kind, id))
        r.report(rule, *block, block->header_span,
                 fmt::format("nothing refers to {} {}", block->schema->keyword, id));
  }
}

}  // namespace

std::vector<Checked> reference_checks() {
  return {{RuleId::DK170, check_missing_entity},  {RuleId::DK171, check_kind},
          {RuleId::DK172, check_empty},           {RuleId::DK173, check_empty},
          {RuleId::DK174, check_analytical},      {RuleId::DK181, check_no_main},
          {RuleId::DK187, check_negative},        {RuleId::DK190, check_ambiguous},
          {RuleId::DK183, check_parts},           {RuleId::DK184, check_repeated},
          {RuleId::DK185, check_unused_friction}, {RuleId::DK186, check_incomplete},
          {RuleId::DK188, check_unused_groups}};
}

}  // namespace deck::detail
