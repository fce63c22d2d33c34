// Rules that test only cells, as they are written on their pages (schemas/cells.md): conditions,
// findings, and the values of other blocks that the solver speaks of.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/rule_id.hpp"
#include "deck/text.hpp"

namespace deck::detail {

/// A condition on the cells of an interface.
struct Predicate {
  enum class Op : std::uint8_t {
    number,
    input,          ///< number on the card; 0: blank or absent
    value,          ///< effective value
    flag,           ///< effective value, 0 for 1000
    given,          ///< the card has a number that is not 0
    bounds,         ///< `given`, and the number is not 1e30 or a similar bound
    written,        ///< number on the card as it is written, in the units of the block
    has,            ///< the interface has the field
    exists,         ///< the id in the cell is that of something
    from_default,   ///< the value comes from /DEFAULT/INTER
    type,           ///< 7 for /INTER/TYPE7
    version,        ///< input version of the block
    working_units,  ///< the block has the working units of the deck
    deck,           ///< deck(airbag): the deck has one; see `deck_facts`
    column,         ///< first column of the cell; 0: the card has none
    law,            ///< Ifric of the /FRICTION whose id is in the cell; 0: there is none
    self_contact,   ///< the two sides have nodes in common, or it is not known
    others,         ///< further interfaces of a finding of the deck
    plus,
    minus,
    times,
    over,
    equal,
    not_equal,
    less,
    less_equal,
    greater,
    greater_equal,
    both,
    either,
    negated
  };
  struct Node {
    Op op = Op::number;
    double number = 0;
    std::string name;                 ///< of a field or a fact
    std::size_t left = 0, right = 0;  ///< positions of the operands
  };
  std::vector<Node> nodes;  ///< operands before what uses them; the last one is the whole

  /// Error: what was expected, and the text from there on.
  static Result<Predicate> parse(std::string_view text);

  /// Value of the whole; true is 1. `leaf(node)` gives the values of functions.
  template <class Leaf>
  double evaluate(const Leaf& leaf) const {
    return value_of(nodes.back(), leaf);
  }

 private:
  template <class Leaf>
  double value_of(const Node& n, const Leaf& leaf) const {
    const auto left = [&] { return value_of(nodes[n.left], leaf); };
    const auto right = [&] { return value_of(nodes[n.right], leaf); };
    switch (n.op) {
      case Op::number:
        return n.number;
      case Op::plus:
        return left() + right();
      case Op::minus:
        return left() - right();
      case Op::times:
        return left() * right();
      case Op::over:
        return left() / right();
      case Op::equal:
        return left() == right();
      case Op::not_equal:
        return left() != right();
      case Op::less:
        return left() < right();
      case Op::less_equal:
        return left() <= right();
      case Op::greater:
        return left() > right();
      case Op::greater_equal:
        return left() >= right();
      case Op::both:
        return left() != 0 && right() != 0;
      case Op::either:
        return left() != 0 || right() != 0;
      case Op::negated:
        return left() == 0;
      default:
        return leaf(n);
    }
  }
};

/// Facts of a deck that predicates may ask for.
inline constexpr std::string_view deck_facts[] = {
    "airbag", "ale", "sol2sph", "adaptive_mesh", "thermal_material", "sph"};

/// Keys of a page or a case, with their values.
using CellKeys = std::map<std::string, std::string, std::less<>>;

struct CellRule {
  struct Repair {
    std::string field, text, title;  ///< writes `text` into the cell
    bool safe = false;
    std::optional<Predicate> when;  ///< only then
  };
  struct Case {
    std::optional<Predicate> when;   ///< beside that of the rule
    std::vector<std::string> at;     ///< fields of the findings
    std::string message;             ///< with placeholders
    std::vector<std::string> notes;  ///< fields that it also shows
    bool interfaces = true, all_interfaces = false, frictions = false;  ///< what it looks at
    bool per_card = false;
    std::optional<Repair> fix;
  };
  Predicate when;
  std::vector<Case> cases;
  bool per_deck = false;

  /// From the keys of a page and those of its cases. Error: the key, what was expected, and the
  /// text from there on.
  static Result<CellRule> read(const std::vector<CellKeys>& keys);
  /// Fields that the rule names.
  std::vector<std::string> fields() const;
};

/// Values of one cell, while a condition is true. Without a cell the solver speaks of the keyword.
struct Limit {
  std::string keyword, field;
  std::optional<Predicate> when;
  bool sum = false;
  std::string not_a;
  RuleId rule = RuleId::none;  ///< that reports it
  ReferenceMessage message;
  std::string legal, says, fix;

  /// From a case with `keywords`: one for each keyword and cell. Error: what was expected.
  static Result<std::vector<Limit>> read(RuleId rule, const CellKeys& keys);
  /// Fields that the condition names, `at` for that of the value.
  std::vector<std::string> fields() const;
};

/// Stands for the field of the finding.
inline constexpr std::string_view this_field = "at";

/// A piece of a message: text, or what a placeholder asks for of a field ("show", "Istf").
struct MessagePiece {
  std::string_view what, field;  ///< what empty: `field` is text; "=": it is an expression
};
std::vector<MessagePiece> pieces_of(std::string_view message);

}  // namespace deck::detail
