// Examples of rules, expanded to decks. "@/INTER/TYPE7/1 Istf=7" is the card of that keyword with
// these fields, in the layout of the deck's version.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/keyword.hpp"
#include "deck/text.hpp"
#include "keyword/shared/card_forms.hpp"
#include "text/shared/rule_page.hpp"

namespace deck {

/// Notation, line by line:
///   @version N          input version of the deck (2022 if absent)
///   @bare               no model around the text, only /BEGIN and /END
///   @deck               the text is the whole main file
///   @file NAME          what follows is the content of another file of the deck
///   @gzip NAME          the same, and the file lies there packed
///   @limit NAME N       a reading limit for this example (used by tests only)
///   @/KEYWORD/1 A=1 B=2 the card of that keyword; interfaces get sides 1 and 2 if none are given
///   anything else       taken as it is
struct ExampleDeck {
  std::string main;                                        ///< text of the main file
  std::vector<std::pair<std::string, std::string>> files;  ///< further files: name, text
  std::vector<std::pair<std::string, int>> limits;
};

/// The example as a deck.
ExampleDeck example_deck(std::string_view example, const SchemaSet& schemas);
/// The example as shown: expanded cards without the model.
std::string example_text(std::string_view example, const SchemaSet& schemas);
/// Errors in examples of the team rules in use, one line each: place and problem.
std::vector<std::string> broken_examples(const std::vector<RulePage>& pages);
/// The card of the example with the finding, at most `width` columns (0: all), and a caret under
/// the cell. Empty: the finding needs geometry, or has no place.
std::string marked_example(const Rule& rule, const SchemaSet& schemas, std::size_t width);

}  // namespace deck
