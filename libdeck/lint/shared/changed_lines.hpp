// The lines of a deck that a change touched: findings are shown there, where a forge shows them
// within the change.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/text/diagnostic.hpp"

namespace deck {

class ChangedLines {
 public:
  /// Lines `first` and on of a file, by the path under which it is read.
  void add(const std::string& path, std::uint64_t first, std::uint64_t count);
  /// The new side of the hunks of a patch of that file, without lines of context around them.
  void add_hunks(const std::string& path, std::string_view patch);
  bool empty() const { return files_.empty(); }

 private:
  friend class ChangedPlaces;
  /// Absolute path -> first and last lines of stretches, ascending.
  std::map<std::string, std::vector<std::pair<std::uint64_t, std::uint64_t>>> files_;
};

/// Changed lines among the files of one deck. Not for several threads at once.
class ChangedPlaces {
 public:
  ChangedPlaces(const ChangedLines& lines, const SourceSet& sources)
      : lines_(lines), sources_(sources) {}
  /// The first changed line that the span reaches into, as far as the span goes; an invalid span if
  /// there is none.
  Span first_in(const Span& span);

 private:
  const ChangedLines& lines_;
  const SourceSet& sources_;
  /// Stretches by file of the sources.
  std::map<std::uint32_t, const std::vector<std::pair<std::uint64_t, std::uint64_t>>*> of_file_;
};

/// A finding that stands on an unchanged line, with a note on a changed one, is moved there; its
/// old place becomes a note.
void stand_at_changes(std::vector<Diagnostic>& findings, const SourceSet& sources,
                      const ChangedLines& lines);

}  // namespace deck
