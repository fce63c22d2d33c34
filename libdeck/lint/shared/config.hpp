// Settings of a lint run from .decklint.toml beside or above the deck.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/lint.hpp"
#include "deck/text.hpp"
#include "lint/shared/gate.hpp"
#include "text/shared/rule_page.hpp"

namespace deck {

/// A key of .decklint.toml.
struct ConfigKey {
  std::string_view table;     ///< "" or "gate"; "gate.interface" is [[gate.interface]], a list
  std::string_view key;       ///< an example, if it is a selector or pattern
  std::string_view example;   ///< a value, as TOML
  std::string_view fallback;  ///< default; empty: the key is required
  std::string_view meaning;
};
const std::vector<ConfigKey>& config_keys();
/// Keys and tables of a table, for messages: "max-depth, max-ratio, ...".
std::string known_config_keys(std::string_view table);
/// Text of `deck lint --init`: every key as a comment.
std::string config_template();

/// Error about an unknown selector, with a suggestion.
std::string unknown_selector(std::string_view text);

/// Reads the team rules: all pages (*.md) of a directory, by id. Error: invalid page, duplicate id
/// or name, circular `covers`.
Result<std::vector<RulePage>> read_rules(const std::string& directory);

/// Contents of .decklint.toml.
struct LintConfig {
  std::string path;  ///< path of the file; empty: none
  /// Line of every key in the file: "fail-on", "severity.DK9", "gate.max-depth",
  /// "gate.interface[0]".
  std::map<std::string, std::uint64_t> lines;
  std::vector<std::string> select, ignore;
  std::string fail_on;
  std::string baseline;
  std::optional<bool> geometry;  ///< nullopt: the quick checks
  std::string rules_directory;
  std::vector<RulePage> rules;  ///< empty if this thread has team rules (--rules) already
  std::map<std::string, Severity> severity;
  std::vector<std::pair<std::string, std::vector<std::string>>> per_file_ignores;
  Gate gate;
  std::string compare;   ///< [gate] compare: an earlier `deck gaps --json`
  std::string accepted;  ///< [gate] baseline: of `deck gaps --write-baseline`

  /// True if a gate, comparison or baseline is set.
  bool gated() const { return gate.any() || !compare.empty() || !accepted.empty(); }
};

/// Parses a configuration. Errors: unknown keys, unknown rules.
Result<LintConfig> parse_lint_config(std::string_view text, const std::string& path);
inline constexpr std::uint64_t most_config_bytes = std::uint64_t{1} << 20;

/// The bytes of a regular file of at most `most` bytes, or of standard input ("-").
Result<std::string> read_config_file(const std::string& path, std::uint64_t most);
/// Finds .decklint.toml in the directory of `deck_path` or above. No file: an empty configuration.
Result<LintConfig> find_lint_config(const std::string& deck_path);

/// Matches `path` or its last component with a glob of * (no slash), ** and ?.
bool glob_match(std::string_view pattern, std::string_view path);

}  // namespace deck
