// TextDrain: how a document that is too large to be held leaves while it is written.
#pragma once
#include <cstddef>
#include <functional>
#include <string>

namespace deck {

/// Takes the text so far out of the string, which is empty afterwards. A function that is given one
/// calls it between rows and returns the rest; with an empty one it returns the whole document.
using TextDrain = std::function<void(std::string& text)>;

/// Calls it when there is enough text to be worth it.
inline void drain_text(const TextDrain& drain, std::string& text) {
  constexpr std::size_t enough = std::size_t{1} << 20;
  if (drain && text.size() >= enough) drain(text);
}

}  // namespace deck
