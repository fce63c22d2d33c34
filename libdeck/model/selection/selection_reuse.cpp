// Compares what the members of groups depend on.
#include <algorithm>

#include "deck/model/reuse.hpp"

namespace deck {
namespace {

bool same_elements(const Elements& a, const Elements& b) {
  return a.id == b.id && a.part == b.part && a.nodes == b.nodes && a.shape == b.shape &&
         a.extra == b.extra && a.extra_nodes == b.extra_nodes;
}

bool same_part(const Part& a, const Part& b) {
  return a.id == b.id && a.prop_id == b.prop_id && a.mat_id == b.mat_id &&
         a.subset_id == b.subset_id && a.submodel == b.submodel;
}

bool has_boxes(const Model& m) {
  return std::any_of(m.deck->blocks.begin(), m.deck->blocks.end(),
                     [](const Block& b) { return b.schema != nullptr && b.schema->kind == "box"; });
}

bool same_places(const Model& a, const Model& b) {
  if (a.nodes.x != b.nodes.x || a.nodes.y != b.nodes.y || a.nodes.z != b.nodes.z) return false;
  // Rare enough beside boxes: taken for different.
  return a.before_transforms == nullptr && b.before_transforms == nullptr &&
         a.submodel_motions.empty() && b.submodel_motions.empty();
}

template <class Map>
bool same_keys(const Map& a, const Map& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& x, const auto& y) { return x.first == y.first; });
}

}  // namespace

bool same_members(const Model& a, const Model& b) {
  if (a.nodes.id != b.nodes.id || a.merged_nodes != b.merged_nodes) return false;
  for (const auto family :
       {&ModelData::shell4, &ModelData::shell3, &ModelData::solid8, &ModelData::quad,
        &ModelData::tria, &ModelData::truss, &ModelData::beam, &ModelData::spring})
    if (!same_elements(a.*family, b.*family)) return false;
  return std::equal(a.parts.begin(), a.parts.end(), b.parts.begin(), b.parts.end(), same_part) &&
         a.subset_children == b.subset_children && same_keys(a.submodels, b.submodels) &&
         same_keys(a.material_of_id, b.material_of_id) &&
         same_keys(a.property_of_id, b.property_of_id) && a.two_dimensional == b.two_dimensional &&
         (!has_boxes(a) || same_places(a, b));
}

}  // namespace deck
