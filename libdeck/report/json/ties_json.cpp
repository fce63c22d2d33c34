// Ties of /INTER/TYPE2 in documents.
#include "report/json/ties_json.hpp"

#include "report/shared_records.hpp"
#include "verdict/shared/of_interface.hpp"

namespace deck {
namespace {

using TieCorners = std::array<std::int64_t, 4>;

struct TiedNodeRow {
  const Model& model;
  const Tie& tie;
  const TiedNode* node;
  bool found() const { return node->segment != no_index; }
  TieCorners corners(std::uint32_t segment) const {
    return segment == no_index ? TieCorners{} : node_ids(model, tie.main[segment]);
  }
  double search() const { return node->search != 0 ? node->search : tie.search_distance; }
};

struct NearestRow {
  TieCorners segment{};
  double distance = 0;
};
Record<NearestRow> record_of(const NearestRow*) {
  static constexpr Column<NearestRow> columns[] = {column<&NearestRow::segment>("segment"),
                                                   column<&NearestRow::distance>("distance")};
  return {"nearest_segment", "", columns, true};
}

Record<TiedNodeRow> record_of(const TiedNodeRow*) {
  using Row = TiedNodeRow;
  static constexpr Column<Row> columns[] = {
      column("node", [](const Row& r) { return r.model.nodes.id[r.node->node]; }),
      column<&TiedNodeRow::node, &TiedNode::tied>("tied"),
      column("segment", "Node ids; triangles repeat the last",
             [](const Row& r) { return known(r.found(), r.corners(r.node->segment)); }),
      column("s",
             "Place on the segment, -1 to 1 within it; on triangles with Spotflag 27 the weight of "
             "the first corner",
             [](const Row& r) { return known(r.found(), r.node->s); }),
      column("t", [](const Row& r) { return known(r.found(), r.node->t); }),
      column("distance", [](const Row& r) { return known(r.found(), r.node->distance); }),
      column("search", "How far the solver searches with this segment, or with the nearest one",
             [](const Row& r) { return known(r.search() != 0, r.search()); }),
      column("message", "Message of the solver that lists the node",
             [](const Row& r) { return known(r.node->message != 0, r.node->message); }),
      column<&TiedNodeRow::node, &TiedNode::penalty>("penalty", "Tied by penalty"),
      column("why", "A sentence", [](const Row& r) { return why_text(r.tie, *r.node); }),
      column("nearest", "Without a segment: the nearest one", [](const Row& r) {
        return if_any(!r.found() && r.node->nearest != no_index,
                      NearestRow{r.corners(r.node->nearest), r.node->nearest_distance});
      })};
  return {"tied_node", "A secondary node of a tie.", columns, true};
}

}  // namespace

Record<RepeatedTies> record_of(const RepeatedTies*) {
  static constexpr Column<RepeatedTies> columns[] = {
      column<&RepeatedTies::interface_id>("interface"), column<&RepeatedTies::count>("nodes")};
  return {"repeated_ties", "", columns, true};
}

Record<TieCounts> record_of(const TieCounts*) {
  static constexpr Column<TieCounts> columns[] = {
      column<&TieCounts::nodes>("nodes"),
      column<&TieCounts::tied>("tied"),
      column<&TieCounts::not_found>("not_found", "No segment within reach"),
      column<&TieCounts::dropped>("dropped", "A segment was found, and the node dropped"),
      column<&TieCounts::elsewhere>("elsewhere", "Taken out because something else holds them"),
      column<&TieCounts::outside>("outside", "Tied from beyond the rim of their segment")};
  return {"tie_counts", "", columns, true};
}

Record<TieRow> record_of(const TieRow*) {
  using Row = TieRow;
  static constexpr Column<Row> columns[] = {
      column<&TieRow::tie, &Tie::inter, &InterType2::id>("id"),
      column<&TieRow::tie, &Tie::inter, &InterType2::type>("type", "2"),
      column<&TieRow::tie, &Tie::inter, &InterType2::title>("title"),
      column("level", "As of an interface", [](const Row& r) { return level_of_tie(*r.tie); }),
      column(
          "search_distance", "null: every pair has its own, or there is none",
          [](const Row& r) { return known(r.tie->search_distance != 0, r.tie->search_distance); }),
      column(
          "not_evaluated", "Why no segments were searched; null: they were",
          [](const Row& r) { return known(!r.tie->not_evaluated.empty(), r.tie->not_evaluated); }),
      column("nodes",
             "With --all every secondary node, else those that are not tied, or tied from beyond a "
             "rim",
             [](const Row& r) {
               return Rows<TiedNodeRow>{[&r](const auto& add) {
                 for (const TiedNode& n : r.tie->nodes)
                   if (r.all || !n.tied || n.message != 0) add({r.model, *r.tie, &n});
               }};
             }),
      column<&TieRow::tie, &Tie::repeated>(
          "repeated", "Ties that an earlier interface makes already (message 1630)"),
      column("main_and_tied",
             "Main nodes in use that are tied themselves: the solver stops (message 556)",
             [](const Row& r) {
               std::vector<std::int64_t> ids;
               for (const NodeIndex n : r.tie->main_and_tied) ids.push_back(r.model.nodes.id[n]);
               return ids;
             }),
      column("summary", [](const Row& r) { return count_ties(*r.tie); })};
  return {"tie", "A TYPE2 at start-up.", columns};
}

}  // namespace deck
