// /PARAMETER blocks and their expressions. All files are read before anything is evaluated, so a
// definition may follow its use, as in the open reader.
#include <cmath>
#include <set>

#include "deck/text/number.hpp"
#include "keyword/reader.hpp"

namespace deck::detail {
namespace {

/// Recursive-descent evaluation of + - * / ^ ** ( ) numbers, &names and a few functions, with a
/// bound on steps so that a hostile deck cannot keep us busy.
class Expression {
 public:
  using Lookup = std::optional<double> (*)(void*, std::string_view);
  Expression(std::string_view text, int steps, Lookup lookup, void* context)
      : text_(text), steps_(steps), lookup_(lookup), context_(context) {}

  std::optional<double> evaluate() {
    const auto value = sum(0);
    blanks();
    if (!value || at_ != text_.size()) return fail("unexpected text at position ");
    return std::isfinite(*value) ? value : fail("the value is not finite; position ");
  }
  const std::string& error() const { return error_; }

 private:
  static constexpr int max_depth = 60;

  void blanks() {
    while (at_ < text_.size() && static_cast<unsigned char>(text_[at_]) <= ' ') ++at_;
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

  std::optional<double> sum(int depth) {
    if (depth > max_depth || --steps_ < 0) return fail("expression too deep or too long at ");
    auto left = product(depth);
    while (left) {
      if (eat("+")) {
        const auto right = product(depth);
        if (!right) return right;
        *left += *right;
      } else if (eat("-")) {
        const auto right = product(depth);
        if (!right) return right;
        *left -= *right;
      } else {
        break;
      }
    }
    return left;
  }
  std::optional<double> product(int depth) {
    auto left = power(depth);
    while (left && --steps_ >= 0) {
      blanks();
      if (!text_.substr(at_).starts_with("**") && eat("*")) {
        const auto right = power(depth);
        if (!right) return right;
        *left *= *right;
      } else if (eat("/")) {
        const auto right = power(depth);
        if (!right) return right;
        if (*right == 0) return fail("division by zero before position ");
        *left /= *right;
      } else {
        break;
      }
    }
    return left;
  }
  std::optional<double> power(int depth) {
    if (depth > max_depth || --steps_ < 0) return fail("expression too deep or too long at ");
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
    if (at_ < text_.size() && (text_[at_] == '&' || std::isalpha(
                                   static_cast<unsigned char>(text_[at_])))) {
      const bool parameter = text_[at_] == '&';
      const std::size_t begin = at_ + (parameter ? 1 : 0);
      at_ = begin;
      while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) ||
                                    text_[at_] == '_'))
        ++at_;
      const std::string_view name = text_.substr(begin, at_ - begin);
      if (!parameter && eat("(")) return function(name, depth);
      const auto v = lookup_(context_, name);
      return v ? v : fail("undefined parameter before position ");
    }
    std::size_t end = at_;
    while (end < text_.size() && (std::isdigit(static_cast<unsigned char>(text_[end])) ||
                                  text_[end] == '.'))
      ++end;
    if (end < text_.size() && end > at_ && std::string_view("eEdD").find(text_[end]) != std::string_view::npos) {
      std::size_t e = end + 1;
      if (e < text_.size() && (text_[e] == '+' || text_[e] == '-')) ++e;
      if (e < text_.size() && std::isdigit(static_cast<unsigned char>(text_[e]))) {
        while (e < text_.size() && std::isdigit(static_cast<unsigned char>(text_[e]))) ++e;
        end = e;
      }
    }
    const RealCell number = read_real(text_.substr(at_, end - at_));
    if (number.status != NumberStatus::ok) return fail("expected a number at position ");
    at_ = end;
    return number.value;
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
              std::string& why);

std::optional<double> lookup(void* context, std::string_view name) {
  auto& c = *static_cast<Context*>(context);
  auto* p = const_cast<Parameter*>(c.deck->find_parameter(name, c.file));
  if (p == nullptr || p->type == Parameter::Type::text) return std::nullopt;
  std::string why;
  if (!p->valid && !evaluate(*c.deck, *c.limits, *p, *c.open, why)) return std::nullopt;
  return p->type == Parameter::Type::integer ? static_cast<double>(p->integer) : p->real;
}

bool evaluate(Deck& deck, const Limits& limits, Parameter& p, std::set<const Parameter*>& open,
              std::string& why) {
  if (p.expression.empty()) return false;
  if (open.size() > 100 || !open.insert(&p).second) {
    why = "the definition refers to itself";
    return false;
  }
  Context context{&deck, &limits, p.file, &open};
  Expression expression(p.expression, limits.expression_steps, lookup, &context);
  const auto value = expression.evaluate();
  open.erase(&p);
  if (!value) {
    why = expression.error();
    return false;
  }
  p.real = *value;
  if (p.type == Parameter::Type::integer) {
    if (std::fabs(*value) > 9e15) {
      why = "the value does not fit an integer";
      return false;
    }
    p.integer = std::llround(*value);
  }
  p.valid = true;
  return true;
}

void report(Deck& deck, Span span, std::string message) {
  if (!deck.diagnostics.wants("DK019")) return;
  Diagnostic d;
  d.rule = "DK019";
  d.span = span;
  d.message = std::move(message);
  d.reference_behaviour = "it reads 0 wherever the parameter is used";
  d.help = "write the name in columns 1-10 and the value (or expression) from column 11 on";
  deck.diagnostics.add(std::move(d));
}

}  // namespace

void read_parameters(Deck& deck, const Limits& limits) {
  std::vector<Parameter*> pending;
  for (const Block& b : deck.blocks) {
    if (!b.header.starts_with("/PARAMETER/")) continue;
    const std::string_view rest = b.header.substr(11);
    Parameter p;
    p.local = rest.starts_with("LOCAL");
    const auto slash = rest.find('/');
    const std::string_view kind =
        slash == std::string_view::npos ? std::string_view() : rest.substr(slash + 1);
    const bool text = kind.starts_with("TEXT");
    const bool expression = kind.starts_with("REAL_EXPR") || kind.starts_with("INT_EXPR");
    const bool integer = kind.starts_with("INT");
    p.type = text ? Parameter::Type::text
                  : integer ? Parameter::Type::integer : Parameter::Type::real;
    LineCursor cursor(deck.sources, b);
    if (!text) cursor.next();  // title
    const Line line = cursor.next();
    if (!line.valid()) {
      report(deck, b.header_span, "/PARAMETER without its data line");
      continue;
    }
    p.file = line.file;
    p.span = line.whole();
    const std::string name(trim(columns(line.text, 1, 10)));
    if (name.empty()) {
      report(deck, p.span, "/PARAMETER without a name in columns 1-10");
      continue;
    }
    if (text) {
      p.text = std::string(cursor.next().text);
      p.valid = true;
    } else if (expression) {
      p.expression = std::string(trim(columns(line.text, 11, 100)));
    } else if (integer) {
      const IntegerCell cell = read_integer(columns(line.text, 11, 20));
      p.integer = cell.value;
      p.real = static_cast<double>(cell.value);
      p.valid = cell.status == NumberStatus::ok;
    } else {
      const RealCell cell = read_real(columns(line.text, 11, 30));
      p.real = cell.value;
      p.valid = cell.status == NumberStatus::ok || cell.status == NumberStatus::implicit_exponent;
    }
    const bool bad = !p.valid && p.expression.empty();
    if (bad)
      report(deck, p.span, "parameter '" + name + "' has no readable value in '" +
                               std::string(line.text) + "'");
    Parameter& kept = deck.parameters.emplace(name, std::move(p))->second;
    if (!kept.expression.empty()) pending.push_back(&kept);
  }
  for (Parameter* p : pending) {
    std::set<const Parameter*> open;
    std::string why;
    if (!p->valid && !evaluate(deck, limits, *p, open, why))
      report(deck, p->span, "expression '" + p->expression + "' cannot be evaluated: " + why);
  }
}

}  // namespace deck::detail
