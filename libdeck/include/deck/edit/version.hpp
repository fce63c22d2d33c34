// Input versions: the blocks of a deck written again with the columns of another version of the
// format. What the new version has no cell for is reported, never silently lost.
#pragma once
#include "deck/edit/rewrite.hpp"

namespace deck {

struct VersionOptions {
  /// Drop values that the other version has no cell for, and keep blocks whose columns there are
  /// not known as they are. Without it both are refusals.
  bool allow_loss = false;
};

/// The versions that decks can be written in: 110 to 140 and 2017 on.
bool is_target_version(int version);

/// Changes the version number of every /BEGIN to `version` (110 … 2026) and every block whose
/// layout differs between its own version and that one: cells that both have keep their text, cells
/// that only the old one has are blanked, lines are inserted, removed and moved as the new layout
/// asks. Comments stay where they are. Loss report: one `kept` per block that was changed;
/// `dropped` for a value that is not at its default and has no cell any more; `undecided` for every
/// keyword of which not every column is known in both versions, with the number of its blocks, and
/// for values that do not fit. `dropped` and `undecided` are refusals without allow_loss; a
/// smoothed surface (Ists) that would be read as a node group always is. Refused as a whole:
/// unknown target, decks older than version 100 or without /BEGIN.
Rewrite to_version(const LoadedDeck& context, int version, const VersionOptions& options = {});

}  // namespace deck
