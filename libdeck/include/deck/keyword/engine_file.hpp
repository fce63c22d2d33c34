// Engine files: what a run is asked to do, beside its Starter deck (car_0000.rad) as car_0001.rad,
// car_0002.rad and so on. Keyword lines, and lines in free format below them.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "deck/keyword/deck.hpp"

namespace deck {

/// One keyword of an Engine file with its lines.
struct EngineBlock {
  std::string_view keyword;  ///< "/RUN/car/1": the line without trailing blanks
  Span header;
  std::vector<Span> lines;  ///< data lines: neither blank nor comments
  /// Part n of the keyword, counted from 0: part(0) of "/RUN/car/1" is "RUN". Empty: there is none.
  std::string_view part(std::size_t n) const;
};

struct EngineFile {
  std::uint32_t file = 0;  ///< in the deck's sources
  int number = 0;          ///< of its name: 1 for car_0001.rad
  std::vector<EngineBlock> blocks;
  std::vector<Span> includes;  ///< lines that would include a file
};

struct EngineFiles {
  std::string run;                ///< "car"; empty: the deck has no name of that form
  std::vector<EngineFile> files;  ///< by number
  struct Unread {
    std::string path, why;
  };
  std::vector<Unread> unread;  ///< there, but not to be read
};

/// Reads the Engine files that stand beside the main file of the deck, NAME_0000.rad (of a packed
/// deck also packed ones): number 1 and on, up to the first that is not there. They are added to
/// the deck's sources, so that spans of findings lie in them, and belong to no block. A file above
/// Limits::map_threshold is no Engine file: it is named in `unread`.
EngineFiles read_engine_files(Deck& deck, const Limits& limits = {});

/// The Starter deck of an Engine file by its name: "car_0000.rad" of "car_0002.rad"; empty: this is
/// no such name.
std::string starter_of_engine_file(std::string_view path);

/// The words of a line, parted by blanks and commas.
std::vector<Span> engine_cells(const SourceSet& sources, Span line);

}  // namespace deck
