// Ties as lines from their nodes to the nearest points of their segments.
#include "deck/contact/closest.hpp"
#include "report/vtk/vtk_writer.hpp"

namespace deck::detail {

std::string tie_lines(const Model& model, const Tie& tie) {
  VtkPolyData out(VtkPolyData::Cells::lines);
  std::vector<std::int64_t> node, tied, lost, message;
  std::vector<double> distance, search;
  const auto at = [&](NodeIndex n) {
    return Point3<double>{model.nodes.x[n], model.nodes.y[n], model.nodes.z[n]};
  };
  for (const TiedNode& n : tie.nodes) {
    const bool found = n.segment != no_index;
    const std::uint32_t segment = found ? n.segment : n.nearest;
    const Point3<double> p = at(n.node);
    Point3<double> foot = p;
    if (segment != no_index) {
      const std::array<NodeIndex, 4>& c = tie.main[segment];
      foot = p - closest_on_segment<Form::reference>(p, {at(c[0]), at(c[1]), at(c[2]), at(c[3])},
                                                     c[2] == c[3])
                     .closest()
                     .vector;
    }
    const std::size_t first = out.points();
    out.add_point(p.x, p.y, p.z);
    out.add_point(foot.x, foot.y, foot.z);
    out.add_cell(std::array{first, first + 1});
    node.push_back(model.node_id(n.node));
    tied.push_back(n.tied);
    lost.push_back(n.lost());
    message.push_back(n.message);
    distance.push_back(found ? n.distance : n.nearest_distance);
    search.push_back(n.search != 0 ? n.search : tie.search_distance);
  }
  out.cell_data("node", node);
  out.cell_data("tied", tied);
  out.cell_data("lost", lost);
  out.cell_data("message", message);
  out.cell_data("distance", distance);
  out.cell_data("search", search);
  return out.document();
}

}  // namespace deck::detail
