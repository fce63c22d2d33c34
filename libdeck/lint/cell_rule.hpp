// Rules whose condition is a predicate of the cells of an interface: data on the page of the rule.
//
//   when: flag(Igap) >= 2 and input(Gapmin) > input(Gapmax) and input(Gapmax) > 0
//   at: Gapmax
//   message: "{name}: Gapmax ({input Gapmax}) is below Gapmin ({input Gapmin})"
//   note: Gapmin
//   fix: {Igap: 1000, if: input(Igap) == 2, safe: false, title: write Igap 1000}
//   interfaces: all
//
// `when`, and `if` of a fix, have numbers, the functions of `Predicate::Op`, == != < <= > >=, not,
// and, or, brackets. `message` and the title of a fix have {name}, the interface, {at}, and
// {show F}, {text F}, {input F}, {value F} of its fields F.
// `at` may list fields: each of them for which `when` is true is a finding, and is called `at`.
// `interfaces: all`: also of types that the page does not list.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/text/result.hpp"

namespace deck::detail {

/// A condition on the cells of an interface.
struct Predicate {
  enum class Op : std::uint8_t {
    number,
    input,          ///< number on the card; 0: blank or absent
    value,          ///< effective value
    flag,           ///< effective value, 0 for 1000
    given,          ///< the card has a number that is not 0
    bounds,         ///< the same, and it is not 1e30 or its like
    written,        ///< number on the card as it is written, in the units of the block
    has,            ///< the interface has the field
    exists,         ///< the id in the cell is that of something
    from_default,   ///< the value comes from /DEFAULT/INTER
    type,           ///< 7 for /INTER/TYPE7
    version,        ///< input version of the block
    working_units,  ///< the block has the working units of the deck
    deck,           ///< deck(airbag): the deck has one; see `deck_facts`
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

struct CellRule {
  Predicate when;
  std::vector<std::string> at;     ///< fields of the findings
  std::string message;             ///< with placeholders
  std::vector<std::string> notes;  ///< fields that it also shows
  bool all_interfaces = false;
  struct Repair {
    std::string field, text, title;  ///< writes `text` into the cell
    bool safe = false;
    std::optional<Predicate> when;  ///< only then
  };
  std::optional<Repair> fix;

  /// From the keys of a page. Error: the key, what was expected, and the text from there on.
  static Result<CellRule> read(const std::map<std::string, std::string, std::less<>>& keys);
  /// Fields that the rule names.
  std::vector<std::string> fields() const;
};

/// Stands for the field of the finding.
inline constexpr std::string_view this_field = "at";

/// A piece of a message: text, or what a placeholder asks for of a field ("show", "Istf").
struct MessagePiece {
  std::string_view what, field;  ///< what empty: `field` is text
};
std::vector<MessagePiece> pieces_of(std::string_view message);

}  // namespace deck::detail
