// Results by their whole input, found again by comparing the input byte by byte.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

namespace deck {

using InputBytes = std::span<const std::byte>;

inline std::size_t input_size(std::span<const InputBytes> pieces) {
  std::size_t sum = 0;
  for (const InputBytes& p : pieces) sum += p.size();
  return sum;
}

/// A number made of some words of every piece: inputs that differ mostly differ in it. Saves
/// comparing; decides nothing.
inline std::uint64_t input_mark(std::span<const InputBytes> pieces) {
  constexpr std::size_t samples = 16, word = sizeof(std::uint64_t);
  std::uint64_t mark = 0;
  for (const InputBytes& p : pieces) {
    const std::size_t words = p.size() / word, step = std::max<std::size_t>(1, words / samples);
    for (std::size_t i = 0; i < words; i += step) {
      std::uint64_t value = 0;
      std::memcpy(&value, p.data() + i * word, word);
      mark = (mark ^ value) * 0x9E3779B97F4A7C15U;
      mark ^= mark >> 29;
    }
  }
  return mark;
}

/// Values that were computed from inputs that may come again. The pieces of an input have to say
/// themselves where they end (by the first piece, which has a fixed length). For one thread at a
/// time.
template <class Value>
class KnownInputs {
 public:
  /// Keeps what was used last, up to `bytes` with the inputs.
  explicit KnownInputs(std::size_t bytes) : room_(bytes) {}

  /// nullptr: not known. Valid until the next keep().
  const Value* find(std::span<const InputBytes> input) {
    const std::uint64_t mark = input_mark(input);
    for (Entry& e : entries_)
      if (e.mark == mark && is_same(e.input, input)) {
        e.used = ++clock_;
        return &e.value;
      }
    return nullptr;
  }

  /// `bytes` is what the value takes beside its own size.
  void keep(std::span<const InputBytes> input, Value value, std::size_t bytes) {
    const std::size_t all = sizeof(Entry) + input_size(input) + bytes;
    if (all > room_) return;
    while (held_ + all > room_) {
      const auto oldest =
          std::min_element(entries_.begin(), entries_.end(),
                           [](const Entry& a, const Entry& b) { return a.used < b.used; });
      held_ -= oldest->bytes;
      if (&*oldest != &entries_.back()) *oldest = std::move(entries_.back());
      entries_.pop_back();
    }
    Entry entry{input_mark(input), ++clock_, all, {}, std::move(value)};
    entry.input.reserve(input_size(input));
    for (const InputBytes& p : input) entry.input.insert(entry.input.end(), p.begin(), p.end());
    held_ += all;
    entries_.push_back(std::move(entry));
  }

 private:
  struct Entry {
    std::uint64_t mark, used;  ///< of its input, and when
    std::size_t bytes;
    std::vector<std::byte> input;
    Value value;
  };

  static bool is_same(const std::vector<std::byte>& known, std::span<const InputBytes> pieces) {
    if (known.size() != input_size(pieces)) return false;
    const std::byte* at = known.data();
    for (const InputBytes& p : pieces) {
      if (!p.empty() && std::memcmp(at, p.data(), p.size()) != 0) return false;
      at += p.size();
    }
    return true;
  }

  std::size_t room_, held_ = 0;
  std::uint64_t clock_ = 0;
  std::vector<Entry> entries_;
};

}  // namespace deck
