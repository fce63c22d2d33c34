// Settings of a lint run that live in a file: .decklint.toml beside or above the deck.
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

/// A key that .decklint.toml may have.
struct ConfigKey {
  std::string_view table;     ///< "" or "gate"; "gate.interface" is [[gate.interface]], a list
  std::string_view key;       ///< an example where it is a selector or a pattern
  std::string_view example;   ///< a value, as TOML
  std::string_view fallback;  ///< what holds without the key; empty: it has to be there
  std::string_view meaning;
};
const std::vector<ConfigKey>& config_keys();
/// The keys of a table and the tables in it, "max-depth, max-ratio, ...", for messages.
std::string known_config_keys(std::string_view table);
/// What `deck lint --init` writes: every key as a comment.
std::string config_template();

/// What is wrong with a selector that fits no rule, with the id that was probably meant.
std::string unknown_selector(std::string_view text);

/// The rules of a team: every page (*.md) in a directory, by id. Error: a page that breaks the
/// form, the id or name of another rule, `covers` that come back to their own rule.
Result<std::vector<RulePage>> read_rules(const std::string& directory);

/// .decklint.toml, read.
struct LintConfig {
  std::string path;  ///< file it came from; empty: none
  /// Line of every key that is there: "fail-on", "severity.DK9", "gate.max-depth",
  /// "gate.interface[0]".
  std::map<std::string, std::uint64_t> lines;
  std::vector<std::string> select, ignore;
  std::string fail_on;
  std::string baseline;
  std::optional<bool> geometry;  ///< nullopt: as far as it is quick
  std::string rules_directory;
  std::vector<RulePage> rules;  ///< none if this thread has rules of a team (--rules) already
  std::map<std::string, Severity> severity;
  std::vector<std::pair<std::string, std::vector<std::string>>> per_file_ignores;
  Gate gate;
  std::string compare;   ///< [gate] compare: an earlier `deck gaps --json`
  std::string accepted;  ///< [gate] baseline: of `deck gaps --write-baseline`

  /// Contacts are to be held against something.
  bool gated() const { return gate.any() || !compare.empty() || !accepted.empty(); }
};

/// Parses the text of a configuration; unknown keys and unknown rules are errors.
Result<LintConfig> parse_lint_config(std::string_view text, const std::string& path);
inline constexpr std::uint64_t most_config_bytes = std::uint64_t{1} << 20;

/// The bytes of a regular file of at most `most` bytes, or of standard input ("-").
Result<std::string> read_config_file(const std::string& path, std::uint64_t most);
/// Looks for .decklint.toml in the directory of `deck_path` and above. No file: an empty config.
Result<LintConfig> find_lint_config(const std::string& deck_path);

/// `path` against a glob with * (no slash), ** and ?; also matches the last path component alone.
bool glob_match(std::string_view pattern, std::string_view path);

}  // namespace deck
