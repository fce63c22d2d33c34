// Ties of /INTER/TYPE2 and TYPE10 in the page: which node goes to which segment, and of those that
// are not tied, or tied from beyond the rim of their segment, what `deck gaps` says.
#include <fmt/format.h>

#include <algorithm>

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
  std::vector<bool> marks(tie.main.size());
  for (const TiedNode& n : tie.nodes)
    if (const std::uint32_t s = segment_of(n); s != no_index) marks[s] = true;
  std::vector<std::uint32_t> out;
  for (std::uint32_t s = 0; s < marks.size(); ++s)
    if (marks[s]) out.push_back(s);
  return out;
}

class TieWriter {
 public:
  TieWriter(const HtmlInput& input, const PageNodes& nodes, std::string& out)
      : input_(input), model_(*input.scene->model), nodes_(nodes), connectivity_(model_), j_(out) {}

  void run() {
    j_.begin_array();
    for (const Tie& tie : input_.scene->ties) write(tie);
    for (const Contact& c : input_.scene->contacts)
      if (c.ties()) write(c);
    j_.end_array();
  }

 private:
  void write(const Tie& tie) {
    const std::vector<std::uint32_t> segments = segments_of(tie);
    j_.begin_object(true).key("main").begin_array(true);
    for (const std::uint32_t s : segments)
      for (const NodeIndex n : tie.main[s]) j_.value(nodes_[n]);
    j_.end_array().key("nodes").begin_array(true);
    for (const TiedNode& n : tie.nodes) j_.value(nodes_[n.node]);
    j_.end_array().key("segment").begin_array(true);
    for (const TiedNode& n : tie.nodes) {
      const auto at = std::lower_bound(segments.begin(), segments.end(), segment_of(n));
      j_.value(segment_of(n) == no_index ? std::int64_t{-1} : at - segments.begin());
    }
    j_.end_array().key("holds").begin_array(true);
    for (const TiedNode& n : tie.nodes) j_.value(static_cast<int>(holds(n)));
    j_.end_array();
    write_rows(tie);
    j_.end_object();
  }

  /// A TYPE10: each node goes to the segment that is nearest within the gap.
  void write(const Contact& c) {
    std::vector<const PenetrationRow*> nearest(c.secondary.size(), nullptr);
    for (const PenetrationRow& row : c.penetrations)
      if (const PenetrationRow*& known = nearest[row.secondary];
          known == nullptr || row.distance < known->distance)
        known = &row;
    j_.begin_object(true).key("main").begin_array(true);
    for (const PenetrationRow* row : nearest)
      if (row != nullptr)
        for (const NodeIndex n : c.main[row->main].nodes) j_.value(nodes_[n]);
    j_.end_array().key("nodes").begin_array(true);
    for (const SecondaryNode& s : c.secondary) j_.value(nodes_[s.node]);
    j_.end_array().key("segment").begin_array(true);
    std::int64_t segments = 0;
    for (const PenetrationRow* row : nearest)
      j_.value(row != nullptr ? segments++ : std::int64_t{-1});
    j_.end_array().key("holds").begin_array(true);
    for (const PenetrationRow* row : nearest)
      j_.value(static_cast<int>(row != nullptr || !c.evaluated ? Holds::tied : Holds::lost));
    j_.end_array();
    std::vector<std::uint32_t> untied = untied_secondary(c);
    if (untied.size() > most_tie_rows) untied.resize(most_tie_rows);
    std::vector<NodeIndex> list;
    for (const std::uint32_t i : untied) list.push_back(c.secondary[i].node);
    const std::vector<Span> spans = node_spans(model_, list);
    j_.key("rows").begin_array(true);
    for (std::size_t k = 0; k < untied.size(); ++k) {
      j_.begin_array(true).value(untied[k]).null().value(c.gapmin).value(part_at(list[k]));
      j_.value("no segment")
          .value(fmt::format("No segment is within the gap of {:.6g}: the node is not tied.",
                             c.gapmin));
      place(spans[k]);
      j_.end_array();
    }
    j_.end_array().end_object();
  }

  void place(const Span& span) {
    j_.value(span.valid() ? std::int64_t{span.file} : std::int64_t{-1});
    j_.value(span.valid() ? input_.deck->sources.position(span).line : 0);
  }

  void write_rows(const Tie& tie) {
    const std::vector<std::uint32_t> rows = listed(tie);
    std::vector<NodeIndex> nodes;
    for (const std::uint32_t i : rows) nodes.push_back(tie.nodes[i].node);
    const std::vector<Span> spans = node_spans(model_, nodes);
    j_.key("rows").begin_array(true);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const TiedNode& n = tie.nodes[rows[k]];
      const bool found = n.segment != no_index;
      const double search = n.search != 0 ? n.search : tie.search_distance;
      const auto number = [&](bool known, double v) { known ? j_.value(v) : j_.null(); };
      j_.begin_array(true).value(rows[k]);
      number(segment_of(n) != no_index, found ? n.distance : n.nearest_distance);
      number(search != 0, search);
      j_.value(part_at(n.node)).value(short_reason(tie, n)).value(why_text(tie, n));
      place(spans[k]);
      j_.end_array();
    }
    j_.end_array();
  }

  std::int64_t part_at(NodeIndex node) {
    return part_position(model_, element_at(model_, connectivity_, node));
  }

  const HtmlInput& input_;
  const Model& model_;
  const PageNodes& nodes_;
  Connectivity connectivity_;
  JsonWriter j_;
};

}  // namespace

std::vector<NodeIndex> use_nodes(const Scene& scene, PageNodes& nodes) {
  std::vector<NodeIndex> out;
  const auto want = [&](NodeIndex n, bool always) {
    if (always || !nodes.used(n)) out.push_back(n);
  };
  for (const Tie& tie : scene.ties)
    for (const TiedNode& n : tie.nodes) {
      const bool close = holds(n) != Holds::tied;
      want(n.node, close);
      if (const std::uint32_t s = segment_of(n); s != no_index)
        for (const NodeIndex corner : tie.main[s]) want(corner, close);
    }
  for (const Tie& tie : scene.ties)
    for (const TiedNode& n : tie.nodes) {
      nodes.use(n.node);
      if (const std::uint32_t s = segment_of(n); s != no_index)
        for (const NodeIndex corner : tie.main[s]) nodes.use(corner);
    }
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
  std::string out;
  TieWriter(input, nodes, out).run();
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
  const auto& order = input.scene->interfaces->ordered;
  for (std::size_t i = 0; i < input.scene->contacts.size(); ++i) {
    const Contact& c = input.scene->contacts[i];
    if (!c.ties()) continue;
    const ContactTotals& t = input.view->contacts[i];
    double farthest = 0;
    for (const PenetrationRow& row : c.penetrations) farthest = std::max(farthest, row.distance);
    const std::size_t nodes = c.secondary.size();
    j.begin_object(true).field(
        "interface",
        static_cast<std::int64_t>(std::find(order.begin(), order.end(), c.inter) - order.begin()));
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
