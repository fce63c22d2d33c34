// The verdict in documents and on the terminal.
#pragma once
#include <string>

#include "deck/verdict.hpp"
#include "report/shared/json.hpp"

namespace deck {

/// The member "verdict": level, text, sentences with their counts, counts of all.
void write_verdict(JsonWriter& json, const Verdict& verdict);
/// The same by itself.
std::string verdict_json(const Verdict& verdict);
/// The text as a line.
std::string verdict_text(const Verdict& verdict, bool color);

}  // namespace deck
