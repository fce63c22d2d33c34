// Fixes: turns the repairs of diagnostics into new file contents or a unified diff.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "deck/text/diagnostic.hpp"
#include "deck/text/edits.hpp"
#include "deck/text/source.hpp"

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
/// all; of two that touch the same bytes the first in the order of `diagnostics` wins.
FixResult apply_fixes(const SourceSet& sources, const std::vector<Diagnostic>& diagnostics,
                      bool unsafe);

}  // namespace deck
