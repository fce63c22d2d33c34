// Parts and element groups: /GRSHEL … /GRSPRI and /GRPART; lists of parts, materials, properties,
// subsets and submodels as tags per part.
#include <algorithm>

#include "model/selection/selection_impl.hpp"
#include "model/shared/families.hpp"
#include "text/shared/columns.hpp"

namespace deck {

using detail::Definition;
using detail::FamilyName;
using detail::IdList;
using detail::IdRef;
using detail::Indices;

namespace {

/// Ids of a subset and its descendants, without duplicates; stops at cycles.
void collect_subsets(const Model& model, std::int64_t id, std::set<std::int64_t>& seen) {
  std::vector<std::int64_t> open{id};
  while (!open.empty()) {
    const std::int64_t next = open.back();
    open.pop_back();
    if (!seen.insert(next).second) continue;
    const auto it = model.subset_children.find(next);
    if (it != model.subset_children.end())
      open.insert(open.end(), it->second.begin(), it->second.end());
  }
}

bool in_submodel(const Deck& deck, std::int32_t submodel, std::int64_t id) {
  for (; submodel >= 0; submodel = deck.submodels[static_cast<std::size_t>(submodel)].parent)
    if (detail::submodel_id(deck, deck.submodels[static_cast<std::size_t>(submodel)]) == id)
      return true;
  return false;
}

const char* lower_name(std::string_view type) {
  if (type == "PART") return "part";
  if (type == "MAT") return "material";
  if (type == "PROP") return "property";
  if (type == "SUBSET" || type == "SUBS") return "subset";
  return "submodel";
}

}  // namespace

const PartElements& Selections::Impl::elements_of_parts(ElementKind kind) {
  const auto i = static_cast<std::size_t>(kind);
  if (!part_elements_ready[i]) {
    part_elements_cache[i] = connect_parts(model->family(kind), model->parts.size());
    part_elements_ready[i] = true;
  }
  return part_elements_cache[i];
}

void Selections::Impl::report_unread(const Block& block, const Indices& parts) {
  if (!parts_with_unread) {
    parts_with_unread.emplace();
    for (const Block& b : deck().blocks) {
      if (!detail::is_below(b.header, "/SPHCEL") && !detail::is_below(b.header, "/XELEM")) continue;
      const auto it = model->part_of_id.find(b.id.value + deck().offset_of(b, "part"));
      if (it == model->part_of_id.end()) continue;
      parts_with_unread->resize(model->parts.size(), false);
      (*parts_with_unread)[it->second] = true;
    }
  }
  if (parts_with_unread->empty()) return;
  const auto hit = std::find_if(parts.begin(), parts.end(),
                                [&](std::uint32_t p) { return (*parts_with_unread)[p]; });
  if (hit == parts.end()) return;
  report(block, RuleId::DK164,
         detail::name_of(block) + ": part " + std::to_string(model->parts[*hit].id) +
             " has particles (/SPHCEL) or strands (/XELEM), which deck does not evaluate");
}

bool Selections::Impl::is_part_type(std::string_view type) {
  return type == "PART" || type == "MAT" || type == "PROP" || type == "SUBSET" ||
         type == "SUBMODEL";
}

Indices Selections::Impl::parts_of(std::string_view type, std::int64_t id, bool& known) const {
  const Model& m = *model;
  Indices out;
  known = false;
  const auto all_parts_where = [&](auto&& matches) {
    for (std::uint32_t p = 0; p < m.parts.size(); ++p)
      if (matches(m.parts[p])) out.push_back(p);
  };
  if (type == "PART") {
    if (const auto it = m.part_of_id.find(id); it != m.part_of_id.end()) out = {it->second};
    known = !out.empty();
  } else if (type == "MAT") {
    known = m.material_of_id.count(id) > 0;
    all_parts_where([&](const Part& p) { return p.mat_id == id; });
  } else if (type == "PROP") {
    known = m.property_of_id.count(id) > 0;
    all_parts_where([&](const Part& p) { return p.prop_id == id; });
  } else if (type == "SUBSET" || type == "SUBS") {
    known = m.subset_children.count(id) > 0;
    std::set<std::int64_t> subsets;
    collect_subsets(m, id, subsets);
    if (known) all_parts_where([&](const Part& p) { return subsets.count(p.subset_id) > 0; });
  } else {
    known = m.submodels.count(id) > 0;
    all_parts_where([&](const Part& p) { return in_submodel(deck(), p.submodel, id); });
  }
  return out;
}

std::vector<std::int8_t> Selections::Impl::part_tags(const Block& block, std::string_view type,
                                                     const IdList& list) {
  std::vector<std::int8_t> tags(model->parts.size(), 0);
  std::vector<IdRef> missing, hollow;
  const auto apply = [&](const std::vector<IdRef>& refs, std::int8_t tag) {
    for (const IdRef& ref : refs) {
      bool known = false;
      const Indices parts = parts_of(type, ref.id, known);
      if (!known)
        missing.push_back(ref);
      else if (parts.empty() && type == "SUBSET")
        hollow.push_back(ref);
      for (const std::uint32_t p : parts)
        if (tags[p] == 0) tags[p] = tag;
    }
  };
  apply(list.positive, 1);
  apply(list.negative, -1);
  report_missing(RuleId::DK151, block, lower_name(type), missing, 194);
  if (!hollow.empty())
    report({RuleId::DK166, hollow.front().span,
            detail::name_of(block) + " lists subset " + std::to_string(hollow.front().id) +
                ", which holds no part",
            std::string(block.keyword), block.id.value});
  return tags;
}

std::int64_t Selections::Impl::element_id(Carrier carrier, std::uint32_t e) const {
  const auto family = detail::family_of_carrier(carrier);
  return family && e != no_index ? model->family(*family).id[e] : 0;
}

const Indices* Selections::Impl::element_group(const FamilyName& name, std::int64_t id) {
  const auto family = static_cast<std::size_t>(name.kind);
  return resolved(
      element_groups[family], name.group, id, 176,
      [&](const Definition& def, const DecodedBlock& d) {
        Indices members = resolve_elements(name, def, d);
        keep(members, *def.block);
        return members;
      },
      [&](const detail::SetState& state, const Block& block) {
        Indices members;
        state.for_each_group([&](const detail::SetGroup& group) {
          const Indices& some = group.elements[family];
          if (fits(members.size() + some.size(), sizeof some[0], block))
            members.insert(members.end(), some.begin(), some.end());
        });
        detail::normalise(members);
        keep(members, block);
        return members;
      });
}

Indices Selections::Impl::resolve_elements(const FamilyName& name, const Definition& def,
                                           const DecodedBlock& d) {
  const Block& block = *def.block;
  const Elements& family = model->family(name.kind);
  Indices out;
  std::vector<IdRef> missing;
  if (def.type == name.member) {
    // Elements keep the order of their first mention.
    std::vector<bool> seen(family.size());
    for (const IdRef& ref : id_list(d).positive) {
      const std::uint32_t e = family.map.find(ref.id);
      if (e == no_index) {
        missing.push_back(ref);
      } else if (!seen[e]) {
        seen[e] = true;
        out.push_back(e);
      }
    }
    // Without elements of the kind the solver does not check them.
    report_missing(RuleId::DK168, block, "element", missing, family.size() > 0 ? 70 : 0);
    return out;
  }
  if (is_part_type(def.type)) {
    const auto tags = part_tags(block, def.type, id_list(d));
    const PartElements& rows = elements_of_parts(name.kind);
    for (std::size_t p = 0; p < tags.size(); ++p)
      if (tags[p] > 0) detail::append(out, rows.row(p));
  } else if (def.type == "BOX" || def.type == "BOX2") {
    const IdList list = id_list(d);
    const bool any_node = def.type == "BOX2";
    out = elements_in_boxes(block, list.positive, name.kind, any_node, 798);
    out = detail::without(out, elements_in_boxes(block, list.negative, name.kind, any_node, 798));
  } else if (def.type == "GENE" || def.type == "GEN_INCR") {
    for (const detail::IdRange& range : id_ranges(d, name.id_kind)) {
      // A pair must ascend.
      if (def.type == "GENE" && range.last == range.first) continue;
      for (std::uint32_t e = 0; e < family.size(); ++e)
        if (range.contains(family.id[e])) out.push_back(e);
      if (!fits(out.size(), sizeof out[0], block)) break;
    }
  } else if (def.type == name.keyword) {
    const IdList list = id_list(d);
    const auto get = [&](std::int64_t id) { return element_group(name, id); };
    out = joined(list.positive, missing, block, get);
    Indices gone = joined(list.negative, missing, block, get);
    report_missing(RuleId::DK151, block, "element group", missing, 172);
    detail::normalise(out);
    detail::normalise(gone);
    out = detail::without(out, gone);
  }
  detail::normalise(out);
  return out;
}

Indices Selections::Impl::elements_in_box(const detail::BoxVolume& b, ElementKind kind,
                                          bool any_node) const {
  const Elements& family = model->family(kind);
  const int count = detail::carrying_nodes(kind);
  Indices out;
  for (std::uint32_t e = 0; e < family.size(); ++e) {
    const NodeIndex* n = family.of(e);
    int in = 0, present = 0;
    for (int i = 0; i < count; ++i) {
      if (n[i] == no_index) continue;
      ++present;
      const auto p = box_point(n[i]);
      in += b.contains(p[0], p[1], p[2]);
    }
    if (present > 0 && (any_node ? in > 0 : in == present)) out.push_back(e);
  }
  return out;
}

Indices Selections::Impl::elements_in_boxes(const Block& block, const std::vector<IdRef>& ids,
                                            ElementKind kind, bool any_node, int missing_number) {
  Indices out;
  for (const IdRef& ref : ids) {
    const detail::BoxVolume* b = box(ref.id, block, missing_number);
    if (b == nullptr) continue;
    const Indices in = elements_in_box(*b, kind, any_node);
    out.insert(out.end(), in.begin(), in.end());
  }
  detail::normalise(out);
  return out;
}

const Indices* Selections::Impl::part_group(std::int64_t id) {
  return resolved(
      part_groups, "grpart", id, 176,
      [&](const Definition& def, const DecodedBlock& d) {
        Indices parts = resolve_part_group(def, d);
        keep(parts, *def.block);
        return parts;
      },
      [](const detail::SetState& state, const Block&) { return state.parts; });
}

Indices Selections::Impl::resolve_part_group(const Definition& def, const DecodedBlock& d) {
  const Block& block = *def.block;
  Indices out, gone;
  if (is_part_type(def.type)) {
    const auto tags = part_tags(block, def.type, id_list(d));
    for (std::uint32_t p = 0; p < tags.size(); ++p)
      if (tags[p] > 0) out.push_back(p);
  } else if (def.type == "GENE" || def.type == "GEN_INCR") {
    for (const detail::IdRange& range : id_ranges(d, "part"))
      for (std::uint32_t p = 0; p < model->parts.size(); ++p)
        if (range.contains(model->parts[p].id)) out.push_back(p);
  } else if (def.type == "GRPART") {
    std::vector<IdRef> missing;
    const IdList list = id_list(d);
    const auto get = [&](std::int64_t id) { return part_group(id); };
    out = joined(list.positive, missing, block, get);
    gone = joined(list.negative, missing, block, get);
    report_missing(RuleId::DK151, block, "part group", missing, 172);
  }
  detail::normalise(out);
  detail::normalise(gone);
  return detail::without(out, gone);
}

}  // namespace deck
