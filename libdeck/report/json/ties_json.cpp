// Ties of /INTER/TYPE2 in documents.
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
LINE_RECORD(NearestRow, "nearest_segment", "", COLUMN("segment", "", r.segment),
            COLUMN("distance", "", r.distance));

LINE_RECORD(
    TiedNodeRow, "tied_node", "A secondary node of a tie.",
    COLUMN("node", "", r.model.nodes.id[r.node->node]), COLUMN("tied", "", r.node->tied),
    COLUMN("segment", "Node ids; triangles repeat the last",
           known(r.found(), r.corners(r.node->segment))),
    COLUMN("s",
           "Place on the segment, -1 to 1 within it; on triangles with Spotflag 27 the weight of "
           "the first corner",
           known(r.found(), r.node->s)),
    COLUMN("t", "", known(r.found(), r.node->t)),
    COLUMN("distance", "", known(r.found(), r.node->distance)),
    COLUMN("search", "How far the solver searches with this segment, or with the nearest one",
           known(r.search() != 0, r.search())),
    COLUMN("message", "Message of the solver that lists the node",
           known(r.node->message != 0, r.node->message)),
    COLUMN("penalty", "Tied by penalty", r.node->penalty),
    COLUMN("why", "A sentence", why_text(r.tie, *r.node)),
    COLUMN("nearest", "Without a segment: the nearest one",
           if_any(!r.found() && r.node->nearest != no_index,
                  NearestRow{r.corners(r.node->nearest), r.node->nearest_distance})));

void each_tied_node(const TieRow& r, const std::function<void(const TiedNodeRow&)>& add) {
  for (const TiedNode& n : r.tie->nodes)
    if (r.all || !n.tied || n.message != 0) add({r.model, *r.tie, &n});
}

}  // namespace

LINE_RECORD(RepeatedTies, "repeated_ties", "", COLUMN("interface", "", r.interface_id),
            COLUMN("nodes", "", r.count));

LINE_RECORD(TieCounts, "tie_counts", "", COLUMN("nodes", "", r.nodes), COLUMN("tied", "", r.tied),
            COLUMN("not_found", "No segment within reach", r.not_found),
            COLUMN("dropped", "A segment was found, and the node dropped", r.dropped),
            COLUMN("elsewhere", "Taken out because something else holds them", r.elsewhere),
            COLUMN("outside", "Tied from beyond the rim of their segment", r.outside));

RECORD(
    TieRow, "tie", "A TYPE2 at start-up.", COLUMN("id", "", r.tie->inter->id),
    COLUMN("type", "2", r.tie->inter->type), COLUMN("title", "", r.tie->inter->title),
    COLUMN("level", "As of an interface", level_of_tie(*r.tie)),
    COLUMN("search_distance", "null: every pair has its own, or there is none",
           known(r.tie->search_distance != 0, r.tie->search_distance)),
    COLUMN("not_evaluated", "Why no segments were searched; null: they were",
           known(!r.tie->not_evaluated.empty(), r.tie->not_evaluated)),
    COLUMN("nodes",
           "With --all every secondary node, else those that are not tied, or tied from beyond a "
           "rim",
           rows_from<each_tied_node>(r)),
    COLUMN("repeated", "Ties that an earlier interface makes already (message 1630)",
           r.tie->repeated),
    COLUMN("main_and_tied",
           "Main nodes in use that are tied themselves: the solver stops (message 556)",
           node_ids(r.model, r.tie->main_and_tied)),
    COLUMN("summary", "", count_ties(*r.tie)));

}  // namespace deck
