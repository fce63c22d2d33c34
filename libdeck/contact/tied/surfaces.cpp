// Surface-to-surface input of a tie: selects segments of two surfaces that face each other.
#include <algorithm>
#include <array>
#include <cmath>

#include "contact/shared/tie_steps.hpp"

namespace deck::detail {
namespace {

// Shares of the solver; single precision there.
constexpr double reach_share = 0.2F, box_share = 0.6F, equal_share = 0.1F;

struct FacingSegment {
  Vec low, high, centre, normal;
  double reach = 0;
  bool kept = true;
};

FacingSegment facing(const Coordinates& x, const Corners& c, double dsearch) {
  FacingSegment f;
  f.low = f.high = at(x, c[0]);
  Vec sum;
  for (const NodeIndex n : c) {
    const Vec p = at(x, n);
    f.low = {std::min(f.low.x, p.x), std::min(f.low.y, p.y), std::min(f.low.z, p.z)};
    f.high = {std::max(f.high.x, p.x), std::max(f.high.y, p.y), std::max(f.high.z, p.z)};
    sum = sum + p;
  }
  f.centre = 0.25 * sum;
  const Vec n = cross(at(x, c[2]) - at(x, c[0]), at(x, c[3]) - at(x, c[1]));
  f.normal = unit(n);
  f.reach = std::max(dsearch, reach_share * std::sqrt(0.5 * norm(n)));
  return f;
}

bool near(const FacingSegment& i, const FacingSegment& j) {
  const auto axis = [&](double centre, double low_i, double high_i, double low_j, double high_j) {
    const double wider = i.reach + box_share * (high_j - low_j);
    return centre >= low_i - wider && centre <= high_i + wider && low_j <= high_i + i.reach &&
           high_j >= low_i - i.reach;
  };
  return axis(j.centre.x, i.low.x, i.high.x, j.low.x, j.high.x) &&
         axis(j.centre.y, i.low.y, i.high.y, j.low.y, j.high.y) &&
         axis(j.centre.z, i.low.z, i.high.z, j.low.z, j.high.z) &&
         std::fabs(dot(i.normal, j.normal)) >= 0.5;
}

/// One direction: removes segments of `first` that face none of `second`, and segments of `second`
/// that are not the nearest.
void select(std::vector<FacingSegment>& first, std::vector<FacingSegment>& second) {
  std::vector<std::pair<double, std::size_t>> along;  // centres of `second`
  double widest = 0;
  for (std::size_t j = 0; j < second.size(); ++j) {
    along.emplace_back(second[j].centre.x, j);
    widest = std::max(widest, second[j].high.x - second[j].low.x);
  }
  std::sort(along.begin(), along.end());
  std::vector<std::size_t> close;
  for (FacingSegment& i : first) {
    if (!i.kept) continue;
    FacingSegment* found = nullptr;
    double depth = i.reach;
    const double wider = i.reach + box_share * widest;
    close.clear();
    for (auto it = std::lower_bound(along.begin(), along.end(),
                                    std::pair(i.low.x - wider, std::size_t{0}));
         it != along.end() && it->first <= i.high.x + wider; ++it)
      close.push_back(it->second);
    std::sort(close.begin(), close.end());  // the order of the list decides
    for (const std::size_t k : close) {
      FacingSegment& j = second[k];
      if (!j.kept || !near(i, j)) continue;
      const double height = std::fabs(dot(i.centre - j.centre, i.normal));
      const double equal = equal_share * j.reach;
      if (height < depth) {
        if (found != nullptr && height + equal < depth) found->kept = false;
        found = &j;
        depth = height;
      } else if (height > depth + equal && found != nullptr) {
        j.kept = false;
      } else if (found == nullptr) {
        found = &j;
      }
    }
    if (found == nullptr) i.kept = false;
  }
}

}  // namespace

std::vector<NodeIndex> corner_set(const Corners& c) {
  std::vector<NodeIndex> out(c.begin(), c.end());
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

void join_surfaces(const Coordinates& x, double dsearch, const std::vector<Corners>& first,
                   const std::vector<Corners>& second, Tie& tie) {
  std::vector<FacingSegment> one, two;
  std::vector<std::vector<NodeIndex>> known;
  for (const Corners& c : first) {
    one.push_back(facing(x, c, dsearch));
    known.push_back(corner_set(c));
  }
  std::sort(known.begin(), known.end());
  for (const Corners& c : second) {
    two.push_back(facing(x, c, dsearch));
    two.back().kept = !std::binary_search(known.begin(), known.end(), corner_set(c));
  }
  select(one, two);
  select(two, one);
  std::vector<NodeIndex> nodes;
  const auto keep_active = [&](const std::vector<Corners>& segments,
                               const std::vector<FacingSegment>& of) {
    for (std::size_t i = 0; i < segments.size(); ++i) {
      if (!of[i].kept) continue;
      tie.main.push_back(segments[i]);
      for (const NodeIndex n : segments[i]) nodes.push_back(n);
    }
  };
  keep_active(first, one);
  keep_active(second, two);
  std::vector<bool> seen(x.x.size(), false);
  for (const NodeIndex n : nodes) {
    if (!seen[n]) tie.nodes.push_back({n});
    seen[n] = true;
  }
}

}  // namespace deck::detail
