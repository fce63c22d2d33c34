// Reports of `deck accuracy`: text, JSON and a page of what each word of --accuracy costs. Pure
// functions from a measurement to bytes.
#pragma once
#include <string>
#include <vector>

#include "accuracy/shared/choice.hpp"
#include "deck/keyword.hpp"

namespace deck {

// Where and how the measurement was made; goes into every footer.
struct AccuracyContext {
  std::string path;            // of the deck, as given; empty: hard cases alone
  const Deck* deck = nullptr;  // nullptr: hard cases alone
  std::string processor, command;
  DeckPicture picture = {};
  AnswerDigest digest = answer_digest();
};
// As measure_hard_cases() gives them.
using AccuracyChoices = std::vector<AccuracyChoice>;

// Name and version of the compiler that built the library, with the build's rules of arithmetic.
std::string accuracy_compiler();

// Tables fit lines of `width` columns; 0: of any length.
std::string accuracy_text(const AccuracyChoices& choices, const AccuracyContext& context,
                          bool color = false, std::size_t width = 0);
std::string accuracy_json(const AccuracyChoices& choices, const AccuracyContext& context);
// One page without outside references: what the price buys, the words of --accuracy with the wrong
// pairs of the deck in its picture, hard cases by family with the worst pair on click, a hard case
// in motion. The JSON document stands in it.
std::string accuracy_html(const AccuracyChoices& choices, const AccuracyContext& context);

}  // namespace deck
