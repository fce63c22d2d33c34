// What a batch remembers of a finished deck: which files and options its result came from, so that
// the next run can tell whether it still holds. Records are lines of JSON in DIR/.batch/.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/shared/hash.hpp"
#include "deck/text/result.hpp"

namespace deck::cli {

/// A file as it was when it was read.
struct FileState {
  std::string path;  ///< as opened
  std::uint64_t size = 0;
  std::int64_t mtime = 0;  ///< nanoseconds; 0: not to be relied on, compare the hash
  std::uint64_t hash = 0;
};

/// State of a file with the bytes known. `since` is when reading began (nanoseconds): a file that
/// was modified then or just before could be modified once more without its time showing it.
FileState file_state(const std::string& path, std::string_view bytes, std::int64_t since);
/// The same, reading the file; nullopt if that is not possible.
std::optional<FileState> file_state(const std::string& path);
/// Nanoseconds since the epoch, by the clock of file times.
std::int64_t file_clock_now();

/// One finished deck.
struct Record {
  std::string deck;                   ///< as given
  std::string result;                 ///< file name in the output directory; empty: there is none
  std::uint64_t key = 0;              ///< of tool, verb and options
  std::uint64_t bytes = 0, hash = 0;  ///< of the result file
  double seconds = 0;
  std::vector<FileState> files;     ///< the include tree
  std::vector<FileState> settings;  ///< other files the result depends on
  std::vector<FileState> outputs;   ///< decks and documents written below the output directory
  bool written = false;             ///< decks were written, below that directory or in place
  bool announced = false;           ///< they are about to be written: `files`, `outputs` say what
  std::string losses;  ///< of the decks that were written together: the lists of a loss report
  std::string entry;   ///< its line of the summary, a JSON object
  int code = 0;
};

/// One line of JSON with its end.
std::string record_line(const Record& record);
/// nullopt: not a record, for example a line that was cut off.
std::optional<Record> parse_record(std::string_view line);

/// The records of a text of such lines; what is no record is passed over.
std::vector<Record> parse_records(std::string_view lines);

/// Tells whether finished decks are still finished. Files that many decks include are looked at
/// once.
class Freshness {
 public:
  /// True if the result in `directory` is as it was written and so are all files it came from.
  /// `settings` are the paths it would depend on now.
  bool holds(const Record& record, const std::string& directory, std::uint64_t key,
             const std::string& result, const std::vector<std::string>& settings);
  bool unchanged(const FileState& state);

 private:
  struct Seen {
    std::optional<std::uint64_t> size, hash;
    std::int64_t mtime = 0;
  };
  std::map<std::string, Seen> seen_;
};

/// `path` as it reads in JSON: bytes that are no UTF-8 are taken for Latin-1.
std::string as_utf8(std::string_view text);

/// What identifies this program: version and the identity the linker gave it.
std::string program_identity();

}  // namespace deck::cli
