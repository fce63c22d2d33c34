// Edits: replacing spans of a file's bytes and showing the difference. Everything outside the spans
// stays byte for byte what it was.
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

/// The bytes of `source` with the edits made (those of its own file; in any order). The same
/// replacement given twice is made once. Several insertions at one place are made in the order
/// given. Error: edits that overlap, or lie outside the file.
Result<std::string> apply_edits(const Source& source, const std::vector<TextEdit>& edits);
Result<std::string> apply_edit_pointers(const Source& source, std::vector<const TextEdit*> edits);

/// Unified diff of one file, three lines of context, that `git apply` takes. Empty if equal. `path`
/// is put behind a/ and b/.
std::string unified_diff(std::string_view path, std::string_view before, std::string_view after);

/// Writes texts into cells: columns of a line, or what stands between two commas. The one place
/// where lines grow, texts are aligned and cells are padded.
class CellWriter {
 public:
  explicit CellWriter(const SourceSet& sources) : sources_(&sources) {}

  /// Puts `text`, right-aligned, into columns first..last (1-based) of `line`, a text in memory,
  /// which grows if it is too short; nothing else on it moves. Empty text blanks the cell.
  static void put(std::string& line, int first, int last, std::string_view text);
  /// The edit that does the same to the line of a file that holds `on_line`; the cell becomes as
  /// wide as its columns. `text` longer than the cell is the caller's mistake.
  static TextEdit edit(const SourceSet& sources, Span on_line, int first, int last,
                       std::string_view text);
  /// The same where the text ends where the one before ended, further right if it is longer.
  static TextEdit edit_in_place(const SourceSet& sources, Span on_line, int first, int last,
                                std::string_view text);

  /// Collects such an edit; several on one line grow it once. A cell that is set twice has the last
  /// text.
  void set(Span on_line, int first, int last, std::string_view text);
  /// Collects the edit of a cell of a line in free format: `cell` is what stands there.
  void replace(Span cell, std::string_view text);
  bool empty() const { return lines_.empty() && free_.empty(); }
  /// Fixed cells in file order, then free ones. The writer is empty afterwards.
  std::vector<TextEdit> finish();

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

/// Edit that makes the bytes of `span` blanks.
TextEdit blank_edit(Span span);

}  // namespace deck
