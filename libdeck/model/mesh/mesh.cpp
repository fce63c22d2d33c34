// Mesh figures as the Starter lists them. Each element is computed once (mesh_shells, mesh_solids,
// mesh_lines), in parallel chunks; the chunks are added to nodes and parts in element order, so
// sums do not depend on threads. node_sums.cpp then adds the effects of rigid bodies, added masses,
// ties and damping. Unknown values are NaN and have a reason. Cost: O(elements).
#include "model/shared/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/shared/parallel.hpp"
#include "deck/keyword.hpp"
#include "model/mesh/mesh_parts.hpp"
#include "model/shared/families.hpp"
#include "text/shared/columns.hpp"

namespace deck {
namespace {

using namespace detail;

constexpr std::size_t chunk_size = 8192;
/// Slots at the ends of the sides of a tetrahedron.
constexpr std::size_t ends[6][2] = {{0, 2}, {2, 5}, {5, 0}, {0, 4}, {2, 4}, {5, 4}};

bool engine_asks(const EngineFiles* engine, std::string_view keyword) {
  if (engine == nullptr || engine->files.empty()) return false;
  const EngineFile& first = engine->files.front();
  if (first.number != 1) return false;
  return std::any_of(first.blocks.begin(), first.blocks.end(),
                     [&](const EngineBlock& b) { return is_below(b.keyword, keyword); });
}

/// Sums of a part relative to a nearby point.
struct Sums {
  bool begun = false;
  Vec origin;
  double mass = 0;
  Vec first;
  std::array<double, 6> second{};
  double spin = 0;  ///< rotational inertia of the nodes

  void add(const Vec& x, double m) {
    if (!begun) {
      begun = true;
      origin = x;
    }
    const Vec d = x - origin;
    mass += m;
    first = first + m * d;
    add_point(second, m, d);
  }
  void write(PartFigures& out) const {
    out.mass = mass;
    if (!begun || !(mass > 0.0)) {
      if (std::isnan(mass)) out.inertia.fill(not_known), out.centre.fill(not_known);
      return;
    }
    const Vec d = (1.0 / mass) * first, c = origin + d;
    out.centre = {c.x, c.y, c.z};
    out.inertia = second;
    add_point(out.inertia, -mass, d);
    for (std::size_t i = 0; i < 3; ++i) out.inertia[i] += spin;
  }
};

class Assembly {
 public:
  Assembly(const Model& model, const MeshOptions& options)
      : model_(model),
        options_(options),
        threads_(effective_threads(options.threads)),
        rows_(part_rows(model)),
        nodes_(model, options, mesh_.nodes) {
    const Coordinates* x = options.coordinates;
    places_ = x != nullptr
                  ? Places{x->x.data(), x->y.data(), x->z.data()}
                  : Places{model.nodes.x.data(), model.nodes.y.data(), model.nodes.z.data()};
    sums_.resize(model.parts.size());
    mesh_.parts.resize(model.parts.size());
    brick_option_ = engine_asks(options.engine, "/DT1/BRICK");
    tetra_option_ = engine_asks(options.engine, "/DT1TET10");
    thick_option_ = engine_asks(options.engine, "/DTTSH");
    for (const Block& b : model.deck->blocks)
      if (b.schema != nullptr && b.schema->keyword == "/ANALY")
        axisymmetric_ = decode(*model.deck, b).integer("N2D3D") == 1;
  }

  Mesh run() {
    for (std::size_t k = 0; k < mesh_.elements.size(); ++k) family(static_cast<ElementKind>(k));
    complete_parts();
    nodes_.complete(places_);
    for (LeftOut& l : nodes_.left_out) mesh_.left_out.push_back(std::move(l));
    for (auto& [key, count] : reasons_)
      mesh_.left_out.push_back({"time steps of " + key.first, key.second, count});
    return std::move(mesh_);
  }

 private:
  using Chunk = std::vector<ElementOutcome>;

  const char* option_reason(const PartRow& row, SolidShape shape) const {
    if (brick_option_ && shape == SolidShape::tetra4)
      return "/DT1/BRICK of the Engine file changes the length of tetrahedra";
    if (tetra_option_ && shape == SolidShape::tetra10)
      return "/DT1TET10 of the Engine file changes the length of tetrahedra";
    if (thick_option_ && row.property.type >= 20 && row.property.type <= 22)
      return "/DTTSH of the Engine file changes the length of thick shells";
    return nullptr;
  }

  /// Corners that must exist.
  static int corners(ElementKind kind, const PartRow& row) {
    const bool pulley = kind == ElementKind::spring && row.property.type == 12;
    return pulley ? 3 : carrying_nodes(kind);
  }

  void solid(const Elements& f, std::uint32_t e, const PartRow& row, ElementOutcome& out) const {
    const NodeIndex* n = f.of(e);
    std::array<Vec, 8> x;
    for (std::size_t i = 0; i < 8; ++i) x[i] = places_.at(n[i]);
    std::array<Vec, 6> middle;
    const SolidShape shape = f.shape[e];
    const bool extra = e < f.extra.size() && f.extra[e] != no_index;
    if (extra && shape == SolidShape::tetra10) {
      for (std::size_t i = 0; i < 6; ++i) {
        const NodeIndex m = f.extra_nodes[f.extra[e] + i];
        middle[i] = m != no_index ? places_.at(m) : 0.5 * (x[ends[i][0]] + x[ends[i][1]]);
      }
    }
    solid_outcome(row, shape, x, extra && shape == SolidShape::tetra10 ? &middle : nullptr, out);
    if (const char* why = option_reason(row, shape); why != nullptr && out.dt < no_step) {
      out.dt = out.stiffness = out.middle_stiffness = not_known;
      out.why = why;
    }
  }

  void element(ElementKind kind, const Elements& f, std::uint32_t e, ElementOutcome& out) const {
    const std::uint32_t part = f.part[e];
    const NodeIndex* n = f.of(e);
    if (part == no_index || part >= rows_.size()) {
      out.dt = not_known;
      out.why = "the part is missing";
      return;
    }
    const PartRow& row = rows_[part];
    const int count = corners(kind, row);
    if (std::find(n, n + count, no_index) != n + count) {
      out.dt = not_known;
      out.why = "a node is missing";
      return;
    }
    const double own = e < f.thickness.size() ? f.thickness[e] : 0.0;
    const double t = own > 0.0 ? own : row.thickness;
    const auto x = [&](int i) { return places_.at(n[i]); };
    switch (kind) {
      case ElementKind::shell4:
        shell4_outcome(row, t, {x(0), x(1), x(2), x(3)}, out);
        break;
      case ElementKind::shell3:
        shell3_outcome(row, t, {x(0), x(1), x(2)}, out);
        break;
      case ElementKind::solid8:
        solid(f, e, row, out);
        break;
      case ElementKind::quad:
        quad_outcome(row, {x(0), x(1), x(2), x(3)}, axisymmetric_, out);
        break;
      case ElementKind::tria:
        out.dt = out.mass = out.stiffness = not_known;
        out.why = "plane triangles are not evaluated";
        break;
      case ElementKind::truss:
        truss_outcome(row, norm(x(1) - x(0)), out);
        break;
      case ElementKind::beam:
        beam_outcome(row, norm(x(1) - x(0)), out);
        break;
      case ElementKind::spring: {
        double l = norm(x(1) - x(0));
        if (row.property.type == 12) l += norm(x(2) - x(1));
        spring_outcome(row, l, nodes_.on_body(n[0]) || nodes_.on_body(n[1]), out);
        break;
      }
    }
    if (row.why != nullptr && out.dt < no_step) {
      out.dt = out.stiffness = out.rotational = out.middle_stiffness = not_known;
      out.why = row.why;
    }
    if (std::isnan(out.dt) && out.why == nullptr)
      out.why = "the law's speed of sound is not established";
  }

  void family(ElementKind kind) {
    const Elements& f = model_.family(kind);
    ElementFigures& to = mesh_.elements[static_cast<std::size_t>(kind)];
    const std::size_t size = f.size();
    to.dt.resize(size);
    to.mass.resize(size);
    run_in_order<Chunk>((size + chunk_size - 1) / chunk_size, threads_,
                        [&](std::size_t k, Chunk& out) {
                          const std::size_t begin = k * chunk_size,
                                            end = std::min(size, begin + chunk_size);
                          out.assign(end - begin, {});
                          for (std::size_t e = begin; e < end; ++e)
                            element(kind, f, static_cast<std::uint32_t>(e), out[e - begin]);
                        },
                        [&](std::size_t k, const Chunk& in) {
                          for (std::size_t i = 0; i < in.size(); ++i) {
                            const auto e = static_cast<std::uint32_t>(k * chunk_size + i);
                            to.dt[e] = in[i].dt;
                            to.mass[e] = in[i].mass;
                            if (kind == ElementKind::beam)
                              mesh_.beam_factors.push_back(in[i].beam_factor);
                            add(kind, f, e, in[i]);
                          }
                        });
  }

  void add(ElementKind kind, const Elements& f, std::uint32_t e, const ElementOutcome& o) {
    const std::uint32_t part = f.part[e];
    if (o.why != nullptr) ++reasons_[{name_of(kind), o.why}];
    if (part == no_index || part >= rows_.size()) return;
    PartFigures& figures = mesh_.parts[part];
    if (std::isnan(o.dt)) {
      ++figures.not_computed;
    } else if (o.dt < figures.dt) {
      figures.dt = o.dt;
      figures.slowest = {kind, e};
    }
    Sums& sums = sums_[part];
    const NodeIndex* n = f.of(e);
    const int count = corners(kind, rows_[part]);
    if (std::find(n, n + count, no_index) != n + count) return;
    const bool rotates = o.inertia != 0.0 || o.rotational != 0.0;
    const bool pulley = kind == ElementKind::spring && rows_[part].property.type == 12;
    const int type = rows_[part].property.type;
    const bool thick = type >= 20 && type <= 22;
    // Solids with six nodes: the solver gives stiffness to the first six slots only.
    const bool six = kind == ElementKind::solid8 && f.shape[e] == SolidShape::penta6 && !thick;
    const int stiff = six ? 6 : count;
    for (int i = 0; i < count; ++i) {
      const double m = o.share[static_cast<std::size_t>(i)] * o.mass;
      if (m != 0.0) sums.add(places_.at(n[i]), m);
      const double k = pulley && i == 1 ? o.middle_stiffness : o.stiffness;
      nodes_.add(n[i], m, i < stiff ? k : 0.0);
      if (!rotates) continue;
      const double inertia = o.share[static_cast<std::size_t>(i)] * o.inertia;
      sums.spin += inertia;
      nodes_.add_rotation(n[i], inertia, o.rotational);
    }
    if (kind == ElementKind::solid8) middles(f, e, o, sums);
  }

  /// Mid-side nodes; the share of a missing one goes to its corners.
  void middles(const Elements& f, std::uint32_t e, const ElementOutcome& o, Sums& sums) {
    if (o.middle_share == 0.0 || e >= f.extra.size() || f.extra[e] == no_index) return;
    const NodeIndex* n = f.of(e);
    const int count = extra_node_count(f.shape[e]);
    for (int i = 0; i < count; ++i) {
      const NodeIndex middle = f.extra_nodes[f.extra[e] + static_cast<std::uint32_t>(i)];
      const double m = o.middle_share * o.mass;
      if (middle != no_index) {
        // Condensed nodes are listed with a mass that is not counted in the part.
        if (o.middle_share < 1.0) sums.add(places_.at(middle), m);
        nodes_.add(middle, m, o.middle_stiffness);
      } else if (f.shape[e] == SolidShape::tetra10 && o.middle_share < 1.0) {
        for (const std::size_t end : ends[i]) {
          sums.add(places_.at(n[end]), 0.5 * m);
          nodes_.add(n[end], 0.5 * m, 0.5 * o.middle_stiffness);
        }
      }
    }
  }

  static std::string name_of(ElementKind kind) {
    constexpr std::string_view names[] = {"shells with four nodes",
                                          "shells with three nodes",
                                          "solids",
                                          "plane elements",
                                          "plane triangles",
                                          "trusses",
                                          "beams",
                                          "springs"};
    return std::string(names[static_cast<std::size_t>(kind)]);
  }

  void complete_parts() {
    Sums all;
    PartFigures& total = mesh_.total;
    for (std::size_t p = 0; p < sums_.size(); ++p) {
      PartFigures& part = mesh_.parts[p];
      sums_[p].write(part);
      total.not_computed += part.not_computed;
      if (part.dt < total.dt) {
        total.dt = part.dt;
        total.slowest = part.slowest;
      }
      if (!(part.mass > 0.0)) continue;
      all.add({part.centre[0], part.centre[1], part.centre[2]}, part.mass);
      for (std::size_t i = 0; i < 6; ++i) all.second[i] += part.inertia[i];
    }
    all.write(total);
  }

  const Model& model_;
  const MeshOptions& options_;
  int threads_;
  std::vector<PartRow> rows_;
  Mesh mesh_;
  NodeSums nodes_;
  Places places_{};
  std::vector<Sums> sums_;
  std::map<std::pair<std::string, std::string>, std::uint64_t> reasons_;
  bool axisymmetric_ = false;
  bool brick_option_ = false, tetra_option_ = false, thick_option_ = false;
};

}  // namespace

void detail::add_point(std::array<double, 6>& t, double m, const Vec& d) {
  t[0] += m * (d.y * d.y + d.z * d.z);
  t[1] += m * (d.z * d.z + d.x * d.x);
  t[2] += m * (d.x * d.x + d.y * d.y);
  t[3] -= m * d.x * d.y;
  t[4] -= m * d.y * d.z;
  t[5] -= m * d.z * d.x;
}

Mesh make_mesh(const Model& model, const MeshOptions& options) {
  return Assembly(model, options).run();
}

}  // namespace deck
