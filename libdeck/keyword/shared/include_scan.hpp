// The directive #include: its path and the places where the file may lie. IncludeScan: of which
// files decks are made, found by looking for #include and nothing else, every file once. For
// thousands of decks before any of them is read: who shares files with whom?
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

namespace deck::detail {

inline constexpr std::size_t longest_path = 4096;

/// True for the directive, also for one without a file name.
bool is_include(std::string_view line);

/// Path of the directive at `pos`; continuation by a trailing " +", "..." or "&", or by a next line
/// that starts with "+". `pos` moves behind the directive.
std::string include_path(std::string_view bytes, std::uint64_t& pos);

/// Candidate places of an include, in the order they are tried, without repetition; at the end the
/// packed files (".gz") of these names that are on disk, which are only looked for if none of the
/// places was taken.
class IncludeCandidates {
 public:
  IncludeCandidates(const std::string& written, const std::vector<std::string>& directories);
  /// The next one; nullptr: there are no more.
  const std::string* next();
  /// What there was so far.
  const std::vector<std::string>& all() const { return all_; }

 private:
  std::vector<std::string> all_;
  std::size_t places_ = 0, at_ = 0;
};

/// What a path that leads nowhere was probably meant to be; empty: no idea. `backslash`: it was
/// written with '\\'. Looks into the folders on disk.
std::string include_hint(std::string written, bool backslash,
                         const std::vector<std::string>& candidates);

}  // namespace deck::detail
