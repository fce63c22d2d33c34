// Gaps and stiffness that differ from the manual, for users who compare the listing with it.
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <vector>

#include "contact/shared/scene_steps.hpp"
#include "lint/checks/geometry/geometry.hpp"
#include "model/shared/families.hpp"

namespace deck::detail {
namespace {

constexpr double no_limit = 1e30;  // Contact::secondary_length of nodes on no main segment

/// DK316: each part of a TYPE19 computes its default gap from its own main side.
void check_part_defaults(const GeometryRun& run) {
  std::map<const InterBase*, std::vector<const Contact*>> parts;
  for (const Contact& c : run.scene.contacts)
    if (c.inter->type == 19 && !c.dropped && c.gapmin_origin != GapminOrigin::card)
      parts[c.inter].push_back(&c);
  for (const Contact& c : run.scene.contacts) {
    const auto it = parts.find(c.inter);
    if (it == parts.end() || it->second.front() != &c) continue;
    const auto differs = [&](const Contact* o) { return o->gapmin != c.gapmin; };
    if (std::none_of(it->second.begin(), it->second.end(), differs)) continue;
    std::string list;
    for (const Contact* o : it->second)
      list += fmt::format("{}{} {:.6g}", list.empty() ? "" : ", ", to_string(o->role), o->gapmin);
    run.report(RuleId::DK316, c, "Gapmin",
               fmt::format("its parts have different default gaps: {}", list));
  }
}

/// DK317: the default gap of TYPE10 is the mean thickness.
void check_tied_default(const GeometryRun& run, const Contact& c) {
  if (c.inter->type != 10 || c.gapmin_origin != GapminOrigin::mean_thickness) return;
  double smallest = std::numeric_limits<double>::infinity();
  for (const MainSegment& m : c.main)
    if (detail::is_on_shell(m))
      smallest = std::min(smallest, detail::contact_thickness(run.model(), m));
  if (!(smallest < c.gapmin)) return;
  run.report(RuleId::DK317, c, "Gap",
             fmt::format("the default gap is {:.6g}, the mean thickness of the main shells; the "
                         "thinnest has {:.6g}",
                         c.gapmin, smallest));
}

/// DK318: Igap 3 limits the gap of a node by the main segments around it.
void check_no_mesh_limit(const GeometryRun& run, const Contact& c) {
  if (c.igap != 3 || c.kind != ContactKind::node_segment || c.role == ContactRole::reversed) return;
  std::size_t unlimited = 0;
  for (std::size_t i = 0; i < c.secondary.size(); ++i)
    unlimited += c.secondary_length[i] >= no_limit && c.secondary[i].gap > 0;
  if (unlimited == 0) return;
  run.report(RuleId::DK318, c, "Igap",
             fmt::format("Igap = 3 does not limit the gap of {} of {}, which {} to no main "
                         "segment",
                         count_text(unlimited, "secondary node"), c.secondary.size(),
                         unlimited == 1 ? "belongs" : "belong"));
}

/// Segments of solids under shells with equal nodes.
class Covered {
 public:
  explicit Covered(const Model& model) : model_(model) {}

  bool by_shell(const MainSegment& m) {
    const bool triangle = m.nodes[2] == m.nodes[3];
    const Elements& family = triangle ? model_.shell3 : model_.shell4;
    if (family.size() == 0) return false;
    NodeElements& rows = triangle ? triangles_ : quads_;
    if (rows.rows() == 0) rows = connect_nodes(family, model_.nodes.size());
    const std::size_t corners = triangle ? 3 : 4;
    std::array<NodeIndex, 4> mine = m.nodes;
    std::sort(mine.begin(), mine.begin() + corners);
    for (const std::uint32_t e : rows.row(m.nodes[0])) {
      std::array<NodeIndex, 4> other{};
      for (std::size_t k = 0; k < corners; ++k) other[k] = family.of(e)[k];
      std::sort(other.begin(), other.begin() + corners);
      if (std::equal(mine.begin(), mine.begin() + corners, other.begin())) return true;
    }
    return false;
  }

 private:
  const Model& model_;
  NodeElements quads_, triangles_;
};

/// DK319, DK307: segments whose stiffness is that of a solid.
void check_solid_segments(const GeometryRun& run, const Contact& c, Covered& covered) {
  if (c.kind != ContactKind::node_segment || c.istf == 1) return;
  std::size_t solids = 0, under_shells = 0;
  const MainSegment* first = nullptr;
  double largest = 0;
  for (const MainSegment& m : c.main) {
    if (detail::is_on_shell(m) || m.carrier == Carrier::none || !(m.stiffness > 0)) continue;
    ++solids;
    largest = std::max(largest, m.stiffness);
    if (!covered.by_shell(m)) continue;
    if (first == nullptr) first = &m;
    ++under_shells;
  }
  if (solids != 0 && c.inter->type != 10)  // a tied contact acts with all of it
    run.report(
        RuleId::DK307, c, "Istf",
        fmt::format("{} of solids {} a stiffness of up to {:.6g}; half of it acts",
                    count_text(solids, "main segment"), solids == 1 ? "stores" : "store", largest));
  if (first != nullptr)
    run.report(
        RuleId::DK319, c, "surf_IDm",
        fmt::format("{} of {} {} the stiffness of the solids, "
                    "because the surface was made from the solids; the first is {}",
                    count_text(under_shells, "main segment"), c.main.size(),
                    under_shells == 1 ? "lies under shells and keeps" : "lie under shells and keep",
                    nodes_text(run.model(), *first)));
}

}  // namespace

void check_manual_differences(const GeometryRun& run) {
  check_part_defaults(run);
  Covered covered(run.model());
  for (const Contact& c : run.scene.contacts) {
    if (c.dropped || is_type24_or_25(c.type)) continue;
    check_tied_default(run, c);
    check_no_mesh_limit(run, c);
    check_solid_segments(run, c, covered);
  }
}

}  // namespace deck::detail
