// Builds what the rules look at: contact, default and friction blocks decoded once, effective
// values beside the cells they came from. Private to the lint stage.
#pragma once
#include "deck/lint/lint.hpp"
#include "text/shared/columns.hpp"

namespace deck::detail {

/// Decodes every block that has a schema and is not read by the fast path; findings go to `sink`.
LintContext build_context(const LoadedDeck& loaded, Diagnostics& sink);

/// Formats a value the way people write it: whole numbers without a point, else up to six digits.
std::string number_text(double value);

/// The beginning of a text that may be arbitrarily long.
inline std::string clipped(std::string_view text, std::size_t longest = 60) {
  return std::string(text.substr(0, longest)) + (text.size() > longest ? "…" : "");
}

}  // namespace deck::detail
