// Where the coordinates of nodes are written, and what a new coordinate is once it is printed
// there. Private to the stage.
#pragma once
#include <array>
#include <map>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "edit/cells.hpp"

namespace deck::detail {

class NodeCells {
 public:
  explicit NodeCells(const LoadedDeck& context);
  /// Finds the lines of these nodes; those known already cost nothing.
  void look_up(std::span<const NodeIndex> nodes);
  /// Why the coordinates of a node that was looked up cannot be changed on its line; empty: they
  /// can.
  const std::string& obstacle(NodeIndex n) const { return known_.at(n).obstacle; }
  /// The line of a node that was looked up; invalid: it was not found.
  Span line(NodeIndex n) const {
    return known_.at(n).line.valid() ? known_.at(n).line.whole() : Span{};
  }

  /// Coordinate `axis` of a node with `value` printed in its cell: what reading it gives. nullopt:
  /// it does not fit.
  struct Printed {
    std::string text;
    double value = 0;
  };
  std::optional<Printed> print(NodeIndex n, int axis, double value) const;
  /// Puts the text of a coordinate into its cell.
  void write(CellWriter& cells, NodeIndex n, int axis, std::string_view text) const {
    known_.at(n).places[static_cast<std::size_t>(axis)].write(cells, text);
  }
  /// Edits for new texts per node and axis.
  std::vector<TextEdit> edits(const std::map<std::pair<NodeIndex, int>, std::string>& texts) const;

 private:
  struct Cells {
    Line line;
    std::array<CellPlace, 3> places;
    double factor = 1;
    std::array<double, 3> offset{};  ///< from the line to the model: noise of /RANDOM
    std::string obstacle;
  };
  Cells read(NodeIndex n, const Block& block, const Span& line) const;
  const LoadedDeck& context_;
  std::unordered_map<NodeIndex, Cells> known_;
  std::set<std::string> twice_;  ///< files included more than once
  std::set<NodeIndex> merged_;   ///< nodes that /CNODE merges with another
  bool noise_only_ = false;      ///< /RANDOM is all that moves nodes from where their lines say
};

}  // namespace deck::detail
