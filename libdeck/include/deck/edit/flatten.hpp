// Flattening: a deck as one file, every include replaced by what it holds.
#pragma once
#include "deck/edit/rewrite.hpp"

namespace deck {

struct FlattenOptions {
  bool mark = true;  ///< comment lines that name the included file, before and behind its lines
};

/// The deck without includes (Rewrite::new_text). Every line that is read stays byte for byte what
/// it was, line ends included, with these exceptions: directives become comments; the last line of
/// a file gets a line end if it has none; /END, #enddata and what follows them in an included file
/// is left out; a /BEGIN of an included file (same version, outside of submodels) becomes a
/// comment; a LOCAL parameter whose name means something else in another file gets a new name of
/// the same length. The result is read again and compared block by block.
///
/// A file of another input version is read with the version around it from now on: where that
/// changes nothing that is known, keywords described in part are `undecided` in the loss report.
///
/// Refusals: includes that cannot be read, cells that would mean something else in the version
/// around them, local parameters for which there is no free name.
Rewrite flatten(const LoadedDeck& context, const FlattenOptions& options = {});

}  // namespace deck
