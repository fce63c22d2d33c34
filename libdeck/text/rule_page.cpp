// Reads a page of schemas/rules: front matter, then a paragraph or an example for each heading.
#include "text/shared/rule_page.hpp"

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <optional>

#include "text/shared/columns.hpp"

namespace deck::detail {
namespace {

std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<RuleStage> stage_of(std::string_view text) {
  constexpr std::string_view stages[] = {"reading", "model", "check", "geometry", "gate", "linter"};
  const auto* const found = std::find(std::begin(stages), std::end(stages), text);
  if (found == std::end(stages)) return std::nullopt;
  return static_cast<RuleStage>(found - std::begin(stages));
}

/// Id of "DK203" or "X101"; none: not an id.
RuleId id_of(std::string_view text) {
  const bool team = text.starts_with('X');
  if ((!team && !text.starts_with("DK")) || text.size() != (team ? 4 : 5)) return RuleId::none;
  const int number = whole_number(text.substr(text.size() - 3)).value_or(0);
  return number > 0 ? static_cast<RuleId>(number + (team ? first_team_id : 0)) : RuleId::none;
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

/// True for a legal source of `known_from`.
bool is_source(std::string_view text) {
  constexpr std::string_view kinds[] = {"run ", "record ", "listing ", "specification ", "manual "};
  return std::any_of(std::begin(kinds), std::end(kinds),
                     [&](std::string_view kind) { return text.starts_with(kind); });
}

/// Legal form of the value of a key, for error messages.
std::string form_of(std::string_view key) {
  if (key == "id") return "X001 to X999, as in the name of the file";
  if (key == "name") return "words of small letters joined by '-'";
  if (key == "title" || key == "message") return "a text in quotes";
  if (key == "severity") return "error, warning or info";
  if (key == "types") return "numbers of interface types";
  if (key == "found_by") return "check, for the rule of a team";
  return "a key of a page that is not there yet, with a value that it can have";
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
  PageReader(std::string_view name, std::string_view text, PagePlaces* places)
      : name_(name), rest_(text), peek_(text.substr(0, text.find('\n'))), places_(places) {}

  Result<Rule> read() {
    read_front_matter();
    for (const Section& section : sections) {
      if ((section.optional || team()) && next_heading() != section.heading) continue;
      read_section(section);
    }
    skip_blank();
    if (!done())
      fail("expected no text behind the last section, not '" + std::string(next()) + "'");
    if (rule_.bad.empty() != rule_.good.empty()) fail("one example without the other");
    if (!problem_.empty()) return Error{Error::Code::config, problem_};
    return std::move(rule_);
  }

 private:
  /// Keeps the first problem with its place; parsing continues.
  void fail(const std::string& what, std::size_t column = 1) {
    if (problem_.empty())
      problem_ = std::string(name_) + ":" + std::to_string(std::max(line_, 1)) + ":" +
                 std::to_string(column) + ": " + what;
  }
  bool team() const { return is_team_rule(rule_.id); }

  bool done() const { return rest_.empty(); }
  std::string_view peek() const { return peek_; }
  std::string_view next() {
    const std::string_view line = peek_;
    rest_.remove_prefix(std::min(line.size() + 1, rest_.size()));
    peek_ = rest_.substr(0, rest_.find('\n'));
    ++line_;
    return line;
  }
  void skip_blank() {
    while (!done() && peek().empty()) next();
  }
  /// The name in "- **name.** text" on the next non-blank line; empty: none.
  std::string_view next_heading() {
    skip_blank();
    const std::string_view line = peek();
    if (!line.starts_with("- **")) return {};
    const auto end = line.find(".**");
    return end != line.npos ? line.substr(4, end - 4) : std::string_view();
  }

  void read_front_matter() {
    if (next() != "---") fail("expected '---', which a page starts with");
    while (!done() && peek() != "---" && problem_.empty()) read_line(next());
    if (next() != "---" || rule_.name.empty() || rule_.title.empty() || rule_.severities.empty() ||
        !(stage_ || team()) || (team() && rule_.cells.empty()))
      fail("expected '---' behind an id, a name, a title, a severity and " +
           std::string(team() ? "'when', 'at' and 'message'" : "found_by"));
  }

  /// Stores the position of a key. False: the key is repeated.
  bool add_place(std::size_t of, std::string_view key, std::size_t column) {
    const Position here{static_cast<std::uint64_t>(line_), column};
    return places_ == nullptr || places_->emplace(std::pair(of, key), here).second;
  }

  /// Parses "key: value" of the page or, after "- " or "  ", of a case.
  void read_line(std::string_view line) {
    if (line == "cases:") return;
    const bool first = line.starts_with("- "), of_case = first || line.starts_with("  ");
    if (first) rule_.cells.resize(std::max<std::size_t>(rule_.cells.size(), 1) + 1);
    const std::size_t start = of_case ? 2 : 0, colon = line.find(": ", start);
    if (colon == line.npos || line.size() > 1000)
      return fail("expected 'key: value' of at most 1000 characters, '---' after the last one");
    const std::string_view key = line.substr(start, colon - start);
    const std::string_view value = trim(line.substr(colon + 1));
    const std::size_t column = value.empty() ? line.size() : line.find(value, colon);
    const std::size_t of = of_case && !rule_.cells.empty() ? rule_.cells.size() - 1 : 0;
    if (!add_place(of, key, column + 1) && team() && key != "message")
      return fail("expected '" + std::string(key) + "' only once", start + 1);
    if (of_case ? read_cell_key(key, value) : read_key(key, value)) return;
    fail("'" + std::string(key) + "' is '" + std::string(value) + "', expected " + form_of(key),
         column + 1);
  }

  /// Calls f(item) for the items of a list. False: f returned false.
  template <class F>
  static bool for_each_item(std::string_view list, F&& f, char separator = ',') {
    while (true) {
      const auto end = std::min(list.find(separator), list.size());
      if (!f(trim(list.substr(0, end)))) return false;
      if (end == list.size()) return true;
      list.remove_prefix(end + 1);
    }
  }

  /// Adds the items of a list, converted by `read`. False: an item is illegal.
  template <class T, class Read>
  static bool read_items(std::string_view list, std::vector<T>& out, Read&& read) {
    return for_each_item(list, [&](std::string_view item) {
      const auto value = read(item);
      if (value) out.push_back(*value);
      return value.has_value();
    });
  }

  static bool is_one_of(std::string_view key, std::initializer_list<std::string_view> keys) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
  }

  /// Parses a key of a rule that is a predicate of cells, or of one of its cases.
  bool read_cell_key(std::string_view key, std::string_view value) {
    if (rule_.cells.empty() ||
        !is_one_of(key, {"when", "if", "at", "message", "because", "note", "fix", "of", "per",
                         "keywords", "beside", "legal", "sum", "not_a", "known_from"}) ||
        (team() && is_one_of(key, {"keywords", "beside", "legal", "sum", "not_a"})))
      return false;
    if (value.size() > 2 && value.starts_with('"') && value.ends_with('"'))
      value = value.substr(1, value.size() - 2);
    if (value.empty() || value.starts_with('"')) return false;
    return rule_.cells.back().emplace(key, value).second;
  }

  bool read_key(std::string_view key, std::string_view value) {
    if (key == "id") {
      const std::string_view name = name_.substr(name_.rfind('/') + 1);
      const std::string_view stem = name.substr(0, name.rfind(".md"));
      rule_.id = id_of(value);  // names of team pages are free
      return rule_.id != RuleId::none && (value == stem || (team() && id_of(stem) == RuleId::none));
    }
    if (rule_.id == RuleId::none || (team() && is_one_of(key, {"was", "flag", "except"})))
      return false;
    if (key == "name") {
      rule_.name = value;
      return is_kebab_case(value);
    }
    if (key == "title") {
      if (value.size() < 3 || value.front() != '"' || value.back() != '"') return false;
      rule_.title = value.substr(1, value.size() - 2);
      return rule_.title.find_first_of("\"\\") == std::string::npos;
    }
    if (key == "severity") return read_items(value, rule_.severities, severity_of);
    if (key == "found_by") {
      stage_ = stage_of(value);
      rule_.stage = stage_.value_or(RuleStage::check);
      return stage_.has_value() && (!team() || stage_ == RuleStage::check);
    }
    if (is_one_of(key, {"when", "at", "note", "fix", "of", "per"}) ||
        (key == "message" && value.starts_with('"'))) {
      if (rule_.cells.empty()) rule_.cells.emplace_back();
      return rule_.cells.size() == 1 && read_cell_key(key, value);  // cases come last
    }
    if (is_one_of(key, {"covers", "only_where", "zeros", "flag", "except"}))
      return for_each_item(value, [&](std::string_view item) {
        rule_.exceptions[std::string(key)].emplace_back(item);
        return !item.empty();
      });
    if (key == "message") return read_items(value, rule_.messages, reference_message);
    if (key == "known_from") {
      rule_.source = value;
      return for_each_item(value, is_source, ';');
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
      const RuleId was = id_of(value.substr(0, blank));
      return was != RuleId::none && was != rule_.id && read_fields(value.substr(blank), was);
    }
    return key == "types" && read_items(value, rule_.types, whole_number);
  }

  /// Parses "Gapmin, Gap" (fields of the rule); "VISF (info)" has its own severity.
  bool read_fields(std::string_view list, RuleId was) {
    return for_each_item(list, [&](std::string_view item) {
      const auto bracket = std::min(item.find('('), item.size());
      RuleField field{std::string(trim(item.substr(0, bracket))), was};
      if (bracket < item.size()) {
        field.severity = severity_of(item.substr(bracket + 1, item.size() - bracket - 2));
        if (!field.severity || item.back() != ')') return false;
      }
      if (field.name.empty() || rule_.field(field.name) != nullptr) return false;
      rule_.fields.push_back(std::move(field));
      return true;
    });
  }

  /// Splits "| a
  ///
  /// b |" into cells.
  static std::vector<std::string_view> cells_of(std::string_view line) {
    auto out = parts_of(line.substr(1), '|');
    for (std::string_view& cell : out) cell = trim(cell);
    return out;
  }

  /// Parses a table of field overrides: names, then columns "Solver", "Fix" and one with another
  /// title, the note.
  void read_table() {
    const auto head = cells_of(next());
    if (!next().starts_with("|--")) fail("a table has a line |---| below its head");
    while (peek().starts_with('|')) {
      const auto cells = cells_of(next());
      bool known = cells.size() == head.size() && !cells.empty();
      known = known && for_each_item(cells.front(), [&](std::string_view name) {
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
    if (!expected)
      return fail("expected the section '- **" + std::string(section.heading) + ".**'");
    add_place(0, section.heading, 1);
    const std::string_view rest =
        trim(first.substr(std::min(first.size(), section.heading.size() + 7)));
    std::string& text = rule_.*section.text;
    if (section.example) {
      read_example(text, rest);
    } else {
      for (text = rest; !done() && next_heading().empty();)
        if (peek().starts_with('|'))
          read_table();
        else
          (text += text.empty() ? "" : " ") += next();
    }
    if (text.empty()) fail("the section '**" + std::string(section.heading) + ".**' is empty");
  }

  /// Parses an example: one line in back quotes, or lines between fences.
  void read_example(std::string& text, std::string_view line) {
    if (line.size() > 2 && line.front() == '`' && line.back() == '`') {
      text = std::string(line.substr(1, line.size() - 2)) + "\n";
      return;
    }
    const std::string_view fence = line.empty() ? next() : line;
    if (fence != "```" && fence != "```escaped")
      return fail(
          "an example is one line between back quotes, or stands between lines ``` "
          "(or ```escaped and ```)");
    while (!done() && peek() != "```") {
      std::string row = std::string(next()) + "\n";
      if (fence != "```" && !unescape(row))
        fail("\\r, \\t, \\xHH, \\\\ and \\ at the end of a line");
      text += row;
    }
    if (done()) fail("an example does not end: ``` is missing");
    next();
  }

  /// Replaces \r, \t, \xHH and \\. A backslash at the end joins the next line.
  static bool unescape(std::string& line) {
    constexpr std::string_view marks = "rt\\", bytes = "\r\t\\";
    std::string out;
    for (std::size_t i = 0; i < line.size(); ++i) {
      int code = 0;
      if (line[i] != '\\') {
        out += line[i];
      } else if (++i == line.size()) {
        return false;
      } else if (const auto mark = marks.find(line[i]); mark != marks.npos) {
        out += bytes[mark];
      } else if (const char* const end = line.data() + std::min(i + 3, line.size());
                 line[i] == 'x' && i + 2 < line.size() &&
                 std::from_chars(end - 2, end, code, 16).ptr == end) {
        out += static_cast<char>(code);
        i += 2;
      } else if (line[i] != '\n') {
        return false;
      }
    }
    line = std::move(out);
    return true;
  }

  std::string_view name_, rest_, peek_;
  PagePlaces* places_;  // none: nobody asks for them
  Rule rule_;
  std::optional<RuleStage> stage_;
  std::string problem_;
  int line_ = 0;
};

}  // namespace

std::string with_message(std::string text, const std::optional<ReferenceMessage>& message) {
  if (!message) return text;
  if (text.ends_with('.')) text.pop_back();
  return text + " (" + to_string(message->severity) + " " + std::to_string(message->number) + ").";
}

std::optional<ReferenceMessage> reference_message(std::string_view text) {
  const auto blank = std::min(text.find(' '), text.size());
  const auto severity = severity_of(text.substr(0, blank));
  const auto number = whole_number(trim(text.substr(blank)));
  if (!severity || !number) return std::nullopt;
  return ReferenceMessage{*number, *severity};
}

Result<Rule> parse_rule_page(std::string_view name, std::string_view text, PagePlaces* places) {
  return PageReader(name, text, places).read();
}

}  // namespace deck::detail

namespace deck {

std::optional<Severity> severity_of(std::string_view text) {
  for (const Severity s : {Severity::error, Severity::warning, Severity::info})
    if (text == to_string(s)) return s;
  return std::nullopt;
}

std::string RulePage::problem(const std::string& key, const std::string& what,
                              std::size_t of) const {
  auto place = places.find({of, key});
  if (place == places.end()) place = places.find({0, key});
  const Position p = place == places.end() ? Position{1, 1} : place->second;
  return path + ":" + std::to_string(p.line) + ":" + std::to_string(p.column) + ": " + what;
}

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
