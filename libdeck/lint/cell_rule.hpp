// Rules whose page has the test itself (schemas/cells.md): conditions on cells, findings, and
// values of other blocks for which the solver has a message.
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
    given,          ///< the card has a non-zero number
    bounds,         ///< `given`, and the number is not a limit such as 1e30
    written,        ///< number as written on the card, in the units of the block
    has,            ///< the interface has the field
    exists,         ///< the id in the cell exists
    from_default,   ///< the value is from /DEFAULT/INTER
    type,           ///< 7 for /INTER/TYPE7
    version,        ///< input version of the block
    working_units,  ///< the block has the working units of the deck
    deck,           ///< deck(airbag): the deck has one; see `deck_facts`
    column,         ///< first column of the cell; 0: not on the card
    law,            ///< Ifric of the /FRICTION with this id; 0: none
    self_contact,   ///< the two sides share nodes, or it is unknown
    others,         ///< number of further interfaces with this finding
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
  std::vector<Node> nodes;  ///< operands before their operators; the last one is the root

  /// Error: the expected text, and the rest of the line.
  static Result<Predicate> parse(std::string_view text);

  /// Value of the root; true is 1. `leaf(node)` returns the values of functions.
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

/// Facts of a deck for predicates.
inline constexpr std::string_view deck_facts[] = {
    "airbag", "ale", "sol2sph", "adaptive_mesh", "thermal_material", "sph"};

/// Keys of a page or case, with values.
using CellKeys = std::map<std::string, std::string, std::less<>>;

struct CellRule {
  struct Repair {
    std::string field, text, title;  ///< the fix writes `text` into `field`
    bool safe = false;
    std::optional<Predicate> when;  ///< condition of the fix
  };
  struct Case {
    std::optional<Predicate> when;   ///< in addition to the condition of the rule
    std::vector<std::string> at;     ///< fields of the findings
    std::string message;             ///< with placeholders
    std::vector<std::string> notes;  ///< fields shown in addition
    bool interfaces = true, all_interfaces = false, frictions = false;  ///< blocks to test
    bool per_card = false;
    std::optional<Repair> fix;
  };
  Predicate when;
  std::vector<Case> cases;
  bool per_deck = false;

  /// Reads the keys of a page and of its cases. Error: the key, the expected text, and the rest of
  /// the line.
  static Result<CellRule> read(const std::vector<CellKeys>& keys);
  /// Names of the fields used.
  std::vector<std::string> fields() const;
};

/// Forbidden values of one cell under a condition. Without a cell: of the keyword itself.
struct Limit {
  std::string keyword, field;
  std::optional<Predicate> when;
  bool sum = false;
  std::string not_a;
  RuleId rule = RuleId::none;  ///< rule that reports it
  ReferenceMessage message;
  std::string legal, says, fix;

  /// Reads a case with `keywords`: one Limit per keyword and cell. Error: the expected text.
  static Result<std::vector<Limit>> read(RuleId rule, const CellKeys& keys);
  /// Fields in the condition; `at` for the tested field.
  std::vector<std::string> fields() const;
};

/// Placeholder for the field of the finding.
inline constexpr std::string_view this_field = "at";

/// A piece of a message: text, or a placeholder for a field ("show", "Istf").
struct MessagePiece {
  std::string_view what, field;  ///< `what` empty: `field` is text; "=": it is an expression
};
std::vector<MessagePiece> pieces_of(std::string_view message);

}  // namespace deck::detail
