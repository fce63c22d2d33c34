// The summary of a batch: one line per deck and the totals. Parts made by shards merge
// into the same bytes that one process writes.
#pragma once
#include <cstddef>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "batch/list.hpp"
#include "deck/text/result.hpp"

namespace deck::cli {

struct SummaryEntry {
  std::string json;  ///< one line: deck, status, result, exit_code, error, verdict, gate, counts
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
/// What the line of a deck says.
struct EntryFacts {
  std::string_view deck, status;
  std::string_view result;  ///< empty: there is none
  int code = 0;
  std::string_view error;
  std::string_view verdict, counts;  ///< JSON objects; empty: there is none
  std::optional<bool> gate = {};     ///< as in DocumentFacts
};
SummaryEntry summary_entry(const EntryFacts& facts);
/// An entry of a summary that was parsed. Throws where it is none.
SummaryEntry entry_of(const nlohmann::ordered_json& entry);

std::string summary_json(const Summary& summary);
Result<Summary> parse_summary(std::string_view text);

/// The overview DIR/index.html: one file that needs nothing else and no script. `previous` are the
/// results before these, nullptr where there are none; `seconds` by line of an entry.
std::string summary_page(const Summary& summary, const Summary* previous,
                         const std::map<std::string, double>& seconds);
/// What a person reads at the end: the decks that are not clean, the worst first, and how many are;
/// "" if all are clean. No line is longer than `width` (0: any length).
std::string summary_table(const Summary& summary, std::size_t width, bool color);

/// "summary.json" or "summary-2-of-8.json".
std::string summary_name(const Shard& shard);
/// The whole from the summaries of all shards in a directory. Error: they do not make up one.
Result<Summary> merge_shards(const std::string& directory);

}  // namespace deck::cli
