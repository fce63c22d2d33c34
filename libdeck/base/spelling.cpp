// Capitals, edit distance (one row of the table at a time), numbers as text.
#include "base/shared/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace deck {

std::string in_capitals(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 32);
  return out;
}

std::string in_lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
  return out;
}

std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t limit) {
  if (a.size() > b.size() + limit || b.size() > a.size() + limit) return limit + 1;
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min(
          {above + 1, row[j - 1] + 1, diagonal + static_cast<std::size_t>(a[i - 1] != b[j - 1])});
      diagonal = above;
    }
  }
  return row[b.size()];
}

std::string closest_word(std::string_view word, const std::vector<std::string>& known) {
  const std::string wanted = in_capitals(word);
  std::size_t best = word.size() < 3 ? 1 : word.size() < 6 ? 2 : 3;  // largest distance
  std::string found;
  for (const std::string& candidate : known) {
    const std::size_t d = edit_distance(wanted, in_capitals(candidate), best);
    if (d > best || (d == best && !found.empty())) continue;
    best = d;
    found = candidate;
  }
  return found;
}

std::string list_text(const std::vector<std::int64_t>& ids, std::size_t most) {
  const std::size_t shown = std::min(most, ids.size());
  std::string out = fmt::format("{}", fmt::join(ids.data(), ids.data() + shown, ", "));
  return shown == ids.size() ? out : out + fmt::format(" and {} more", ids.size() - shown);
}

std::string length_text(double length, int digits, double largest) {
  if (is_unbounded(length) || std::fabs(length) > largest) return "unbounded";
  return fmt::format("{:.{}g}", length, digits);
}

std::string figure_text(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : std::string(not_computed);
}

}  // namespace deck
