// Turns fixes of findings into new file contents or a unified diff.
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
  std::size_t skipped = 0;  ///< overlap with an earlier fix; a second run applies them
};

/// Applies safe fixes, and unsafe ones if requested. A fix is applied completely or not at all; of
/// overlapping ones the first in `findings` wins.
FixResult apply_fixes(const SourceSet& sources, const std::vector<Finding>& findings, bool unsafe);
/// Applies the fixes in `wanted` only.
FixResult apply_fixes(const SourceSet& sources, const std::vector<const Fix*>& wanted);

/// A deck fixed together with others.
struct FixedDeck {
  const SourceSet* sources = nullptr;
  const std::vector<Finding>* findings = nullptr;
};
/// A fix left out because another deck includes the file and does not want it: unused or wrong in
/// one deck can be right in another.
struct WithheldFix {
  std::size_t deck = 0, other = 0;
  const Finding* finding = nullptr;
};
struct AgreedFixes {
  std::vector<std::vector<const Fix*>> wanted;  ///< per deck
  std::vector<WithheldFix> withheld;
};
/// Fixes (safe or all) that every deck with the file requests identically. Files are identified on
/// disk, not by path; a deck that includes a file twice must request it for both.
AgreedFixes agree_on_fixes(const std::vector<FixedDeck>& decks, bool unsafe);

}  // namespace deck

namespace deck::detail {

/// Adds the mechanical fix of the rule if `d` has no fix.
void attach_fix(const LintContext& context, Finding& d);

}  // namespace deck::detail
