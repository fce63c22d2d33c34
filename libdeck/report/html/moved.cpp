// What a repair has moved: the nodes that stand elsewhere than in the deck before it.
#include <algorithm>
#include <cmath>

#include "report/html/parts.hpp"

namespace deck::detail {
namespace {

constexpr std::size_t most_moved = 100000;  // farthest first

struct Moved {
  NodeIndex node = 0;
  std::array<double, 3> by{};
  double length() const { return std::hypot(by[0], by[1], by[2]); }
};

/// By id; farthest first, equal ones in the order of the model.
std::vector<Moved> moved_nodes(const Model& model, const Model& before) {
  std::vector<Moved> out;
  const Nodes &now = model.nodes, &was = before.nodes;
  for (NodeIndex n = 0; n < now.size(); ++n) {
    const NodeIndex old = was.map.find(now.id[n]);
    if (old == no_index) continue;
    const Moved m{n, {now.x[n] - was.x[old], now.y[n] - was.y[old], now.z[n] - was.z[old]}};
    if (m.by != std::array<double, 3>{}) out.push_back(m);
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Moved& a, const Moved& b) { return a.length() > b.length(); });
  return out;
}

}  // namespace

void use_moved(const Model& model, const Model& before, PageNodes& nodes) {
  for (const Moved& m : moved_nodes(model, before)) nodes.use(m.node);
}

std::string moved_block(const Model& model, const Model& before, const PageNodes& nodes) {
  const std::vector<Moved> all = moved_nodes(model, before);
  std::string out;
  JsonWriter j(out);
  j.begin_object(true).field("total", all.size()).key("rows").begin_array(true);
  for (std::size_t i = 0; i < std::min(all.size(), most_moved); ++i) {
    j.begin_array(true).value(nodes[all[i].node]);
    for (const double d : all[i].by) j.value(d);
    j.end_array();
  }
  j.end_array().end_object();
  return packed_text(out);
}

}  // namespace deck::detail
