// What a batch remembers of a group of decks: what its results came from and what they are, so that
// the next run can tell whether they still hold. One file in DIR/.batch a group.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "batch/summary.hpp"
#include "deck/text/result.hpp"

namespace deck::cli {

/// A file that was written.
struct WrittenFile {
  std::string path;  ///< relative to the output directory if it lies below that, else absolute
  std::uint64_t hash = 0;
};

/// Decks that were done together: several only where decks are written.
struct Record {
  std::string verb;
  std::vector<std::string> decks;  ///< as given
  std::uint64_t settings = 0;      ///< hash of program, verb, options and configuration
  std::uint64_t contents = 0;      ///< hash of the files of the decks
  /// False: refused, or about to be written. Whether it then was written, `outputs` tell.
  bool done = false;
  /// Not 0: `contents` before the decks were converted in place, which must not be done twice.
  std::uint64_t before = 0;
  double seconds = 0;  ///< of each deck
  std::vector<SummaryEntry> entries;
  std::vector<WrittenFile> outputs;
  std::vector<WrittenFile> former;  ///< outputs of earlier runs that are none any more
  std::string losses;               ///< the lists of a loss report
};

std::string record_text(const Record& record);
/// nullopt: not a record.
std::optional<Record> parse_record(std::string_view text);
/// Where the record of the group is whose first deck has this result.
std::string record_path(const std::string& directory, const std::string& result);
/// The records of an output directory, by path.
std::map<std::string, Record> read_records(const std::string& directory);

/// Hash of a regular file; 0: there is none.
std::uint64_t file_hash(const std::string& path);
/// True if the file is as it was written.
bool is_as_written(const std::string& directory, const WrittenFile& file);

/// `path` as it reads in JSON: bytes that are no UTF-8 are taken for Latin-1.
std::string as_utf8(std::string_view text);

/// What identifies this program: its version and the hash of its files. Empty: nothing does.
std::string program_identity();

}  // namespace deck::cli
