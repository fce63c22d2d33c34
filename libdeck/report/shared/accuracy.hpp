// Reports of `deck accuracy` as text, JSON and page.
#pragma once
#include <string>
#include <vector>

#include "accuracy/shared/choice.hpp"
#include "deck/keyword.hpp"

namespace deck {

// Conditions of the measurement, for footers.
struct AccuracyContext {
  std::string path;            // of the deck, as given; empty: hard cases only
  const Deck* deck = nullptr;  // nullptr: hard cases only
  std::string processor, command;
  DeckPicture picture = {};
  AnswerDigest digest = answer_digest();
};
// In the order of measure_hard_cases().
using AccuracyChoices = std::vector<AccuracyChoice>;

// Compiler of the library with version and arithmetic options.
std::string accuracy_compiler();

// Lines have at most `width` columns; 0: any.
std::string accuracy_text(const AccuracyChoices& choices, const AccuracyContext& context,
                          bool color = false, std::size_t width = 0);
std::string accuracy_json(const AccuracyChoices& choices, const AccuracyContext& context);
// One page without external references: benefit of the extra time, the accuracies with their wrong
// pairs in a picture of the deck, hard cases by family with the worst pair on click, a hard case in
// motion. Contains the JSON document.
std::string accuracy_html(const AccuracyChoices& choices, const AccuracyContext& context);

}  // namespace deck
