// Reads a page of schemas/rules: front matter, then a paragraph or an example for each heading.
#include "text/shared/rule_page.hpp"

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <optional>

namespace deck::detail {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<Severity> severity_of(std::string_view text) {
  if (text == "error") return Severity::error;
  if (text == "warning") return Severity::warning;
  if (text == "info") return Severity::info;
  return std::nullopt;
}

std::optional<RuleStage> stage_of(std::string_view text) {
  if (text == "reading") return RuleStage::reading;
  if (text == "model") return RuleStage::model;
  if (text == "check") return RuleStage::check;
  if (text == "geometry") return RuleStage::extra;
  if (text == "gate") return RuleStage::gate;
  if (text == "linter") return RuleStage::linter;
  return std::nullopt;
}

/// "DK203" of "DK203.md"; none: not the name of a page.
RuleId id_of(std::string_view name) {
  if (name.size() != 8 || !name.starts_with("DK") || !name.ends_with(".md")) return RuleId::none;
  return static_cast<RuleId>(whole_number(name.substr(2, 3)).value_or(0));
}

/// "renard-curve": two or more words of small letters and digits.
bool is_kebab_case(std::string_view text) {
  const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
  const bool legal = std::all_of(text.begin(), text.end(), [&](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '-';
  });
  return legal && text.find('-') != text.npos && text.find("--") == text.npos &&
         is_letter(text.front()) && text.back() != '-';
}

/// What a source of `known_from` begins with.
bool is_source(std::string_view text) {
  constexpr std::string_view kinds[] = {"run ", "record ", "listing ", "specification ", "manual "};
  return std::any_of(std::begin(kinds), std::end(kinds),
                     [&](std::string_view kind) { return text.starts_with(kind); });
}

struct Section {
  std::string_view heading;
  std::string Rule::*text;
  bool optional = false;
  bool example = false;
};
constexpr Section sections[] = {
    {heading::problem, &Rule::problem},     {heading::why, &Rule::why},
    {heading::solver, &Rule::solver},       {heading::fix, &Rule::fix},
    {heading::bad, &Rule::bad, true, true}, {heading::good, &Rule::good, true, true},
    {heading::ignore, &Rule::ignore, true},
};

class PageReader {
 public:
  PageReader(std::string_view name, std::string_view text) : name_(name), rest_(text) {}

  Result<Rule> read() {
    rule_.id = id_of(name_);
    if (rule_.id == RuleId::none) return error("the page of a rule must be named DKnnn.md");
    read_front_matter();
    for (const Section& section : sections) {
      if (section.optional && next_heading() != section.heading) continue;
      read_section(section);
    }
    skip_blank();
    if (!done()) fail("text after the last section");
    if (rule_.bad.empty() != rule_.good.empty()) fail("one example without the other");
    if (!problem_.empty()) return error(problem_);
    return std::move(rule_);
  }

 private:
  Error error(const std::string& what) const {
    return {Error::Code::internal,
            std::string(name_) + ":" + std::to_string(problem_line_) + ": " + what};
  }
  /// Keeps the first problem; reading goes on to the end of the page.
  void fail(std::string what) {
    if (!problem_.empty()) return;
    problem_ = std::move(what);
    problem_line_ = line_;
  }

  bool done() const { return rest_.empty(); }
  std::string_view peek() const { return rest_.substr(0, rest_.find('\n')); }
  std::string_view next() {
    const std::string_view line = peek();
    rest_.remove_prefix(std::min(line.size() + 1, rest_.size()));
    ++line_;
    return line;
  }
  void skip_blank() {
    while (!done() && peek().empty()) next();
  }
  /// The name in "- **name.** text" on the next line that is not blank; empty: none stands there.
  std::string_view next_heading() {
    skip_blank();
    const std::string_view line = peek();
    const auto end = line.find(".**");
    return line.starts_with("- **") && end != std::string_view::npos ? line.substr(4, end - 4)
                                                                     : std::string_view();
  }

  void read_front_matter() {
    if (next() != "---") fail("a page starts with '---'");
    bool id = false;
    while (!done() && peek() != "---") {
      std::string_view line = next();
      if (line == "cases:") continue;
      const bool first = line.starts_with("- "), of_case = first || line.starts_with("  ");
      if (first) rule_.cells.resize(std::max<std::size_t>(rule_.cells.size(), 1) + 1);
      if (of_case) line.remove_prefix(2);
      const auto colon = line.find(": ");
      if (colon == std::string_view::npos) {
        fail("expected 'key: value', '---' after the last one");
        return;
      }
      const std::string_view key = line.substr(0, colon), value = trimmed(line.substr(colon + 2));
      id = id || key == "id";
      if (of_case ? !read_cell_key(key, value) : !read_key(key, value))
        fail("'" + std::string(line) + "' is not understood");
    }
    next();
    if (!id || rule_.name.empty() || rule_.title.empty() || rule_.severities.empty() || !stage_)
      fail("a page has an id, a name, a title, a severity and found_by");
  }

  /// Calls f(item) for the items of a list; false: f refused one of them.
  template <class F>
  static bool each_item(std::string_view list, F&& f, char separator = ',') {
    while (true) {
      const auto end = std::min(list.find(separator), list.size());
      if (!f(trimmed(list.substr(0, end)))) return false;
      if (end == list.size()) return true;
      list.remove_prefix(end + 1);
    }
  }

  static bool is_one_of(std::string_view key, std::initializer_list<std::string_view> keys) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
  }

  /// A key of a rule that is a predicate of cells, or of one of its cases.
  bool read_cell_key(std::string_view key, std::string_view value) {
    if (rule_.cells.empty() ||
        !is_one_of(key, {"when", "if", "at", "message", "because", "note", "fix", "of", "per",
                         "keywords", "beside", "legal", "sum", "not_a", "known_from"}))
      return false;
    if (value.size() > 2 && value.starts_with('"') && value.ends_with('"'))
      value = value.substr(1, value.size() - 2);
    return rule_.cells.back().emplace(key, value).second;
  }

  bool read_key(std::string_view key, std::string_view value) {
    if (key == "id") return value == name_.substr(0, name_.size() - 3);
    if (key == "name") {
      rule_.name = value;
      return is_kebab_case(value);
    }
    if (key == "title") {
      if (value.size() < 3 || value.front() != '"' || value.back() != '"') return false;
      rule_.title = value.substr(1, value.size() - 2);
      return rule_.title.find_first_of("\"\\") == std::string::npos;
    }
    if (key == "severity")
      return each_item(value, [&](std::string_view item) {
        const auto severity = severity_of(item);
        if (severity) rule_.severities.push_back(*severity);
        return severity.has_value();
      });
    if (key == "found_by") {
      stage_ = stage_of(value);
      rule_.stage = stage_.value_or(RuleStage::check);
      return stage_.has_value();
    }
    if (is_one_of(key, {"when", "at", "note", "fix", "of", "per"}) ||
        (key == "message" && value.starts_with('"'))) {
      if (rule_.cells.empty()) rule_.cells.emplace_back();
      return rule_.cells.size() == 1 && read_cell_key(key, value);  // cases come last
    }
    if (is_one_of(key, {"covers", "only_where", "zeros", "flag", "except"}))
      return each_item(value, [&](std::string_view item) {
        rule_.exceptions[std::string(key)].emplace_back(item);
        return !item.empty();
      });
    if (key == "message")
      return each_item(value, [&](std::string_view item) {
        const auto blank = std::min(item.find(' '), item.size());
        const auto severity = severity_of(item.substr(0, blank));
        const auto number = whole_number(trimmed(item.substr(blank)));
        if (severity && number) rule_.messages.push_back({*number, *severity});
        return severity && number;
      });
    if (key == "known_from") {
      rule_.source = value;
      return each_item(value, is_source, ';');
    }
    if (key == "if_include_missing") {
      rule_.absence = true;
      return value == "hidden";
    }
    if (key == "fixable") {
      rule_.fixable = value == "safe" ? Fixable::safe : Fixable::unsafe;
      return value == "safe" || value == "unsafe";
    }
    if (key == "fields") return read_fields(value, rule_.id);
    if (key == "was") {
      const auto blank = std::min(value.find(' '), value.size());
      const RuleId was = id_of(std::string(value.substr(0, blank)) + ".md");
      return was != RuleId::none && was != rule_.id && read_fields(value.substr(blank), was);
    }
    if (key == "types")
      return each_item(value, [&](std::string_view item) {
        const auto number = whole_number(item);
        if (number) rule_.types.push_back(*number);
        return number.has_value();
      });
    return false;
  }

  /// "Gapmin, Gap": fields of the rule; "VISF (info)" has a severity of its own.
  bool read_fields(std::string_view list, RuleId was) {
    return each_item(list, [&](std::string_view item) {
      const auto bracket = std::min(item.find('('), item.size());
      RuleField field{std::string(trimmed(item.substr(0, bracket))), was};
      if (bracket < item.size()) {
        field.severity = severity_of(item.substr(bracket + 1, item.size() - bracket - 2));
        if (!field.severity || item.back() != ')') return false;
      }
      if (field.name.empty() || rule_.field(field.name) != nullptr) return false;
      rule_.fields.push_back(std::move(field));
      return true;
    });
  }

  /// "| a | b |" as its cells.
  static std::vector<std::string_view> cells_of(std::string_view line) {
    std::vector<std::string_view> out;
    line.remove_prefix(1);
    for (auto end = line.find('|'); end != std::string_view::npos; end = line.find('|')) {
      out.push_back(trimmed(line.substr(0, end)));
      line.remove_prefix(end + 1);
    }
    return out;
  }

  /// A table of what is particular about fields: their names, then the columns of its head:
  /// "Solver", "Fix", and one of any other name, the note.
  void read_table() {
    const auto head = cells_of(next());
    if (!next().starts_with("|--")) fail("a table has a line |---| below its head");
    while (peek().starts_with('|')) {
      const auto cells = cells_of(next());
      bool known = cells.size() == head.size() && !cells.empty();
      known = known && each_item(cells.front(), [&](std::string_view name) {
                const auto field = std::find_if(rule_.fields.begin(), rule_.fields.end(),
                                                [&](const RuleField& f) { return f.name == name; });
                if (field == rule_.fields.end()) return false;
                for (std::size_t i = 1; i < cells.size(); ++i)
                  (head[i] == "Solver" ? field->solver
                   : head[i] == "Fix"  ? field->fix
                                       : field->note) = cells[i];
                return true;
              });
      if (!known) fail("a line of a table has the cells of its head, the first one names fields");
    }
  }

  void read_section(const Section& section) {
    const bool expected = next_heading() == section.heading;
    const std::string_view first = next();
    if (!expected) {
      fail("expected the section '- **" + std::string(section.heading) + ".**'");
      return;
    }
    const std::string_view rest =
        trimmed(first.substr(std::min(first.size(), section.heading.size() + 7)));
    std::string& text = rule_.*section.text;
    if (section.example) {
      read_example(text, rest);
    } else {
      for (text = rest; !done() && next_heading().empty();)
        if (peek().starts_with('|'))
          read_table();
        else
          text += (text.empty() ? "" : " ") + std::string(next());
    }
    if (text.empty()) fail("the section '**" + std::string(section.heading) + ".**' is empty");
  }

  /// An example: one line between back quotes, or lines between fences.
  void read_example(std::string& text, std::string_view line) {
    if (line.size() > 2 && line.front() == '`' && line.back() == '`') {
      text = std::string(line.substr(1, line.size() - 2)) + "\n";
      return;
    }
    const std::string_view fence = line.empty() ? next() : line;
    if (fence != "```" && fence != "```escaped") {
      fail(
          "an example is one line between back quotes, or stands between lines ``` "
          "(or ```escaped and ```)");
      return;
    }
    while (!done() && peek() != "```") {
      std::string row = std::string(next()) + "\n";
      if (fence != "```" && !unescape(row))
        fail("\\r, \\t, \\xHH, \\\\ and \\ at the end of a line");
      text += row;
    }
    if (done()) fail("an example does not end: ``` is missing");
    next();
  }

  /// \r, \t, \xHH and \\; a backslash at the end of a line: the line goes on.
  static bool unescape(std::string& line) {
    std::string out;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line[i] != '\\') {
        out += line[i];
        continue;
      }
      if (++i == line.size()) return false;
      int code = 0;
      switch (line[i]) {
        case 'r':
          out += '\r';
          break;
        case 't':
          out += '\t';
          break;
        case '\\':
          out += '\\';
          break;
        case '\n':
          break;
        case 'x':
          if (i + 2 >= line.size() ||
              std::from_chars(line.data() + i + 1, line.data() + i + 3, code, 16).ptr !=
                  line.data() + i + 3)
            return false;
          out += static_cast<char>(code);
          i += 2;
          break;
        default:
          return false;
      }
    }
    line = std::move(out);
    return true;
  }

  std::string_view name_, rest_;
  Rule rule_;
  std::optional<RuleStage> stage_;
  std::string problem_;
  int line_ = 0, problem_line_ = 0;
};

}  // namespace

std::string with_message(std::string text, const std::optional<ReferenceMessage>& message) {
  if (!message) return text;
  if (text.ends_with('.')) text.pop_back();
  return text + " (" + to_string(message->severity) + " " + std::to_string(message->number) + ").";
}

Result<Rule> parse_rule_page(std::string_view name, std::string_view text) {
  return PageReader(name, text).read();
}

}  // namespace deck::detail

namespace deck {

const RuleField* Rule::field(std::string_view field_name) const {
  const auto it = std::find_if(fields.begin(), fields.end(),
                               [&](const RuleField& f) { return f.name == field_name; });
  return it == fields.end() ? nullptr : &*it;
}

bool Rule::lists(std::string_view key, std::string_view item) const {
  const auto it = exceptions.find(key);
  return it != exceptions.end() &&
         std::find(it->second.begin(), it->second.end(), item) != it->second.end();
}

}  // namespace deck
