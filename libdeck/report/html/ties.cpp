// Ties of /INTER/TYPE2 and TYPE10 in the page: which node goes to which segment, and of those that
// are not tied, or tied from beyond the rim of their segment, what `deck gaps` says.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/shared/count.hpp"
#include "contact/shared/element_names.hpp"
#include "deck/contact/ties.hpp"
#include "model/shared/families.hpp"
#include "model/shared/item_spans.hpp"
#include "report/html/parts.hpp"

namespace deck::detail {
namespace {

constexpr std::size_t most_tie_rows = 20000;  // of a tie, untied nodes first

/// What the page makes of a node; the numbers are those of tools/viewer/src/meta.ts.
enum class Holds { tied = 0, lost = 1, beyond_rim = 2, elsewhere = 3 };

Holds holds(const TiedNode& n) {
  if (n.tied) return n.message == 0 ? Holds::tied : Holds::beyond_rim;
  return n.lost() ? Holds::lost : Holds::elsewhere;
}

/// The segment that the node is tied to, else the nearest.
std::uint32_t segment_of(const TiedNode& n) {
  return n.segment != no_index ? n.segment : n.nearest;
}

/// Positions in Tie::nodes of what the table has, untied nodes first.
std::vector<std::uint32_t> listed(const Tie& tie) {
  std::vector<std::uint32_t> out;
  for (const Holds wanted : {Holds::lost, Holds::beyond_rim})
    for (std::uint32_t i = 0; i < tie.nodes.size() && out.size() < most_tie_rows; ++i)
      if (holds(tie.nodes[i]) == wanted) out.push_back(i);
  return out;
}

/// Positions of the segments that a line ends at, ascending.
std::vector<std::uint32_t> segments_of(const Tie& tie) {
  std::vector<std::uint8_t> marks(tie.main.size(), 0);
  for (const TiedNode& n : tie.nodes)
    if (const std::uint32_t s = segment_of(n); s != no_index) marks[s] = 1;
  return marked(marks);
}

/// An untied node as the page lists it; distances that are not finite are not known.
struct UntiedRow {
  std::uint32_t position = 0;  ///< in the tie
  NodeIndex node = 0;
  double distance = 0, search = 0;
  std::string reason, why;
};

/// A tie as the page draws it.
struct TieLines {
  std::vector<std::int64_t> main;     ///< nodes of the segments, one segment after the other
  std::vector<std::int64_t> nodes;    ///< that are tied, or should be
  std::vector<std::int64_t> segment;  ///< of each node: which segment, -1: none
  std::vector<std::int64_t> holds;    ///< of each node
  std::vector<UntiedRow> rows;

  void add(std::uint32_t node, std::int64_t to, Holds how) {
    nodes.push_back(node);
    segment.push_back(to);
    holds.push_back(static_cast<int>(how));
  }
};

TieLines lines_of(const Tie& tie, const PageNodes& nodes) {
  TieLines out;
  const std::vector<std::uint32_t> segments = segments_of(tie);
  for (const std::uint32_t s : segments)
    for (const NodeIndex n : tie.main[s]) out.main.push_back(nodes[n]);
  for (const TiedNode& n : tie.nodes) {
    const std::uint32_t s = segment_of(n);
    const auto at = std::lower_bound(segments.begin(), segments.end(), s);
    out.add(nodes[n.node], s == no_index ? -1 : at - segments.begin(), holds(n));
  }
  for (const std::uint32_t i : listed(tie)) {
    const TiedNode& n = tie.nodes[i];
    const double search = n.search != 0 ? n.search : tie.search_distance;
    const double distance = n.segment != no_index   ? n.distance
                            : n.nearest != no_index ? n.nearest_distance
                                                    : INFINITY;
    out.rows.push_back({i, n.node, distance, search != 0 ? search : INFINITY, short_reason(tie, n),
                        why_text(tie, n)});
  }
  return out;
}

/// A TYPE10: each node goes to the segment that is nearest within the gap.
TieLines lines_of(const Contact& c, const PageNodes& nodes) {
  TieLines out;
  std::vector<const PenetrationRow*> nearest(c.secondary.size(), nullptr);
  for (const PenetrationRow& row : c.penetrations)
    if (const PenetrationRow*& known = nearest[row.secondary];
        known == nullptr || row.distance < known->distance)
      known = &row;
  std::int64_t segments = 0;
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    const bool found = nearest[i] != nullptr;
    if (found)
      for (const NodeIndex n : c.main[nearest[i]->main].nodes) out.main.push_back(nodes[n]);
    out.add(nodes[c.secondary[i].node], found ? segments++ : -1,
            found || !c.evaluated ? Holds::tied : Holds::lost);
  }
  for (const std::uint32_t i : untied_secondary(c)) {
    if (out.rows.size() == most_tie_rows) break;
    out.rows.push_back(
        {i, c.secondary[i].node, INFINITY, c.gapmin, "no segment",
         fmt::format("No segment is within the gap of {:.6g}: the node is not tied.", c.gapmin)});
  }
  return out;
}

void write_lines(JsonWriter& j, const TieLines& lines, const Model& model,
                 Connectivity& connectivity) {
  const auto list = [&](std::string_view name, const std::vector<std::int64_t>& values) {
    j.key(name).begin_array(true);
    for (const std::int64_t v : values) j.value(v);
    j.end_array();
  };
  j.begin_object(true);
  list("main", lines.main);
  list("nodes", lines.nodes);
  list("segment", lines.segment);
  list("holds", lines.holds);
  std::vector<NodeIndex> nodes;
  for (const UntiedRow& row : lines.rows) nodes.push_back(row.node);
  const std::vector<Span> spans = node_spans(model, nodes);
  j.key("rows").begin_array(true);
  for (std::size_t k = 0; k < spans.size(); ++k) {
    const UntiedRow& row = lines.rows[k];
    const bool placed = spans[k].valid();
    write_row(j, row.position, row.distance, row.search,
              part_position(model, element_at(model, connectivity, row.node)), row.reason, row.why,
              placed ? std::int64_t{spans[k].file} : -1,
              placed ? model.deck->sources.position(spans[k]).line : 0);
  }
  j.end_array().end_object();
}

/// Calls use(node, close) for both ends of all lines; `close`: the node is not simply tied.
template <class Use>
void each_end(const Scene& scene, const Use& use) {
  for (const Tie& tie : scene.ties)
    for (const TiedNode& n : tie.nodes) {
      const bool close = holds(n) != Holds::tied;
      use(n.node, close);
      if (const std::uint32_t s = segment_of(n); s != no_index)
        for (const NodeIndex corner : tie.main[s]) use(corner, close);
    }
}

}  // namespace

std::vector<NodeIndex> use_nodes(const Scene& scene, PageNodes& nodes) {
  std::vector<NodeIndex> out;
  each_end(scene, [&](NodeIndex n, bool close) {
    if (close || !nodes.used(n)) out.push_back(n);
  });
  each_end(scene, [&](NodeIndex n, bool) { nodes.use(n); });
  // The sides of a TYPE10 are those of a contact.
  for (const Contact& c : scene.contacts)
    for (const std::uint32_t i : untied_secondary(c)) out.push_back(c.secondary[i].node);
  return out;
}

bool has_ties(const Scene& scene) {
  return !scene.ties.empty() || std::any_of(scene.contacts.begin(), scene.contacts.end(),
                                            [](const Contact& c) { return c.ties(); });
}

std::string ties_block(const HtmlInput& input, const PageNodes& nodes) {
  const Model& model = *input.scene->model;
  Connectivity connectivity(model);
  std::string out;
  JsonWriter j(out);
  j.begin_array();
  for (const Tie& tie : input.scene->ties)
    write_lines(j, lines_of(tie, nodes), model, connectivity);
  for (const Contact& c : input.scene->contacts)
    if (c.ties()) write_lines(j, lines_of(c, nodes), model, connectivity);
  j.end_array();
  return packed_text(out);
}

void write_page_ties(JsonWriter& j, const HtmlInput& input) {
  const std::size_t contacts = input.scene->interfaces->ordered.size();
  j.key("ties").begin_array();
  for (std::size_t i = 0; i < input.scene->ties.size(); ++i) {
    const Tie& tie = input.scene->ties[i];
    const TieCounts n = count_ties(tie);
    double farthest = 0;
    for (const TiedNode& node : tie.nodes)
      if (node.tied) farthest = std::max(farthest, node.distance);
    j.begin_object(true).field("interface", contacts + i).field("nodes", n.nodes);
    j.field("tied", n.tied).field("lost", n.lost()).field("beyond_rim", n.outside);
    j.field("search_distance", tie.search_distance).field("farthest", farthest);
    j.field("text", holds_text(tie)).field("losses", losses_text(tie));
    j.field("evaluated", tie.not_evaluated.empty());
    const bool stops = tie.main_and_tied.size() + (tie.ignore == 0 ? n.not_found : 0) > 0;
    j.field("stops", stops).end_object();
  }
  for (std::size_t i = 0; i < input.scene->contacts.size(); ++i) {
    const Contact& c = input.scene->contacts[i];
    if (!c.ties()) continue;
    const ContactTotals& t = input.view->contacts[i];
    double farthest = 0;
    for (const PenetrationRow& row : c.penetrations) farthest = std::max(farthest, row.distance);
    const std::size_t nodes = c.secondary.size();
    j.begin_object(true).field("interface", interface_position(*input.scene, c.inter));
    j.field("nodes", nodes).field("tied", t.tied.nodes).field("lost", t.untied);
    j.field("beyond_rim", 0).field("search_distance", c.gapmin).field("farthest", farthest);
    j.field("text", !c.evaluated ? std::string("not evaluated")
                    : t.untied > 0
                        ? fmt::format("{} of {} {} not tied", t.untied,
                                      count(nodes, "node", "nodes"), t.untied == 1 ? "is" : "are")
                        : fmt::format("{} tied", count(nodes, "node is", "nodes are")));
    j.field("losses", t.untied > 0 ? fmt::format("{} without a segment within the gap", t.untied)
                                   : std::string("-"));
    j.field("evaluated", c.evaluated).field("stops", t.solver_errors > 0).end_object();
  }
  j.end_array();
}

}  // namespace deck::detail
