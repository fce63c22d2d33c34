// Reports of `deck accuracy`: text, JSON and a page; first what each word of --accuracy costs, then
// the number types. Pure functions from a measurement to bytes.
#pragma once
#include <string>

#include "accuracy/shared/accuracy.hpp"
#include "accuracy/shared/choice.hpp"
#include "deck/keyword/deck.hpp"

namespace deck {

// Where and how the measurement was made; goes into every footer.
struct AccuracyContext {
  std::string path;            // of the deck, as given; empty: hard cases
  const Deck* deck = nullptr;  // nullptr: hard cases
  // The hard cases where the report is that of a deck; nullptr: they were not measured.
  const AccuracyReport* hard = nullptr;
  std::string processor, command;
};

// What each accuracy costs; empty where the hard cases were not measured.
std::vector<AccuracyChoice> accuracy_choices_of(const AccuracyReport& report,
                                                const AccuracyContext& context);

// Name and version of the compiler that built the library, with the build's rules of arithmetic.
std::string accuracy_compiler();

// The choices of --accuracy, with `verbose` also number types and kinds of hard cases. Tables fit
// lines of `width` columns; 0: of any length.
std::string accuracy_text(const AccuracyReport& report, const AccuracyContext& context,
                          bool color = false, std::size_t width = 0, bool verbose = false);
// One pair of every family and tier with wrong decisions, its coordinates as hexadecimal numbers;
// empty if there is none.
std::string accuracy_examples(const AccuracyReport& report);
std::string accuracy_json(const AccuracyReport& report, const AccuracyContext& context);
// One page without outside references: two sentences, the choices of --accuracy, the kinds of hard
// cases with an example on click; folded: where the time goes, charts and tables of number types.
// The JSON document stands in it.
std::string accuracy_html(const AccuracyReport& report, const AccuracyContext& context);

}  // namespace deck
