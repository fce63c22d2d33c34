// Decks of a sheet with single nodes over it, and cards of the ties between them.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "contact/meshes.hpp"

namespace deck::test {

struct TieCard {
  int id = 1, grnd = 9, surf = 1, ignore = 1, spotflag = 5;
  double dsearch = 0;
  int isearch = 0;
};

/// The card; Spotflag 25 to 28 have a line more.
inline std::string tie_card(const TieCard& c) {
  std::string out =
      fmt::sprintf("/INTER/TYPE2/%d\ntie\n%10d%10d%10d%10d%10d%10d%10d%10s%20.13g", c.id, c.grnd,
                   c.surf, c.ignore, c.spotflag, 0, c.isearch, 0, "", c.dsearch);
  if (c.spotflag >= 25 && c.spotflag <= 28) out += "\n                 1.0                0.05";
  return out;
}

/// A sheet of 3 x 3 quads of 10 x 10 at z = 0 (nodes 1 to 16, surface 1), and single nodes from 101
/// on in group 9.
inline SmallDeck sheet(const std::vector<std::array<double, 3>>& nodes) {
  SmallDeck d;
  add_sheet(d, 1, 1, 1, 3, 3, [](int i, int j) { return std::array{10.0 * i, 10.0 * j, 0.0}; });
  std::vector<int> group;
  for (const auto& p : nodes) {
    group.push_back(101 + static_cast<int>(group.size()));
    d.node(group.back(), p[0], p[1], p[2]);
  }
  return d.shell_part(1, 2).group("/SURF/PART/1", {1}).group("/GRNOD/NODE/9", group);
}

}  // namespace deck::test
