// Renumbering: new ids for nodes, elements, parts, groups ... and everything that refers to them.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "deck/edit/rewrite.hpp"

namespace deck {

/// New ids of one kind.
struct RenumberRule {
  /// "node", "shell", "sh3n", "solid", "quad", "tria", "truss", "beam", "spring", "part", "prop",
  /// "mat", "subset", "grnod" (and the other group kinds), "surf", "line", "set", "box", "funct",
  /// "sensor", "skew", "frame", "friction", "inter", "transform"; "element": all element kinds;
  /// "group": all groups, surfaces, lines and sets; "all": everything named here.
  std::string kind;
  bool compact = false;    ///< new ids follow one another from `value` on, in the order of the old
  std::int64_t value = 0;  ///< added to every id; with `compact` the first id
  /// Not 0: only this id changes, to `value`. Ids may then come in another order.
  std::int64_t only = 0;
};

/// "node+1000", "part-50" (offset), "node=1" (compact from 1). Error: what is wrong with it.
Result<RenumberRule> parse_renumber_rule(std::string_view text);

struct RenumberOptions {
  std::vector<RenumberRule> rules;  ///< at most one for a kind
  /// Renumber what is known and report the rest as `undecided` instead of refusing.
  bool partial = false;
};

/// The order of ids of a kind stays, so groups, sorts and ties come out as before. Ids are those of
/// the whole model (submodel offsets added); written ids change by as much.
///
/// Refusals (with `partial`: `undecided`): text that no schema describes and that holds a number
/// equal to an id that changes; ids made by parameters; ids that do not fit their columns, or
/// become less than 1 (in a submodel: less than its offset plus 1) or too large; a set that a group
/// would hide under its new id; ranges that do not stay ranges.
Rewrite renumber(const LoadedDeck& context, const RenumberOptions& options);

}  // namespace deck
