// Where in the deck a finding of the gate comes from.
#include "lint/gate/gate_places.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/shared/length_text.hpp"

namespace deck::detail {
namespace {

/// Penetrations whose lines are looked at; the others are less deep.
constexpr std::size_t most_rows = 10'000;

std::vector<std::uint32_t> deepest(const std::vector<std::uint32_t>& rows) {
  return {rows.begin(),
          rows.begin() + static_cast<std::ptrdiff_t>(std::min(most_rows, rows.size()))};
}

}  // namespace

GatePlaces::GatePlaces(const Scene& scene, const SceneView& view, const ChangedLines* lines)
    : scene_(scene), view_(view), model_(*scene.model) {
  if (lines != nullptr && !lines->empty()) changed_.emplace(*lines, model_.deck->sources);
}

bool GatePlaces::add_changed(Notes& notes, const Span& span, const std::string& what) {
  const Span line = changed_->first_in(span);
  if (!line.valid()) return false;
  notes.emplace_back(line, what + " was changed");
  return true;
}

bool GatePlaces::add_changed(Notes& notes, const Block* block, const std::string& what) {
  if (block == nullptr) return false;
  // Long blocks are in no way among these: interfaces, parts, properties, materials.
  for (const Piece& piece : block->body)
    if (add_changed(notes,
                    {piece.file, static_cast<std::uint32_t>(piece.end - piece.begin), piece.begin},
                    what))
      return true;
  return add_changed(notes, block->header_span, what);
}

bool GatePlaces::add_node(Notes& notes, std::int64_t id, const char* what) {
  const NodeIndex n = id == 0 ? no_index : model_.find_node(id);
  return n != no_index && add_changed(notes, model_.node_span(n), fmt::format("{} {}", what, id));
}

bool GatePlaces::add_elements(Notes& notes, const std::vector<std::uint32_t>& rows) {
  for (const std::uint32_t i : rows)
    for (const ElementName& e :
         {view_.penetrations[i].secondary_element, view_.penetrations[i].main_element})
      if (e.valid() &&
          add_changed(notes, model_.element_span(e.kind, e.index), fmt::format("element {}", e.id)))
        return true;
  return false;
}

bool GatePlaces::add_parts(Notes& notes, const std::vector<std::uint32_t>& rows) {
  std::set<std::int64_t> ids;
  for (const std::uint32_t i : rows) {
    ids.insert(view_.penetrations[i].secondary_element.part);
    ids.insert(view_.penetrations[i].main_element.part);
  }
  for (const std::int64_t id : ids) {
    const auto it = model_.part_of_id.find(id);
    if (it == model_.part_of_id.end()) continue;
    const Part& part = model_.parts[it->second];
    if (part.prop != no_index) {
      const Property& property = model_.properties[part.prop];
      if (add_changed(notes, property.block, fmt::format("{} {}", property.type, property.id)))
        return true;
    }
    if (part.mat != no_index) {
      const Material& material = model_.materials[part.mat];
      if (add_changed(notes, material.block, fmt::format("{} {}", material.type, material.id)))
        return true;
    }
    if (add_changed(notes, part.span, fmt::format("part {}", id))) return true;
  }
  return false;
}

std::string GatePlaces::secondary_text(const NamedPenetration& p) const {
  return p.secondary[1] == 0 ? fmt::format("node {}", p.secondary[0])
                             : fmt::format("edge {}-{}", p.secondary[0], p.secondary[1]);
}

GatePlaces::Notes GatePlaces::of_penetrations(const InterBase* inter,
                                              const std::vector<std::uint32_t>& all) {
  Notes notes;
  if (all.empty()) return notes;
  const NamedPenetration& first = view_.penetrations[all.front()];
  if (const NodeIndex n = model_.find_node(first.secondary[0]); n != no_index) {
    const PenetrationRow& row = scene_.contacts[first.contact].penetrations[first.row];
    notes.emplace_back(model_.node_span(n),
                       fmt::format("{} is {} deep", secondary_text(first), length_text(row.depth)));
  }
  if (!changed_) return notes;
  const std::vector<std::uint32_t> rows = deepest(all);
  for (const std::uint32_t i : rows)
    for (const std::int64_t id : view_.penetrations[i].secondary)
      if (add_node(notes, id, "node")) return notes;
  for (const std::uint32_t i : rows)
    for (const std::int64_t id : view_.penetrations[i].main)
      if (add_node(notes, id, "node of the main side,")) return notes;
  if (inter != nullptr &&
      add_changed(notes, inter->block, fmt::format("/INTER/TYPE{} {}", inter->type, inter->id)))
    return notes;
  if (!add_parts(notes, rows)) add_elements(notes, rows);
  return notes;
}

GatePlaces::Notes GatePlaces::of_nodes(const InterBase* inter,
                                       const std::vector<std::int64_t>& nodes) {
  Notes notes;
  if (!nodes.empty())
    if (const NodeIndex n = model_.find_node(nodes.front()); n != no_index)
      notes.emplace_back(model_.node_span(n), fmt::format("node {}", nodes.front()));
  if (!changed_) return notes;
  for (std::size_t i = 0; i < std::min(most_rows, nodes.size()); ++i)
    if (add_node(notes, nodes[i], "node")) return notes;
  for (auto& note : of_interface(inter)) notes.push_back(std::move(note));
  return notes;
}

GatePlaces::Notes GatePlaces::of_interface(const InterBase* inter) {
  Notes notes;
  if (changed_ && inter != nullptr)
    add_changed(notes, inter->block, fmt::format("/INTER/TYPE{} {}", inter->type, inter->id));
  return notes;
}

}  // namespace deck::detail
