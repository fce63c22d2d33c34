// std::from_chars and std::to_chars of double with the same answers where the standard library has
// none of them (libc++ of emscripten).
#pragma once

#include <charconv>

namespace deck {

// As std::from_chars(first, last, value) does: decimal numbers, inf and nan; `value` stays as it is
// without one, and out of range. Exactly rounded.
std::from_chars_result read_real_text(const char* first, const char* last, double& value);
// As std::chars_format::hex reads: digits without 0x, a point, a power of two behind 'p'.
std::from_chars_result read_hexadecimal_text(const char* first, const char* last, double& value);

// As std::chars_format::scientific writes a finite number: "-d.ddde+XX" with `significant` digits,
// exactly rounded; 0: the fewest that read back to the same double, the nearest of them.
std::to_chars_result write_real_text(char* first, char* last, double value, int significant);

// The same without what the standard library may lack: what the functions above are there. On all
// systems, so that tests can hold one against the other.
namespace portable {
std::from_chars_result read_real_text(const char* first, const char* last, double& value);
std::from_chars_result read_hexadecimal_text(const char* first, const char* last, double& value);
std::to_chars_result write_real_text(char* first, char* last, double value, int significant);
}  // namespace portable

}  // namespace deck
