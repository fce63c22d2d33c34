// Many nodes at one place, as a part that was exported at the origin has them: reported once,
// because every node is then on every segment of the others.
#include <fmt/format.h>

#include <algorithm>

#include "contact/shared/scene_parts.hpp"
#include "deck/text/rule.hpp"

namespace deck::detail {

void report_one_place(SceneContext& c, const Contact& contact) {
  const Coordinates& x = c.scene.coordinates;
  std::vector<NodeIndex> touching;
  for (const PenetrationRow& row : contact.penetrations) {
    if (!row.on_surface) continue;
    if (contact.kind == ContactKind::node_segment) {
      touching.push_back(contact.secondary[row.secondary].node);
    } else {
      const auto& nodes = contact.secondary_edges[row.secondary].nodes;
      touching.insert(touching.end(), nodes.begin(), nodes.end());
    }
  }
  const auto place = [&](NodeIndex n) { return std::array{x.x[n], x.y[n], x.z[n]}; };
  const auto before = [&](NodeIndex a, NodeIndex b) {
    return std::tuple(place(a), a) < std::tuple(place(b), b);
  };
  std::sort(touching.begin(), touching.end());
  touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
  std::sort(touching.begin(), touching.end(), before);
  constexpr std::ptrdiff_t most = 8;  // what joints and seams need
  for (auto first = touching.begin(); first != touching.end();) {
    const auto last =
        std::find_if(first, touching.end(), [&](NodeIndex n) { return place(n) != place(*first); });
    if (last - first > most && c.diagnostics.wants(RuleId::DK336)) {
      const auto at = place(*first);
      Diagnostic d = finding_of(
          RuleId::DK336, contact.inter->span,
          fmt::format("/INTER/TYPE{} {}: {} nodes at one place ({:.6g}, {:.6g}, {:.6g}), {} and {} "
                      "among them",
                      contact.inter->type, contact.inter->id, last - first, at[0], at[1], at[2],
                      c.model.node_id(*first), c.model.node_id(*(last - 1))));
      d.keyword = "/INTER/TYPE" + std::to_string(contact.inter->type);
      d.id = contact.inter->id;
      d.notes.emplace_back(c.model.node_span(*first), "one of the nodes");
      c.diagnostics.add(std::move(d));
    }
    first = last;
  }
}

}  // namespace deck::detail
