// The result of `deck fix` as a JSON document.
#include "report/shared/fix.hpp"
#include "report/shared/gate.hpp"
#include "report/shared/json.hpp"

namespace deck {
namespace {

void write_ids(JsonWriter& j, std::string_view name, const std::vector<std::int64_t>& ids) {
  j.key(name).begin_array(true);
  for (const std::int64_t id : ids) j.value(id);
  j.end_array();
}

void write_vector(JsonWriter& j, std::string_view name, const std::array<double, 3>& v) {
  j.key(name).begin_array(true);
  for (const double d : v) j.value(d);
  j.end_array();
}

void write_count(JsonWriter& j, std::string_view name, const FixCount& c) {
  j.key(name).begin_object(true);
  j.field("pairs", c.pairs).field("nodes", c.nodes).field("untreated", c.untreated);
  j.field("on_surface", c.on_surface).field("deepest", c.deepest).end_object();
}

void write_changes(JsonWriter& j, const std::vector<FieldChange>& changes) {
  j.key("changes").begin_array();
  for (const FieldChange& c : changes) {
    j.begin_object(true);
    j.field("field", c.field).field("old_text", c.old_text).field("new_text", c.new_text);
    j.field("old_value", c.old_value).field("new_value", c.new_value).end_object();
  }
  j.end_array();
}

void write_tie_counts(JsonWriter& j, std::string_view name, const TieCounts& n) {
  j.key(name).begin_object(true).field("nodes", n.nodes).field("tied", n.tied);
  j.field("not_found", n.not_found).field("dropped", n.dropped).field("elsewhere", n.elsewhere);
  j.field("outside", n.outside).end_object();
}

void write_ties(JsonWriter& j, const PenetrationFix& fix) {
  j.key("ties").begin_array();
  for (const FixedTie& tie : fix.ties) {
    j.begin_object().field("id", tie.id).field("title", tie.title).field("reach", tie.reach);
    write_tie_counts(j, "before", tie.before);
    write_tie_counts(j, "after", tie.after);
    j.key("needed");
    tie.nodes.empty() ? j.null() : j.value(tie.needed);
    j.key("nodes").begin_array();
    for (const NewlyTied& n : tie.nodes) {
      j.begin_object(true).field("node", n.node);
      write_ids(j, "segment", n.segment);
      j.field("distance", n.distance).end_object();
    }
    j.end_array();
    write_changes(j, tie.changes);
    j.end_object();
  }
  j.end_array();
}

void write_interface(JsonWriter& j, const FixedInterface& i) {
  j.begin_object();
  j.field("id", i.id).field("type", i.type).field("title", i.title);
  write_count(j, "before", i.before);
  write_count(j, "after", i.after);
  write_changes(j, i.changes);
  j.end_object();
}

void write_interfaces(JsonWriter& j, const PenetrationFix& fix) {
  j.key("interfaces").begin_array();
  for (const FixedInterface& i : fix.interfaces) write_interface(j, i);
  j.end_array();
}

void write_crossings(JsonWriter& j, const PenetrationFix& fix) {
  j.key("crossings").begin_object(true);
  j.field("before", fix.crossings_before).field("after", fix.crossings_after).end_object();
}

/// What one strategy of several did.
void write_step(JsonWriter& j, const PenetrationFix& step) {
  j.begin_object().field("strategy", step.strategy).field("complete", step.complete);
  write_crossings(j, step);
  write_interfaces(j, step);
  write_ties(j, step);
  std::vector<std::int64_t> nodes;
  for (const MovedNode& m : step.moved) nodes.push_back(m.id);
  write_ids(j, "moved", nodes);
  j.field("not_treated", step.refused.size());
  const FixScore score = score_of(step);
  j.key("score").begin_object(true).field("solved", score.solved).field("left", score.left);
  j.field("not_treated", score.not_treated).field("treated_already", score.treated_already);
  j.end_object().end_object();
}

void write_refused(JsonWriter& j, const PenetrationFix& fix) {
  j.key("not_treated").begin_array();
  for (const FixRefusal& r : fix.refused) {
    j.begin_object(true).field("interface", r.interface_id);
    write_ids(j, "nodes", r.nodes);
    j.field("depth", r.depth).key("distance");
    r.distance > 0 ? j.value(r.distance) : j.null();
    j.field("reason", r.reason).key("next");
    r.next.empty() ? j.null() : j.value(r.next);
    j.end_object();
  }
  j.end_array();
}

}  // namespace

std::string repair_json(const PenetrationFix& fix, std::string_view deck,
                        const std::vector<NextCommand>& next, std::string_view patch) {
  std::string out;
  JsonWriter j(out);
  j.begin_object().field("strategy", fix.strategy);
  write_crossings(j, fix);
  write_refused(j, fix);
  j.key("groups").begin_array();
  for (const RefusedGroup& g : refused_groups({fix}, deck))
    j.begin_object(true).field("text", g.text).field("command", g.command).end_object();
  j.end_array().key("next").begin_array();
  for (const NextCommand& n : next)
    j.begin_object(true).field("does", n.does).field("command", n.command).end_object();
  j.end_array().field("patch", patch).end_object();
  return out;
}

std::string fix_json(const LoadedDeck& loaded, const PenetrationFix& fix, std::string_view written,
                     const std::vector<PenetrationFix>& steps) {
  std::string out;
  JsonWriter j(out);
  j.begin_object();
  write_json_head(j, "deck/fix", 1);
  write_json_deck(j, loaded.path(), loaded.deck(), nullptr, nullptr);
  write_json_coverage(j,
                      coverage_of(loaded.deck(), loaded.interfaces(), Examined::contacts_and_ties));
  write_verdict(j, verdict_of(loaded));
  j.key("strategy");
  fix.strategy.empty() ? j.null() : j.value(fix.strategy);
  j.field("written", written).field("complete", fix.complete);
  j.field("iterations", fix.iterations);
  j.key("tied").begin_object(true).field("pairs", fix.tied_pairs);
  j.field("nodes", fix.tied_nodes).end_object();
  write_crossings(j, fix);
  write_interfaces(j, fix);
  write_ties(j, fix);
  if (steps.size() > 1 || fix.strategy.empty()) {
    j.key(fix.strategy.empty() ? "proposals" : "steps").begin_array();
    for (const PenetrationFix& step : steps) write_step(j, step);
    j.end_array();
  }
  j.key("moved").begin_array();
  for (const MovedNode& m : fix.moved) {
    j.begin_object(true).field("node", m.id).key("part");
    m.part == 0 ? j.null() : j.value(m.part);
    write_vector(j, "by", m.by);
    j.field("distance", m.distance);
    j.end_object();
  }
  j.end_array();
  j.key("actions").begin_array();
  for (const FixAction& a : fix.actions) {
    j.begin_object(true).field("interface", a.interface_id);
    write_ids(j, "secondary", a.secondary);
    write_ids(j, "main", a.main);
    j.field("depth", a.depth).field("gap", a.gap);
    j.field("before", to_string(a.before)).field("after", to_string(a.after));
    j.field("solver_stops", a.stops).field("gap_left", a.gap0).end_object();
  }
  j.end_array();
  write_refused(j, fix);
  j.end_object();
  out += '\n';
  return out;
}

}  // namespace deck
