// References: the ids that a block names, with kinds and places (cells, set clauses, ranges,
// headers); and blocks by id.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/keyword.hpp"

namespace deck {

/// An id or id range that a block refers to; submodel offsets added.
struct Reference {
  std::string_view kind;   ///< of the target: "grnod", "node", "part" ...; never empty
  std::int64_t id = 0;     ///< without sign
  std::int64_t last = 0;   ///< last id of a range
  std::int64_t step = 0;   ///< step of a range; 0: one id
  bool minus = false;      ///< the group removes it
  std::string_view field;  ///< name of the cell, clause of the set, "" for the header
  Span span;
  bool covers(std::int64_t other) const {
    return step == 0 ? other == id : other >= id && other <= last && (other - id) % step == 0;
  }
};

/// All ids that a block refers to, in line order; for nodes and elements (Schema::bulk) only that
/// of the header. Lines without schema are skipped.
std::vector<Reference> references_of(const Deck& deck, const Block& block);
/// References of a decoded block.
std::vector<Reference> references_of(const Deck& deck, const DecodedBlock& decoded);

/// Kind of the id in a cell: that of the field, or of another cell that changes its meaning.
std::string_view kind_of_id(const DecodedBlock& decoded, const Cell& cell);
/// A cell with an id, or the first of a range.
struct IdCell {
  std::string_view kind;   ///< of the target; "": unknown (clause RBODY of /SET)
  std::string_view field;  ///< name of the cell, clause of the set, "range"
  const DecodedCard* card = nullptr;
  const Cell* cell = nullptr;
  const DecodedCard* last_card = nullptr;  ///< card of `last`
  const Cell* last = nullptr;              ///< last id of a range; nullptr: one id
  std::int64_t step = 0;                   ///< step of the range
  bool range() const { return last != nullptr; }
};
/// Id cells of a decoded block in line order (ranges when complete), without blank or 0 ones. They
/// point into `decoded`.
std::vector<IdCell> id_cells(const DecodedBlock& decoded);

/// First cell of a /SET clause: "SHELL_G" is clause SHELL with options "_G".
struct SetClause {
  std::string_view name, options;
  /// True if its numbers are ranges: first, last, step.
  bool ranges() const { return options.find('G') != options.npos; }
};
SetClause set_clause(std::string_view cell);
/// True if a /SET can have this id where no group, surface or line has it.
bool set_may_stand_for(std::string_view kind);
/// Kind of the ids in a clause of /SET ("PART" -> "part"); empty: no ids.
std::string_view kind_of_clause(std::string_view clause);
/// Kind of entity that the header number refers to besides the schema's kind: materials in
/// /EOS/.../id, parts in /SHELL/id. Empty: none.
std::string_view header_reference(const Block& block);

/// Blocks by the entity that they define.
class Definitions {
 public:
  explicit Definitions(const Deck& deck);
  /// The first block that defines the id; a set can replace a group, surface, line or part group.
  /// nullptr: none.
  const Block* find(std::string_view kind, std::int64_t id) const;
  /// Every block with that id, and its kind.
  std::vector<std::pair<std::string, const Block*>> with_id(std::int64_t id) const;

 private:
  std::map<std::pair<std::string, std::int64_t>, const Block*, std::less<>> blocks_;
};

/// Id of a block including its submodel offset.
std::int64_t id_of(const Deck& deck, const Block& block);

}  // namespace deck
