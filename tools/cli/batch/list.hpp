// Decks of a batch: from arguments, directories and manifests to one list, with a result file for
// each; and which of them belong to a shard. Depends on nothing but the list, so that every process
// of a divided batch comes to the same answer.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "deck/text/result.hpp"
#include "keyword/shared/include_scan.hpp"

namespace deck::cli {

struct BatchDeck {
  std::string path;    ///< as given
  std::string result;  ///< file name in the output directory, "car_0000.json"
};

struct BatchList {
  std::vector<BatchDeck> decks;
  std::vector<std::string> notes;  ///< of files that were found, but are includes and not run
};

/// The decks in the order given: the arguments, then the lines of `manifest` (empty: none, "-":
/// standard input). A directory stands for all decks below it, by name, a pattern
/// for the files it matches; `output` is passed over. A deck named twice is taken once. Error: a
/// manifest or directory that cannot be read, a pattern that matches nothing, "-" as a deck.
///
/// Of what directories and patterns stand for, a file that another deck of the list includes is an
/// include. What is named itself is taken for a deck.
///
/// A result is named after the deck's file name without extension. Where that is not unique, the
/// name of the directory is put before it ("left--car_0000.json"), and of the one above as long as
/// needed; what is still equal is numbered.
Result<BatchList> list_decks(std::vector<std::string> given, const std::string& manifest,
                             const std::string& output, IncludeScan& scan);

/// The files of decks, as far as they can be found, with Engine files, which some verbs look at.
struct DeckFiles {
  std::vector<std::string> paths;
  std::uint64_t contents = 0;  ///< hash of paths and contents
};
DeckFiles files_of_decks(const std::vector<std::string>& decks, IncludeScan& scan);

/// Part `index` (1-based) of `count`: every count-th deck, or group of decks that share files.
struct Shard {
  std::size_t index = 1, count = 1;
  bool whole() const { return count == 1; }
  bool has(std::size_t group) const { return group % count == index - 1; }
};
/// "2/8". Error: anything else.
Result<Shard> parse_shard(const std::string& text);

}  // namespace deck::cli
