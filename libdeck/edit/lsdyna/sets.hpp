// Sets and parts of an LS-DYNA model as far as contacts name them. Private to the LS-DYNA reader.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace deck::detail {

enum class DynaSetKind : std::uint8_t { node, part, segment, shell };

/// The kind of set that a type of a contact's side means (SSTYP, MSTYP: 0 segments, 1 shells, 2 and
/// 6 parts, 4 nodes); false: that type is none.
bool set_kind_of(std::int64_t type, DynaSetKind& kind);

struct DynaSet {
  std::string title;
  std::vector<std::int64_t> ids;                              ///< nodes, parts, shells
  std::vector<std::pair<std::int64_t, std::int64_t>> ranges;  ///< first and last
  std::vector<std::array<std::int64_t, 4>>
      segments;                    ///< a triangle repeats its third node or has 0
  std::vector<std::int64_t> sets;  ///< ADD: all of these sets
  std::string unread;              ///< why it is not known what is in it; empty: it is
};

/// All of them by kind and id; parts by id.
struct DynaSets {
  std::map<std::pair<DynaSetKind, std::int64_t>, DynaSet> sets;
  std::set<std::int64_t> parts;  ///< of *PART
  bool all_parts_known = true;   ///< false: *PART_CONTACT and the like, or a file not followed

  /// No part has the id, as far as that can be said.
  bool lacks_part(std::int64_t id) const {
    return all_parts_known && !parts.empty() && !parts.contains(id);
  }
  /// The set with the members of the sets that it adds; nullptr: not in these files.
  const DynaSet* find(DynaSetKind kind, std::int64_t id);
  /// Adds a set that was read. A second one of the id is merged where both are to be collected,
  /// else it makes the set unread.
  void add(DynaSetKind kind, std::int64_t id, DynaSet set, bool collect);

 private:
  std::set<std::pair<DynaSetKind, std::int64_t>> resolved_, open_;
};

/// How the words behind *SET_ are meant: *SET_PART_LIST_GENERATE_TITLE.
struct DynaSetKeyword {
  DynaSetKind kind{};
  enum class Form : std::uint8_t { list, column, generate, add, segments, other } form{};
  bool title = false, collect = false;
};
/// False: no set of these kinds.
bool read_set_keyword(std::string_view keyword, DynaSetKeyword& out);

/// The set as /GRNOD/NODE, /SURF/PART/EXT or /SURF/SEG, '@' in the place of its id. Empty: only
/// /SET/GENERAL can say it.
std::string plain_block(const DynaSet& set, DynaSetKind kind, const std::string& title);
/// The same as /SET/GENERAL, which input version 2021 and later have.
std::string general_block(const DynaSet& set, DynaSetKind kind, const std::string& title);
/// Clause lines of /SET/GENERAL: `word` and up to nine ids on each.
std::string clause(std::string_view word, const std::vector<std::int64_t>& ids);

}  // namespace deck::detail
