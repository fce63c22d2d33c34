// Parser of predicates, messages and fixes on rule pages.
//
// Recursive descent over one line of text, by precedence: or, and, not, comparison, sum, product,
// leaf. Output: nodes in an array, operands before their operators, so that evaluation is one loop
// without recursion. Example: "flag(A) == 1 and given(B)". Cost: O(length). Errors name the
// expected text and the rest of the line.
#include "lint/cell_rule.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "text/shared/columns.hpp"
#include "text/shared/rule_page.hpp"

namespace deck::detail {
namespace {

using Op = Predicate::Op;

constexpr std::pair<std::string_view, Op> functions[] = {
    {"input", Op::input},   {"value", Op::value},     {"flag", Op::flag},
    {"given", Op::given},   {"bounds", Op::bounds},   {"has", Op::has},
    {"exists", Op::exists}, {"written", Op::written}, {"default", Op::from_default},
    {"column", Op::column}, {"law", Op::law},         {"deck", Op::deck}};
/// Words without a field.
constexpr std::pair<std::string_view, Op> words[] = {{"type", Op::type},
                                                     {"version", Op::version},
                                                     {"working_units", Op::working_units},
                                                     {"self_contact", Op::self_contact},
                                                     {"others", Op::others}};
constexpr std::pair<std::string_view, Op> comparisons[] = {
    {"==", Op::equal},         {"!=", Op::not_equal}, {"<=", Op::less_equal},
    {">=", Op::greater_equal}, {"<", Op::less},       {">", Op::greater}};

bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '%';
}

/// Recursive descent: either > both > negated > comparison > sum > product > leaf.
class Parser {
 public:
  explicit Parser(std::string_view text) : rest_(text) {}

  Result<Predicate> run() {
    either();
    if (skip(); problem_.empty() && !rest_.empty()) fail("'and', 'or' or the end");
    if (!problem_.empty()) return Error{Error::Code::config, problem_};
    return std::move(out_);
  }

 private:
  void fail(std::string_view expected) {
    if (problem_.empty())
      problem_ = "expected " + std::string(expected) + " at '" + std::string(rest_) + "'";
  }
  void skip() {
    while (rest_.starts_with(' ')) rest_.remove_prefix(1);
  }
  bool accept(std::string_view token) {
    skip();
    if (!rest_.starts_with(token)) return false;
    if (is_word(token.back()) && rest_.size() > token.size() && is_word(rest_[token.size()]))
      return false;
    rest_.remove_prefix(token.size());
    return true;
  }
  std::string word() {
    skip();
    const auto end = std::find_if_not(rest_.begin(), rest_.end(), is_word);
    std::string out(rest_.begin(), end);
    rest_.remove_prefix(out.size());
    return out;
  }
  std::size_t add(Predicate::Node node) {
    out_.nodes.push_back(std::move(node));
    return out_.nodes.size() - 1;
  }

  std::size_t either() {
    std::size_t left = both();
    while (accept("or")) left = add({Op::either, 0, {}, left, both()});
    return left;
  }
  std::size_t both() {
    std::size_t left = negated();
    while (accept("and")) left = add({Op::both, 0, {}, left, negated()});
    return left;
  }
  std::size_t negated() {
    if (++depth_ > deepest) fail("less nesting");
    const std::size_t node = !problem_.empty() ? 0
                             : accept("not")   ? add({Op::negated, 0, {}, negated(), 0})
                                               : compared();
    --depth_;
    return node;
  }
  std::size_t compared() {
    const std::size_t left = sum();
    for (const auto& [token, op] : comparisons)
      if (accept(token)) return add({op, 0, {}, left, sum()});
    return left;
  }
  std::size_t sum() { return chain("+", Op::plus, "-", Op::minus, &Parser::product); }
  std::size_t product() { return chain("*", Op::times, "/", Op::over, &Parser::leaf); }
  /// Operands of one precedence with either operator between them.
  std::size_t chain(std::string_view one, Op of_one, std::string_view other, Op of_other,
                    std::size_t (Parser::*operand)()) {
    std::size_t left = (this->*operand)();
    while (problem_.empty()) {
      const bool first = accept(one);
      if (!first && !accept(other)) break;
      left = add({first ? of_one : of_other, 0, {}, left, (this->*operand)()});
    }
    return left;
  }
  std::size_t leaf() {
    if (!problem_.empty()) return 0;
    if (accept("(")) {
      const std::size_t inner = either();
      if (!accept(")")) fail("')'");
      return inner;
    }
    skip();
    double number = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), number);
    if (error == std::errc()) {
      rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
      return add({Op::number, number, {}, 0, 0});
    }
    for (const auto& [name, op] : words)
      if (accept(name)) return add({op, 0, {}, 0, 0});
    for (const auto& [name, op] : functions)
      if (accept(name)) {
        if (!accept("(")) fail("'('");
        std::string field = word();
        if (field.empty()) fail("a name");
        if (op == Op::deck &&
            std::find(std::begin(deck_facts), std::end(deck_facts), field) == std::end(deck_facts))
          fail("a fact of the deck, not " + field);
        if (!accept(")")) fail("')'");
        return add({op, 0, std::move(field), 0, 0});
      }
    fail("a number, a function or '('");
    return 0;
  }

  static constexpr int deepest = 50;
  int depth_ = 0;
  std::string_view rest_;
  Predicate out_;
  std::string problem_;
};

/// Splits "Fheats, Fheatm".
std::vector<std::string> list_of_words(std::string_view text) {
  std::vector<std::string> out;
  for (const std::string_view word : parts_of(text, ',')) out.emplace_back(trim(word));
  return out;
}

/// Parses "{Istf: 1000, if: ..., safe: false, title: ...}"; nullopt: another form.
std::optional<CellRule::Repair> read_repair(std::string_view text) {
  if (!text.starts_with('{') || !text.ends_with('}')) return std::nullopt;
  text = text.substr(1, text.size() - 2);
  CellRule::Repair out;
  bool safe_given = false;
  while (!text.empty()) {
    const auto colon = text.find(':');
    if (colon == std::string_view::npos) return std::nullopt;
    const std::string_view key = trim(text.substr(0, colon));
    text.remove_prefix(colon + 1);
    // The title is the last key, because it can have commas.
    const auto end = key == "title" ? text.size() : std::min(text.find(','), text.size());
    const std::string_view value = trim(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (key == "title") {
      out.title = value;
    } else if (key == "safe") {
      if (value != "true" && value != "false") return std::nullopt;
      out.safe = value == "true";
      safe_given = true;
    } else if (key == "if") {
      auto when = Predicate::parse(value);
      if (!when) return std::nullopt;
      out.when = std::move(*when);
    } else {
      out.field = key;
      out.text = value == "blank" ? "" : value;
    }
  }
  if (out.field.empty() || out.title.empty() || !safe_given) return std::nullopt;
  return out;
}

}  // namespace

Result<Predicate> Predicate::parse(std::string_view text) { return Parser(text).run(); }

std::vector<MessagePiece> pieces_of(std::string_view message) {
  std::vector<MessagePiece> out;
  while (!message.empty()) {
    const auto open = std::min(message.find('{'), message.size());
    if (open > 0) out.push_back({{}, message.substr(0, open)});
    message.remove_prefix(open);
    if (message.empty()) break;
    const auto close = std::min(message.find('}'), message.size());
    const std::string_view inside = message.substr(1, close - 1);
    const auto blank = std::min(inside.find(' '), inside.size());
    out.push_back({inside.substr(0, blank), trim(inside.substr(blank))});
    message.remove_prefix(std::min(close + 1, message.size()));
  }
  return out;
}

namespace {

std::string text_of(const CellKeys& keys, std::string_view key) {
  const auto found = keys.find(key);
  return found == keys.end() ? std::string() : found->second;
}

std::string replaced(std::string text, std::string_view word, std::string_view by) {
  if (const auto at = text.find(word); at != text.npos) text.replace(at, word.size(), by);
  return text;
}

/// Adds the field names used by a condition.
void add_names(const Predicate& condition, std::vector<std::string>& out) {
  for (const Predicate::Node& n : condition.nodes)
    if (!n.name.empty() && n.op != Op::deck &&
        std::find(out.begin(), out.end(), n.name) == out.end())
      out.push_back(n.name);
}

/// Error in a message or in the title of a fix; empty: none.
std::string problem_of_text(std::string_view text) {
  if (std::count(text.begin(), text.end(), '{') != std::count(text.begin(), text.end(), '}'))
    return "expected a '}' for each '{' at '" + std::string(text.substr(text.find('{'))) + "'";
  constexpr std::array<std::string_view, 8> known = {"",     "name",  this_field, "others",
                                                     "show", "input", "value",    "text"};
  for (const MessagePiece& p : pieces_of(text)) {
    if (p.what == "=") {
      if (const auto parsed = Predicate::parse(p.field); !parsed) return parsed.error().message;
    } else if (std::find(known.begin(), known.end(), p.what) == known.end()) {
      return "expected {name}, {at}, {because}, {show F}, {text F}, {input F}, {value F} or {= E} "
             "at '" +
             std::string(text.substr(static_cast<std::size_t>(p.what.data() - text.data()))) + "'";
    }
  }
  return {};
}

Result<CellRule::Case> read_case(const CellKeys& keys) {
  const auto text = [&](std::string_view key) { return text_of(keys, key); };
  CellRule::Case out;
  if (keys.contains("if")) {
    auto when = Predicate::parse(text("if"));
    if (!when) return Error{Error::Code::config, "if: " + when.error().message};
    out.when = std::move(*when);
  }
  out.at = list_of_words(text("at"));
  out.message = replaced(text("message"), "{because}", text("because"));
  out.notes = list_of_words(text("note"));
  out.fix = read_repair(text("fix"));
  const std::string of = text("of"), per = text("per");
  out.all_interfaces = of == "all";
  out.interfaces = of != "frictions";
  out.frictions = of == "frictions" || of == "with frictions";
  out.per_card = per == "card";
  if (out.at.empty() || out.message.empty())
    return Error{Error::Code::config, "a rule of cells has 'when', 'at' and a message in quotes"};
  if (const std::string problem = problem_of_text(out.message); !problem.empty())
    return Error{Error::Code::config, "message: " + problem};
  if (const std::string problem = problem_of_text(out.fix ? out.fix->title : ""); !problem.empty())
    return Error{Error::Code::config, "fix: " + problem};
  if (!out.fix && keys.contains("fix"))
    return Error{Error::Code::config,
                 "fix: expected {FIELD: TEXT, if: CONDITION, safe: BOOL, title: WORDS}"};
  if (!of.empty() && !out.all_interfaces && !out.frictions)
    return Error{Error::Code::config, "of: expected 'all', 'frictions' or 'with frictions'"};
  if (!per.empty() && !out.per_card && per != "deck")
    return Error{Error::Code::config, "per: expected 'card' or 'deck'"};
  return out;
}

/// Cost of a condition: self_contact visits all nodes, other tests one cell.
std::size_t steps_of(const Predicate& condition) {
  constexpr std::size_t steps_of_sides = 1000;
  std::size_t out = 0;
  for (const Predicate::Node& n : condition.nodes)
    out += n.op == Op::self_contact ? steps_of_sides : 1;
  return out;
}

}  // namespace

Result<std::vector<Limit>> Limit::read(RuleId rule, const CellKeys& keys) {
  const auto text = [&](std::string_view key) { return text_of(keys, key); };
  const auto message = reference_message(text("message"));
  if (!message || message->severity == Severity::info)
    return Error{Error::Code::config, "message: expected 'error N' or 'warning N'"};
  std::vector<std::string> cells = list_of_words(text("at")),
                           beside = list_of_words(text("beside"));
  if (cells.empty()) cells.emplace_back();
  beside.resize(cells.size());
  std::vector<Limit> out;
  for (const std::string& keyword : list_of_words(text("keywords")))
    for (std::size_t i = 0; i < cells.size(); ++i) {
      Limit one{keyword,         cells[i],   {},       text("sum") == "true",
                text("not_a"),   rule,       *message, text("legal"),
                text("because"), text("fix")};
      if (const std::string when = replaced(text("if"), "beside", beside[i]); !when.empty()) {
        auto parsed = Predicate::parse(when);
        if (!parsed) return Error{Error::Code::config, "if: " + parsed.error().message};
        for (const Predicate::Node& n : parsed->nodes)
          if (n.op > Predicate::Op::input && n.op < Predicate::Op::plus &&
              n.op != Predicate::Op::version)
            return Error{Error::Code::config, "if: a limit has input(FIELD) and version alone"};
        one.when = std::move(*parsed);
      }
      out.push_back(std::move(one));
    }
  return out;
}

std::vector<std::string> Limit::fields() const {
  std::vector<std::string> out;
  if (when) add_names(*when, out);
  return out;
}

Result<CellRule> CellRule::read(const std::vector<CellKeys>& keys) {
  auto when = Predicate::parse(text_of(keys.front(), "when"));
  if (!when) return Error{Error::Code::config, "when: " + when.error().message};
  CellRule out{std::move(*when), {}, text_of(keys.front(), "per") == "deck"};
  for (std::size_t i = keys.size() > 1 ? 1 : 0; i < keys.size(); ++i) {
    CellKeys all = keys[i];
    all.insert(keys.front().begin(), keys.front().end());
    auto one = read_case(all);
    if (!one) return one.error();
    out.cases.push_back(std::move(*one));
  }
  constexpr std::size_t most_steps = 20000;
  std::size_t steps = 0;
  for (const Case& one : out.cases)
    steps += one.at.size() * (steps_of(out.when) + (one.when ? steps_of(*one.when) : 0));
  if (steps > most_steps)
    return Error{Error::Code::config, "when: takes " + std::to_string(steps) +
                                          " steps for an interface, expected at most " +
                                          std::to_string(most_steps)};
  return out;
}

std::vector<std::string> CellRule::fields() const {
  std::vector<std::string> out;
  add_names(when, out);
  const auto add_message = [&](std::string_view text) {
    for (const MessagePiece& p : pieces_of(text))
      if (p.what == "=")
        add_names(*Predicate::parse(p.field), out);
      else if (!p.field.empty() && !p.what.empty())
        out.emplace_back(p.field);
  };
  for (const Case& one : cases) {
    out.insert(out.end(), one.notes.begin(), one.notes.end());
    out.insert(out.end(), one.at.begin(), one.at.end());
    if (one.when) add_names(*one.when, out);
    add_message(one.message);
    if (!one.fix) continue;
    out.push_back(one.fix->field);
    add_message(one.fix->title);
    if (one.fix->when) add_names(*one.fix->when, out);
  }
  std::erase(out, this_field);
  return out;
}

}  // namespace deck::detail
