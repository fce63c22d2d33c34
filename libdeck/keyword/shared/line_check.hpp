// Checks of data lines, shared by decode_line() (with messages) and the bulk reader (counts only),
// so that both agree. Private to the library.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "deck/keyword.hpp"
#include "deck/rule_id.hpp"
#include "deck/text.hpp"
#include "text/shared/columns.hpp"

namespace deck::detail {

/// Columns of a data line that the solver reads.
inline constexpr int line_columns = 100;

enum class LineRule : std::uint8_t {
  tail,
  tab,
  nul,
  integer,
  real,
  trailing,
  range,
  tiny,
  not_finite,
  letterless,
  gap,
  after,
  none,
};
inline constexpr RuleId line_rule_ids[] = {
    RuleId::DK012, RuleId::DK013, RuleId::DK014, RuleId::DK020, RuleId::DK021, RuleId::DK022,
    RuleId::DK023, RuleId::DK024, RuleId::DK025, RuleId::DK026, RuleId::DK027, RuleId::DK028};
inline RuleId id_of(LineRule rule) { return line_rule_ids[static_cast<std::size_t>(rule)]; }

/// Finding about a number cell, if any. `text_size`: length of the trimmed cell.
inline LineRule number_rule(const Field& field, NumberStatus status, std::size_t text_size,
                            double value) {
  const bool real = field.type == FieldType::real;
  switch (status) {
    case NumberStatus::not_a_number:
      return real ? LineRule::real : LineRule::integer;
    case NumberStatus::trailing_text:
      return LineRule::trailing;
    case NumberStatus::overflow:
      return LineRule::range;
    case NumberStatus::underflow:
      return LineRule::tiny;
    case NumberStatus::not_finite:
      return LineRule::not_finite;
    case NumberStatus::implicit_exponent:
      if (static_cast<int>(text_size) > field.last - field.first) return LineRule::letterless;
      break;
    case NumberStatus::ok:
    case NumberStatus::blank:
      break;
  }
  if (real && value != 0 && std::fabs(value) < std::numeric_limits<double>::min())
    return LineRule::tiny;
  return LineRule::none;
}

/// Status of an integer cell; the solver has 32-bit integers.
inline NumberStatus narrowed(IntegerCell cell) {
  if (cell.status == NumberStatus::ok && (cell.value > 2147483647 || cell.value < -2147483648LL))
    return NumberStatus::overflow;
  return cell.status;
}

/// Clamps to 32 bits; the overflow is reported. Wrapping would give a plausible number.
inline std::int64_t saturated(std::int64_t value) {
  return std::clamp<std::int64_t>(value, std::numeric_limits<std::int32_t>::min(),
                                  std::numeric_limits<std::int32_t>::max());
}

/// Columns that belong to a cell of a card in one version.
struct ColumnMap {
  bool covered[line_columns + 2] = {};  // 1-based; the last entry is never covered
  int last = 0;
  ColumnMap(const CardSchema& card, int version) {
    for (const Field& f : card.fields) {
      if (!f.in_version(version)) continue;
      for (int c = f.first; c <= std::min(f.last, line_columns); ++c) covered[c] = true;
      last = std::max(last, f.last);
    }
  }
};

/// Text after the last column without leading blanks; empty for a spelling of 0, which the solver
/// accepts.
inline std::string_view tail_of(std::string_view line) {
  if (line.size() <= line_columns) return {};
  line = trim_left(line.substr(line_columns));
  return line.find_first_not_of("0.+- ") == std::string_view::npos ? std::string_view() : line;
}

/// Calls f(first, last, after, zero) for every word outside of cells: `after` the last cell or
/// between cells; `zero`: a spelling of 0. A word ends at a blank or cell.
template <class F>
void for_each_gap_text(const ColumnMap& map, std::string_view line, F&& f) {
  const int size = static_cast<int>(std::min<std::size_t>(line.size(), line_columns));
  const auto blank = [&](int k) { return is_blank(line[static_cast<std::size_t>(k - 1)]); };
  for (int c = 1; c <= size;) {
    if (map.covered[c] || blank(c)) {
      ++c;
      continue;
    }
    int end = c;
    while (end < size && !map.covered[end + 1] && !blank(end + 1)) ++end;
    const std::string_view text =
        line.substr(static_cast<std::size_t>(c - 1), static_cast<std::size_t>(end - c + 1));
    f(c, end, c > map.last, text.find_first_not_of("0.+-") == std::string_view::npos);
    c = end + 1;
  }
}

}  // namespace deck::detail
