// Crossed elements in the page: the edge, its element, and the segment that it passes through.
#include <algorithm>

#include "report/html/parts.hpp"

namespace deck::detail {
namespace {

constexpr std::size_t most_crossings = 20000;

}  // namespace

void use_nodes(const std::vector<Crossing>& crossings, PageNodes& nodes) {
  for (const Crossing& c : crossings)
    for (const NodeIndex n : c.edge) nodes.use(n);
}

std::string crossings_block(const Model& model, const std::vector<Crossing>& crossings,
                            const PageNodes& nodes) {
  std::string out;
  JsonWriter j(out);
  j.begin_object(true).field("total", crossings.size());
  j.key("rows").begin_array(true);
  for (std::size_t i = 0; i < std::min(crossings.size(), most_crossings); ++i) {
    const Crossing& c = crossings[i];
    j.begin_array(true).value(c.contact).value(nodes[c.edge[0]]).value(nodes[c.edge[1]]);
    j.value(static_cast<int>(c.edge_kind)).value(model.family(c.edge_kind).id[c.edge_element]);
    j.value(c.main).end_array();
  }
  j.end_array().end_object();
  return packed_text(out);
}

}  // namespace deck::detail
