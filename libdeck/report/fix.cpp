// Result of `deck fix` as JSON and as text: before, after, moved nodes, refusals.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/shared/shown_text.hpp"
#include "contact/shared/reported.hpp"
#include "report/html/page_steps.hpp"
#include "report/shared/fix.hpp"
#include "report/shared_records.hpp"
#include "report/terminal/words.hpp"

namespace deck {

// Records of a fix.
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

LINE_RECORD(FixScore, "score", "Penetrations (tie: nodes). The sum is all of them.",
            COLUMN("solved", "", r.solved), COLUMN("not_treated", "", r.not_treated),
            COLUMN("treated_already", "By the solver, with the deck as it is", r.treated_already));

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

LINE_RECORD(NextCommand, "next", "", COLUMN("does", "", r.does), COLUMN("command", "", r.command));

namespace {

struct Crossings {
  std::uint64_t before = 0, after = 0;
};
LINE_RECORD(Crossings, "crossed", "Crossed elements.", COLUMN("before", "", r.before),
            COLUMN("after", "", r.after));
Crossings crossings_of(const PenetrationFix& fix) {
  return {fix.crossings_before, fix.crossings_after};
}

std::vector<std::int64_t> moved_ids(const PenetrationFix& fix) {
  std::vector<std::int64_t> ids;
  for (const MovedNode& m : fix.moved) ids.push_back(m.id);
  return ids;
}

}  // namespace

RECORD(PenetrationFix, "step", "The result of one strategy.", COLUMN("strategy", "", r.strategy),
       COLUMN("complete", "", r.complete), COLUMN("crossings", "", crossings_of(r)),
       COLUMN("interfaces", "", r.interfaces), COLUMN("ties", "", r.ties),
       COLUMN("moved", "Node ids", moved_ids(r)),
       COLUMN("not_treated", "Rows that the list not_treated has with this strategy alone",
              r.refused.size()),
       COLUMN("score", "", score_of(r)));

namespace {

struct FixDocument {
  const LoadedDeck& loaded;
  const PenetrationFix* fix = nullptr;
  std::string_view written;
  const std::vector<PenetrationFix>& steps;
  const std::vector<NextCommand>& next;
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
       COLUMN("complete", "Nothing of what the strategy is for is not treated", r.fix->complete),
       COLUMN("iterations", "", r.fix->iterations),
       LINE_OBJECT("tied", "Ties (TYPE2, TYPE10) that stay as they are",
                   COLUMN("pairs", "", r.fix->tied_pairs),
                   COLUMN("nodes", "Secondary nodes", r.fix->tied_nodes)),
       COLUMN("crossings", "", crossings_of(*r.fix)), COLUMN("interfaces", "", r.fix->interfaces),
       COLUMN("ties", "The TYPE2 that lose nodes", r.fix->ties),
       COLUMN("proposals", "Without a strategy: what each would do on its own",
              if_any(r.fix->strategy.empty(), rows_of(r.steps))),
       COLUMN("next", "Without a strategy: the commands that together treat most, in their order",
              if_any(r.fix->strategy.empty(), r.next)),
       COLUMN("steps", "Of several strategies what each did with the result of the one before",
              if_any(!r.fix->strategy.empty() && r.steps.size() > 1, rows_of(r.steps))),
       COLUMN("moved", "", r.fix->moved), COLUMN("actions", "", r.fix->actions),
       COLUMN("not_treated", "", r.fix->refused));

constexpr DocumentHead fix_head{"deck/fix", 1, "Written by deck fix --json."};

}  // namespace

DocumentSchema fix_schema() { return document_schema<FixDocument>(fix_head); }

LINE_RECORD(RefusedGroup, "group", "What was not treated for one reason.",
            COLUMN("text", "", r.text), COLUMN("command", "", r.command));

namespace {

struct RepairBlock {
  const PenetrationFix& fix;
  std::string_view deck;
  const std::vector<NextCommand>& next;
  std::string_view starter, patch;
};
RECORD(RepairBlock, "repair", "The block deck-repair of the page of deck fix.",
       COLUMN("text", "What was changed, and the penetrations before and after",
              fix_verdict(r.fix)),
       COLUMN("starter", "What the Starter does then", r.starter),
       COLUMN("strategy", "", r.fix.strategy), COLUMN("crossings", "", crossings_of(r.fix)),
       COLUMN("not_treated", "", r.fix.refused),
       COLUMN("groups", "At most eight, the largest first", refused_groups({r.fix}, r.deck)),
       COLUMN("next", "", r.next), COLUMN("patch", "", r.patch));

}  // namespace

void repair_form(SchemaDefinitions& definitions) { record_form<RepairBlock>(definitions); }

std::string repair_json(const PenetrationFix& fix, std::string_view deck,
                        const std::vector<NextCommand>& next, std::string_view starter,
                        std::string_view patch) {
  return detail::block_json(RepairBlock{fix, deck, next, starter, patch});
}

std::string fix_json(const LoadedDeck& loaded, const PenetrationFix& fix, std::string_view written,
                     const std::vector<PenetrationFix>& steps,
                     const std::vector<NextCommand>& next) {
  return write_document(fix_head, FixDocument{loaded, &fix, written, steps, next}) + '\n';
}

namespace {

FixCount total(const PenetrationFix& fix, FixCount FixedInterface::*which) {
  FixCount sum;
  for (const FixedInterface& i : fix.interfaces) {
    const FixCount& c = i.*which;
    sum.pairs += c.pairs;
    sum.untreated += c.untreated;
    sum.deepest = std::max(sum.deepest, c.deepest);
  }
  return sum;
}

bool changes_flags(const PenetrationFix& fix) {
  return fix.strategy == "inacti" || fix.strategy == "fpenmax";
}

/// "Gapmin 1.25 -> 0.9"; for a blank cell the effective value in brackets.
std::string change_text(const std::vector<FieldChange>& changes) {
  std::string text;
  for (const FieldChange& c : changes) {
    const bool by_pair = c.field == "dsearch" && c.old_value == 0;
    const std::string old = !c.old_text.empty() ? c.old_text
                            : by_pair           ? "(by pair)"
                                                : fmt::format("({:.6g})", c.old_value);
    append(text, ", ", fmt::format("{} {} -> {}", c.field, old, c.new_text));
  }
  return text;
}

std::string or_dash(const std::string& text) { return text.empty() ? "-" : text; }

std::string interface_table(const PenetrationFix& fix, const FixTextOptions& options) {
  const bool flags = changes_flags(fix);
  TextTable table({">interface", "type", flags ? ">pairs" : ">pairs before",
                   flags ? ">untreated before" : ">after", flags ? ">after" : ">deepest before",
                   flags ? ">deepest" : ">after", "changed", "title"});
  for (const FixedInterface& i : fix.interfaces) {
    const std::string type = fmt::format("TYPE{}", i.type),
                      changed = or_dash(change_text(i.changes));
    const std::string deepest = fmt::format("{:.4g}", i.after.deepest);
    const std::uint64_t left = flags ? i.after.untreated : i.after.pairs;
    const TextTable::Cell after(left, left == 0 ? Tone::green : Tone::yellow);
    if (flags)
      table.row({i.id, type, i.after.pairs, i.before.untreated, after, deepest, changed, i.title});
    else
      table.row({i.id, type, i.before.pairs, after, fmt::format("{:.4g}", i.before.deepest),
                 deepest, changed, i.title});
  }
  return table.below_heading(options);
}

std::string moved_text(const PenetrationFix& fix, const FixTextOptions& options) {
  if (fix.moved.empty()) return {};
  std::vector<const MovedNode*> order;
  std::map<std::int64_t, std::size_t> parts;
  for (const MovedNode& m : fix.moved) {
    order.push_back(&m);
    ++parts[m.part];
  }
  std::stable_sort(order.begin(), order.end(), [](const MovedNode* a, const MovedNode* b) {
    return a->distance > b->distance;
  });
  std::string text =
      "\nmoved, by part:" + std::string(options.rows > 0 ? " " : "") +
      first_of(parts, options.rows, [](const auto& of_part) {
        const auto& [part, n] = of_part;
        return part == 0 ? fmt::format("{} of no part", n) : fmt::format("{} of part {}", n, part);
      });
  if (parts.size() > options.rows) text += " parts";
  text += "\nfarthest moves:\n";
  TextTable table({">node", ">part", ">distance", ">x", ">y", ">z"});
  const auto figure = [](double v) { return fmt::format("{:.4g}", v); };
  for (std::size_t i = 0; i < order.size() && i < options.rows; ++i) {
    const MovedNode& m = *order[i];
    table.row({m.id, known_cell(m.part != 0, m.part), figure(m.distance), figure(m.by[0]),
               figure(m.by[1]), figure(m.by[2])});
  }
  return text + table.fitted(options.width, options.color, 2) +
         more_line(order.size(), options.rows, " (--json lists all)");
}

/// Refusals of one strategy for one reason.
struct Gathered {
  std::string strategy;
  std::string reason, next;  ///< of the first one
  std::set<std::int64_t> interfaces;
  std::size_t count = 0;
  double deepest = 0, farthest = 0;
  std::vector<std::string> examples;
};

/// Groups refusals whose reasons differ only in numbers; the largest groups first.
std::vector<Gathered> gathered(const std::vector<PenetrationFix>& fixes) {
  std::vector<Gathered> groups;
  std::map<std::pair<std::string, std::string>, std::size_t> places;
  for (const PenetrationFix& fix : fixes)
    for (const FixRefusal& r : fix.refused) {
      std::string alike = r.reason;
      std::erase_if(alike, [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
      const auto [at, fresh] = places.try_emplace({fix.strategy, alike}, groups.size());
      if (fresh) groups.push_back({fix.strategy, r.reason, r.next, {}, 0, 0, 0, {}});
      Gathered& g = groups[at->second];
      g.interfaces.insert(r.interface_id);
      g.deepest = std::max(g.deepest, r.depth);
      g.farthest = std::max(g.farthest, r.distance);
      if (r.nodes.empty()) continue;
      ++g.count;
      if (g.examples.size() < 5) g.examples.push_back(fmt::format("{}", fmt::join(r.nodes, "-")));
    }
  std::stable_sort(groups.begin(), groups.end(),
                   [](const Gathered& a, const Gathered& b) { return a.count > b.count; });
  return groups;
}

std::string text_of(const Gathered& g, bool with_strategy) {
  std::string text = with_strategy ? g.strategy + ", " : std::string();
  if (g.count > 0)
    text += (g.farthest > 0 ? count(g.count, "node", "nodes")
                            : count(g.count, "node or edge", "nodes or edges")) +
            " of ";
  text += g.interfaces.size() == 1 ? "interface " : "interfaces ";
  text += first_of(g.interfaces, 5);
  if (g.farthest > 0) text += fmt::format(", up to {:.6g} away", g.farthest);
  if (g.deepest > 0) text += fmt::format(", up to {:.4g} deep", g.deepest);
  text += ": " + terminal_text(g.reason);
  if (g.count > 0)
    text += fmt::format(" ({}{})", fmt::join(g.examples, ", "),
                        g.count > g.examples.size() ? ", ..." : "");
  return text;
}

/// "not treated:" with items, of one strategy with commands; empty if everything was treated.
std::string refused_text(const std::vector<PenetrationFix>& fixes, const FixTextOptions& options) {
  std::size_t more = 0;
  std::string text;
  for (const RefusedGroup& g : refused_groups(fixes, options.deck, &more))
    text +=
        "  " + g.text + "\n" + (fixes.size() > 1 ? "" : "      " + terminal_text(g.command) + "\n");
  text += more_line(more, 0, " (--json lists all)");
  return text.empty() ? text : "\nnot treated:\n" + text;
}

/// "64 pairs tied (28 nodes)"; empty without ties.
std::string tied_text(const PenetrationFix& fix) {
  if (fix.tied_pairs == 0) return {};
  return fmt::format("{} tied ({})", count(fix.tied_pairs, "pair", "pairs"),
                     count(fix.tied_nodes, "node", "nodes"));
}

std::string actions_text(const PenetrationFix& fix, const FixTextOptions& options) {
  if (fix.actions.empty()) return {};
  std::map<std::pair<std::int64_t, PenetrationAction>, std::size_t> counts;
  for (const FixAction& a : fix.actions) ++counts[{a.interface_id, a.after}];
  std::string text = "\nthe solver will then:\n";
  std::size_t shown = 0;
  for (const auto& [key, n] : counts) {
    if (shown++ == options.rows) return text + "  ... (--json lists every pair)\n";
    text += fmt::format("  interface {}: {} {}\n", key.first, n, action_words(key.second, n));
  }
  return text;
}

const std::string nothing_to_fix = "no initial penetrations: nothing to fix";
const std::string nothing_evaluated = "no initial penetrations where they were evaluated";

/// False if contacts were omitted because they are not evaluated in full.
bool in_full(const PenetrationFix& fix) {
  return std::all_of(fix.refused.begin(), fix.refused.end(), [&](const FixRefusal& r) {
    return std::any_of(fix.ties.begin(), fix.ties.end(),
                       [&](const FixedTie& tie) { return tie.id == r.interface_id; });
  });
}

/// "5 of 16 nodes"
std::string untied_text(const PenetrationFix& fix, TieCounts FixedTie::*which) {
  std::size_t lost = 0, nodes = 0;
  for (const FixedTie& tie : fix.ties) {
    lost += (tie.*which).lost();
    nodes += (tie.*which).nodes;
  }
  return fmt::format("{} of {}", lost, count(nodes, "node", "nodes"));
}

std::string tie_verdict(const PenetrationFix& fix) {
  if (fix.ties.empty())
    return fix.refused.empty() ? "no node of a TYPE2 is untied: nothing to fix"
                               : "tie: nothing done";
  std::size_t outside = 0, left = 0;
  for (const FixedTie& tie : fix.ties) {
    outside += tie.after.outside - std::min(tie.after.outside, tie.before.outside);
    left += tie.after.lost();
  }
  std::string text =
      fmt::format("tie: {} not tied before, {} after", untied_text(fix, &FixedTie::before), left);
  if (outside > 0) text += fmt::format("; {} of them tied beyond a rim", outside);
  return text;
}

std::string tie_table(const PenetrationFix& fix, const FixTextOptions& options) {
  TextTable table({">interface", ">nodes", ">not tied before", ">after", ">reach", ">farthest tied",
                   "changed", "title"});
  for (const FixedTie& tie : fix.ties)
    table.row({tie.id,
               tie.before.nodes,
               tie.before.lost(),
               {tie.after.lost(), tie.after.lost() == 0 ? Tone::green : Tone::yellow},
               tie.reach,
               known_cell(!tie.nodes.empty(), tie.needed),
               or_dash(change_text(tie.changes)),
               tie.title});
  return table.below_heading(options);
}

/// "5 nodes moved by up to 0.3"; empty if none.
std::string moves_of(const PenetrationFix& fix) {
  double far = 0;
  for (const MovedNode& m : fix.moved) far = std::max(far, m.distance);
  return fix.moved.empty() ? std::string()
                           : fmt::format("{} moved by up to {:.4g}",
                                         count(fix.moved.size(), "node", "nodes"), far);
}

/// Price of Inacti 1, Inacti 2 and Fpenmax: "28 nodes lose the contact for the whole run".
std::string price_text(const PenetrationFix& fix) {
  std::string text;
  std::size_t all = 0;
  const auto add = [&](PenetrationAction action, auto side, const char* one, const char* many) {
    std::set<std::pair<std::int64_t, std::vector<std::int64_t>>> off;
    for (const FixAction& a : fix.actions)
      if (a.after != a.before && a.after == action) off.insert({a.interface_id, a.*side});
    all += off.size();
    if (!off.empty()) append(text, " and ", count(off.size(), one, many));
  };
  add(PenetrationAction::node_stiffness_zero, &FixAction::secondary, "node", "nodes");
  add(PenetrationAction::segment_stiffness_zero, &FixAction::main, "segment", "segments");
  add(PenetrationAction::edge_stiffness_zero, &FixAction::secondary, "edge", "edges");
  if (all == 0) return text;
  return text + (all == 1 ? " loses" : " lose") + " the contact for the whole run";
}

/// "Gapmin 1.25 -> 0.9" of one interface or of how many with `changed` behind it, what that costs,
/// and how many nodes moved how far.
std::string changes_of(const PenetrationFix& fix, const char* changed = "") {
  std::size_t interfaces = 0;
  std::string text;
  for (const FixedInterface& i : fix.interfaces) {
    interfaces += !i.changes.empty();
    if (text.empty()) text = change_text(i.changes);
  }
  if (interfaces > 1) text += fmt::format(", ... of {} interfaces", interfaces);
  if (interfaces > 0) text += changed;
  for (const std::string& more : {price_text(fix), moves_of(fix)})
    if (!more.empty()) append(text, "; ", more);
  return text;
}

/// ", in kg mm ms"
std::string in_units(const FixTextOptions& options) {
  return options.units.length_code.empty() ? "" : ", in " + units_text(options.units);
}

std::string crossings_text(std::uint64_t crossings, const FixTextOptions& options) {
  if (crossings == 0) return {};
  return "\n" + count(crossings, "crossed element stays", "crossed elements stay") +
         ": no fix separates crossed elements; separate their parts in the mesh. This lists them:\n"
         "  deck gaps " +
         terminal_text(options.deck) + " --crossings\n";
}

/// Effect of the strategy tie; empty without a TYPE2 to treat.
std::string tie_proposal(const std::vector<PenetrationFix>& proposals,
                         const FixTextOptions& options) {
  std::string text;
  for (const PenetrationFix& fix : proposals)
    if (fix.strategy == "tie" && !(fix.ties.empty() && fix.refused.empty()))
      text += "\n" +
              toned(untied_text(fix, &FixedTie::before) + " of TYPE2 are not tied", Tone::yellow,
                    options.color) +
              "\n" + tie_table(fix, options) + refused_text({fix}, options);
  return text;
}

}  // namespace

std::vector<RefusedGroup> refused_groups(const std::vector<PenetrationFix>& fixes,
                                         std::string_view deck, std::size_t* more) {
  constexpr std::size_t most = 8;
  const std::vector<Gathered> groups = gathered(fixes);
  std::vector<RefusedGroup> out;
  for (const Gathered& g : groups) {
    if (out.size() == most) break;
    std::string command = g.next.empty() ? "deck gaps DECK" : g.next;
    command.replace(command.find("DECK"), 4, deck);
    out.push_back({text_of(g, fixes.size() > 1),
                   fmt::format("{} --interface {}", command, fmt::join(g.interfaces, ","))});
  }
  if (more != nullptr) *more = groups.size() - out.size();
  return out;
}

std::string starter_text(const Verdict& verdict, const Scene& scene, bool fixed) {
  if (verdict.level != VerdictLevel::stops)
    return verdict.undecided || verdict.level == VerdictLevel::not_examined
               ? "Not every contact was examined: what the Starter does with them is open."
               : "Nothing in the contacts stops the Starter.";
  std::map<std::pair<std::int64_t, int>, std::set<NodeIndex>> nodes;
  for (const Contact& c : scene.contacts)
    if (const int error = on_surface_error(c); error != 0)
      for (const PenetrationRow& row : c.penetrations)
        if (row.on_surface) nodes[{c.inter->id, error}].insert(c.secondary[row.secondary].node);
  std::vector<std::string> places;
  for (const auto& [where, of] : nodes)
    places.push_back(fmt::format("{} on a segment of interface {}, error {}",
                                 count(of.size(), "node", "nodes"), where.first, where.second));
  constexpr std::size_t most = 3;
  std::string text = fixed ? "The Starter will still stop" : "The Starter will stop";
  if (!places.empty())
    text += fmt::format(": {}",
                        fmt::join(std::span(places).first(std::min(most, places.size())), "; "));
  if (places.size() > most)
    text += fmt::format("; and at {} more interfaces", places.size() - most);
  text += ".";
  static constexpr std::string_view others[] = {"errors",       "empty_sides",     "without_gap",
                                                "without_area", "without_element", "ties_stop",
                                                "main_and_tied"};
  std::string more;
  for (const VerdictSentence& s : verdict.sentences)
    if (std::find(std::begin(others), std::end(others), s.what) != std::end(others))
      more += " " + s.text;
  // A sentence that says so itself needs no other before it.
  return places.empty() && more.starts_with(" The solver") ? more.substr(1) : text + more;
}

std::string fix_verdict(const PenetrationFix& fix) {
  const FixCount before = total(fix, &FixedInterface::before),
                 after = total(fix, &FixedInterface::after);
  if (fix.strategy == "tie") return tie_verdict(fix);
  const std::string ties = fix.ties.empty() ? std::string() : "; " + tie_verdict(fix);
  if (fix.interfaces.empty()) return (in_full(fix) ? nothing_to_fix : nothing_evaluated) + ties;
  const std::string changed = changes_of(fix, " changed");
  std::string text =
      fmt::format("{}: {}; {}", fix.strategy, changed.empty() ? "nothing changed" : changed,
                  count(before.pairs, "penetration", "penetrations"));
  if (changes_flags(fix))
    return text +
           fmt::format(", {} without treatment before, {} after", before.untreated,
                       after.untreated) +
           ties;
  text += fmt::format(" before (deepest {:.4g}), {} after", before.deepest, after.pairs);
  if (after.pairs > 0) text += fmt::format(" (deepest {:.4g})", after.deepest);
  return text + ties;
}

std::string fix_text(const PenetrationFix& fix, const FixTextOptions& options) {
  const Tone tone = fix.complete && price_text(fix).empty() ? Tone::green : Tone::yellow;
  const bool nothing = !options.examined && fix.interfaces.empty() && fix.ties.empty();
  std::string text = nothing ? nothing_evaluated : fix_verdict(fix);
  if (!fix.interfaces.empty()) text += in_units(options);
  text = toned(text, tone, options.color) + "\n";
  for (const std::string& table : {interface_table(fix, options), tie_table(fix, options)})
    if (!table.empty()) text += "\n" + table;
  if (fix.tied_pairs > 0) text += "\n" + tied_text(fix) + ", as before\n";
  text += moved_text(fix, options) + actions_text(fix, options);
  return text + refused_text({fix}, options) + crossings_text(fix.crossings_after, options);
}

std::string fix_plan_text(const FixPlan& plan) {
  std::string text = "\n";
  if (!plan.steps.empty())
    text += plan.steps.size() > 1 ? "to do it, in this order:\n" : "to do it:\n";
  for (const NextCommand& step : plan.steps)
    text += fmt::format("  {}\n      {}\n", terminal_text(step.command), terminal_text(step.does));
  if (!plan.steps.empty()) text += "\nthen: ";
  if (plan.untreated > 0)
    text += count(plan.untreated, "penetration is", "penetrations are") +
            " not treated, and no strategy can: change the mesh there by hand. ";
  return text + plan.starter + "\n";
}

std::string fix_proposals_text(const std::vector<PenetrationFix>& proposals,
                               const FixTextOptions& options) {
  const PenetrationFix now = unchanged(proposals);
  const FixCount found = total(now, &FixedInterface::before);
  if (now.complete)
    return (options.examined ? nothing_to_fix : nothing_evaluated) +
           (now.tied_pairs > 0 ? "; " + tied_text(now) : std::string()) + "\n";
  TextTable table({"strategy", ">solved", ">not treated", ">treated already", "changes"});
  std::vector<PenetrationFix> shown;
  for (const PenetrationFix& fix : proposals) {
    if (fix.strategy == "tie") continue;
    const FixScore s = score_of(fix);
    table.row({fix.strategy,
               s.solved,
               {s.not_treated, s.not_treated > 0 ? Tone::yellow : Tone::green},
               s.treated_already,
               or_dash(changes_of(fix))});
    shown.push_back(fix);
    if (fix.complete) shown.back().refused.clear();
  }
  const bool none = now.interfaces.empty() && now.crossings_before == 0;
  const bool all = none && !shown.empty() && shown.front().refused.empty();
  std::string text = all    ? nothing_to_fix
                     : none ? nothing_evaluated
                            : count(found.pairs, "penetration", "penetrations");
  if (found.pairs > 0) text += fmt::format(" (deepest {:.4g}{})", found.deepest, in_units(options));
  if (now.crossings_before > 0)
    text += ", " + count(now.crossings_before, "crossed element", "crossed elements");
  if (now.tied_pairs > 0) text += "; " + tied_text(now) + ", not changed";
  text = toned(text, all ? Tone::green : Tone::yellow, options.color) + "\n";
  if (found.pairs > 0)
    text += "\nwhat each strategy would do:\n" + table.fitted(options.width, options.color, 2);
  if (none) shown.resize(1);  // all refuse alike
  return text + refused_text(shown, options) + crossings_text(now.crossings_before, options) +
         tie_proposal(proposals, options);
}

}  // namespace deck
