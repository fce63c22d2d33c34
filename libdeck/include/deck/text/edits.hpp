// Edits: replacing spans of a file's bytes and showing the difference. Everything outside the spans
// stays byte for byte what it was.
#pragma once
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/text/diagnostic.hpp"
#include "deck/text/result.hpp"
#include "deck/text/source.hpp"

namespace deck {

/// The bytes of `source` with the edits made (those of its own file; in any order). The same
/// replacement given twice is made once. Several insertions at one place are made in the order
/// given. Error: edits that overlap, or lie outside the file.
Result<std::string> apply_edits(const Source& source, const std::vector<TextEdit>& edits);
Result<std::string> apply_edit_pointers(const Source& source, std::vector<const TextEdit*> edits);

/// Unified diff of one file, three lines of context, that `git apply` takes. Empty if equal. `path`
/// is put behind a/ and b/.
std::string unified_diff(std::string_view path, std::string_view before, std::string_view after);

/// Edit that puts `text` right-aligned into the columns first..last (1-based) of the line that
/// holds `on_line`. Nothing else on the line moves; a line that is too short grows. `text` longer
/// than the cell is the caller's mistake.
TextEdit cell_edit(const SourceSet& sources, Span on_line, int first, int last,
                   std::string_view text);
/// New texts for cells of fixed-column lines, several of them on one line if need be: a line that
/// is too short is then grown once.
class CellEdits {
 public:
  /// Puts `text`, right-aligned, into columns first..last (1-based) of the line holding `on_line`.
  /// Setting a cell twice keeps the last text.
  void set(const SourceSet& sources, Span on_line, int first, int last, std::string_view text);
  bool empty() const { return lines_.empty(); }
  /// In file order.
  std::vector<TextEdit> finish(const SourceSet& sources) const;

 private:
  struct Target {
    int last = 0;
    std::string text;
  };
  /// (file, offset of the line) -> first column -> cell
  std::map<std::pair<std::uint32_t, std::uint64_t>, std::map<int, Target>> lines_;
};

/// Edit that makes the bytes of `span` blanks.
TextEdit blank_edit(Span span);

}  // namespace deck
