// Hash of file contents.
#pragma once
#include <cstdint>
#include <string_view>

namespace deck {

/// XXH64 with seed 0: not cryptographic, several bytes per cycle.
std::uint64_t content_hash(std::string_view bytes);

}  // namespace deck
