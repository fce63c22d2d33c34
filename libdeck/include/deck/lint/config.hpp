// Settings of a lint run that live in files: .decklint.toml beside or above the deck, and the
// baseline of findings that are known and accepted.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "deck/lint/lint.hpp"
#include "deck/text/result.hpp"

namespace deck {

/// .decklint.toml. Keys: select, ignore (lists of ids or prefixes), fail-on ("error", "warning",
/// "never"), baseline (path, relative to the file), [severity] id = "error"|"warning"|"info",
/// [per-file-ignores] glob = list.
struct LintConfig {
  std::string path;  ///< file it came from; empty: none
  std::vector<std::string> select, ignore;
  std::string fail_on;
  std::string baseline;
  std::map<std::string, Severity> severity;
  std::vector<std::pair<std::string, std::vector<std::string>>> per_file_ignores;
};

/// Parses the text of a configuration; unknown keys and unknown rules are errors.
Result<LintConfig> parse_lint_config(std::string_view text, const std::string& path);
/// Looks for .decklint.toml in the directory of `deck_path` and above. No file: an empty config.
Result<LintConfig> find_lint_config(const std::string& deck_path);

/// Baseline file: JSON
/// {"schema":"deck.baseline/1","findings":{"<fingerprint>":{"rule":..,"count":..}}}.
Result<std::map<std::string, std::uint64_t>> parse_baseline(std::string_view text);
/// The findings of one or more runs as a baseline, ordered by fingerprint.
std::string write_baseline(const std::vector<const LintResult*>& results);

/// `path` against a glob with * (no slash), ** and ?; also matches the last path component alone.
bool glob_match(std::string_view pattern, std::string_view path);

}  // namespace deck
