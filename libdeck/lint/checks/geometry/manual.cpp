// Gaps and stiffnesses that come out of the mesh otherwise than manuals say: for people who check
// the listing against the manual.
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <vector>

#include "deck/model/connectivity.hpp"
#include "lint/rule_tables.hpp"
#include "lint/checks/geometry/geometry.hpp"

namespace deck::detail {
namespace {

constexpr double no_limit = 1e30;  // SecondaryNode::length of nodes on no main segment

bool on_shell(const MainSegment& m) {
  return m.carrier == Carrier::shell4 || m.carrier == Carrier::shell3;
}

/// DK316: the three parts of a TYPE19 take their default gaps each from its own main side.
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
    run.report(
        "DK316", c, "Gapmin",
        fmt::format("{}: its parts have default gaps of their own: {}", name_of(run, c), list));
  }
}

/// DK317: the default gap of TYPE10 is the mean thickness.
void check_tied_default(const GeometryRun& run, const Contact& c) {
  if (c.inter->type != 10 || c.gapmin_origin != GapminOrigin::mean_thickness) return;
  double smallest = std::numeric_limits<double>::infinity();
  for (const MainSegment& m : c.main)
    if (on_shell(m)) smallest = std::min(smallest, m.thickness);
  if (!(smallest < c.gapmin)) return;
  run.report(
      "DK317", c, "Gap",
      fmt::format("{}: the default gap is {:.6g}, the mean thickness of the main shells; the "
                  "thinnest has {:.6g}",
                  name_of(run, c), c.gapmin, smallest));
}

/// DK318: Igap 3 limits the gap of a node by the main segments that it belongs to.
void check_no_mesh_limit(const GeometryRun& run, const Contact& c) {
  if (c.igap != 3 || c.kind != ContactKind::node_segment || c.role == ContactRole::reversed) return;
  const auto unlimited = static_cast<std::size_t>(
      std::count_if(c.secondary.begin(), c.secondary.end(),
                    [](const SecondaryNode& s) { return s.length >= no_limit && s.gap > 0; }));
  if (unlimited == 0) return;
  run.report(
      "DK318", c, "Igap",
      fmt::format("{}: Igap = 3 does not limit the gap of {} of {}, which belong to no main "
                  "segment",
                  name_of(run, c), count_text(unlimited, "secondary node"), c.secondary.size()));
}

/// Segments of solids that a shell with the same nodes covers.
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
    if (on_shell(m) || m.carrier == Carrier::none || !(m.stiffness > 0)) continue;
    ++solids;
    largest = std::max(largest, m.stiffness);
    if (!covered.by_shell(m)) continue;
    if (first == nullptr) first = &m;
    ++under_shells;
  }
  if (solids != 0 && c.inter->type != 10)  // a tied contact acts with all of it
    run.report("DK307", c, "Istf",
               fmt::format("{}: {} of solids store up to {:.6g}; half of it acts", name_of(run, c),
                           count_text(solids, "main segment"), largest));
  if (first != nullptr)
    run.report("DK319", c, "surf_IDm",
               fmt::format("{}: {} of {} lie under shells and keep the stiffness of the solids, "
                           "because the surface was made from the solids; the first is {}",
                           name_of(run, c), count_text(under_shells, "main segment"), c.main.size(),
                           nodes_text(run.model(), *first)));
}

constexpr std::string_view second_thickness =
    "/PROP/SHELL/9\nthick\n        24         0         0         0\n"
    "                 0.0                 0.0                 0.0                 0.0"
    "                 0.0\n"
    "         5                           3.0                 0.0                   0         0\n"
    "/PART/9\nthick\n         9         1         0\n"
    "/NODE\n        21                10.0                20.0                 0.0\n"
    "        22                 0.0                20.0                 0.0\n"
    "/SHELL/9\n         9         4         3        21        22\n"
    "/SURF/PART/9\nboth\n         1         9\n";

constexpr std::string_view brick =
    "/PROP/SOLID/9\nbrick\n\n\n\n/PART/9\nbrick\n         9         1         0\n"
    "/NODE\n        21                 0.0                 0.0               -10.0\n"
    "        22                10.0                 0.0               -10.0\n"
    "        23                10.0                10.0               -10.0\n"
    "        24                 0.0                10.0               -10.0\n"
    "/BRICK/9\n         9        21        22        23        24         1         2         3"
    "         4\n"
    "/SURF/PART/EXT/9\nfaces\n         9\n";

const std::string& text(std::string_view a, std::string_view b) {
  static std::map<std::pair<std::string_view, std::string_view>, std::string> kept;
  std::string& out = kept[{a, b}];
  if (out.empty()) out = std::string(a) + std::string(b);
  return out;
}

}  // namespace

void check_manual_geometry(const GeometryRun& run) {
  check_part_defaults(run);
  Covered covered(run.model());
  for (const Contact& c : run.scene.contacts) {
    if (c.dropped) continue;
    check_tied_default(run, c);
    check_no_mesh_limit(run, c);
    check_solid_segments(run, c, covered);
  }
}

void add_geometry_manual_rules(std::vector<Rule>& out) {
  using enum Severity;
  out.push_back({.id = "DK316",
                 .title = "TYPE19: three default gaps",
                 .severity = info,
                 .stage = RuleStage::extra,
                 .problem = "Gapmin of a TYPE19 is blank and its parts get different values.",
                 .why = "Manuals name one default for the interface, the smallest over both "
                        "surfaces. Each part (primary, reversed, edges) takes the one of its own "
                        "main side, the edge part the mean of both.",
                 .solver = "it computes a default for each part",
                 .fix = "write Gapmin, which holds for all parts",
                 .ignore = "When both sides may have gaps of their own.",
                 .bad = text(second_thickness, "@/INTER/TYPE19/1 surf_IDs=9\n"),
                 .good = "@/INTER/TYPE19/1 Gapmin=1.0\n"});
  out.push_back({.id = "DK317",
                 .title = "TYPE10: the default gap is the mean thickness",
                 .severity = info,
                 .stage = RuleStage::extra,
                 .problem = "Gap of a TYPE10 is blank and the main shells differ in thickness.",
                 .why = "Manuals say the smallest thickness; the solver takes the mean. Nodes that "
                        "lie between the two are tied although the manual says they are not.",
                 .solver = "it takes the mean thickness",
                 .fix = "write Gap",
                 .ignore = "When the mean is meant.",
                 .bad = text(second_thickness, "@/INTER/TYPE10/1 surf_IDm=9\n"),
                 .good = "@/INTER/TYPE10/1\n"});
  out.push_back({.id = "DK318",
                 .title = "Igap 3 limits nothing on this side",
                 .severity = info,
                 .stage = RuleStage::extra,
                 .problem = "Igap is 3, and secondary nodes belong to no main segment.",
                 .why = "Manuals limit the share of a node by the edges of the elements at it. The "
                        "solver takes only main segments at it: in self contact all, between two "
                        "different sides none.",
                 .solver = "it limits the main share of the gap only",
                 .fix = "limit the gap by Gapmax, or use one surface for both sides",
                 .ignore = "When the mesh of the secondary side is coarse against its thickness.",
                 .bad = "@/INTER/TYPE7/1 Igap=3\n",
                 .good = "@/INTER/TYPE7/1 Igap=2\n"});
  out.push_back({.id = "DK307",
                 .title = "solids act with half of the stored stiffness",
                 .severity = info,
                 .stage = RuleStage::extra,
                 .problem = "The main side has segments of solids.",
                 .why = "For solids the stored stiffness is Stfac B S^2 / V, as manuals say. Half "
                        "of the stiffness of a pair acts in the force, so a solid pushes with half "
                        "of what the manual gives. (Shells store E t, of which half acts, as "
                        "manuals say.)",
                 .solver = "it halves the stiffness of every pair",
                 .fix = "double Stfac where the full stiffness is wanted",
                 .ignore = "When the factor is known.",
                 .bad = text(brick, "@/INTER/TYPE7/1 surf_IDm=9\n"),
                 .good = "@/INTER/TYPE7/1\n"});
  out.push_back({.id = "DK319",
                 .title = "shells on solids, and the stiffness of the solids",
                 .severity = info,
                 .stage = RuleStage::extra,
                 .problem = "Main segments made from solids lie under shells with the same nodes.",
                 .why = "Manuals give such a segment the stiffness of the shell. That holds where "
                        "the surface lists the segment (/SURF/SEG) or is made from the shells; "
                        "made from the solids it keeps the stiffness of the solid, often several "
                        "times as much.",
                 .solver = "it takes the element that the surface was made from",
                 .fix = "make the surface from the shells if their stiffness is wanted",
                 .ignore = "When the stiffness of the solid is meant.",
                 .bad = text(brick, "@/INTER/TYPE7/1 surf_IDm=9\n"),
                 .good = "@/INTER/TYPE7/1\n"});
}

}  // namespace deck::detail
