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

namespace deck::cli {

/// Hashes of files that were written, by path relative to the output directory.
using WrittenFiles = std::map<std::string, std::uint64_t>;

/// Decks that were done together: several only where decks are written.
struct Record {
  std::string verb;
  std::vector<std::string> decks;  ///< as given
  std::uint64_t settings = 0;      ///< hash of program, verb, options and configuration
  std::uint64_t contents = 0;      ///< hash of the files of the decks
  /// False: refused, or about to be written. Whether it then was written, `outputs` tell.
  bool done = false;
  bool in_place = false;  ///< outputs are the decks themselves
  /// Not 0: `contents` before the decks were converted in place, which must not be done twice.
  std::uint64_t before = 0;
  std::vector<Json> lines = {};  ///< of the decks in the summary
  WrittenFiles outputs = {};
  Json losses = nullptr;  ///< a loss report
};

std::string record_text(const Record& record);
/// nullopt: not a record.
std::optional<Record> parse_record(std::string_view text);
/// Where below the output directory the record of the group is whose first deck has this result.
std::string record_name(const std::string& result);
/// The records of an output directory, by these names.
std::map<std::string, Record> read_records(const std::string& directory);

/// What identifies this program: its version and the hash of its file.
std::string program_identity();
/// Hash of a regular file; 0: there is none.
std::uint64_t file_hash(const std::string& path);

}  // namespace deck::cli
