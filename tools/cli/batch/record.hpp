// Data of a batch: list of decks, their lines in the summary, records of groups.
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/text.hpp"
#include "keyword/shared/include_scan.hpp"

namespace deck::cli {

// ---- decks: arguments, directories and manifests become one list with a result file each, and
// shards of it. Depends only on the list, so that all processes of a divided batch agree.

struct BatchDeck {
  std::string path;    ///< as given
  std::string result;  ///< file name in the output directory, "car_0000.json"
};
/// The page beside a result: "car_0000.html".
std::string page_name(const std::string& result);

struct BatchList {
  std::vector<BatchDeck> decks;
  std::vector<std::string> notes;  ///< about found files that are includes and are not run
};

/// Decks in the given order: arguments, then lines of `manifest` (empty: none, "-": standard
/// input). A directory means all decks below it, by name; a pattern all matching files; `output` is
/// skipped. Duplicates are removed. Error: unreadable manifest or directory, a pattern without
/// match, "-" as a deck.
///
/// Files found by directories and patterns are skipped if another deck of the list includes them.
/// Files given by name are always decks.
///
/// A result has the stem of the deck's name; if not unique, with parent directories in front
/// ("left--car_0000.json"), then with a number.
Result<BatchList> list_decks(std::vector<std::string> given, const std::string& manifest,
                             const std::string& output, IncludeScan& scan);

/// The existing files of decks, with Engine files.
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
/// Reads "2/8". Error: other text.
Result<Shard> parse_shard(const std::string& text);

// ---- the summary: a JSON document with one line per deck and totals. Records, page, table and
// merging use only these lines.

using Json = nlohmann::ordered_json;

/// Line of a deck without a result: "deck", "status", "result", "exit_code", "error", "verdict",
/// "gate", "counts". An empty status follows from the code.
Json deck_line(std::string_view deck, int code, std::string_view error,
               std::string_view status = {});
/// Members of the line from a result: "verdict", "gate", "counts" (its "summary" and the number of
/// its interfaces), and "examined" (not part of the line). Does not build a tree. nullopt: not
/// JSON.
std::optional<Json> head_of(std::string_view document);

/// A text member; "": absent.
std::string text_in(const Json& object, const char* name);
/// A number of "counts"; nullopt: absent.
std::optional<double> counted(const Json& line, const char* name);

/// `shard`: positions of its decks in the list of `all`.
Json make_summary(const Json& verb, const Json& arguments, const std::map<std::size_t, Json>& decks,
                  const Shard& shard, std::size_t all);
/// Document as text, with one line per object of a list.
std::string json_text(const Json& document);
/// Worst exit code of the decks.
int worst_code(const Json& decks);

/// "summary.json" or "summary-2-of-8.json".
std::string summary_name(const Shard& shard);
/// Combines the summaries of all shards in a directory. Error: they are not complete or do not
/// match.
Result<Json> merge_shards(const std::string& directory);

/// The overview DIR/index.html, a single file. It works without scripts; with scripts columns can
/// be sorted and levels selected.
std::string summary_page(const Json& summary);
/// Final table: decks that are not clean, worst first, and their number; "": all clean. `width`:
/// largest line length (0: any).
std::string summary_table(const Json& summary, std::size_t width, bool color);

/// `path` as UTF-8 for JSON; invalid bytes are read as Latin-1.
std::string as_utf8(std::string_view text);

// ---- records: inputs and outputs of a group of decks, so that the next run knows if the results
// are still valid. One file in DIR/.batch per group.

/// Hashes of written files by path relative to the output directory.
using WrittenFiles = std::map<std::string, std::uint64_t>;

/// Decks done together; several only if decks are written.
struct Record {
  std::string verb;
  std::vector<std::string> decks;  ///< as given
  std::uint64_t settings = 0;      ///< hash of program, verb, options and configuration
  std::uint64_t contents = 0;      ///< hash of the files of the decks
  /// False: refused, or not yet written; `outputs` tell if files were written.
  bool done = false;
  bool in_place = false;  ///< outputs replace the decks
  /// Not 0: `contents` before an in-place conversion, which must not be repeated.
  std::uint64_t before = 0;
  std::vector<Json> lines = {};  ///< lines of the decks in the summary
  WrittenFiles outputs = {};
  Json losses = nullptr;  ///< a loss report
};

std::string record_text(const Record& record);
/// nullopt: not a record.
std::optional<Record> parse_record(std::string_view text);
/// File name of the record of the group whose first deck has this result.
std::string record_name(const std::string& result);
/// The records of an output directory, by file name.
std::map<std::string, Record> read_records(const std::string& directory);

/// Version of this program and the hash of its file.
std::string program_identity();
/// Hash of a regular file; 0: none.
std::uint64_t file_hash(const std::string& path);

}  // namespace deck::cli
