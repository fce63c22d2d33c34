// The summary of a batch is one JSON document: a line a deck, and the totals. Records, page, table
// and merging all hold these lines and nothing else of a deck.
#pragma once
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "batch/list.hpp"
#include "deck/text/result.hpp"

namespace deck::cli {

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

}  // namespace deck::cli
