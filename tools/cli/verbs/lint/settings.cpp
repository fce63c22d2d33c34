// Lists effective settings: options override the configuration, which overrides defaults.
#include "verbs/lint/lint_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/shared/shown_text.hpp"

namespace deck::cli {
namespace {

struct SettingRow {
  std::string key, value, origin;
};

// A value in TOML; empty: none.
std::string text_of(const std::string& text) {
  if (text.empty()) return {};
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}
std::string text_of(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& w : words) out += (out.empty() ? "[" : ", ") + text_of(w);
  return out + (out.empty() ? "" : "]");
}
std::string text_of(std::optional<bool> yes) { return !yes ? "" : *yes ? "true" : "false"; }

class Settings {
 public:
  Settings(const LintConfig& config, const GivenSettings& given) : config_(config), given_(given) {}

  std::vector<SettingRow> rows() {
    row("select", text_of(config_.select), "--select", text_of(given_.select));
    ignore();
    row("fail-on", text_of(config_.fail_on), "--fail-on", text_of(given_.gate.level()));
    row("baseline", text_of(config_.baseline), "--baseline", text_of(given_.baseline));
    row("geometry", text_of(config_.geometry),
        given_.geometry.value_or(true) ? "--geometry" : "--no-geometry", text_of(given_.geometry));
    row("rules", text_of(config_.rules_directory), "--rules", text_of(given_.rules));
    table("severity");
    for (const auto& [selector, severity] : config_.severity)
      row("severity." + selector, text_of(std::string(to_string(severity))));
    table("per-file-ignores");
    for (const auto& [pattern, rules] : config_.per_file_ignores)
      add("per-file-ignores." + text_of(pattern), rules.empty() ? "[]" : text_of(rules),
          origin("per-file-ignores." + pattern));
    gate();
    return std::move(rows_);
  }

 private:
  std::string origin(const std::string& key) const {
    const auto line = config_.lines.find(key);
    return line == config_.lines.end() ? "default"
                                       : config_.path + ":" + std::to_string(line->second);
  }
  void add(const std::string& key, std::string value, std::string from) {
    rows_.push_back({key, std::move(value), std::move(from)});
  }
  /// Adds a row: the option's value, else the configured one, else the default.
  void row(const std::string& key, std::string configured, const std::string& option = {},
           const std::string& given = {}) {
    if (!given.empty()) return add(key, given, option);
    if (configured.empty()) {
      const auto dot = key.rfind('.');
      const std::string table = dot == key.npos ? "" : key.substr(0, dot);
      for (const ConfigKey& k : config_keys())
        if (k.table == table && k.key == (dot == key.npos ? key : key.substr(dot + 1)))
          configured = k.fallback;
    }
    add(key, std::move(configured), origin(key));
  }
  /// Adds a row for a missing table.
  void table(const std::string& name) {
    const bool any = std::any_of(config_.lines.begin(), config_.lines.end(), [&](const auto& line) {
      return line.first.starts_with(name + ".");
    });
    if (!any) add(name, "none", "default");
  }

  void ignore() {
    if (given_.ignore.empty()) return row("ignore", text_of(config_.ignore));
    std::vector<std::string> all = config_.ignore;
    all.insert(all.end(), given_.ignore.begin(), given_.ignore.end());
    add("ignore", text_of(all),
        (config_.ignore.empty() ? "" : origin("ignore") + " and ") + std::string("--ignore"));
  }

  static std::string scope_text(const GateScope& scope) {
    std::string out =
        "match = " + (scope.match.size() == 1 ? text_of(scope.match[0]) : text_of(scope.match));
    const auto limit = [&](const char* name, const auto& value) {
      if (value) out += fmt::format(", {} = {}", name, *value);
    };
    limit("max-depth", scope.limits.max_depth);
    limit("max-ratio", scope.limits.max_ratio);
    limit("max-count", scope.limits.max_count);
    limit("max-untied", scope.limits.max_untied);
    limit("max-dt-loss", scope.limits.max_dt_loss);
    return out;
  }
  void scopes(const std::string& name, const std::vector<GateScope>& all) {
    if (all.empty()) add("gate." + name, "none", "default");
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::string key = "gate." + name + "[" + std::to_string(i) + "]";
      add(key, scope_text(all[i]), origin(key));
    }
  }
  void gate() {
    const GateLimits& limits = config_.gate.general;
    const GateOptions& o = given_.gate;
    const auto bound = [&](const std::string& key, auto given, const auto& configured) {
      row("gate." + key, configured ? fmt::format("{}", *configured) : "", "--" + key,
          given >= 0 ? fmt::format("{}", given) : "");
    };
    bound("max-depth", o.max_depth, limits.max_depth);
    bound("max-ratio", o.max_ratio, limits.max_ratio);
    bound("max-count", o.max_count, limits.max_count);
    bound("max-untied", o.max_untied, limits.max_untied);
    bound("max-dt-loss", o.max_dt_loss, limits.max_dt_loss);
    row("gate.compare", text_of(config_.compare), "--compare", text_of(o.compare));
    row("gate.baseline", text_of(config_.accepted), "--baseline", text_of(o.baseline));
    std::vector<std::string> words, options;
    for (const char* word : {"new", "worse"}) {
      const bool configured =
          std::string_view(word) == "new" ? config_.gate.on_fresh : config_.gate.on_worse;
      if (configured || o.fails_on(word)) words.emplace_back(word);
      if (o.fails_on(word)) options.emplace_back(word);
    }
    if (options.empty())
      row("gate.fail-on", text_of(words));
    else
      add("gate.fail-on", text_of(words),
          (words == options ? "" : origin("gate.fail-on") + " and ") + std::string("--fail-on"));
    scopes("interface", config_.gate.interfaces);
    scopes("part-pair", config_.gate.part_pairs);
  }

  const LintConfig& config_;
  const GivenSettings& given_;
  std::vector<SettingRow> rows_;
};

}  // namespace

std::string settings_text(const LintConfig& config, const GivenSettings& given) {
  const std::vector<SettingRow> rows = Settings(config, given).rows();
  std::size_t key = 0, value = 0;
  constexpr std::size_t widest = 40;  // longer values do not shift the column of origins
  for (const SettingRow& r : rows) {
    key = std::max(key, r.key.size());
    value = std::max(value, std::min(widest, r.value.size()));
  }
  std::string out;
  for (const SettingRow& r : rows)
    out += fmt::format("  {:<{}}  {:<{}}  {}\n", terminal_text(r.key), key, terminal_text(r.value),
                       value, terminal_text(r.origin));
  return out;
}

Result<std::string> write_settings_file(const std::string& directory) {
  namespace fs = std::filesystem;
  std::error_code ec;
  const std::string path = (fs::path(directory) / ".decklint.toml").string();
  if (!directory.empty() && !fs::is_directory(directory, ec))
    return config_error(directory +
                        " is not a directory; --init takes the directory for .decklint.toml");
  if (fs::symlink_status(path, ec).type() != fs::file_type::not_found)
    return config_error(
        path + " already exists and was not changed; 'deck lint --show-config' shows its settings");
  if (auto written = write_file_atomic(path, config_template()); !written) return written.error();
  return path;
}

}  // namespace deck::cli
