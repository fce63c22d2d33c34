// XXH64 in plain C++.
#include "base/shared/hash.hpp"

#include <bit>
#include <cstring>

namespace deck {
namespace {

constexpr std::uint64_t p1 = 0x9E3779B185EBCA87u, p2 = 0xC2B2AE3D27D4EB4Fu,
                        p3 = 0x165667B19E3779F9u, p4 = 0x85EBCA77C2B2AE63u,
                        p5 = 0x27D4EB2F165667C5u;

template <class T>
std::uint64_t load_word(const char* at) {
  static_assert(std::endian::native == std::endian::little);
  T word;
  std::memcpy(&word, at, sizeof word);
  return word;
}
std::uint64_t round_of(std::uint64_t lane, std::uint64_t word) {
  return std::rotl(lane + word * p2, 31) * p1;
}

}  // namespace

std::uint64_t content_hash(std::string_view bytes) {
  const char* at = bytes.data();
  std::size_t left = bytes.size();
  std::uint64_t h = p5;
  if (left >= 32) {
    std::uint64_t lane[4] = {p1 + p2, p2, 0, 0 - p1};
    for (; left >= 32; left -= 32, at += 32)
      for (std::size_t i = 0; i < 4; ++i)
        lane[i] = round_of(lane[i], load_word<std::uint64_t>(at + 8 * i));
    h = std::rotl(lane[0], 1) + std::rotl(lane[1], 7) + std::rotl(lane[2], 12) +
        std::rotl(lane[3], 18);
    for (const std::uint64_t l : lane) h = (h ^ round_of(0, l)) * p1 + p4;
  }
  h += bytes.size();
  for (; left >= 8; left -= 8, at += 8)
    h = std::rotl(h ^ round_of(0, load_word<std::uint64_t>(at)), 27) * p1 + p4;
  if (left >= 4) {
    h = std::rotl(h ^ (load_word<std::uint32_t>(at) * p1), 23) * p2 + p3;
    left -= 4;
    at += 4;
  }
  for (; left > 0; --left, ++at) h = std::rotl(h ^ (static_cast<unsigned char>(*at) * p5), 11) * p1;
  h = (h ^ (h >> 33)) * p2;
  h = (h ^ (h >> 29)) * p3;
  return h ^ (h >> 32);
}

}  // namespace deck
