// The keys of .decklint.toml: the one list that the parser, its messages, `deck lint --init`,
// `deck lint --show-config` and the test of the documentation go by.
#include <algorithm>

#include "lint/shared/config.hpp"

namespace deck {

const std::vector<ConfigKey>& config_keys() {
  static const std::vector<ConfigKey> keys = {
      {"", "select", R"(["DK0", "DK1", "DK2"])", "all rules",
       "only these rules: ids, names, beginnings of ids (\"DK2\") or fields (DK201:Istf); see "
       "'deck rules'"},
      {"", "ignore", R"(["DK9"])", "none", "not these rules, even if selected"},
      {"", "fail-on", R"("warning")", "\"error\"",
       "exit code 1 at or above: \"error\", \"warning\" or \"never\""},
      {"", "baseline", R"("lint-baseline.json")", "none",
       "findings that are known and accepted: a file of 'deck lint --write-baseline' or 'deck gate "
       "--accept', relative to this one"},
      {"", "geometry", "true", "as far as it is quick",
       "check geometry (rules DK3, DK4): true for decks of any size, false never (not with "
       "[gate])"},
      {"severity", "DK9", R"("warning")", "that of the rule",
       "severity of rules: \"error\", \"warning\" or \"info\"; the longest matching selector wins"},
      {"per-file-ignores", R"("legacy/**/*.inc")", R"(["DK2"])", "none",
       "not these rules in files that match the pattern, included ones too"},
      {"gate", "max-depth", "0.5", "no bound", "deepest penetration, in the deck's units"},
      {"gate", "max-ratio", "0.5", "no bound", "largest share of its gap that a pair penetrates"},
      {"gate", "max-count", "0", "no bound", "penetrating nodes and edges of the deck, each once"},
      {"gate", "max-untied", "0", "no bound",
       "nodes of /INTER/TYPE2 in the deck that are not tied, each once"},
      {"gate", "max-dt-loss", "0.1", "no bound",
       "share of the mesh's time step that a contact may take away"},
      {"gate", "compare", R"("gaps.json")", "none",
       "an earlier 'deck gaps --json' to compare with, relative to this file, or \"git:REV\""},
      {"gate", "fail-on", R"(["new", "worse"])", "none",
       "errors for penetrations that the earlier run did not have, or that are deeper now"},
      {"gate", "baseline", R"("gaps-baseline.json")", "none",
       "accepted penetrations, a file of 'deck gaps --write-baseline' or 'deck gate --accept', "
       "relative to this file: only new and worse ones are errors"},
      {"gate.interface", "match", R"("bumper*")", "", "id or title of an interface"},
      {"gate.interface", "max-depth", "1.0", "that of [gate]", "bound for these interfaces"},
      {"gate.interface", "max-ratio", "0.8", "that of [gate]", "bound for these interfaces"},
      {"gate.interface", "max-count", "12", "no bound", "in addition to that of the whole deck"},
      {"gate.interface", "max-untied", "3", "no bound", "in addition to that of the whole deck"},
      {"gate.interface", "max-dt-loss", "0.2", "that of [gate]", "bound for these interfaces"},
      {"gate.part-pair", "match", R"(["rail *", "1004"])", "",
       "ids or titles of two parts, in any order"},
      {"gate.part-pair", "max-depth", "1.0", "that of the interface", "bound for these parts"},
      {"gate.part-pair", "max-ratio", "0.8", "that of the interface", "bound for these parts"},
      {"gate.part-pair", "max-count", "3", "no bound", "in addition to that of the whole deck"},
  };
  return keys;
}

std::string known_config_keys(std::string_view table) {
  std::vector<std::string_view> names;
  const auto add = [&](std::string_view name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  const std::string inside = table.empty() ? std::string() : std::string(table) + ".";
  for (const ConfigKey& k : config_keys()) {
    if (k.table == table)
      add(k.key);
    else if (k.table.starts_with(inside))
      add(k.table.substr(inside.size(), k.table.find('.', inside.size()) - inside.size()));
  }
  std::string out;
  for (const std::string_view name : names) out += (out.empty() ? "" : ", ") + std::string(name);
  return out;
}

std::string config_template() {
  std::string out =
      "# Settings of deck lint, and of the gate of deck gaps and deck cycle, for the decks in "
      "this\n"
      "# directory and below it. Every key is here as a comment, with an example: remove the\n"
      "# '# ' before a line (and before the [table] above it) to use it.\n"
      "# 'deck lint --show-config DECK' shows all settings and where they come from.\n";
  std::string_view table;
  for (const ConfigKey& k : config_keys()) {
    out += "\n";
    if (k.table != table) {
      const bool list = k.table.find('.') != k.table.npos;
      out += (list ? "# [[" : "# [") + std::string(k.table) + (list ? "]]\n" : "]\n");
      table = k.table;
    }
    out += "## " + std::string(k.meaning);
    if (!k.fallback.empty()) out += " (default: " + std::string(k.fallback) + ")";
    out += "\n# " + std::string(k.key) + " = " + std::string(k.example) + "\n";
  }
  return out;
}

}  // namespace deck
