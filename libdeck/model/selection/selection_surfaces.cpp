// Surfaces: /SURF of every type, in the solver's creation order with its final sort by carrier and
// element id. Surfaces of shells of parts are kept as runs of elements; their segments are formed
// on demand.
#include <algorithm>
#include <array>
#include <utility>

#include "model/selection/selection_impl.hpp"

namespace deck {

using detail::Definition;
using detail::IdList;
using detail::IdRef;
using detail::Indices;

namespace {

Segment turned(Segment s) {
  if (s.nodes[2] == s.nodes[3])
    s.nodes = {s.nodes[2], s.nodes[1], s.nodes[0], s.nodes[0]};
  else
    s.nodes = {s.nodes[3], s.nodes[2], s.nodes[1], s.nodes[0]};
  return s;
}

/// Rotates to the smallest node; triangles repeat the last node again.
std::array<NodeIndex, 4> from_smallest(const std::array<NodeIndex, 4>& n) {
  const std::size_t corners = n[2] == n[3] ? 3 : 4;
  std::size_t least = 0;
  for (std::size_t i = 1; i < corners; ++i)
    if (n[i] < n[least]) least = i;
  std::array<NodeIndex, 4> out{};
  for (std::size_t i = 0; i < corners; ++i) out[i] = n[(least + i) % corners];
  if (corners == 3) out[3] = out[2];
  return out;
}

/// Segment of shell `e` with these nodes.
Segment segment_of(const NodeIndex* n, bool quadrangle, Carrier carrier, std::uint32_t e,
                   bool reversed) {
  if (!reversed) return {{n[0], n[1], n[2], quadrangle ? n[3] : n[2]}, carrier, e};
  // A quadrangle is reversed as such even if its last two nodes are equal.
  if (quadrangle) return {{n[3], n[2], n[1], n[0]}, carrier, e};
  return {{n[2], n[1], n[0], n[0]}, carrier, e};
}

}  // namespace

const Surface* Selections::Impl::surface(std::int64_t id) {
  keep_runs(id);
  return resolved(
      surfaces, "surf", id, 189,
      [&](const Definition& def, const DecodedBlock& d) {
        Surface s{id, d.title, {}, false, def.block->header_span};
        s.segments = resolve_surface(def, d, s.analytical);
        keep(s.segments, *def.block);
        sort_segments(s.segments);
        // Beams and trusses of parts are segments to the solver.
        if (s.segments.empty() && !s.analytical && all_held && !is_part_type(def.type))
          report(*def.block, RuleId::DK154, detail::name_of(*def.block) + " has no segment",
                 {.message = 692});
        return s;
      },
      [&](const detail::SetState& state, const Block& block) {
        detail::SegmentsOfGroup last;
        const auto whole = sets.find(id);
        Surface view{
            id, set_title(block),
            whole != sets.end() ? whole->second.segments : set_segment_list(state, block, last),
            false, block.header_span};
        keep(view.segments, block);
        return view;
      });
}

std::vector<Segment> Selections::Impl::resolve_surface(const Definition& def, const DecodedBlock& d,
                                                       bool& analytical) {
  const Block& block = *def.block;
  const std::string_view type = def.type;
  if (type == "SEG") return segments_by_nodes(block, d);
  if (is_part_type(type)) return segments_of_parts(def, part_tags(block, type, id_list(d)));
  if (type == "BOX" || type == "BOX2") return segments_in_boxes(def, d);
  if (type == "GRSHEL" || type == "GRSH3N" || type == "GRTRIA" || type == "GRBRIC")
    return segments_of_groups(def, d);
  if (type == "SURF") return segments_of_surfaces(block, d);
  if (type == "DSURF") return difference_of_surfaces(block, d);
  analytical = type == "PLANE" || type == "ELLIPS" || type == "MDELLIPS";
  if (!analytical)
    report(block, RuleId::DK165,
           std::string(block.header) + " is not a combination that defines a surface");
  return {};
}

void Selections::Impl::sort_segments(std::vector<Segment>& segments) const {
  const auto before = [&](const Segment& a, const Segment& b) {
    if (a.carrier != b.carrier) return a.carrier < b.carrier;
    if (a.element == b.element) return false;
    return element_id(a.carrier, a.element) < element_id(b.carrier, b.element);
  };
  if (std::is_sorted(segments.begin(), segments.end(), before)) return;
  struct Key {
    std::uint64_t id;
    std::uint32_t place;
    std::uint32_t low() const { return static_cast<std::uint32_t>(id); }
    std::uint32_t high() const { return static_cast<std::uint32_t>(id >> 32); }
  };
  const auto in_order = [](const Key&, const Key&) { return false; };
  std::array<std::vector<Key>, static_cast<std::size_t>(Carrier::shell3) + 1> by_carrier;
  for (std::uint32_t i = 0; i < segments.size(); ++i) {
    const Segment& s = segments[i];
    const auto id = static_cast<std::uint64_t>(element_id(s.carrier, s.element));
    by_carrier[static_cast<std::size_t>(s.carrier)].push_back({id, i});
  }
  std::vector<Segment> sorted;
  sorted.reserve(segments.size());
  for (std::vector<Key>& keys : by_carrier) {
    detail::sort_by_bucket(
        keys, [](const Key& k) { return k.low(); }, in_order);
    if (std::any_of(keys.begin(), keys.end(), [](const Key& k) { return k.high() != 0; }))
      detail::sort_by_bucket(
          keys, [](const Key& k) { return k.high(); }, in_order);
    for (const Key& key : keys) sorted.push_back(segments[key.place]);
  }
  segments = std::move(sorted);
}

std::vector<Segment> Selections::Impl::segments_by_nodes(const Block& block,
                                                         const DecodedBlock& d) {
  std::vector<Segment> out;
  std::vector<IdRef> missing;
  const std::size_t fewest = model->two_dimensional ? 2 : 3;
  for (const DecodedCard& card : d.cards) {
    Segment s;
    std::size_t have = 0;
    bool complete = true;
    std::size_t at = 0;
    for (const Cell& cell : card.cells) {
      if (cell.field->ref != "node") continue;
      // Only the fourth node may be blank; in two dimensions a segment has two nodes.
      if (cell.integer != 0 || at < fewest) {
        const std::int64_t id = deck().shifted_id(block, "node", cell.integer);
        s.nodes[have] = node(id);
        if (s.nodes[have] == no_index) {
          missing.push_back({id, cell.span});
          complete = false;
        }
        ++have;
      }
      if (++at == 4) break;
    }
    if (!complete || have < fewest) continue;
    for (std::size_t k = have; k < 4; ++k) s.nodes[k] = s.nodes[k - 1];
    if (have == 2)
      out.push_back(s);
    else
      add_plain_segment(s, out);
  }
  report_missing(RuleId::DK150, block, "node", missing, 78);
  return out;
}

void Selections::Impl::add_plain_segment(const Segment& s, std::vector<Segment>& out) {
  const Elements& solids = model->solid8;
  if (!tetra_faces) {
    tetra_faces = std::make_unique<detail::KeyTable>(0);
    for (std::uint32_t e = 0; e < solids.size(); ++e) {
      if (solids.shape[e] != SolidShape::tetra10 || solids.extra[e] == no_index) continue;
      for (int f = 2; f < 6; ++f) {
        const detail::Face face = detail::solid_face(solids.of(e), f);
        if (face.corners != 3) continue;
        if (tetra_faces->insert(detail::node_key(face.nodes.data(), 3)) == tetra_face_of.size())
          tetra_face_of.emplace_back(e, f);
      }
    }
  }
  const bool triangle = s.nodes[2] == s.nodes[3];
  const std::uint32_t at = triangle && tetra_faces->size() > 0
                               ? tetra_faces->find(detail::node_key(s.nodes.data(), 3))
                               : no_index;
  if (at == no_index) {
    out.push_back(s);
    return;
  }
  const auto [e, f] = tetra_face_of[at];
  const detail::Face face = detail::solid_face(solids.of(e), f);
  const auto face_mids = detail::tetra10_mids(solids, e, f);
  // The mid-side node of each side of the segment, in either sense.
  std::array<NodeIndex, 3> mids{no_index, no_index, no_index};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeIndex a = face.nodes[k], b = face.nodes[(k + 1) % 3];
      const NodeIndex p = s.nodes[i], q = s.nodes[(i + 1) % 3];
      if ((a == p && b == q) || (a == q && b == p)) mids[i] = face_mids[k];
    }
  std::array<std::array<NodeIndex, 4>, 4> pieces;
  const int count = detail::cut_triangle({s.nodes[0], s.nodes[1], s.nodes[2]}, mids, pieces);
  for (int i = 0; i < count; ++i)
    out.push_back({pieces[static_cast<std::size_t>(i)], s.carrier, s.element});
}

void Selections::Impl::add_shells(const Elements& shells, const Indices& members, bool reversed,
                                  std::vector<Segment>& out) const {
  if (out.size() + members.size() > out.capacity())
    out.reserve(std::max(out.size() + members.size(), 3 * out.size() / 2));
  for (const std::uint32_t e : members) {
    const Segment s = detail::shell_segment(shells, e, reversed);
    if (std::find(s.nodes.begin(), s.nodes.end(), no_index) == s.nodes.end()) out.push_back(s);
  }
}

detail::ShellCover& Selections::Impl::cover() {
  if (!shell_cover)
    shell_cover = std::make_unique<detail::ShellCover>(model->shell4, model->shell3);
  return *shell_cover;
}

detail::SolidFaces& Selections::Impl::solid_faces() {
  if (!all_solid_faces) all_solid_faces = std::make_unique<detail::SolidFaces>(model->solid8);
  return *all_solid_faces;
}

void Selections::Impl::add_solids(const Block& block, std::string_view option, Indices members,
                                  std::vector<Segment>& out) {
  const Elements& solids = model->solid8;
  if (members.empty()) return;
  detail::normalise(members);
  if (option.empty()) {
    const std::uint32_t e = members.front();
    const std::uint32_t p = solids.part[e];
    Finding d = detail::finding_from(detail::finding_about(
        block, RuleId::DK155,
        detail::name_of(block) + " selects " + std::to_string(members.size()) +
            (members.size() == 1 ? " solid" : " solids") +
            " but does not say which faces; the first is solid " + std::to_string(solids.id[e]) +
            (p == no_index ? std::string() : " of part " + std::to_string(model->parts[p].id)),
        {.fix = "write " + std::string(block.keyword) +
                "/EXT for the exterior faces or /ALL for all"}));
    d.notes.emplace_back(model->element_span(ElementKind::solid8, e), "the solid");
    found.report(std::move(d));
    return;
  }
  const auto is_quadratic = [&](std::uint32_t e) {
    return solids.shape[e] == SolidShape::brick20 || solids.shape[e] == SolidShape::thick16;
  };
  const auto quadratic = std::find_if(members.begin(), members.end(), is_quadratic);
  if (quadratic != members.end()) {
    report(block, RuleId::DK156,
           detail::name_of(block) +
               " selects solids with 20 or 16 nodes, whose faces have mid-side nodes; the first "
               "is solid " +
               std::to_string(solids.id[*quadratic]));
    std::erase_if(members, is_quadratic);
  }
  Indices shells4, shells3;
  for (const Segment& s : out)
    (s.carrier == Carrier::shell4 ? shells4 : shells3).push_back(s.element);
  detail::FaceQuery query;
  query.solids = &members;
  query.exterior_only = option != "ALL";
  if (!out.empty()) {
    cover().select(shells4, shells3);
    query.cover = &cover();
  }
  query.against_all = option == "FREE";
  std::vector<detail::LostFace> lost;
  if (block.schema->keyword.starts_with("/SURF/GRBRIC") && query.exterior_only &&
      model->shell4.size() + model->shell3.size() > 0) {
    query.cover = &cover();
    query.by_part_place = true;
    query.lost = &lost;
  }
  solid_faces().add_segments(query, out);
  if (!lost.empty()) report_lost_faces(block, lost);
}

void Selections::Impl::report_lost_faces(const Block& block,
                                         const std::vector<detail::LostFace>& lost) {
  const auto [solid, shell] = lost.front();
  const Elements& shells = shell.four ? model->shell4 : model->shell3;
  const std::int64_t skin = model->parts[shells.part[shell.element]].id;
  const std::uint32_t part = model->solid8.part[solid];
  const std::string body =
      part == no_index ? "the solids" : "part " + std::to_string(model->parts[part].id);
  Finding d = detail::finding_from(detail::finding_about(
      block, RuleId::DK063,
      detail::name_of(block) + " lacks " +
          (lost.size() == 1 ? "1 face" : std::to_string(lost.size()) + " faces") +
          " of its solids; the first is the face of solid " +
          std::to_string(model->solid8.id[solid]) + " under shell " +
          std::to_string(shells.id[shell.element]) + " of part " + std::to_string(skin),
      {.fix = "name " + body + " in a /SURF/PART/EXT; with part " + std::to_string(skin) +
              " added, the shells replace the faces"}));
  d.notes.emplace_back(model->element_span(ElementKind::solid8, solid), "the solid");
  d.notes.emplace_back(
      model->element_span(shell.four ? ElementKind::shell4 : ElementKind::shell3, shell.element),
      "the shell");
  found.report(std::move(d));
}

std::vector<Segment> Selections::Impl::segments_of_parts(const Definition& def,
                                                         const std::vector<std::int8_t>& tags) {
  std::vector<Segment> out;
  for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3}) {
    const Elements& shells = model->family(kind);
    if (shells.size() == 0) continue;
    const PartElements& rows = elements_of_parts(kind);
    for (std::size_t p = 0; p < tags.size(); ++p) {
      if (tags[p] == 0) continue;
      Indices members;
      detail::append(members, rows.row(p));
      add_shells(shells, members, tags[p] < 0, out);
    }
  }
  Indices solids;
  if (model->solid8.size() > 0) {
    const PartElements& rows = elements_of_parts(ElementKind::solid8);
    for (std::size_t p = 0; p < tags.size(); ++p)
      if (tags[p] != 0) detail::append(solids, rows.row(p));
  }
  add_solids(*def.block, def.option, std::move(solids), out);
  return out;
}

std::vector<Segment> Selections::Impl::segments_in_boxes(const Definition& def,
                                                         const DecodedBlock& d) {
  const IdList list = id_list(d);
  const bool any_node = def.type == "BOX2";
  need_boxes(list, d, 800);
  std::vector<Segment> out;
  for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3}) {
    const Elements& shells = model->family(kind);
    const Indices plain = elements_in_boxes(*def.block, list.positive, kind, any_node, 800);
    Indices reversed = elements_in_boxes(*def.block, list.negative, kind, any_node, 800);
    std::erase_if(reversed, [&](std::uint32_t e) {
      return std::binary_search(plain.begin(), plain.end(), e);
    });
    add_shells(shells, plain, false, out);
    add_shells(shells, reversed, true, out);
  }
  Indices solids = elements_in_boxes(*def.block, list.positive, ElementKind::solid8, any_node, 800);
  const Indices more =
      elements_in_boxes(*def.block, list.negative, ElementKind::solid8, any_node, 800);
  solids.insert(solids.end(), more.begin(), more.end());
  add_solids(*def.block, def.option, std::move(solids), out);
  return out;
}

std::vector<Segment> Selections::Impl::segments_of_groups(const Definition& def,
                                                          const DecodedBlock& d) {
  const Block& block = *def.block;
  const ElementKind kind = def.type == "GRSHEL"   ? ElementKind::shell4
                           : def.type == "GRBRIC" ? ElementKind::solid8
                                                  : ElementKind::shell3;
  const detail::FamilyName& name = detail::family_name(kind);
  const IdList list = id_list(d);
  std::vector<Segment> out;
  std::vector<IdRef> missing;
  Indices solids;
  const auto collect = [&](const std::vector<IdRef>& refs, bool reversed) {
    for (const IdRef& ref : refs) {
      const Indices* group = element_group(name, ref.id);
      if (group == nullptr)
        missing.push_back(ref);
      else if (!fits(solids.size() + out.size() + group->size(), sizeof(Segment), block))
        break;
      else if (kind == ElementKind::solid8)
        solids.insert(solids.end(), group->begin(), group->end());
      else
        add_shells(model->family(kind), *group, reversed, out);
    }
  };
  collect(list.positive, false);
  collect(list.negative, true);
  report_missing(RuleId::DK151, block, "element group", missing, 192);
  if (kind != ElementKind::solid8) return out;
  if (def.option.empty()) {
    report(block, RuleId::DK157,
           "/SURF/GRBRIC " + std::to_string(block.id.value) + " does not say which faces");
    return out;
  }
  add_solids(block, def.option, std::move(solids), out);
  return out;
}

const std::vector<Segment>* Selections::Impl::listed_surface(const Block& block, const IdRef& ref,
                                                             std::vector<IdRef>& missing) {
  if (recursive("surf", ref.id, block, 189)) return nullptr;
  const Surface* s = surface(ref.id);
  if (s == nullptr) {
    missing.push_back(ref);
    return nullptr;
  }
  if (s->analytical) {
    report({RuleId::DK158, ref.span,
            detail::name_of(block) + " lists surface " + std::to_string(ref.id) +
                ", which is analytical",
            std::string(block.keyword), block.id.value});
    return nullptr;
  }
  return &s->segments;
}

std::vector<Segment> Selections::Impl::segments_of_surfaces(const Block& block,
                                                            const DecodedBlock& d) {
  const IdList list = id_list(d);
  std::vector<Segment> out;
  std::vector<IdRef> missing;
  const auto collect = [&](const std::vector<IdRef>& refs, auto&& as) {
    for (const IdRef& ref : refs)
      if (const auto* segments = listed_surface(block, ref, missing);
          segments != nullptr && fits(out.size() + segments->size(), sizeof(Segment), block))
        std::transform(segments->begin(), segments->end(), std::back_inserter(out), as);
  };
  collect(list.positive, [](const Segment& s) { return s; });
  collect(list.negative, turned);
  report_missing(RuleId::DK151, block, "surface", missing, 188);
  return out;
}

std::vector<Segment> Selections::Impl::difference_of_surfaces(const Block& block,
                                                              const DecodedBlock& d) {
  const IdList list = id_list(d);
  std::vector<Segment> out;
  std::vector<Segment> gone;
  std::vector<IdRef> missing;
  const auto collect = [&](const std::vector<IdRef>& refs, std::vector<Segment>& into) {
    for (const IdRef& ref : refs)
      if (const auto* segments = listed_surface(block, ref, missing);
          segments != nullptr && fits(into.size() + segments->size(), sizeof(Segment), block))
        for (Segment s : *segments) {
          s.nodes = from_smallest(s.nodes);
          into.push_back(s);
        }
  };
  const auto before = [](const Segment& a, const Segment& b) { return a.nodes < b.nodes; };
  collect(list.positive, out);
  collect(list.negative, gone);
  report_missing(RuleId::DK151, block, "surface", missing, 188);
  std::stable_sort(out.begin(), out.end(), before);
  std::sort(gone.begin(), gone.end(), before);
  out.erase(std::unique(out.begin(), out.end(),
                        [](const Segment& a, const Segment& b) { return a.nodes == b.nodes; }),
            out.end());
  std::erase_if(out, [&](const Segment& s) {
    return std::binary_search(gone.begin(), gone.end(), s, before);
  });
  return out;
}

// ---- surfaces of shells of parts by runs of elements --------------------------------------------

std::span<const Segment> SegmentList::some(std::size_t begin, std::size_t end,
                                           std::vector<Segment>& room) const {
  if (held_ != nullptr) return {held_->data() + begin, end - begin};
  room.resize(end - begin);
  auto run = std::upper_bound(runs_->begin(), runs_->end(), begin,
                              [](std::size_t at, const ShellRun& r) { return at < r.end; });
  for (std::size_t at = begin; at < end; ++run) {
    const Elements& shells = model_->family(run->kind);
    const Carrier carrier = detail::family_name(run->kind).carrier;
    const bool quadrangles = shells.width == 4, reversed = run->reversed;
    const std::size_t start = run == runs_->begin() ? 0 : (run - 1)->end;
    auto e = run->first + static_cast<std::uint32_t>(at - start);
    for (const std::size_t stop = std::min(end, run->end); at < stop; ++at, ++e)
      room[at - begin] = segment_of(shells.of(e), quadrangles, carrier, e, reversed);
  }
  return room;
}

Segment detail::shell_segment(const Elements& shells, std::uint32_t e, bool reversed) {
  return segment_of(shells.of(e), shells.width == 4, family_name(shells.kind).carrier, e, reversed);
}

std::optional<std::vector<ShellRun>> Selections::Impl::shell_runs(
    const std::vector<std::int8_t>& tags) {
  const auto selects = [&](ElementKind kind) {
    if (model->family(kind).size() == 0) return false;
    const PartElements& rows = elements_of_parts(kind);
    for (std::size_t p = 0; p < tags.size(); ++p)
      if (tags[p] != 0 && !rows.row(p).empty()) return true;
    return false;
  };
  if (selects(ElementKind::solid8)) return std::nullopt;  // runs do not say which faces
  std::vector<ShellRun> out;
  std::size_t count = 0;
  for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3}) {
    if (!selects(kind)) continue;
    const Elements& shells = model->family(kind);
    const PartElements& rows = elements_of_parts(kind);
    const std::int64_t* last = nullptr;  // id of the previous element
    for (std::size_t p = 0; p < tags.size(); ++p) {
      if (tags[p] == 0) continue;
      for (const ElementRun& run : rows.row(p)) {
        const NodeIndex* const nodes = shells.of(run.first);
        const NodeIndex* const nodes_end = shells.of(run.end);
        if (std::find(nodes, nodes_end, no_index) != nodes_end) return std::nullopt;
        const std::int64_t* const ids = shells.id.data() + run.first;
        if (last != nullptr && *ids < *last) return std::nullopt;
        if (!std::is_sorted(ids, ids + run.size())) return std::nullopt;
        last = ids + run.size() - 1;
        count += run.size();
        out.push_back({kind, tags[p] < 0, run.first, count});
      }
    }
  }
  return out;
}

std::optional<SurfaceOutline> Selections::Impl::outline(std::int64_t id) {
  const detail::Definition* def = definition("surf", id);
  const bool by_runs = def != nullptr && is_part_type(def->type) && !surfaces.contains(id);
  if (by_runs && !run_surfaces.contains(id)) {
    const Block& block = *def->block;
    if (recursive("surf", id, block, 189)) return std::nullopt;
    const DecodedBlock d = decode(deck(), block);
    const std::vector<std::int8_t> tags = part_tags(block, def->type, id_list(d));
    if (auto runs = shell_runs(tags)) {
      // Counted as if their segments were stored.
      if (!reserve_bytes(runs->empty() ? 0 : runs->back().end, sizeof(Segment), block))
        runs->clear();
      run_surfaces.emplace(id, std::move(*runs));
    } else {
      Surface s{id, d.title, segments_of_parts(*def, tags), false, block.header_span};
      keep(s.segments, block);
      sort_segments(s.segments);
      surfaces.emplace(id, std::move(s));
    }
  }
  if (const auto it = run_surfaces.find(id); by_runs && it != run_surfaces.end())
    return SurfaceOutline{{*model, it->second}, false};
  const Surface* s = surface(id);
  if (s == nullptr) return std::nullopt;
  return SurfaceOutline{{*model, s->segments}, s->analytical};
}

void Selections::Impl::keep_runs(std::int64_t id) {
  const auto it = run_surfaces.find(id);
  if (it == run_surfaces.end() || surfaces.contains(id)) return;
  const Block& block = *definition("surf", id)->block;
  Surface s{id, decode(deck(), block).title, {}, false, block.header_span};
  const SegmentList list(*model, it->second);
  list.some(0, list.size(), s.segments);
  surfaces.emplace(id, std::move(s));
}

}  // namespace deck
