// Numbers with their words, as sentences for people need them.
#pragma once
#include <fmt/format.h>

#include <cstdint>
#include <string>

namespace deck {

/// "1 node", "3 nodes".
inline std::string count(std::uint64_t n, const char* one, const char* many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

}  // namespace deck
