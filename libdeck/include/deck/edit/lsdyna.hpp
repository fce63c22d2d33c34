// LS-DYNA contact keywords as Radioss interfaces, with the sets and parts that they name.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "deck/edit/rewrite.hpp"
#include "deck/keyword/schema.hpp"
#include "deck/text/result.hpp"

namespace deck {

struct LsDynaFile {
  std::string_view path, text;
};

struct LsDynaOptions {
  /// 7, 10, 11 or 19 for every contact; 0: by keyword — single surface, nodes to surface and one
  /// way 7, surface to surface and general 19, tied 10. SOFT = -7, -11 or -19 on a card chooses its
  /// type.
  int target = 0;
  int version = 2022;  ///< input version whose columns are written
  /// Contacts without an id, and the groups, surfaces, lines and sets that they need, get ids from
  /// here on. Not given: contacts from 1, the others from 90000001.
  std::optional<std::int64_t> first_id;
  /// The file that `name` on an *INCLUDE line of the file `from` means; it must stay as it is until
  /// the conversion has ended. Error: why there is none. Not given: nothing is included.
  std::function<Result<LsDynaFile>(std::string_view name, std::string_view from)> include = {};
};

/// Reads *CONTACT_AUTOMATIC_SINGLE_SURFACE, _SURFACE_TO_SURFACE, _ONE_WAY_SURFACE_TO_SURFACE,
/// _NODES_TO_SURFACE, _GENERAL and *CONTACT_TIED_NODES_TO_SURFACE, _SURFACE_TO_SURFACE,
/// _SHELL_EDGE_TO_SURFACE with the options ID, MPP, OFFSET, BEAM_OFFSET, CONSTRAINED_OFFSET,
/// SMOOTH, MORTAR, INTERIOR and the optional cards A to G; 10-column, long (20-column) and comma
/// format; values by *PARAMETER; files by *INCLUDE. Sets of nodes, parts, segments and shells
/// (*SET_…, lists, columns, ranges, sets of sets) that a contact names become groups, surfaces or
/// sets. `new_text` is an include file of /INTER blocks and what they need; a set that is not in
/// these files is named by its id, and must be a set (or surface, group) of that id in the deck.
///
/// The loss report has an entry for every cell that is not blank. Units are not changed. Nothing in
/// `text` can make the function fail: what cannot be read is `undecided`. Refusals: no contact
/// keyword at all, an unknown target or version.
Rewrite contacts_from_lsdyna(std::string_view path, std::string_view text, const SchemaSet& schemas,
                             const LsDynaOptions& options = {});
/// The same for the files of one deck, one result each: no id is used twice in all of them.
std::vector<Rewrite> contacts_from_lsdyna(const std::vector<LsDynaFile>& files,
                                          const SchemaSet& schemas,
                                          const LsDynaOptions& options = {});

}  // namespace deck
