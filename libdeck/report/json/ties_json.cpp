// Ties of /INTER/TYPE2 as JSON.
#include "report/json/ties_json.hpp"

#include "deck/contact/ties.hpp"
#include "verdict/shared/of_interface.hpp"

namespace deck::detail {
namespace {

void write_node(JsonWriter& j, const Model& model, const Tie& tie, const TiedNode& n) {
  const bool found = n.segment != no_index;
  j.begin_object(true).field("node", model.nodes.id[n.node]).field("tied", n.tied).key("segment");
  if (found) {
    j.begin_array(true);
    for (const NodeIndex corner : tie.main[n.segment]) j.value(model.nodes.id[corner]);
    j.end_array();
  } else {
    j.null();
  }
  const auto number = [&](const char* name, bool known, double v) {
    j.key(name);
    known ? j.value(v) : j.null();
  };
  number("s", found, n.s);
  number("t", found, n.t);
  number("distance", found, n.distance);
  const double search = n.search != 0 ? n.search : tie.search_distance;
  number("search", search != 0, search);
  j.key("message");
  n.message != 0 ? j.value(n.message) : j.null();
  j.field("penalty", n.penalty).field("why", why_text(tie, n));
  if (!found && n.nearest != no_index) {
    j.key("nearest").begin_object(true).key("segment").begin_array(true);
    for (const NodeIndex corner : tie.main[n.nearest]) j.value(model.nodes.id[corner]);
    j.end_array().field("distance", n.nearest_distance).end_object();
  }
  j.end_object();
}

}  // namespace

void write_ties(JsonWriter& j, const Scene& scene, bool all) {
  j.key("ties").begin_array();
  for (const Tie& tie : scene.ties) {
    j.begin_object().field("id", tie.inter->id).field("type", tie.inter->type);
    j.field("title", tie.inter->title).field("level", to_string(level_of_tie(tie)));
    j.key("search_distance");
    tie.search_distance != 0 ? j.value(tie.search_distance) : j.null();
    j.key("not_evaluated");
    tie.not_evaluated.empty() ? j.null() : j.value(tie.not_evaluated);
    j.key("nodes").begin_array();
    for (const TiedNode& n : tie.nodes)
      if (all || !n.tied || n.message != 0) write_node(j, *scene.model, tie, n);
    j.end_array().key("repeated").begin_array(true);
    for (const RepeatedTies& r : tie.repeated)
      j.begin_object(true).field("interface", r.interface_id).field("nodes", r.count).end_object();
    j.end_array().key("main_and_tied").begin_array(true);
    for (const NodeIndex n : tie.main_and_tied) j.value(scene.model->nodes.id[n]);
    const TieCounts count = count_ties(tie);
    j.end_array().key("summary").begin_object(true).field("nodes", count.nodes);
    j.field("tied", count.tied).field("not_found", count.not_found);
    j.field("dropped", count.dropped).field("elsewhere", count.elsewhere);
    j.field("outside", count.outside).end_object().end_object();
  }
  j.end_array();
}

}  // namespace deck::detail
