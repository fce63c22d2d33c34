// Reports of `deck accuracy`: table, JSON, CSV and the chart of error against time.
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
// One line per tier, then one per family and tier, RFC 4180.
std::string accuracy_csv(const AccuracyReport& report);
// Self-contained, one panel per kind of tier: x = time per pair, y = worst error (relative; of hard
// cases over the size of the pair; of decisions alone: wrong ones), both logarithmic; the frontier
// of what nothing else beats on these axes; the rest hollow.
std::string accuracy_svg(const AccuracyReport& report, const AccuracyContext& context);
// One page without outside references: a sentence, the chart, families with an example on click,
// where the time goes, tables; the JSON document stands in it.
std::string accuracy_html(const AccuracyReport& report, const AccuracyContext& context);

}  // namespace deck
