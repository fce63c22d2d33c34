// The picture: outer faces of solids, shells and lines, part by part. Positions are integers on a
// grid of 2^20 (large parts: 2^16) steps per part; nodes are numbered in order of appearance. A
// separate block has data of picked elements (place of definition, own thickness) by face, so that
// the first picture does not wait for it.
#include <algorithm>
#include <cmath>
#include <map>

#include "model/shared/item_spans.hpp"
#include "report/html/page_steps.hpp"

namespace deck::detail {
namespace {

/// Faces by stored slots.
constexpr int slots_of_face[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                     {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

/// A face of a solid: distinct nodes in order, and sorted as key.
struct SolidFace {
  std::array<NodeIndex, 4> key{no_index, no_index, no_index, no_index};
  std::array<NodeIndex, 4> nodes{};
  int corners = 0;
  int face = 0;
  std::uint32_t element = 0;
};

/// Face 0..5; repeated nodes count once. Fewer than three corners: no face.
SolidFace solid_face_of(const NodeIndex* slots, int face, std::uint32_t element) {
  SolidFace f;
  f.element = element;
  f.face = face;
  for (const int slot : slots_of_face[face]) {
    const NodeIndex n = slots[slot];
    const auto end = f.nodes.begin() + f.corners;
    if (std::find(f.nodes.begin(), end, n) == end) {
      f.nodes[static_cast<std::size_t>(f.corners)] = n;
      f.key[static_cast<std::size_t>(f.corners++)] = n;
    }
  }
  std::sort(f.key.begin(), f.key.end());
  return f;
}

bool complete(const NodeIndex* nodes, int n) {
  return std::find(nodes, nodes + n, no_index) == nodes + n;
}

/// Faces of exactly one solid, in order of the solids.
std::vector<SolidFace> outer_faces(const Elements& family,
                                   const std::vector<std::uint32_t>& solids) {
  std::vector<SolidFace> all;
  all.reserve(6 * solids.size());
  for (const std::uint32_t e : solids) {
    const NodeIndex* slots = family.of(e);
    if (!complete(slots, 8)) continue;
    for (int k = 0; k < 6; ++k)
      if (const SolidFace f = solid_face_of(slots, k, e); f.corners >= 3) all.push_back(f);
  }
  std::vector<std::pair<std::array<NodeIndex, 4>, std::uint32_t>> order;  // key and face
  order.reserve(all.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) order.emplace_back(all[i].key, i);
  std::sort(order.begin(), order.end());
  std::vector<std::uint8_t> outer(all.size(), 1);
  for (std::size_t i = 1; i < order.size(); ++i)
    if (order[i].first == order[i - 1].first)
      outer[order[i].second] = outer[order[i - 1].second] = 0;
  std::vector<SolidFace> out;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (outer[i]) out.push_back(all[i]);
  return out;
}

/// Calls use(node) for every corner of every face of a group, in order.
template <class Use>
void for_each_corner(const Model& model, const MeshGroup& g, const Use& use) {
  const Elements& family = model.family(g.kind);
  for (std::size_t i = 0; i < g.element.size(); ++i) {
    const NodeIndex* n = family.of(g.element[i]);
    const SolidFace solid = g.face.empty() ? SolidFace{} : solid_face_of(n, g.face[i], 0);
    if (!g.face.empty()) n = solid.nodes.data();
    for (int k = 0; k < g.corners; ++k) use(n[k]);
  }
}

constexpr std::size_t large_part = 100000;  // number of nodes

class Collector {
 public:
  Collector(const Model& model, PageNodes& nodes)
      : model_(model), nodes_(nodes), parts_(model.parts.size() + 1) {}

  std::vector<MeshPart> run() {
    for (const auto* f : {&model_.shell4, &model_.shell3, &model_.quad, &model_.tria}) shells(*f);
    solids();
    for (const auto* family : {&model_.truss, &model_.beam, &model_.spring}) lines(*family);
    std::vector<MeshPart> out;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      if (parts_[p].empty()) continue;
      out.push_back({p < model_.parts.size() ? static_cast<std::uint32_t>(p) : no_index,
                     std::move(parts_[p])});
    }
    return out;
  }

 private:
  void add(std::uint32_t part, ElementKind kind, int corners, const NodeIndex* n,
           std::uint32_t element, int face = -1) {
    auto& groups = parts_[std::min<std::size_t>(part, model_.parts.size())];
    auto it = std::find_if(groups.begin(), groups.end(), [&](const MeshGroup& g) {
      return g.kind == kind && g.corners == corners;
    });
    if (it == groups.end()) it = groups.insert(groups.end(), MeshGroup{kind, corners, {}, {}});
    for (int k = 0; k < corners; ++k) nodes_.use(n[k]);
    it->element.push_back(element);
    if (face >= 0) it->face.push_back(static_cast<std::uint8_t>(face));
  }

  void shells(const Elements& family) {
    for (std::uint32_t e = 0; e < family.size(); ++e) {
      const NodeIndex* n = family.of(e);
      if (!complete(n, family.width)) continue;
      const bool quad = family.width == 4 && n[2] != n[3];
      add(family.part[e], family.kind, quad ? 4 : 3, n, e);
    }
  }

  void solids() {
    const Elements& family = model_.solid8;
    std::vector<std::vector<std::uint32_t>> of_part(parts_.size());
    for (std::uint32_t e = 0; e < family.size(); ++e)
      of_part[std::min<std::size_t>(family.part[e], model_.parts.size())].push_back(e);
    for (std::size_t p = 0; p < of_part.size(); ++p) {
      if (of_part[p].empty()) continue;
      for (const SolidFace& f : outer_faces(family, of_part[p]))
        add(static_cast<std::uint32_t>(p), family.kind, f.corners, f.nodes.data(), f.element,
            f.face);
    }
  }

  void lines(const Elements& family) {
    for (std::uint32_t e = 0; e < family.size(); ++e) {
      const NodeIndex* n = family.of(e);
      if (n[0] != no_index && n[1] != no_index && n[0] != n[1])
        add(family.part[e], family.kind, 2, n, e);
    }
  }

  const Model& model_;
  PageNodes& nodes_;
  std::vector<std::vector<MeshGroup>> parts_;
};

/// One part: nodes in order of appearance, positions, faces. A corner is stored as its distance
/// from the next new node: well-numbered meshes give mostly zeros and small numbers.
class PartWriter {
 public:
  PartWriter(const Model& model, const PageNodes& nodes, ByteStream& out)
      : model_(model), nodes_(nodes), out_(out), local_(nodes.list().size(), no_index) {}

  void write(const MeshPart& part) {
    order_.clear();
    for (const MeshGroup& g : part.groups)
      for_each_corner(model_, g, [&](NodeIndex node) { local(node); });
    out_.u(part.part == no_index ? 0 : part.part + 1);
    positions();
    std::uint32_t next = 0;
    out_.u(part.groups.size());
    for (const MeshGroup& g : part.groups) {
      out_.u(static_cast<std::uint64_t>(g.kind));
      out_.u(static_cast<std::uint64_t>(g.corners));
      out_.u(g.element.size());
      for_each_corner(model_, g, [&](NodeIndex node) {
        const std::uint32_t i = local_[nodes_[node]];
        out_.u(next - i);
        if (i == next) ++next;
      });
      Delta id;
      for (const std::uint32_t e : g.element) out_.s(id(model_.family(g.kind).id[e]));
    }
    for (const std::uint32_t n : order_) local_[n] = no_index;
  }

 private:
  void local(NodeIndex node) {
    const std::uint32_t n = nodes_[node];
    if (local_[n] != no_index) return;
    local_[n] = static_cast<std::uint32_t>(order_.size());
    order_.push_back(n);
  }

  void positions() {
    out_.u(order_.size());
    Delta number;
    for (const std::uint32_t n : order_) out_.s(number(n));
    const double steps = order_.size() >= large_part ? 65535 : 1048575;
    for (const std::vector<double>* axis : {&model_.nodes.x, &model_.nodes.y, &model_.nodes.z}) {
      double low = INFINITY, high = -INFINITY;
      for (const std::uint32_t n : order_) {
        const double v = (*axis)[nodes_.list()[n]];
        low = std::min(low, v);
        high = std::max(high, v);
      }
      const double step = high > low ? (high - low) / steps : 1;
      const double frame[2] = {low, step};
      out_.f64(frame);
      Delta d;
      for (const std::uint32_t n : order_) {
        const double q = ((*axis)[nodes_.list()[n]] - low) / step;
        out_.s(d(std::isfinite(q) ? std::llround(q) : 0));
      }
    }
  }

  const Model& model_;
  const PageNodes& nodes_;
  ByteStream& out_;
  std::vector<std::uint32_t> local_;  // page node -> position in order_
  std::vector<std::uint32_t> order_;
};

/// Places of all elements of a family, block by block.
std::vector<ItemPlace> element_places(const Model& model, const Elements& family) {
  std::vector<ItemPlace> out(family.size(), ItemPlace{0, 0});
  std::vector<std::uint8_t> wanted(model.element_blocks.size(), 0);
  for (const std::uint32_t block : family.block)
    if (block < wanted.size()) wanted[block] = 1;
  std::span<const BulkBlock> runs;
  for (std::size_t b = 0; b < wanted.size(); b += runs.size()) {
    runs = runs_of_block(model.element_blocks, b);
    if (wanted[b] == 0) continue;
    for_each_item_place(*model.deck, runs, [&](std::uint32_t e, ItemPlace at) {
      if (e < out.size() && family.block[e] >= b && family.block[e] < b + runs.size()) out[e] = at;
    });
  }
  return out;
}

}  // namespace

void PageNodes::number() {
  list_ = marked(used_);
  number_.assign(used_.size(), no_index);
  for (std::uint32_t i = 0; i < list_.size(); ++i) number_[list_[i]] = i;
}

std::vector<MeshPart> collect_mesh(const Model& model, PageNodes& nodes) {
  return Collector(model, nodes).run();
}

std::string mesh_block(const Model& model, const std::vector<MeshPart>& mesh,
                       const PageNodes& nodes) {
  ByteStream out;
  out.u(nodes.list().size());
  Delta id;
  for (const NodeIndex n : nodes.list()) out.s(id(model.nodes.id[n]));
  out.u(mesh.size());
  PartWriter writer(model, nodes, out);
  for (const MeshPart& part : mesh) writer.write(part);
  return std::move(out).text();
}

void for_each_item_place(const Deck& deck, std::span<const BulkBlock> runs,
                         const std::function<void(std::uint32_t, ItemPlace)>& take) {
  Span last;
  std::uint64_t line = 0;
  for_each_item_span(deck, runs, [&](std::uint32_t item, const Span& s) {
    const auto& source = deck.sources[s.file];
    if (line == 0 || s.file != last.file || s.offset < last.offset) {
      line = source.position(s.offset).line;
    } else {
      const std::string_view between = source.bytes().substr(last.offset, s.offset - last.offset);
      line += static_cast<std::uint64_t>(std::count(between.begin(), between.end(), '\n'));
      source.release(last.offset, s.offset);
    }
    last = s;
    take(item, {s.file, line <= UINT32_MAX ? static_cast<std::uint32_t>(line) : 0});
  });
}

std::string elements_block(const Model& model, const std::vector<MeshPart>& mesh) {
  std::map<ElementKind, std::vector<ItemPlace>> places;
  ByteStream out;
  for (const MeshPart& part : mesh)
    for (const MeshGroup& g : part.groups) {
      const Elements& family = model.family(g.kind);
      std::vector<ItemPlace>& place = places[g.kind];
      if (place.empty()) place = element_places(model, family);
      Delta file, line;
      for (const std::uint32_t e : g.element) out.s(file(place[e].file));
      for (const std::uint32_t e : g.element) out.s(line(std::int64_t{place[e].line}));
      out.palette(g.element, [&](std::uint32_t e) {
        return e < family.thickness.size() ? family.thickness[e] : 0.0;
      });
    }
  return std::move(out).text();
}

}  // namespace deck::detail
