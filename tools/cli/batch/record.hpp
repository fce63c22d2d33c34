// What a batch is about: its decks in one list, the line of each in the summary, and the record of
// a group of decks.
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

// ---- decks: from arguments, directories and manifests to one list, with a result file for each;
// and which of them belong to a shard. Depends on nothing but the list, so that every process of a
// divided batch comes to the same answer.

struct BatchDeck {
  std::string path;    ///< as given
  std::string result;  ///< file name in the output directory, "car_0000.json"
};
/// The page beside a result: "car_0000.html".
std::string page_name(const std::string& result);

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

// ---- the summary is one JSON document: a line a deck, and the totals. Records, page, table and
// merging all hold these lines and nothing else of a deck.

using Json = nlohmann::ordered_json;

/// The line of a deck without a result: members "deck", "status", "result", "exit_code", "error",
/// "verdict", "gate", "counts". Without a status the code gives it.
Json deck_line(std::string_view deck, int code, std::string_view error,
               std::string_view status = {});
/// What the line says of a result: "verdict", "gate", "counts" (the members of its "summary" and
/// the number of its interfaces), and "examined", which is none of the line. The document is not
/// held as a tree. nullopt: it is not JSON.
std::optional<Json> head_of(std::string_view document);

/// A member that is a text; "" where it is none.
std::string text_in(const Json& object, const char* name);
/// A number of "counts"; nullopt: it was not counted.
std::optional<double> counted(const Json& line, const char* name);

/// `shard` has the decks at these places in the list of `all`.
Json make_summary(const Json& verb, const Json& arguments, const std::map<std::size_t, Json>& decks,
                  const Shard& shard, std::size_t all);
/// A document as a text: lists of objects have a line an object.
std::string json_text(const Json& document);
/// Worst exit code of the decks.
int worst_code(const Json& decks);

/// "summary.json" or "summary-2-of-8.json".
std::string summary_name(const Shard& shard);
/// The whole from the summaries of all shards in a directory. Error: they do not make up one.
Result<Json> merge_shards(const std::string& directory);

/// The overview DIR/index.html: one file that needs nothing else. All is there without a script;
/// with one the columns sort and levels are chosen.
std::string summary_page(const Json& summary);
/// What a person reads at the end: the decks that are not clean, the worst first, and how many are;
/// "" if all are clean. No line is longer than `width` (0: any length).
std::string summary_table(const Json& summary, std::size_t width, bool color);

/// `path` as it reads in JSON: bytes that are no UTF-8 are taken for Latin-1.
std::string as_utf8(std::string_view text);

// ---- what a batch remembers of a group of decks: what its results came from and what they are, so
// that the next run can tell whether they still hold. One file in DIR/.batch a group.

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
