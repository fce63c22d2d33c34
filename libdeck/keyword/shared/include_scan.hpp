// The #include directive and its candidate files. IncludeScan finds the files of many decks by
// searching only for #include, each file once, to group decks that share files.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace deck {

/// Paths of the #include directives of a text, with '/' for backslashes.
std::vector<std::string> included_names(std::string_view text);

/// The Engine files of a Starter deck NAME_0000.rad: number 1, 2, ... up to the first missing one;
/// packed ones only if the deck is packed.
std::vector<std::string> engine_files_beside(std::string_view deck);

/// Device and inode of a file.
using FileIdentity = std::pair<std::uint64_t, std::uint64_t>;

class IncludeScan {
 public:
  /// `include_paths` as in ReadOptions.
  explicit IncludeScan(std::vector<std::string> include_paths = {})
      : include_paths_(std::move(include_paths)) {}

  struct File {
    std::string path;  ///< as the reader opens it
    FileIdentity identity;
    std::uint64_t contents = 0;  ///< hash of its bytes; 0: unreadable
  };
  /// Files of a deck without duplicates, the main file first; unreadable files are left out.
  /// Includes after /END of the main file count, too.
  std::vector<File> files(const std::string& deck);

 private:
  struct Text {
    std::vector<std::string> names;  ///< names of its includes
    std::uint64_t contents = 0;
  };
  const Text& read(const File& file);
  std::vector<std::string> include_paths_;
  std::map<FileIdentity, Text> read_;
};

/// Groups of decks that share files, directly or through others. Groups in the order of their first
/// deck, decks in the given order.
std::vector<std::vector<std::size_t>> sharing_groups(
    const std::vector<std::vector<IncludeScan::File>>& files_of_decks);

}  // namespace deck

namespace deck::detail {

inline constexpr std::size_t longest_path = 4096;

/// True for the directive, also without a file name.
bool is_include(std::string_view line);

/// Path of the directive at `pos`; continuation by a trailing " +", "..." or "&", or by a next line
/// that starts with "+". Moves `pos` behind the directive.
std::string include_path(std::string_view bytes, std::uint64_t& pos);

/// Candidate files of an include in order, without duplicates; at the end existing packed files
/// (".gz") of these names, in case no candidate exists.
class IncludeCandidates {
 public:
  IncludeCandidates(const std::string& written, const std::vector<std::string>& directories);
  /// The next candidate; nullptr: none.
  const std::string* next();
  /// All candidates so far.
  const std::vector<std::string>& all() const { return all_; }

 private:
  std::vector<std::string> all_;
  std::size_t places_ = 0, at_ = 0;
};

/// Suggestion for a path that does not exist; empty: none. `backslash`: it was written with '\\'.
/// Reads folders.
std::string include_hint(std::string written, bool backslash,
                         const std::vector<std::string>& candidates);

}  // namespace deck::detail
