// Id spaces and their new numbers. Private to renumbering.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/edit/convert.hpp"

namespace deck::detail {

/// Name of the id space of an entity kind: all solids share one. Empty: not renumbered.
std::string_view space_of(std::string_view kind);

/// Ids of one space, old and new.
struct IdSpace {
  std::vector<std::int64_t> ids;  ///< defined ones, ascending, unique
  bool changes = false, compact = false;
  std::int64_t value = 0, only = 0;  ///< as in RenumberRule

  bool defined(std::int64_t id) const;
  /// New number of a defined id, or of one that only a reference names; nullopt: it cannot have
  /// one.
  std::optional<std::int64_t> mapped(std::int64_t id) const;
  /// Those of the ids from, from + step ... to that are defined.
  std::vector<std::int64_t> members(std::int64_t from, std::int64_t to, std::int64_t step) const;
  /// A number that a defined id has afterwards.
  bool taken(std::int64_t new_id) const;
};

using IdSpaces = std::map<std::string, IdSpace, std::less<>>;

/// All definitions of the deck with the rules applied. `refusals` gets rules that make no sense.
IdSpaces collect_spaces(const LoadedDeck& context, const RenumberOptions& options,
                        std::vector<std::string>& refusals);

}  // namespace deck::detail
