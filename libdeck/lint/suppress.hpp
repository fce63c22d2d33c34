// Suppression comments: "# decklint: ignore[DK104] reason=..." for the block around or after it, "#
// decklint: ignore-file[...] reason=..." for its file. Private to the lint stage.
#pragma once
#include <string>
#include <vector>

#include "deck/lint.hpp"
#include "keyword/shared/place.hpp"

namespace deck::detail {

struct Suppression {
  std::vector<std::string> rules;  ///< selectors (deck/lint.hpp)
  std::string reason;
  bool whole_file = false;
  std::uint32_t file = 0;
  std::int64_t block = -1;  ///< index into Deck::blocks; -1: whole file, or nothing
  Span span;                ///< the comment line
  bool used = false;
};

/// All suppressions of the deck; invalid ones become findings.
std::vector<Suppression> find_suppressions(const Deck& deck, const BlockIndex& index,
                                           Reporter& reporter);
/// The suppression of `d`; nullptr: none.
Suppression* covering(std::vector<Suppression>& suppressions, const BlockIndex& index,
                      const Finding& d);

}  // namespace deck::detail
