// Fixes: turns the repairs of findings into new file contents or a unified diff.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "deck/lint.hpp"
#include "deck/text.hpp"
#include "text/shared/edits.hpp"

namespace deck {

/// One changed file.
struct FixedFile {
  std::uint32_t file = 0;
  std::string text;       ///< new content
  std::size_t fixes = 0;  ///< repairs applied
};

struct FixResult {
  std::vector<FixedFile> files;  ///< ordered by file index
  std::size_t applied = 0;
  std::size_t skipped = 0;  ///< overlapping with an earlier one; a second run gets them
};

/// Applies the safe fixes (and the unsafe ones if asked). A fix is applied as a whole or not at
/// all; of two that touch the same bytes the first in the order of `findings` wins.
FixResult apply_fixes(const SourceSet& sources, const std::vector<Finding>& findings, bool unsafe);
/// The same with the fixes in `wanted` only.
FixResult apply_fixes(const SourceSet& sources, const std::vector<const Fix*>& wanted);

/// A deck that is fixed together with others.
struct FixedDeck {
  const SourceSet* sources = nullptr;
  const std::vector<Finding>* findings = nullptr;
};
/// A fix that was left out: it is for a file that another deck includes, too, and there it is not
/// wanted — what is unused or wrong for one deck is not so for the other.
struct WithheldFix {
  std::size_t deck = 0, other = 0;
  const Finding* finding = nullptr;
};
struct AgreedFixes {
  std::vector<std::vector<const Fix*>> wanted;  ///< by deck
  std::vector<WithheldFix> withheld;
};
/// Fixes (safe ones, or all) that every deck which includes the file asks for, byte for byte. A
/// file is the same by what it is on disk, not by its path; a deck that includes it twice has to
/// agree with itself.
AgreedFixes agree_on_fixes(const std::vector<FixedDeck>& decks, bool unsafe);

}  // namespace deck

namespace deck::detail {

/// Gives `d` a fix where its rule has a mechanical one and it has none yet.
void attach_fix(const LintContext& context, Finding& d);

}  // namespace deck::detail
