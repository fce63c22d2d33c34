// Number cells without a function call: the inner loops of read_real(), read_integer() and of the
// bulk reader. Eight digits at a time in one register; never reads outside [p, end).
#pragma once
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "deck/text.hpp"
#include "text/shared/columns.hpp"

namespace deck::detail {

inline constexpr std::uint64_t every_byte = 0x0101010101010101u;
inline constexpr std::uint64_t high_bits = 0x80 * every_byte;

/// Eight bytes, the first one in the low bits on every machine.
inline std::uint64_t load8(const char* p) {
  std::uint64_t x;
  std::memcpy(&x, p, 8);
  if constexpr (std::endian::native == std::endian::big) x = __builtin_bswap64(x);
  return x;
}

/// High bit of every byte that is not '0'..'9', exact per byte. `x`: digit ^ '0' per byte.
inline std::uint64_t not_digits(std::uint64_t x) {
  return (((x & ~high_bits) + 0x76 * every_byte) | x) & high_bits;
}

/// Value of eight digits (0..9 per byte), the first one in the low byte.
inline std::uint64_t value_of_digits(std::uint64_t x) {
  x = x * 10 + (x >> 8);
  constexpr std::uint64_t mask = 0x000000ff000000ffu;
  constexpr std::uint64_t upper = 0x000f424000000064u;  // 100 + (1000000 << 32)
  constexpr std::uint64_t lower = 0x0000271000000001u;  // 1 + (10000 << 32)
  return ((x & mask) * upper + ((x >> 16) & mask) * lower) >> 32;
}

inline constexpr std::uint64_t small_power_of_ten[] = {1,      10,      100,      1000,     10000,
                                                       100000, 1000000, 10000000, 100000000};

/// Appends the digits at p to `mantissa` (wraps after 19) and moves p behind them. A load may read
/// before p down to `begin`, but not beyond `end`.
inline void scan_digits(const char* begin, const char*& p, const char* end,
                        std::uint64_t& mantissa) {
  if (end - begin < 8) {
    while (p != end && is_digit(*p)) mantissa = mantissa * 10 + static_cast<unsigned>(*p++ - '0');
    return;
  }
  while (p != end) {
    const auto left = end - p;
    const std::uint64_t x = left >= 8 ? load8(p) : load8(end - 8) >> (8 * (8 - left));
    const std::uint64_t digits = x ^ ('0' * every_byte);
    const std::uint64_t stop = not_digits(digits);
    if (stop == 0) {
      mantissa = mantissa * 100000000 + value_of_digits(digits);
      p += 8;
      continue;
    }
    const int count = std::countr_zero(stop) / 8;
    if (count == 0) return;
    mantissa = mantissa * small_power_of_ten[count] + value_of_digits(digits << (8 * (8 - count)));
    p += count;
    return;
  }
}

/// Definition of a blank: every byte <= 0x20, or only the space, so that other control characters
/// need the slow path.
enum class Blanks { all, spaces };

template <Blanks blanks>
inline bool blank_as(char c) {
  return blanks == Blanks::all ? is_blank(c) : c == ' ';
}

/// Skips leading blanks.
template <Blanks blanks>
inline void skip_blanks(const char*& p, const char* end) {
  while (end - p >= 8) {
    const std::uint64_t x = load8(p) ^ (' ' * every_byte);
    if (x == 0) {
      p += 8;
      continue;
    }
    p += std::countr_zero(x) / 8;
    break;
  }
  while (p != end && blank_as<blanks>(*p)) ++p;
}

inline constexpr double power_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                          1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                          1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
inline constexpr std::uint64_t exact_mantissa = std::uint64_t{1} << 53;

/// Reads a cell that scan_real() does not decide. `begin`..`end` is trimmed and not empty.
RealCell read_real_general(const char* begin, const char* end);

/// Reads a real cell with one rounding if mantissa and power of ten are exact doubles (Clinger),
/// else by the general function.
inline double with_sign(double value, bool negative) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) ^
                               (static_cast<std::uint64_t>(negative) << 63));
}

template <Blanks blanks = Blanks::all>
inline RealCell scan_real(const char* p, const char* end) {
  const char* const cell = p;
  skip_blanks<blanks>(p, end);
  if (p == end) return {0, NumberStatus::blank};
  while (blank_as<blanks>(end[-1])) --end;
  const char* const begin = p;
  // Signs are unpredictable: no branch.
  const bool negative = *p == '-';
  p += static_cast<int>(negative) | static_cast<int>(*p == '+');
  std::uint64_t mantissa = 0;
  const char* const digits = p;
  scan_digits(cell, p, end, mantissa);
  std::ptrdiff_t count = p - digits;
  std::ptrdiff_t exponent = 0;
  if (p != end && *p == '.') {
    const char* const fraction = ++p;
    scan_digits(cell, p, end, mantissa);
    exponent = fraction - p;
    count -= exponent;
  }
  if (count == 0 || count > 19) return read_real_general(begin, end);
  NumberStatus status = NumberStatus::ok;
  if (p != end) {
    const char mark = static_cast<char>(*p | 0x20);
    const bool letter = mark == 'e' || mark == 'd';
    if (letter)
      ++p;
    else
      status = NumberStatus::implicit_exponent;
    const bool sign = p != end && (*p == '-' || *p == '+');
    const bool minus = sign && *p == '-';
    if (sign) ++p;
    int written = 0;
    const char* const first = p;
    while (p != end && is_digit(*p) && p - first < 5) written = written * 10 + (*p++ - '0');
    if (p != end || p == first || (!letter && !sign)) return read_real_general(begin, end);
    exponent += minus ? -written : written;
  }
  if (mantissa > exact_mantissa || exponent < -22 || exponent > 22) {
    if (mantissa == 0) return {negative ? -0.0 : 0.0, status};
    return read_real_general(begin, end);
  }
  auto value = static_cast<double>(mantissa);
  value = exponent < 0 ? value / power_of_ten[-exponent] : value * power_of_ten[exponent];
  return {with_sign(value, negative), status};
}

/// Reads an integer cell.
template <Blanks blanks = Blanks::all>
inline IntegerCell scan_integer(const char* p, const char* end) {
  const char* const cell = p;
  skip_blanks<blanks>(p, end);
  if (p == end) return {0, NumberStatus::blank};
  const bool negative = *p == '-';
  if (negative || *p == '+') ++p;
  std::uint64_t value = 0;
  const char* const digits = p;
  scan_digits(cell, p, end, value);
  if (p == digits) return {0, NumberStatus::not_a_number};
  if (p - digits > 18) return {0, NumberStatus::overflow};
  const auto whole =
      negative ? -static_cast<std::int64_t>(value) : static_cast<std::int64_t>(value);
  while (p != end && blank_as<blanks>(*p)) ++p;
  return {whole, p == end ? NumberStatus::ok : NumberStatus::trailing_text};
}

/// Reads up to eight digits after blanks, ending in the last of eight columns. Returns 0 if the
/// cell has this form; `value` is then valid.
inline std::uint64_t digit_mismatch(const char* p, std::uint64_t& value) {
  const std::uint64_t x = load8(p) ^ (' ' * every_byte);  // blank: 0, digit: 0x10 ... 0x19
  const std::uint64_t marks = x >> 4 & every_byte;        // 1 for a digit
  const std::uint64_t digits = x & 0x0f * every_byte;
  value = value_of_digits(digits);
  return (x & ~(marks * 0x1f)) | ((digits + 0x06 * every_byte) & 0x10 * every_byte) |
         ((marks & ~(marks >> 8)) ^ std::uint64_t{1} << 56);
}

/// Reads the usual form of ids: blanks, then 1 to 8 digits ending in the last column of a cell with
/// at least 8 columns. False: use scan_integer().
inline bool scan_plain_integer(const char* p, const char* end, std::uint64_t& value) {
  if (digit_mismatch(end - 8, value) != 0) return false;
  for (end -= 8; p != end; ++p)
    if (*p != ' ') return false;
  return true;
}

/// digit_mismatch() for a cell of ten columns.
inline std::uint64_t unlike_id(const char* p, std::uint64_t& value) {
  std::uint16_t front;
  std::memcpy(&front, p, 2);
  return digit_mismatch(p + 2, value) | (front ^ 0x2020u);
}

/// SSE2 version of scan_plain_real() for sixteen columns; on other processors it returns false.
#if defined(__SSE2__) && defined(__x86_64__)
inline bool scan_sixteen(const char* p, double& value) {
  const __m128i text = _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
  const __m128i numbers = _mm_xor_si128(text, _mm_set1_epi8('0'));
  const __m128i is_digit = _mm_cmpeq_epi8(_mm_min_epu8(numbers, _mm_set1_epi8(9)), numbers);
  // Bit k is column k.
  const auto columns = [](__m128i m) { return static_cast<std::uint32_t>(_mm_movemask_epi8(m)); };
  const auto columns_of = [&](char c) { return columns(_mm_cmpeq_epi8(text, _mm_set1_epi8(c))); };
  const std::uint32_t others = columns(is_digit) ^ 0xffff;
  const std::uint32_t points = columns_of('.'), blanks = columns_of(' '), minus = columns_of('-');
  const std::uint32_t bad = (others ^ (points | blanks | minus)) | (points & (points - 1)) |
                            (blanks & (blanks + 1)) | (minus & ~(blanks + 1));
  if (bad != 0 || points == 0 || others == 0xffff) return false;
  const int point = std::countr_zero(points);
  // Moves the digits before the point to those after it.
  alignas(32) static constexpr unsigned char before_point[32] = {
      0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff,
      0xff, 0xff, 0xff, 0xff, 0xff, 0,    0,    0,    0,    0,    0,
      0,    0,    0,    0,    0,    0,    0,    0,    0,    0};
  const __m128i moved =
      _mm_loadu_si128(reinterpret_cast<const __m128i*>(before_point + 15 - point));
  const __m128i apart = _mm_and_si128(is_digit, numbers);
  const __m128i digits =
      _mm_or_si128(_mm_and_si128(moved, _mm_slli_si128(apart, 1)), _mm_andnot_si128(moved, apart));
  // Combines to numbers of two, four and eight digits.
  const __m128i two = _mm_add_epi16(
      _mm_mullo_epi16(_mm_and_si128(digits, _mm_set1_epi16(0xff)), _mm_set1_epi16(10)),
      _mm_srli_epi16(digits, 8));
  const __m128i four = _mm_madd_epi16(two, _mm_set1_epi32(1 << 16 | 100));
  const __m128i eight =
      _mm_madd_epi16(_mm_packs_epi32(four, four), _mm_set1_epi32(1 << 16 | 10000));
  const auto halves = static_cast<std::uint64_t>(_mm_cvtsi128_si64(eight));
  const std::uint64_t mantissa = (halves & 0xffffffff) * 100000000 + (halves >> 32);
  value =
      with_sign(static_cast<double>(static_cast<std::int64_t>(mantissa)) / power_of_ten[15 - point],
                minus != 0);
  return true;
}
#else
inline bool scan_sixteen(const char*, double&) { return false; }
#endif

/// Reads the usual form of coordinates: blanks, optional minus, digits and one point within the
/// last 16 columns of a cell with at least 16, ending in the last. The value equals that of
/// scan_real(). False: use scan_real().
inline bool scan_plain_real(const char* p, const char* end, double& value) {
  if (!scan_sixteen(end - 16, value)) return false;
  for (const char* const last = end - 16; p != last; ++p)
    if (*p != ' ') return false;
  return true;
}

/// scan_plain_real() for a cell of twenty columns.
inline bool scan_plain_twenty(const char* p, double& value) {
  std::uint32_t front;
  std::memcpy(&front, p, 4);
  return front == 0x20202020u && scan_sixteen(p + 4, value);
}

// ---- decimal digits as text, in the two forms a deck knows -------------------------------------

/// value = 0.d1d2d3… * 10^point, without trailing zeros.
struct Decimal {
  bool negative = false;
  std::string_view digits;
  int point = 0;
};

/// Writes "-d.ddde+XX" with `significant` digits, correctly rounded; 0: the fewest that read back
/// to the same double.
inline std::to_chars_result write_scientific(char* first, char* last, double value,
                                             int significant) {
  constexpr auto form = std::chars_format::scientific;
  return significant == 0 ? std::to_chars(first, last, value, form)
                          : std::to_chars(first, last, value, form, significant - 1);
}

/// The most readable text with all these digits within `room`; empty: none fits.
std::string readable_text(const Decimal& d, std::size_t room);

}  // namespace deck::detail
