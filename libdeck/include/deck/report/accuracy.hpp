// Reports of `deck accuracy`: table, JSON and a page with the chart of error against time.
// Pure functions from a measurement to bytes.
#pragma once
#include <string>

#include "deck/accuracy/accuracy.hpp"
#include "deck/keyword/deck.hpp"

namespace deck {

// Where and how the measurement was made; goes into every footer.
struct AccuracyContext {
  std::string path;            // of the deck, as given; empty: hard cases
  const Deck* deck = nullptr;  // nullptr: hard cases
  std::string processor, command;
};

// Name and version of the compiler that built the library, with the build's rules of arithmetic.
std::string accuracy_compiler();

// Tables fit lines of `width` columns; 0: of any length.
std::string accuracy_text(const AccuracyReport& report, const AccuracyContext& context,
                          bool color = false, std::size_t width = 0);
// One pair of every family and tier with wrong decisions, its coordinates as hexadecimal numbers;
// empty if there is none.
std::string accuracy_examples(const AccuracyReport& report);
std::string accuracy_json(const AccuracyReport& report, const AccuracyContext& context);
// One page without outside references: a sentence, the chart, families with an example on click,
// where the time goes, tables; the JSON document stands in it.
std::string accuracy_html(const AccuracyReport& report, const AccuracyContext& context);

}  // namespace deck
