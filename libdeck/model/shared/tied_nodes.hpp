// Nodes that ties hold, as the mesh and the kinematic conditions need them from the contacts.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "deck/model/model.hpp"

namespace deck {

/// The nodes that one /INTER/TYPE2 holds at the start.
struct TiedNodes {
  struct Row {
    NodeIndex node = no_index;
    std::array<NodeIndex, 4> main{};  ///< triangle: last repeated
    /// Place on the segment, -1 to 1 within it. Triangles with Spotflag 27: weights of corners
    /// 1, 2.
    double s = 0, t = 0;
    bool penalty = false;
  };
  const Block* block = nullptr;
  int spotflag = 0;       ///< effective; 0 is the standard formulation
  bool rim = false;       ///< masses of nodes beyond the rim go to the rim (Iproj 1)
  bool evaluated = true;  ///< false: which nodes it holds is not known
  std::vector<Row> rows;  ///< ascending node id
};

}  // namespace deck
