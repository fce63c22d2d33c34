// Edits replace spans of a file; all other bytes stay unchanged. Also: unified diffs.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "deck/text.hpp"

namespace deck {

/// Applies the edits for this file, in any order. Equal replacements are made once. Insertions at
/// one place keep their order. Error: edits overlap or lie outside the file.
Result<std::string> apply_edits(const Source& source, const std::vector<TextEdit>& edits);
Result<std::string> apply_edit_pointers(const Source& source, std::vector<const TextEdit*> edits);

/// Unified diff of one file with three lines of context for `git apply`. Empty if equal. a/ and b/
/// are added before `path`.
std::string unified_diff(std::string_view path, std::string_view before, std::string_view after);

/// Writes texts into cells: columns of a line, or text between commas. All padding, alignment and
/// extending of lines is done here.
class CellWriter {
 public:
  explicit CellWriter(const SourceSet& sources) : sources_(&sources) {}

  /// Writes `text` right-aligned into columns first..last (1-based) of `line`, extending it if
  /// needed. Other columns do not change. Empty text blanks the cell.
  static void put(std::string& line, int first, int last, std::string_view text);
  /// The edit equal to put() on the line of a file with `on_line`. `text` must fit the cell.
  static TextEdit edit(const SourceSet& sources, Span on_line, int first, int last,
                       std::string_view text);
  /// Like edit(), but aligned to the end of the old text; longer texts extend to the right.
  static TextEdit edit_in_place(const SourceSet& sources, Span on_line, int first, int last,
                                std::string_view text);

  /// Collects an edit(). Several cells extend a line once. The last text of a cell wins.
  void set(Span on_line, int first, int last, std::string_view text);
  /// Collects the replacement of a cell in free format.
  void replace(Span cell, std::string_view text);
  bool empty() const { return lines_.empty() && free_.empty(); }
  /// The collected edits: fixed cells in file order, then free ones. Clears the writer.
  std::vector<TextEdit> release_edits();

 private:
  struct Target {
    int last = 0;
    std::string text;
  };
  const SourceSet* sources_;
  /// (file, offset of the line) -> first column -> cell
  std::map<std::pair<std::uint32_t, std::uint64_t>, std::map<int, Target>> lines_;
  /// (file, offset, length) of a cell of a free line -> its text
  std::map<std::tuple<std::uint32_t, std::uint64_t, std::uint32_t>, std::string> free_;
};

/// Replaces the bytes of `span` by blanks.
TextEdit blank_edit(Span span);

}  // namespace deck
