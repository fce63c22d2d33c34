// Surfaces of shells of parts by runs of elements: their segments are formed where they are looked
// at, and held only for those who ask for all of them at once.
#include <algorithm>

#include "model/selection/selection_impl.hpp"

namespace deck {
namespace {

/// Shell `e` of these nodes.
Segment segment_of(const NodeIndex* n, bool quadrangle, Carrier carrier, std::uint32_t e,
                   bool reversed) {
  if (!reversed) return {{n[0], n[1], n[2], quadrangle ? n[3] : n[2]}, carrier, e};
  // A quadrangle is turned as one even where its last two nodes coincide.
  if (quadrangle) return {{n[3], n[2], n[1], n[0]}, carrier, e};
  return {{n[2], n[1], n[0], n[0]}, carrier, e};
}

}  // namespace

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
  if (selects(ElementKind::solid8)) return std::nullopt;  // which faces: more than a run says
  std::vector<ShellRun> out;
  std::size_t count = 0;
  for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3}) {
    if (!selects(kind)) continue;
    const Elements& shells = model->family(kind);
    const PartElements& rows = elements_of_parts(kind);
    const std::int64_t* last = nullptr;  // id of the element before
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
      // They count as held, as if somebody had asked for all of them.
      if (!hold(runs->empty() ? 0 : runs->back().end, sizeof(Segment), block)) runs->clear();
      run_surfaces.emplace(id, std::move(*runs));
    } else {
      finish_surface({id, d.title, segments_of_parts(*def, tags), false, block.header_span}, block);
    }
  }
  if (const auto it = run_surfaces.find(id); by_runs && it != run_surfaces.end())
    return SurfaceOutline{{*model, it->second}, false};
  const Surface* s = surface(id);
  if (s == nullptr) return std::nullopt;
  return SurfaceOutline{{*model, s->segments}, s->analytical};
}

const Surface& Selections::Impl::finish_surface(Surface surface, const Block& block) {
  keep(surface.segments, block);
  sort_segments(surface.segments);
  const std::int64_t id = surface.id;
  return surfaces.emplace(id, std::move(surface)).first->second;
}

const Surface* Selections::Impl::surface_of_runs(std::int64_t id, const Block& block) {
  const auto it = run_surfaces.find(id);
  if (it == run_surfaces.end()) return nullptr;
  Surface s{id, decode(deck(), block).title, {}, false, block.header_span};
  const SegmentList list(*model, it->second);
  list.some(0, list.size(), s.segments);
  return &surfaces.emplace(id, std::move(s)).first->second;
}

}  // namespace deck
