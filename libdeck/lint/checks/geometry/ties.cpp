// Nodes of /INTER/TYPE2: untied ones, and ties with a hidden problem.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/shared/vec.hpp"
#include "base/shared/words.hpp"
#include "contact/shared/reported.hpp"
#include "deck/contacts.hpp"
#include "lint/checks/geometry/geometry.hpp"

namespace deck::detail {
namespace {

std::string tie_name(const Tie& tie) { return fmt::format("/INTER/TYPE2 {}", tie.inter->id); }

struct Nodes {
  std::vector<const TiedNode*> all;
  std::string text(const Model& model) const {
    std::vector<std::int64_t> ids;
    for (const TiedNode* n : all) ids.push_back(model.node_id(n->node));
    return list_text(ids);
  }
};

template <class F>
Nodes nodes_where(const Tie& tie, F&& test) {
  Nodes out;
  for (const TiedNode& n : tie.nodes)
    if (test(n)) out.all.push_back(&n);
  return out;
}

/// Reports nodes of a tie: "/INTER/TYPE2 3: 2 nodes WHAT: 5, 6". nullptr: no nodes.
Finding* about_nodes(const GeometryRun& run, RuleId rule, const Tie& tie, std::string_view field,
                     const Nodes& nodes, std::string_view what, const std::string& of = "") {
  if (nodes.all.empty()) return nullptr;
  return &run.report(
      rule, *tie.inter, field,
      fmt::format("{}: {}{} {} {}: {}", tie_name(tie), count_text(nodes.all.size(), "node"), of,
                  are(nodes.all.size()), what, nodes.text(run.model())),
      nodes.all.size());
}

/// One finding for the nodes of a solver message; shows the reasons of the first three.
void check_message(const GeometryRun& run, const Tie& tie, RuleId rule, int message,
                   std::string_view field, std::string_view what) {
  const Nodes nodes = nodes_where(tie, [&](const TiedNode& n) { return n.message == message; });
  Finding* d =
      about_nodes(run, rule, tie, field, nodes, what, fmt::format(" of {}", tie.nodes.size()));
  if (d == nullptr) return;
  d->reference = rule_of(rule).message(message);
  constexpr std::size_t most = 3;
  for (std::size_t i = 0; i < std::min(most, nodes.all.size()); ++i)
    d->notes.emplace_back(run.model().node_span(nodes.all[i]->node), why_text(tie, *nodes.all[i]));
}

void check_messages(const GeometryRun& run, const Tie& tie) {
  check_message(run, tie, RuleId::DK340, 1078, "dsearch", "without a main segment");
  for (const int message : {1071, 1157})
    check_message(run, tie, RuleId::DK341, message, "dsearch", "not tied, no segment is found");
  for (const int message : {1158, 1872})
    check_message(run, tie, RuleId::DK342, message, "Spotflag",
                  "too far beyond the rim of a segment and not tied");
  for (const int message : {1079, 1873})
    check_message(run, tie, RuleId::DK343, message, "dsearch",
                  "tied, but beyond the rim of a segment");
  for (const RepeatedTies& r : tie.repeated)
    run.report(RuleId::DK344, *tie.inter, "grnd_IDs",
               fmt::format("{}: /INTER/TYPE2 {} already makes {} of its ties", tie_name(tie),
                           r.interface_id, r.count),
               static_cast<std::size_t>(r.count));
}

void check_conditions(const GeometryRun& run, const Tie& tie) {
  const Model& model = run.model();
  if (tie.spotflag == 27 || tie.spotflag == 28)
    about_nodes(run, RuleId::DK345, tie, "Spotflag",
                nodes_where(tie, [](const TiedNode& n) { return n.penalty; }),
                "tied by penalty, because of another condition");
  about_nodes(run, RuleId::DK346, tie, "grnd_IDs",
              nodes_where(tie, [](const TiedNode& n) { return n.removed_by == 1209; }),
              "left out, because Itetra10 2 condenses mid nodes");
  if (tie.main_and_tied.empty()) return;
  std::vector<std::int64_t> ids;
  for (const NodeIndex n : tie.main_and_tied) ids.push_back(model.node_id(n));
  std::sort(ids.begin(), ids.end());
  Finding& d =
      run.report(RuleId::DK347, *tie.inter, "surf_IDm",
                 fmt::format("{}: {} of segments in use {} tied, too: {}", tie_name(tie),
                             count_text(ids.size(), "corner"), are(ids.size()), list_text(ids)),
                 ids.size());
  d.notes.emplace_back(model.node_span(tie.main_and_tied.front()), "one of the nodes");
}

Vec place(const Coordinates& x, NodeIndex n) { return {x.x[n], x.y[n], x.z[n]}; }

/// Position of a point on a segment by mean directions: -1 to 1 within a parallelogram, independent
/// of the solver's sub-triangles. nullopt: no area.
std::optional<std::pair<double, double>> plain_place(const Coordinates& x,
                                                     const std::array<NodeIndex, 4>& c,
                                                     const Vec& p) {
  const Vec a = place(x, c[0]), b = place(x, c[1]), d = place(x, c[2]), e = place(x, c[3]);
  const Vec middle = 0.25 * (a + b + d + e);
  const Vec u = 0.25 * (b - a + d - e), v = 0.25 * (e - a + d - b), r = p - middle;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), area = uu * vv - uv * uv;
  if (!(area > 0)) return std::nullopt;
  return std::pair((dot(r, u) * vv - dot(r, v) * uv) / area,
                   (dot(r, v) * uu - dot(r, u) * uv) / area);
}

/// Nodes in line with a mesh line: tied to its last segment from far away, without a message.
void check_in_line(const GeometryRun& run, const Tie& tie) {
  if (tie.inter->Isearch.value == 1) return;
  constexpr double limit = 1.02;  // above it the solver reports the node as outside
  const Coordinates& x = run.scene.coordinates;
  const Nodes nodes = nodes_where(tie, [&](const TiedNode& n) {
    if (!n.tied || n.message != 0) return false;
    const auto& c = tie.main[n.segment];
    if (c[2] == c[3] || std::max(std::fabs(n.s), std::fabs(n.t)) != 1) return false;
    const auto true_place = plain_place(x, c, place(x, n.node));
    return true_place &&
           std::max(std::fabs(true_place->first), std::fabs(true_place->second)) > limit;
  });
  if (nodes.all.empty()) return;
  const auto farthest = std::max_element(
      nodes.all.begin(), nodes.all.end(),
      [](const TiedNode* a, const TiedNode* b) { return a->distance < b->distance; });
  run.report(
      RuleId::DK348, *tie.inter, "dsearch",
      fmt::format(
          "{}: {} {} tied to the rim of a segment without lying over it, up to {:.6g} away: {}",
          tie_name(tie), count_text(nodes.all.size(), "node"), are(nodes.all.size()),
          (*farthest)->distance, nodes.text(run.model())),
      nodes.all.size());
}

/// In a sub-triangle without area the solver computes the distance 0 for any node.
void check_collapsed(const GeometryRun& run, const Tie& tie) {
  const Coordinates& x = run.scene.coordinates;
  std::map<std::uint32_t, std::size_t> caught;
  std::size_t nodes = 0;
  for (const TiedNode& n : tie.nodes) {
    if (!n.tied || n.segment == no_index || n.distance != 0 || tie.inter->Isearch.value == 1)
      continue;
    const auto& c = tie.main[n.segment];
    Vec low = place(x, c[0]), high = low;
    for (const NodeIndex corner : c) {
      const Vec p = place(x, corner);
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const Vec p = place(x, n.node);
    const bool outside =
        p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y || p.z < low.z || p.z > high.z;
    if (!outside) continue;
    ++caught[n.segment];
    ++nodes;
  }
  if (nodes == 0) return;
  std::vector<std::int64_t> first;
  for (const NodeIndex corner : tie.main[caught.begin()->first])
    first.push_back(run.model().node_id(corner));
  run.report(
      RuleId::DK349, *tie.inter, "surf_IDm",
      fmt::format("{}: {} {} tied at distance 0 to {} without area; the first one is {}",
                  tie_name(tie), count_text(nodes, "node"), are(nodes),
                  count_text(caught.size(), "segment"), fmt::format("{}", fmt::join(first, " "))),
      nodes);
}

/// Ties that depend on element numbers, or on a wrong entry in the solver's tables.
void check_thickness(const GeometryRun& run, const Tie& tie) {
  const Nodes nodes = nodes_where(tie, [](const TiedNode& n) {
    if (n.least_search == n.most_search) return false;
    if (n.segment != no_index) return n.tied && n.distance >= n.least_search;
    return n.nearest != no_index && n.nearest_distance >= n.search &&
           n.nearest_distance < n.most_search;
  });
  if (!nodes.all.empty())
    run.report(
        RuleId::DK350, *tie.inter, "dsearch",
        fmt::format("{}: whether {} {} tied depends on the order of corners in the shells around: "
                    "{}",
                    tie_name(tie), count_text(nodes.all.size(), "node"), are(nodes.all.size()),
                    nodes.text(run.model())),
        nodes.all.size());
  about_nodes(run, RuleId::DK351, tie, "dsearch",
              nodes_where(tie, [](const TiedNode& n) { return n.missed; }),
              "not tied, although a segment is within the search distance");
}

}  // namespace

void check_ties(const GeometryRun& run) {
  for (const Tie& tie : run.ties) {
    if (!tie.not_evaluated.empty()) continue;
    check_messages(run, tie);
    check_conditions(run, tie);
    check_in_line(run, tie);
    check_collapsed(run, tie);
    check_thickness(run, tie);
  }
}

}  // namespace deck::detail
