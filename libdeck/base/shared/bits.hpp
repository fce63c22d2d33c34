// The bits of a value as another type. std::bit_cast is not in every standard library this project
// is compiled with (that of emscripten lacks it); the built-in behind it is in every compiler.
#pragma once

namespace deck {

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  static_assert(sizeof(To) == sizeof(From));
  return __builtin_bit_cast(To, from);
}

}  // namespace deck
