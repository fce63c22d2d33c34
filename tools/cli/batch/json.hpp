// JSON in the hands of `deck batch`: the numbers that a verb's document opens with, without holding
// the document as a tree, and parsed values printed the way the library prints them.
#pragma once
#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "report/shared/json.hpp"

namespace deck::cli {

/// What the summary says of a result.
struct DocumentFacts {
  std::string counts;   ///< JSON object: members of "summary", number of interfaces
  std::string verdict;  ///< JSON object: member "verdict"; empty: there is none
  std::string level;    ///< of it
  std::optional<std::uint64_t> examined;  ///< member "examined"; nullopt: there is none
  std::optional<bool> gate;               ///< "passed" of member "gate"; nullopt: none was set
};
/// nullopt: not JSON.
std::optional<DocumentFacts> document_facts(std::string_view document);

/// What `write` writes, without the end of the line.
std::string json_line(const std::function<void(JsonWriter&)>& write);
/// A value on one line, in the spelling of JsonWriter.
std::string json_line(const nlohmann::ordered_json& value);

}  // namespace deck::cli
