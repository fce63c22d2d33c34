// References: which ids a block names, of what kind, and where — the one place that knows clauses
// of sets, ranges and ids in headers. Also the way back, from an id to the block that defines it.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/keyword.hpp"

namespace deck {

/// An id, or a range of ids, that a block names. Submodel offsets are added.
struct Reference {
  std::string_view kind;   ///< of the target: "grnod", "node", "part" ... ("" is never given)
  std::int64_t id = 0;     ///< without sign
  std::int64_t last = 0;   ///< a range: its last id
  std::int64_t step = 0;   ///< of the range; 0: one id
  bool minus = false;      ///< a group takes it away
  std::string_view field;  ///< name of the cell, clause of the set, "" for the header
  Span span;
  bool covers(std::int64_t other) const {
    return step == 0 ? other == id : other >= id && other <= last && (other - id) % step == 0;
  }
};

/// All ids that a block names, in line order; of nodes and elements (Schema::bulk) only the
/// header's. Lines that no schema describes are not looked at.
std::vector<Reference> references_of(const Deck& deck, const Block& block);
/// The same for a block that was decoded already.
std::vector<Reference> references_of(const Deck& deck, const DecodedBlock& decoded);

/// What the id in a cell is of: the kind that its field says, but for cells that another cell
/// gives a second meaning.
std::string_view kind_of_id(const DecodedBlock& decoded, const Cell& cell);
/// A cell of a block that holds an id, or the two that hold the ends of a range of ids.
struct IdCell {
  std::string_view kind;   ///< of the target; "": not known (clause RBODY of /SET)
  std::string_view field;  ///< name of the cell, clause of the set, "range"
  const DecodedCard* card = nullptr;
  const Cell* cell = nullptr;
  const DecodedCard* last_card = nullptr;  ///< of the last id of a range
  const Cell* last = nullptr;              ///< of a range; nullptr: one id
  std::int64_t step = 0;                   ///< of the range
  bool range() const { return last != nullptr; }
};
/// Those of a decoded block, in line order (those of a range when it is complete); cells that are
/// blank or 0 are left out. They point into `decoded`.
std::vector<IdCell> id_cells(const DecodedBlock& decoded);

/// First cell of a clause of /SET: "SHELL_G" is the clause SHELL with the options "_G".
struct SetClause {
  std::string_view name, options;
  /// Its numbers are ranges: first, last, step.
  bool ranges() const { return options.find('G') != options.npos; }
};
SetClause set_clause(std::string_view cell);
/// An id of this kind may be that of a /SET, where no group, surface or line has it.
bool set_may_stand_for(std::string_view kind);
/// Kind of the ids in a clause of /SET ("PART" -> "part"); empty: no ids.
std::string_view kind_of_clause(std::string_view clause);
/// Entity kind that a header id or header number refers to besides the schema's kind: materials in
/// /EOS/.../id, parts in /SHELL/id. Empty: none.
std::string_view header_reference(const Block& block);

/// Blocks by what they define.
class Definitions {
 public:
  explicit Definitions(const Deck& deck);
  /// The block that defines the id; a set may stand for a group, surface, line or part group.
  /// nullptr: none. Of several the first.
  const Block* find(std::string_view kind, std::int64_t id) const;
  /// Every block with that id, with its kind.
  std::vector<std::pair<std::string, const Block*>> with_id(std::int64_t id) const;

 private:
  std::map<std::pair<std::string, std::int64_t>, const Block*, std::less<>> blocks_;
};

/// Id of a block as the model has it: with the offset of its submodel.
std::int64_t id_of(const Deck& deck, const Block& block);

}  // namespace deck
