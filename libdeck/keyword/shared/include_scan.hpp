// IncludeScan: of which files decks are made, found by looking for #include and nothing else, every
// file once. For thousands of decks before any of them is read: who shares files with whom?
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace deck {

/// The paths that the directives #include of a text name, as they are written with '/' for a
/// backslash.
std::vector<std::string> included_names(std::string_view text);

/// The Engine files beside a Starter deck, NAME_0000.rad: number 1 and on, up to the first that is
/// not there. Of a packed deck also packed ones.
std::vector<std::string> engine_files_beside(std::string_view deck);

/// A file by what it is: device and inode.
using FileIdentity = std::pair<std::uint64_t, std::uint64_t>;

class IncludeScan {
 public:
  /// `include_paths` as in ReadOptions.
  explicit IncludeScan(std::vector<std::string> include_paths = {})
      : include_paths_(std::move(include_paths)) {}

  struct File {
    std::string path;  ///< as the reader opens it
    FileIdentity identity;
    std::uint64_t contents = 0;  ///< hash of its bytes; 0: it cannot be read
  };
  /// The files of a deck, the main file first, each once. What cannot be opened is left out. Files
  /// behind the main file's /END count as well.
  std::vector<File> files(const std::string& deck);

 private:
  struct Text {
    std::vector<std::string> names;  ///< that it includes
    std::uint64_t contents = 0;
  };
  const Text& read(const File& file);
  std::vector<std::string> include_paths_;
  std::map<FileIdentity, Text> read_;
};

/// Decks that share a file, directly or by way of others, in one group. Groups in the order of
/// their first decks, decks in the order given.
std::vector<std::vector<std::size_t>> sharing_groups(
    const std::vector<std::vector<IncludeScan::File>>& files_of_decks);

}  // namespace deck
