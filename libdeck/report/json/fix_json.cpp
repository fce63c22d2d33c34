// The result of `deck fix` as a JSON document.
#include "report/shared/fix.hpp"
#include "report/shared_records.hpp"

namespace deck {

// Records of what a fix is made of.
LINE_RECORD(FixCount, "count", "Initial penetrations; lengths in working units.",
            COLUMN("pairs", "", r.pairs),
            COLUMN("nodes", "Distinct secondary nodes or edges", r.nodes),
            COLUMN("untreated", "Pairs that the solver leaves as they are, or at which it stops",
                   r.untreated),
            COLUMN("on_surface", "Pairs at distance 0", r.on_surface),
            COLUMN("deepest", "", r.deepest));

LINE_RECORD(FieldChange, "change", "", COLUMN("field", "", r.field),
            COLUMN("old_text", "As on the card; empty: blank", r.old_text),
            COLUMN("new_text", "", r.new_text),
            COLUMN("old_value", "Effective value, working units", r.old_value),
            COLUMN("new_value", "", r.new_value));

LINE_RECORD(NewlyTied, "newly_tied", "", COLUMN("node", "", r.node),
            COLUMN("segment", "", r.segment), COLUMN("distance", "", r.distance));

RECORD(FixedTie, "fixed_tie", "A TYPE2 that loses nodes.", COLUMN("id", "", r.id),
       COLUMN("title", "", r.title),
       COLUMN("reach", "How far its nodes may be, working units", r.reach),
       COLUMN("before", "", r.before), COLUMN("after", "", r.after),
       COLUMN("needed", "Search distance that ties them; null: none are tied",
              known(!r.nodes.empty(), r.needed)),
       COLUMN("nodes", "Newly tied", r.nodes), COLUMN("changes", "", r.changes));

RECORD(FixedInterface, "fixed_interface", "", COLUMN("id", "", r.id), COLUMN("type", "", r.type),
       COLUMN("title", "", r.title), COLUMN("before", "", r.before), COLUMN("after", "", r.after),
       COLUMN("changes", "", r.changes));

LINE_RECORD(FixRefusal, "not_treated", "", COLUMN("interface", "", r.interface_id),
            COLUMN("nodes", "Secondary node or edge; empty: the interface as a whole", r.nodes),
            COLUMN("depth", "In the deck as it was read", r.depth),
            COLUMN("distance", "tie: of a node from its nearest segment, working units",
                   known(r.distance > 0, r.distance)),
            COLUMN("reason", "", r.reason),
            COLUMN("next",
                   "Command that goes on from here, without --interface; DECK stands for the deck",
                   known(!r.next.empty(), r.next)));

LINE_RECORD(FixScore, "score", "Penetrations and untied nodes.", COLUMN("solved", "", r.solved),
            COLUMN("left", "", r.left), COLUMN("not_treated", "", r.not_treated),
            COLUMN("treated_already", "", r.treated_already));

LINE_RECORD(MovedNode, "moved_node", "", COLUMN("node", "", r.id),
            COLUMN("part", "", known(r.part != 0, r.part)), COLUMN("by", "Working units", r.by),
            COLUMN("distance", "", r.distance));

LINE_RECORD(FixAction, "fix_action",
            "inacti, fpenmax: what the solver will do with each penetration.",
            COLUMN("interface", "", r.interface_id), COLUMN("secondary", "", r.secondary),
            COLUMN("main", "", r.main), COLUMN("depth", "", r.depth), COLUMN("gap", "", r.gap),
            COLUMN("before", "", r.before), COLUMN("after", "", r.after),
            COLUMN("solver_stops", "", r.stops),
            COLUMN("gap_left", "Where the gap is reduced, else 0", r.gap0));

namespace {

struct Crossings {
  std::uint64_t before = 0, after = 0;
};
LINE_RECORD(Crossings, "crossed", "Crossed elements.", COLUMN("before", "", r.before),
            COLUMN("after", "", r.after));
Crossings crossings_of(const PenetrationFix& fix) {
  return {fix.crossings_before, fix.crossings_after};
}

struct TiedRow {
  std::uint64_t pairs = 0, nodes = 0;
};
LINE_RECORD(TiedRow, "tied", "", COLUMN("pairs", "", r.pairs),
            COLUMN("nodes", "Secondary nodes", r.nodes));

struct FixStepRow {
  const PenetrationFix* step = nullptr;
};

std::vector<std::int64_t> moved_ids(const PenetrationFix& fix) {
  std::vector<std::int64_t> ids;
  for (const MovedNode& m : fix.moved) ids.push_back(m.id);
  return ids;
}
RECORD(FixStepRow, "step", "The result of one strategy.", COLUMN("strategy", "", r.step->strategy),
       COLUMN("complete", "", r.step->complete), COLUMN("crossings", "", crossings_of(*r.step)),
       COLUMN("interfaces", "", r.step->interfaces), COLUMN("ties", "", r.step->ties),
       COLUMN("moved", "Node ids", moved_ids(*r.step)),
       COLUMN("not_treated", "How many", r.step->refused.size()),
       COLUMN("score", "", score_of(*r.step)));

struct FixDocument {
  const LoadedDeck& loaded;
  const PenetrationFix* fix = nullptr;
  std::string_view written;
  const std::vector<PenetrationFix>& steps;
  Coverage coverage = coverage_of(loaded.deck(), loaded.interfaces(), Examined::contacts_and_ties);
};
RECORD(FixDocument, "document", "",
       COLUMN("deck", "", DeckRow{r.loaded.path(), &r.loaded.deck(), nullptr, nullptr}),
       COLUMN("examined", "Contacts and ties that are examined", r.coverage.examined),
       COLUMN("not_examined", "Interfaces of other types, by keyword", r.coverage.not_examined),
       COLUMN("verdict", "Of the deck as it was read", verdict_of(r.loaded)),
       COLUMN("strategy",
              "Several by commas, in their order; null: none was asked for, see proposals",
              known(!r.fix->strategy.empty(), r.fix->strategy)),
       COLUMN("written", "no, diff, in-place, or the directory the deck was written to", r.written),
       COLUMN("complete", "Nothing is left of what the strategy treats", r.fix->complete),
       COLUMN("iterations", "", r.fix->iterations),
       COLUMN("tied", "Ties (TYPE2, TYPE10) that stay as they are",
              TiedRow{r.fix->tied_pairs, r.fix->tied_nodes}),
       COLUMN("crossings", "", crossings_of(*r.fix)), COLUMN("interfaces", "", r.fix->interfaces),
       COLUMN("ties", "The TYPE2 that lose nodes", r.fix->ties),
       COLUMN("proposals", "Without a strategy: what each would do on its own",
              if_any(r.fix->strategy.empty(), rows<FixStepRow>(r.steps))),
       COLUMN("steps", "Of several strategies what each did with what the one before left",
              if_any(!r.fix->strategy.empty() && r.steps.size() > 1, rows<FixStepRow>(r.steps))),
       COLUMN("moved", "", r.fix->moved), COLUMN("actions", "", r.fix->actions),
       COLUMN("not_treated", "", r.fix->refused));

constexpr DocumentHead fix_head{"deck/fix", 1, "Written by deck fix --json."};

}  // namespace

DocumentSchema fix_schema() { return document_schema<FixDocument>(fix_head); }

LINE_RECORD(RefusedGroup, "group", "What was not treated for one reason.",
            COLUMN("text", "", r.text), COLUMN("command", "", r.command));

LINE_RECORD(NextCommand, "next", "", COLUMN("does", "", r.does), COLUMN("command", "", r.command));

namespace {

struct RepairBlock {
  const PenetrationFix& fix;
  std::string_view deck;
  const std::vector<NextCommand>& next;
  std::string_view patch;
};
RECORD(RepairBlock, "repair", "The block deck-repair of the page of deck fix.",
       COLUMN("strategy", "", r.fix.strategy), COLUMN("crossings", "", crossings_of(r.fix)),
       COLUMN("not_treated", "", r.fix.refused),
       COLUMN("groups", "At most eight, the largest first", refused_groups({r.fix}, r.deck)),
       COLUMN("next", "", r.next), COLUMN("patch", "", r.patch));

}  // namespace

void repair_form(SchemaDefinitions& definitions) { record_form<RepairBlock>(definitions); }

std::string repair_json(const PenetrationFix& fix, std::string_view deck,
                        const std::vector<NextCommand>& next, std::string_view patch) {
  std::string out;
  JsonWriter json(out);
  write_value(json, RepairBlock{fix, deck, next, patch});
  return out;
}

std::string fix_json(const LoadedDeck& loaded, const PenetrationFix& fix, std::string_view written,
                     const std::vector<PenetrationFix>& steps) {
  return write_document(fix_head, FixDocument{loaded, &fix, written, steps}) + '\n';
}

}  // namespace deck
