// /PARAMETER blocks and their expressions. Evaluation starts after all files are read, so a
// definition may follow its use, as in the open reader.
#include <algorithm>
#include <cmath>
#include <set>

#include "deck/text.hpp"
#include "keyword/shared/decode_parts.hpp"
#include "keyword/shared/line_check.hpp"
#include "keyword/shared/reader.hpp"
#include "text/shared/number_scan.hpp"

namespace deck::detail {
namespace {

// Independent of the locale.
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Recursive-descent parser for + - * / ^ ** ( ), numbers, &names and functions. Steps and depth
/// (including references between parameters) are limited for hostile decks.
class Expression {
 public:
  /// Returns the value of a parameter, or writes the reason of a failure.
  using Lookup = std::optional<double> (*)(void*, std::string_view name, int depth, std::string&);
  Expression(std::string_view text, int steps, Lookup lookup, void* context)
      : text_(text), steps_(steps), lookup_(lookup), context_(context) {}

  std::optional<double> evaluate(int depth) {
    const auto value = sum(depth);
    blanks();
    if (!value || at_ != text_.size()) return fail("unexpected text at position ");
    return std::isfinite(*value) ? value : fail("the value is not finite; position ");
  }
  const std::string& error() const { return error_; }

 private:
  static constexpr int max_depth = 300;

  void blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  }
  bool eat(std::string_view token) {
    blanks();
    if (!text_.substr(at_).starts_with(token)) return false;
    at_ += token.size();
    return true;
  }
  std::optional<double> fail(const char* why) {
    if (error_.empty()) error_ = why + std::to_string(at_ + 1);
    return std::nullopt;
  }
  bool spent(int depth) { return depth > max_depth || --steps_ < 0; }

  std::optional<double> sum(int depth) {
    if (spent(depth)) return fail("too deep or too long at position ");
    auto left = product(depth);
    while (left && !spent(depth)) {
      const bool plus = eat("+");
      if (!plus && !eat("-")) break;
      const auto right = product(depth);
      if (!right) return right;
      *left += plus ? *right : -*right;
    }
    return left;
  }
  std::optional<double> product(int depth) {
    auto left = power(depth);
    while (left && !spent(depth)) {
      blanks();
      const bool times = !text_.substr(at_).starts_with("**") && eat("*");
      if (!times && !eat("/")) break;
      const auto right = power(depth);
      if (!right) return right;
      if (!times && *right == 0) return fail("division by zero before position ");
      *left = times ? *left * *right : *left / *right;
    }
    return left;
  }
  std::optional<double> power(int depth) {
    if (spent(depth)) return fail("too deep or too long at position ");
    if (eat("-")) {
      const auto v = power(depth + 1);
      return v ? std::optional(-*v) : v;
    }
    if (eat("+")) return power(depth + 1);
    const auto base = primary(depth);
    if (!base || !(eat("**") || eat("^"))) return base;
    const auto exponent = power(depth + 1);
    return exponent ? std::optional(std::pow(*base, *exponent)) : exponent;
  }
  std::optional<double> primary(int depth) {
    blanks();
    if (eat("(")) {
      const auto v = sum(depth + 1);
      return v && !eat(")") ? fail("expected ')' at position ") : v;
    }
    if (at_ < text_.size() && (text_[at_] == '&' || is_letter(text_[at_]))) return name(depth);
    std::size_t end = at_;
    while (end < text_.size() && (is_digit(text_[end]) || text_[end] == '.')) ++end;
    constexpr std::string_view marks = "eEdD";
    if (end < text_.size() && end > at_ && marks.find(text_[end]) != std::string_view::npos) {
      std::size_t e = end + 1;
      if (e < text_.size() && (text_[e] == '+' || text_[e] == '-')) ++e;
      if (e < text_.size() && is_digit(text_[e])) {
        while (e < text_.size() && is_digit(text_[e])) ++e;
        end = e;
      }
    }
    const RealCell number = read_real(text_.substr(at_, end - at_));
    if (number.status != NumberStatus::ok) return fail("expected a number at position ");
    at_ = end;
    return number.value;
  }
  /// "&name", "name" or "function(".
  std::optional<double> name(int depth) {
    const bool parameter = text_[at_] == '&';
    if (parameter) ++at_;
    const std::size_t begin = at_;
    while (at_ < text_.size() &&
           (is_letter(text_[at_]) || is_digit(text_[at_]) || text_[at_] == '_'))
      ++at_;
    const std::string_view word = text_.substr(begin, at_ - begin);
    if (!parameter && eat("(")) return function(word, depth);
    std::string why;
    const auto v = lookup_(context_, word, depth + 1, why);
    if (!v && error_.empty()) error_ = why;
    return v;
  }
  std::optional<double> function(std::string_view name, int depth) {
    const auto x = sum(depth + 1);
    if (!x) return x;
    if (!eat(")")) return fail("expected ')' at position ");
    if (name == "sqrt") return std::sqrt(*x);
    if (name == "exp") return std::exp(*x);
    if (name == "log") return std::log(*x);
    if (name == "log10") return std::log10(*x);
    if (name == "sin") return std::sin(*x);
    if (name == "cos") return std::cos(*x);
    if (name == "tan") return std::tan(*x);
    if (name == "abs") return std::fabs(*x);
    if (name == "int") return std::trunc(*x);
    return fail("unknown function before position ");
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int steps_;
  Lookup lookup_;
  void* context_;
  std::string error_;
};

struct Context {
  Deck* deck;
  const Limits* limits;
  std::uint32_t file;
  std::set<const Parameter*>* open;  // parameters being evaluated, to find cycles
};

bool evaluate(Deck& deck, const Limits& limits, Parameter& p, std::set<const Parameter*>& open,
              int depth, std::string& why);

std::optional<double> lookup(void* context, std::string_view name, int depth, std::string& why) {
  auto& c = *static_cast<Context*>(context);
  auto* p = const_cast<Parameter*>(c.deck->find_parameter(name, c.file));
  const std::string subject = "parameter '" + std::string(name.substr(0, 40)) + "' ";
  if (p == nullptr || p->type == Parameter::Type::text) {
    why = subject + (p == nullptr ? "is not defined here" : "is a text");
    return std::nullopt;
  }
  if (!p->valid && !evaluate(*c.deck, *c.limits, *p, *c.open, depth, why)) {
    // Report the innermost cause.
    if (!why.starts_with("parameter '")) why = subject + why;
    return std::nullopt;
  }
  return p->type == Parameter::Type::integer ? static_cast<double>(p->integer) : p->real;
}

bool evaluate(Deck& deck, const Limits& limits, Parameter& p, std::set<const Parameter*>& open,
              int depth, std::string& why) {
  const auto fail = [&](std::string_view reason) {
    why = reason;
    return false;
  };
  if (p.expression.empty()) return fail("has no readable value");
  if (!open.insert(&p).second) return fail("refers to itself");
  Context context{&deck, &limits, p.file, &open};
  Expression expression(p.expression, limits.expression_steps, lookup, &context);
  const auto value = expression.evaluate(depth);
  open.erase(&p);
  if (!value) return fail(expression.error());
  p.real = *value;
  if (p.type == Parameter::Type::integer) {
    if (std::fabs(*value) > 9e15) return fail("does not fit an integer");
    p.integer = std::llround(*value);
  }
  p.valid = true;
  return true;
}

void report_parameter(Deck& deck, Span span, std::string message) {
  detail::report(deck, RuleId::DK019, span, std::move(message));
}

/// Reads the parameter of a block without evaluation; nullopt: reported.
std::optional<std::pair<std::string, Parameter>> read_definition(Deck& deck, const Block& b) {
  // /PARAMETER/GLOBAL|LOCAL/kind/id
  const std::string_view rest = b.header.substr(11);
  const auto slash = rest.find('/');
  const std::string_view kind =
      slash == std::string_view::npos ? std::string_view() : rest.substr(slash + 1);
  const bool text = kind.starts_with("TEXT");
  const bool expression = kind.starts_with("REAL_EXPR") || kind.starts_with("INT_EXPR");
  const bool integer = kind.starts_with("INT");
  Parameter p;
  p.local = rest.starts_with("LOCAL");
  p.type = text      ? Parameter::Type::text
           : integer ? Parameter::Type::integer
                     : Parameter::Type::real;
  LineCursor cursor(deck.sources, b);
  if (!text) cursor.next();  // title
  const Line line = cursor.next();
  if (!line.valid()) {
    report_parameter(deck, b.header_span, "/PARAMETER without its data line");
    return std::nullopt;
  }
  p.file = line.file;
  p.span = line.whole();
  // In free format: name, then value.
  const bool free_format = is_free(line);
  const FreeCells free = free_format ? split_free(line) : FreeCells();
  const auto cell = [&](std::size_t i, int first, int last) {
    if (!free_format) return columns(line.text, first, last);
    return i < free.size() ? free[i].first : std::string_view();
  };
  std::string name(trim(cell(0, 1, 10)));
  if (name.empty()) {
    report_parameter(deck, p.span, "/PARAMETER without a name in columns 1-10");
    return std::nullopt;
  }
  std::string partly_read;  // the leading number of an unreadable value
  if (text) {
    p.text = std::string(cursor.next().text.substr(0, 100));
    p.valid = true;
  } else if (expression) {
    p.expression = std::string(trim(columns(line.text, 11, 100)));
    if (free_format && free.size() > 1) {
      const auto behind = static_cast<std::size_t>(free[1].second.offset - line.offset);
      p.expression = std::string(trim(line.text.substr(behind, line_columns - behind)));
    }
  } else if (integer) {
    const IntegerCell number = read_integer(cell(1, 11, 20));
    p.integer = number.value;
    p.real = static_cast<double>(number.value);
    p.valid = number.status == NumberStatus::ok;
    if (number.status == NumberStatus::trailing_text) partly_read = std::to_string(number.value);
  } else {
    const RealCell number = read_real(cell(1, 11, 30));
    p.real = number.value;
    p.valid = number.status == NumberStatus::ok || number.status == NumberStatus::implicit_exponent;
    if (number.status == NumberStatus::trailing_text)
      if (const auto shown = format_real(number.value, 24)) partly_read = shown->text;
  }
  if (!partly_read.empty()) {
    report_parameter(deck, p.span,
                     "parameter '" + name + "' holds more than a number in '" +
                         std::string(line.text.substr(0, 100)) + "'; it is read as " + partly_read);
    p.valid = true;
  }
  if (!p.valid && p.expression.empty())
    report_parameter(deck, p.span,
                     "parameter '" + name + "' has no readable value in '" +
                         std::string(line.text.substr(0, 100)) + "'");
  return std::pair{std::move(name), std::move(p)};
}

}  // namespace

std::int64_t as_integer(const Parameter& p) {
  if (p.type == Parameter::Type::integer) return p.integer;
  constexpr double most = 9e18;
  return static_cast<std::int64_t>(std::clamp(p.real, -most, most));
}

std::int64_t read_offset(const Deck& deck, const Span& cell) {
  std::string_view text = trim(deck.sources.text(cell));
  const bool minus = text.starts_with("-&");
  if (!minus && !text.starts_with('&')) return read_integer(text).value;
  const Parameter* p = deck.find_parameter(text.substr(minus ? 2 : 1), cell.file);
  if (p == nullptr || !p->valid || p->type == Parameter::Type::text) return 0;
  return minus ? -as_integer(*p) : as_integer(*p);
}

void read_parameters(Deck& deck, const Limits& limits) {
  std::vector<Parameter*> pending;
  // One entry per name and scope, so that a million equal names do not slow down look-ups.
  std::set<std::pair<std::string, std::uint32_t>> seen;
  for (const Block& b : deck.blocks) {
    if (!b.header.starts_with("/PARAMETER/")) continue;
    auto definition = read_definition(deck, b);
    if (!definition) continue;
    auto& [name, p] = *definition;
    if (!seen.emplace(name, p.local ? p.file : Span::no_file).second) {
      detail::report(deck, RuleId::DK056, p.span,
                     "parameter '" + name + "' is defined twice in the same scope");
      continue;
    }
    Parameter& kept = deck.parameters.emplace(std::move(name), std::move(p))->second;
    if (!kept.expression.empty()) pending.push_back(&kept);
  }
  for (Parameter* p : pending) {
    std::set<const Parameter*> open;
    std::string why;
    if (!p->valid && !evaluate(deck, limits, *p, open, 0, why))
      report_parameter(deck, p->span, "expression '" + p->expression + "': " + why);
  }
}

}  // namespace deck::detail
