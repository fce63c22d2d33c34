// The keys of .decklint.toml (schemas/config: table, key, example, default, meaning), used by the
// parser, its messages, `deck lint --init`, `deck lint --show-config` and the test of the
// documentation.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/shared/embedded.hpp"
#include "lint/shared/config.hpp"

namespace deck {

const std::vector<ConfigKey>& config_keys() {
  static const auto rows = nlohmann::json::parse(detail::embedded_config().front().text);
  static const std::vector<ConfigKey> keys = [] {
    std::vector<ConfigKey> out;
    for (const auto& row : rows) {
      const auto text = [&](int i) -> std::string_view {
        return row[i].get_ref<const std::string&>();
      };
      out.push_back({text(0), text(1), text(2), text(3), text(4)});
    }
    return out;
  }();
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
  return fmt::format("{}", fmt::join(names, ", "));
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
