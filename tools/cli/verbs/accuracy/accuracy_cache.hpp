// What was measured on the hard cases, kept between runs of one program on one machine.
#pragma once
#include <cstdint>
#include <functional>

#include "accuracy/shared/accuracy.hpp"

namespace deck::cli {

/// What is measured on the hard cases.
struct HardCases {
  std::size_t samples = 1000;  ///< pairs per kind
  std::uint64_t seed = 1;
  int repeats = 5;
  bool decisions_only = true;
  bool again = false;  ///< measure also what was kept
};

/// The measurement, read from the user's cache directory where this program has left it there
/// ($XDG_CACHE_HOME/deck, else ~/.cache/deck); else made and left there. A directory that cannot
/// be read or written changes nothing but the time.
AccuracyReport measured_hard_cases(const HardCases& which,
                                   std::function<void(std::uint64_t, std::uint64_t)> progress);

}  // namespace deck::cli
