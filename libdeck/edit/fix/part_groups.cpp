// Which parts hang together: a forest over the nodes.
#include "edit/fix/part_groups.hpp"

#include <numeric>
#include <set>

#include "edit/fix/common.hpp"
#include "model/shared/kinematics.hpp"

namespace deck::detail {
namespace {

constexpr ElementKind kinds_of_elements[] = {
    ElementKind::shell4, ElementKind::shell3, ElementKind::solid8, ElementKind::quad,
    ElementKind::tria,   ElementKind::truss,  ElementKind::beam,   ElementKind::spring};

class Forest {
 public:
  explicit Forest(std::size_t nodes) : above_(nodes) {
    std::iota(above_.begin(), above_.end(), 0u);
  }
  NodeIndex top(NodeIndex n) {
    while (above_[n] != n) n = above_[n] = above_[above_[n]];
    return n;
  }
  void join(NodeIndex a, NodeIndex b) {
    if (a == no_index || b == no_index) return;
    a = top(a);
    b = top(b);
    if (a != b) above_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<NodeIndex> above_;
};

void join_elements(const Model& model, Forest& forest) {
  for (const ElementKind kind : kinds_of_elements) {
    const Elements& family = model.family(kind);
    for (std::size_t e = 0; e < family.size(); ++e) {
      NodeIndex first = no_index;
      for (int k = 0; k < family.width; ++k) {
        const NodeIndex n = family.of(e)[k];
        if (first == no_index) first = n;
        forest.join(first, n);
      }
    }
  }
  // Mid nodes of solids.
  const Elements& solids = model.solid8;
  for (std::size_t e = 0; e < solids.extra.size(); ++e) {
    if (solids.extra[e] == no_index) continue;
    const std::size_t count = solids.shape[e] == SolidShape::tetra10   ? 6
                              : solids.shape[e] == SolidShape::brick20 ? 12
                                                                       : 8;
    for (std::size_t k = 0; k < count && solids.extra[e] + k < solids.extra_nodes.size(); ++k)
      forest.join(solids.of(e)[0], solids.extra_nodes[solids.extra[e] + k]);
  }
}

/// Conditions that keep nodes in place against each other.
bool joins(ConditionType type) {
  switch (type) {
    case ConditionType::rlink:
    case ConditionType::rbe2:
    case ConditionType::rbe3:
    case ConditionType::rbody:
    case ConditionType::cyl_joint:
      return true;
    default:
      return false;
  }
}

void join_conditions(const LoadedDeck& context, Forest& forest) {
  const Kinematics& kinematics = context.kinematics();
  std::vector<NodeIndex> first(kinematics.sources.size(), no_index);
  for (NodeIndex n = 0; n + 1 < kinematics.first.size(); ++n)
    for (const std::uint32_t source : kinematics.of(n)) {
      if (!joins(kinematics.sources[source].type)) continue;
      if (first[source] == no_index) first[source] = n;
      forest.join(first[source], n);
    }
  for (const Tie& tie : context.ties())
    for (const TiedNode& n : tie.nodes)
      if (n.tied && n.segment != no_index)
        for (const NodeIndex corner : tie.main[n.segment]) forest.join(n.node, corner);
}

void join_contacts(const Scene& scene, const FixOptions& options, Forest& forest) {
  for (const Contact& contact : scene.contacts) {
    if (!contact.ties() || is_wanted(options, contact)) continue;
    for (const PenetrationRow& row : contact.penetrations)
      if (contact.kind == ContactKind::node_segment)
        forest.join(contact.secondary[row.secondary].node, contact.main[row.main].nodes[0]);
      else
        forest.join(contact.secondary_edges[row.secondary].nodes[0],
                    contact.main_edges[row.main].nodes[0]);
  }
}

}  // namespace

PartGroups::PartGroups(const LoadedDeck& context, const Scene& scene, const FixOptions& options)
    : model_(context.model()) {
  Forest forest(model_.nodes.size());
  join_elements(model_, forest);
  join_conditions(context, forest);
  join_contacts(scene, options, forest);
  group_.resize(model_.nodes.size());
  for (NodeIndex n = 0; n < group_.size(); ++n) group_[n] = forest.top(n);
}

std::vector<NodeIndex> PartGroups::nodes_of(std::uint32_t group) const {
  std::vector<NodeIndex> out;
  for (NodeIndex n = 0; n < group_.size(); ++n)
    if (group_[n] == group) out.push_back(n);
  return out;
}

std::string PartGroups::name_of(std::uint32_t group) const {
  std::set<std::int64_t> ids;
  for (const ElementKind kind : kinds_of_elements) {
    const Elements& family = model_.family(kind);
    for (std::size_t e = 0; e < family.size(); ++e)
      if (const NodeIndex n = family.of(e)[0];
          n != no_index && group_[n] == group && family.part[e] != no_index)
        ids.insert(model_.parts[family.part[e]].id);
  }
  if (ids.empty()) return "node " + std::to_string(model_.node_id(group));
  if (ids.size() == 1) return "part " + std::to_string(*ids.begin());
  constexpr std::size_t most = 5;
  std::string out = "parts";
  std::size_t shown = 0;
  for (const std::int64_t id : ids) {
    if (shown++ == most) break;
    out += (shown > 1 ? ", " : " ") + std::to_string(id);
  }
  if (ids.size() > most) out += " and " + std::to_string(ids.size() - most) + " more";
  return out + " (they hang together)";
}

}  // namespace deck::detail
