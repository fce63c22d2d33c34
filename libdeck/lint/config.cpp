// Reads the configuration; the only file with the TOML parser, which is header-only.
#include "lint/shared/config.hpp"

namespace deck {
namespace {
/// Thrown in place of the parser's assertions, which input can trigger ("[*"). The original ones
/// end the process or, in a release build, are undefined behaviour.
struct ParserLost {};
}  // namespace
}  // namespace deck
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(condition) ((condition) ? static_cast<void>(0) : throw deck::ParserLost())
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpragmas"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#ifndef __clang__
#pragma GCC diagnostic ignored "-Wterminate"
#endif
#endif
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/shared/words.hpp"

namespace deck {
namespace fs = std::filesystem;

std::string unknown_selector(std::string_view text) {
  std::vector<std::string> known;
  for (const Rule& rule : all_rules())
    for (const std::string& head : {std::string(id_text(rule.id)), rule.name}) {
      known.push_back(head);
      if (text.find(':') != text.npos)
        for (const RuleField& f : rule.fields) known.push_back(head + ":" + f.name);
    }
  const std::string close = closest_word(text, known);
  return "no rule is called '" + std::string(text) + "'" +
         (close.empty() ? "; see 'deck rules'" : "; did you mean '" + close + "'?");
}

namespace {

Error config_error(const std::string& path, std::uint64_t line, const std::string& what) {
  return {Error::Code::config,
          path + (line > 0 ? ":" + std::to_string(line) : std::string()) + ": " + what};
}

std::uint64_t line_of(const toml::node& node) { return node.source().begin.line; }

/// Error in a value; caught where the file name is known.
struct ConfigProblem {
  std::uint64_t line;
  std::string what;
};

[[noreturn]] void fail(const toml::node& node, std::string what) {
  throw ConfigProblem{line_of(node), std::move(what)};
}

const toml::table& table_of(const toml::node& node, std::string what) {
  if (const toml::table* table = node.as_table()) return *table;
  fail(node, std::move(what));
}

/// A path relative to the directory of the configuration.
std::string path_of(const toml::node& node, std::string_view key, const LintConfig& config) {
  const auto text = node.value<std::string>();
  if (!text) fail(node, "'" + std::string(key) + "' is not a path");
  return (fs::path(config.path).parent_path() / *text).string();
}

[[noreturn]] void fail_at_key(const toml::node& node, std::string_view key,
                              std::string_view table) {
  fail(node, "unknown key '" + std::string(key) + "'; known: " + known_config_keys(table));
}

/// A list of selectors of known rules.
std::vector<std::string> string_list(const toml::node& node, std::string_view key) {
  const toml::array* array = node.as_array();
  if (array == nullptr) fail(node, "'" + std::string(key) + "' is not a list of strings");
  std::vector<std::string> out;
  for (const toml::node& item : *array) {
    const auto text = item.value<std::string>();
    if (!text) fail(item, "'" + std::string(key) + "' holds something that is not a string");
    if (!known_selector(*text)) fail(item, unknown_selector(*text));
    out.push_back(*text);
  }
  return out;
}

void read_severity(const toml::node& node, LintConfig& config) {
  for (const auto& [key, value] : table_of(node, "'severity' is not a table")) {
    const auto text = value.value<std::string>();
    const auto severity = text ? severity_of(*text) : std::nullopt;
    if (!severity) fail(value, "a severity is \"error\", \"warning\" or \"info\"");
    if (!known_selector(key.str())) fail(value, unknown_selector(key.str()));
    config.severity[std::string(key.str())] = *severity;
    config.lines["severity." + std::string(key.str())] = line_of(value);
  }
}

/// Reads a bound of the gate; false: `name` is not one.
bool read_bound(std::string_view name, const toml::node& node, GateLimits& limits) {
  if (name == "max-count" || name == "max-untied") {
    const auto count = node.value<std::int64_t>();
    if (!node.is_integer() || *count < 0)
      fail(node, "'" + std::string(name) + "' is a whole number, 0 or more");
    (name == "max-count" ? limits.max_count : limits.max_untied) =
        static_cast<std::uint64_t>(*count);
    return true;
  }
  std::optional<double>* bound = name == "max-depth"     ? &limits.max_depth
                                 : name == "max-ratio"   ? &limits.max_ratio
                                 : name == "max-dt-loss" ? &limits.max_dt_loss
                                                         : nullptr;
  if (bound == nullptr) return false;
  const auto number = node.value<double>();
  if (!node.is_number() || !(*number >= 0))
    fail(node, "'" + std::string(name) + "' is a number, 0 or more");
  // A share above 1 never triggers: 30 % is 0.3.
  if (*number > 1 && name != "max-depth")
    fail(node, "'" + std::string(name) + "' is a share from 0 to 1");
  *bound = *number;
  return true;
}

/// One table of [[gate.interface]] (`patterns` 1) or [[gate.part-pair]] (2).
GateScope read_scope(const toml::node& node, std::size_t patterns) {
  const std::string form = patterns == 1 ? "a pattern of the id or title of an interface"
                                         : "a list of two patterns of ids or titles of parts";
  GateScope scope;
  for (const auto& [key, value] : table_of(node, "this is not a table with 'match' and bounds")) {
    if (key.str() == "match") {
      if (const auto text = value.value<std::string>()) {
        scope.match = {*text};
      } else if (const toml::array* list = value.as_array()) {
        for (const toml::node& item : *list)
          if (const auto text_of = item.value<std::string>()) scope.match.push_back(*text_of);
      }
      if (scope.match.size() != patterns) fail(value, "'match' is " + form);
      continue;
    }
    const bool known = read_bound(key.str(), value, scope.limits);
    if (!known || (patterns == 2 && key.str() == "max-dt-loss"))
      fail_at_key(value, key.str(), patterns == 1 ? "gate.interface" : "gate.part-pair");
  }
  if (scope.match.empty()) fail(node, "'match' is missing: " + form);
  return scope;
}

void read_gate(const toml::node& node, LintConfig& config) {
  for (const auto& [key, value] : table_of(node, "'gate' is not a table")) {
    const bool of_interface = key.str() == "interface";
    if (of_interface || key.str() == "part-pair") {
      const toml::array* list = value.as_array();
      if (list == nullptr)
        fail(value, "expected [[gate." + std::string(key.str()) + "]], a list of tables");
      for (const toml::node& item : *list) {
        auto& scopes = of_interface ? config.gate.interfaces : config.gate.part_pairs;
        config.lines["gate." + std::string(key.str()) + "[" + std::to_string(scopes.size()) + "]"] =
            line_of(item);
        scopes.push_back(read_scope(item, of_interface ? 1 : 2));
      }
      continue;
    }
    config.lines["gate." + std::string(key.str())] = line_of(value);
    if (key.str() == "fail-on") {
      const toml::array* list = value.as_array();
      bool legal = list != nullptr;
      for (std::size_t i = 0; legal && i < list->size(); ++i) {
        const auto word = list->get(i)->value<std::string>();
        legal = word == "new" || word == "worse";
        (word == "new" ? config.gate.on_fresh : config.gate.on_worse) = true;
      }
      if (!legal) fail(value, "'fail-on' of the gate is a list of \"new\" and \"worse\"");
      continue;
    }
    if (key.str() == "compare" || key.str() == "baseline") {
      const bool compare = key.str() == "compare";
      std::string& path = compare ? config.compare : config.accepted;
      path = value.value_or(std::string());
      // "git:REV" is the deck at a revision.
      if (!compare || !path.starts_with("git:")) path = path_of(value, key.str(), config);
      continue;
    }
    if (!read_bound(key.str(), value, config.gate.general)) fail_at_key(value, key.str(), "gate");
  }
}

void read_key(std::string_view key, const toml::node& node, LintConfig& config) {
  config.lines[std::string(key)] = line_of(node);
  if (key == "select" || key == "ignore") {
    (key == "select" ? config.select : config.ignore) = string_list(node, key);
    return;
  }
  if (key == "fail-on") {
    const auto text = node.value<std::string>();
    if (!text || (*text != "error" && *text != "warning" && *text != "never"))
      fail(node, "'fail-on' is \"error\", \"warning\" or \"never\"");
    config.fail_on = *text;
    return;
  }
  if (key == "baseline") {
    config.baseline = path_of(node, key, config);
    return;
  }
  if (key == "rules") return;  // read first, because other keys use their names
  if (key == "geometry") {
    config.geometry = node.value_exact<bool>();
    if (!config.geometry) fail(node, "'geometry' is true or false");
    return;
  }
  if (key == "severity") return read_severity(node, config);
  if (key == "gate") return read_gate(node, config);
  if (key == "per-file-ignores") {
    for (const auto& [glob, rules] : table_of(node, "'per-file-ignores' is not a table")) {
      config.per_file_ignores.emplace_back(std::string(glob.str()), string_list(rules, glob.str()));
      config.lines["per-file-ignores." + std::string(glob.str())] = line_of(rules);
    }
    return;
  }
  fail_at_key(node, key, "");
}

void read_rules_key(const toml::node& node, LintConfig& config) {
  config.rules_directory = path_of(node, "rules", config);
  if (is_team_rule(all_rules().back().id)) return;
  auto rules = read_rules(config.rules_directory);
  if (!rules) fail(node, rules.error().message);
  config.rules = std::move(*rules);
}

struct Unreadable {
  std::uint64_t line = 0;  ///< 0: unknown
  const char* why = "";
};

/// Text on which the parser fails: a dotted key with more parts than any valid key (a table per
/// part, up to stack overflow), and non-ASCII letters outside of quotes and comments (undefined
/// result of its test for blanks).
Unreadable unreadable_line(std::string_view text) {
  constexpr std::size_t most_parts = 16;
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  std::uint64_t line = 1;
  std::size_t dots = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char ch = text[at];
    if (ch == '"' || ch == '\'') {  // quoted part of a key, or a value
      const std::string_view mark = text.substr(at, 3);
      const bool lines = mark.size() == 3 && mark[1] == ch && mark[2] == ch;
      std::size_t end = at + (lines ? 3 : 1);
      while (end < text.size() && (lines ? text.substr(end, 3) != mark : text[end] != ch)) {
        if (text[end] == '\n' && !lines) break;
        line += text[end] == '\n';
        end += ch == '"' && text[end] == '\\' ? 2 : 1;
      }
      at = end + (lines ? 2 : 0);
      if (at < text.size() && text[at] == '\n') --at;  // an unterminated string
    } else if (ch == '#') {
      at = std::min(text.find('\n', at), text.size()) - 1;
    } else if (ch == '.') {
      if (++dots >= most_parts)
        return {line,
                "a key has more dotted parts than any setting; quote the file patterns of "
                "'per-file-ignores'"};
    } else if (ch == '\n') {
      ++line;
      dots = 0;
    } else if (ch == '=' || ch == '[' || ch == '{' || ch == ',') {
      dots = 0;
    } else if (static_cast<unsigned char>(ch) >= 0x80) {
      return {line, "a character that is not ASCII is outside of quotes"};
    }
  }
  return {};
}

}  // namespace

Result<LintConfig> parse_lint_config(std::string_view text, const std::string& path) try {
  if (const Unreadable bad = unreadable_line(text); bad.line > 0)
    return config_error(path, bad.line, bad.why);
  const toml::parse_result parsed = toml::parse(text, path);
  if (!parsed)
    return config_error(path, parsed.error().source().begin.line,
                        std::string(parsed.error().description()));
  LintConfig config;
  config.path = path;
  if (const toml::node* rules = parsed.table().get("rules")) read_rules_key(*rules, config);
  const auto known = use_rules(config.rules);
  for (const auto& [key, node] : parsed.table()) read_key(key.str(), node, config);
  if (config.geometry == false && config.gated())
    return config_error(path, config.lines["geometry"],
                        "'geometry = false' would switch off the gate of [gate]");
  return config;
} catch (const ConfigProblem& problem) {
  return config_error(path, problem.line, problem.what);
} catch (const ParserLost&) {
  return config_error(
      path, 0, "is not TOML: a table or key begins with a character that is not allowed there");
}

Result<std::string> read_config_file(const std::string& path, std::uint64_t most) {
  Limits limits;
  limits.total_bytes = limits.stdin_bytes = limits.map_threshold = most;
  const auto source = Source::open(path, limits);
  if (!source) return Error{Error::Code::config, source.error().message};
  return std::string((*source)->bytes());
}

Result<LintConfig> find_lint_config(const std::string& deck_path) {
  std::error_code ec;
  fs::path dir =
      deck_path == "-" ? fs::current_path(ec) : fs::absolute(fs::path(deck_path), ec).parent_path();
  while (!dir.empty()) {
    const fs::path file = dir / ".decklint.toml";
    // A dangling link, folder or pipe of that name is an error, so that the gate is not lost.
    const fs::file_type type = fs::symlink_status(file, ec).type();
    if (type != fs::file_type::not_found && type != fs::file_type::none) {
      const auto text = read_config_file(file.string(), most_config_bytes);
      if (!text) return text.error();
      return parse_lint_config(*text, file.string());
    }
    if (dir == dir.parent_path()) break;
    dir = dir.parent_path();
  }
  return LintConfig{};
}

}  // namespace deck
