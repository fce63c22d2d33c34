// Candidates for the direction of a translation, and how long each has to be.
#include "edit/fix/translations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace deck::detail {
namespace {

constexpr double same_normal = 1e-3;       // normals that differ by less are one
constexpr double least_share = 0.05;       // of a translation along a normal that it is to free
constexpr double against = 1e-9;           // along a normal that is nothing but round-off
constexpr double least_part = 1e-3;        // of a translation: a smaller component is left out
constexpr std::size_t most_normals = 400;  // directions tried by themselves
constexpr std::size_t most_paired = 24;    // and in pairs
constexpr int most_pulls = 400;

/// Ways with equal normals as one, which needs as much as the most of them.
std::vector<WayOut> distinct(const std::vector<WayOut>& ways) {
  std::map<std::array<long long, 3>, WayOut> out;
  for (const WayOut& way : ways) {
    const auto cell = [](double x) { return std::llround(x / same_normal); };
    const auto [it, is_new] =
        out.try_emplace({cell(way.normal.x), cell(way.normal.y), cell(way.normal.z)}, way);
    if (!is_new && way.needs > it->second.needs) it->second = way;
  }
  std::vector<WayOut> list;
  for (const auto& [key, way] : out) list.push_back(way);
  std::stable_sort(list.begin(), list.end(),
                   [](const WayOut& a, const WayOut& b) { return a.needs > b.needs; });
  return list;
}

/// The shortest translation that gives every way what it needs, as far as the sweeps come
/// (Hildreth's method: each way pulls along its normal, never back).
Vec shortest(const std::vector<WayOut>& ways) {
  std::vector<double> pulled(ways.size(), 0);
  Vec u{};
  for (int sweep = 0; sweep < most_pulls; ++sweep)
    for (std::size_t i = 0; i < ways.size(); ++i) {
      const double step = std::max(ways[i].needs - dot(ways[i].normal, u), -pulled[i]);
      pulled[i] += step;
      u = u + step * ways[i].normal;
    }
  return u;
}

std::vector<Vec> directions_of(const std::vector<WayOut>& ways) {
  std::vector<WayOut> wanted;
  for (const WayOut& way : distinct(ways))
    if (way.wanted) wanted.push_back(way);
  std::vector<Vec> out = {unit(shortest(wanted))};
  Vec mean{};
  for (const WayOut& way : wanted) mean = mean + way.normal;
  out.push_back(unit(mean));
  for (const double sign : {1.0, -1.0})
    for (const Vec axis : {Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}}) out.push_back(sign * axis);
  for (std::size_t i = 0; i < std::min(most_normals, wanted.size()); ++i)
    out.push_back(wanted[i].normal);
  for (std::size_t i = 0; i < std::min(most_paired, wanted.size()); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      out.push_back(unit(wanted[i].normal + wanted[k].normal));
      out.push_back(unit(shortest({wanted[i], wanted[k]})));
    }
  return out;
}

/// Three digits, away from zero; what hardly counts is left out.
double three_digits(double x, double length) {
  if (std::abs(x) <= least_part * length) return 0;
  const double digit = std::pow(10.0, std::floor(std::log10(std::abs(x))) - 2);
  return std::copysign(std::ceil(std::abs(x) / digit - 1e-9) * digit, x);
}

Vec three_digits(const Vec& u) {
  const double l = norm(u);
  return {three_digits(u.x, l), three_digits(u.y, l), three_digits(u.z, l)};
}

/// The longest of the lengths that free something within the bound: it frees all of them.
double length_along(const Vec& direction, const std::vector<WayOut>& ways, double longest) {
  double length = 0;
  for (const WayOut& way : ways) {
    const double share = dot(way.normal, direction);
    if (share < -against) return 0;
    if (!way.wanted || share < least_share) continue;
    if (const double needed = way.needs / share; needed <= longest)
      length = std::max(length, needed);
  }
  return length;
}

}  // namespace

std::vector<Translation> translations_for(const std::vector<WayOut>& ways, double longest,
                                          std::size_t most) {
  std::vector<Translation> out;
  for (const Vec& direction : directions_of(ways)) {
    const double length = length_along(direction, ways, longest);
    if (length == 0) continue;
    Translation t{three_digits(length * direction), 0};
    if (norm(t.by) > longest) t.by = length * direction;  // the bound goes before round numbers
    bool fits = true;
    for (const WayOut& way : ways) {
      const double along = dot(way.normal, t.by);
      fits = fits && along >= -against * length;
      t.frees += way.wanted && along >= way.needs * (1 - 1e-12);
    }
    if (!fits || t.frees == 0) continue;
    const bool known = std::any_of(out.begin(), out.end(), [&](const Translation& other) {
      return norm(other.by - t.by) <= same_normal * length;
    });
    if (!known) out.push_back(t);
  }
  std::stable_sort(out.begin(), out.end(), [](const Translation& a, const Translation& b) {
    if (a.frees != b.frees) return a.frees > b.frees;
    return norm(a.by) < norm(b.by);
  });
  if (out.size() > most) out.resize(most);
  return out;
}

}  // namespace deck::detail
