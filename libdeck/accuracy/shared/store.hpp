// A measurement as text that is read back bit for bit, to be kept between runs of a program.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "accuracy/shared/accuracy.hpp"

namespace deck {

// `key` says what was measured by what; it is a single line.
std::string stored_accuracy(const AccuracyReport& report, std::string_view key);

// Nothing where the text has another key, is cut off, or was not written by stored_accuracy().
std::optional<AccuracyReport> read_stored_accuracy(std::string_view text, std::string_view key);

}  // namespace deck
