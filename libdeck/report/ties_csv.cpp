// Ties as CSV: one line a secondary node.
#include <fmt/format.h>

#include <iterator>

#include "base/shared/escape.hpp"
#include "contact/shared/element_names.hpp"
#include "deck/contact/ties.hpp"
#include "deck/report/gaps.hpp"
#include "model/shared/families.hpp"
#include "model/shared/item_spans.hpp"

namespace deck {
namespace {

std::string optional(bool known, double v) { return known ? fmt::format("{}", v) : std::string(); }

}  // namespace

std::string ties_csv(const Deck& deck, const Scene& scene, const TextDrain& drain) {
  std::string out =
      "interface,node,part,tied,penalty,message,main_1,main_2,main_3,main_4,s,t,distance,search,"
      "nearest_distance,why,x,y,z,file,line\r\n";
  const Model& model = *scene.model;
  Connectivity connectivity(model);
  for (const Tie& tie : scene.ties) {
    std::vector<NodeIndex> nodes;
    for (const TiedNode& n : tie.nodes) nodes.push_back(n.node);
    const std::vector<Span> spans = detail::node_spans(model, nodes);
    for (std::size_t i = 0; i < tie.nodes.size(); ++i) {
      const TiedNode& n = tie.nodes[i];
      const bool found = n.segment != no_index;
      const std::int64_t part = element_at(model, connectivity, n.node).part;
      fmt::format_to(std::back_inserter(out), "{},{},{},{},{},{}", tie.inter->id,
                     model.node_id(n.node), part == 0 ? "" : fmt::format("{}", part),
                     n.tied ? 1 : 0, n.penalty ? 1 : 0,
                     n.message == 0 ? "" : fmt::format("{}", n.message));
      const std::uint32_t segment = found ? n.segment : n.nearest;
      for (std::size_t k = 0; k < 4; ++k)
        out += segment == no_index ? std::string(",")
                                   : fmt::format(",{}", model.node_id(tie.main[segment][k]));
      fmt::format_to(
          std::back_inserter(out), ",{},{},{},{},{},{},{},{},{},{},{}\r\n", optional(found, n.s),
          optional(found, n.t), optional(found, n.distance), optional(n.search != 0, n.search),
          optional(n.nearest != no_index, n.nearest_distance), csv_text(short_reason(tie, n)),
          model.nodes.x[n.node], model.nodes.y[n.node], model.nodes.z[n.node],
          spans[i].valid() ? csv_text(terminal_text(deck.sources[spans[i].file].path()))
                           : std::string(),
          spans[i].valid() ? fmt::format("{}", deck.sources.position(spans[i]).line)
                           : std::string());
      drain_text(drain, out);
    }
  }
  return out;
}

}  // namespace deck
