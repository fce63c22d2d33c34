// The margin of a long list of segments, on several threads. Private to the library.
#pragma once
#include "deck/contact/search.hpp"

namespace deck {

/// The same sum, digit for digit, for any number of threads.
double candidate_margin(const NodeArrays& nodes,
                        std::span<const std::array<std::uint32_t, 4>> segments, int threads);

}  // namespace deck
