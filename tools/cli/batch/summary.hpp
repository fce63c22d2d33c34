// The summary of a batch: one line per deck and the totals. Parts made by shards merge
// into the same bytes that one process writes.
#pragma once
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "batch/list.hpp"
#include "deck/text/result.hpp"

namespace deck::cli {

struct SummaryEntry {
  std::string json;  ///< one line: deck, status, result, exit_code, error, verdict, counts
  int code = 0;
  std::string status = {};  ///< as in the line
};

struct Summary {
  std::string tool;  ///< version of the program that made it
  std::string verb;
  std::vector<std::string> arguments;
  Shard shard;
  std::size_t all = 0;  ///< decks of all shards together
  std::vector<SummaryEntry> entries;
  std::vector<std::size_t> positions;  ///< of the entries, in the list of all decks
  std::vector<IncludeFile> includes;   ///< found, but not run; the same in all shards

  /// Worst exit code of the decks.
  int worst() const;
  /// Decks with this status.
  std::size_t count(std::string_view status) const;
};

/// clean, findings, unreadable or failed.
std::string_view status_of(int code);
/// An entry from its line.
SummaryEntry entry_of(std::string json, int code);

/// The line of one deck. `result` empty: there is none; `verdict` and `counts` are JSON
/// objects, no verdict is empty; `gate` as in DocumentFacts.
std::string summary_entry(std::string_view deck, std::string_view status, std::string_view result,
                          int code, std::string_view error, std::string_view verdict,
                          std::string_view counts, std::optional<bool> gate = std::nullopt);

std::string summary_json(const Summary& summary);
Result<Summary> parse_summary(std::string_view text);

/// The overview DIR/index.html: one file that needs nothing else and no script. `previous` are the
/// results before these, nullptr where there are none; `seconds` by line of an entry.
std::string summary_page(const Summary& summary, const Summary* previous,
                         const std::map<std::string, double>& seconds);
/// What a person reads at the end: the decks that are not clean, the worst first, and how many are;
/// "" if all are clean. No line is longer than `width` (0: any length).
std::string summary_table(const Summary& summary, std::size_t width, bool color);

/// Parts of one list as the whole. Error: parts that do not belong together or do not make up the
/// whole.
Result<Summary> merge_summaries(const std::vector<Summary>& parts);

/// "summary.json" or "summary-2-of-8.json".
std::string summary_name(const Shard& shard);
/// The complete set of shard summaries in a directory, in order. Error: none, or several sets.
Result<std::vector<Summary>> read_shard_summaries(const std::string& directory);

}  // namespace deck::cli
