// Fixes: turns the repairs of diagnostics into new file contents or a unified diff.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "deck/text/diagnostic.hpp"
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

/// Unified diff of one file, three lines of context, that `git apply` takes. Empty if equal. `path`
/// is put behind a/ and b/.
std::string unified_diff(std::string_view path, std::string_view before, std::string_view after);

/// Edit that puts `text` right-aligned into the columns first..last (1-based) of the line that
/// holds `on_line`. Nothing else on the line moves; a line that is too short grows. `text` longer
/// than the cell is the caller's mistake.
TextEdit cell_edit(const SourceSet& sources, Span on_line, int first, int last,
                   std::string_view text);
/// Edit that makes the bytes of `span` blanks.
TextEdit blank_edit(Span span);

}  // namespace deck
