// deck fix: repairs initial penetrations, by moving nodes or by changing the interface cards, and
// ties that lose nodes, as a patch that has been verified by reading the deck again with it. Its
// options.
#include <algorithm>

#include "deck/report/html.hpp"
#include "deck/text/number.hpp"
#include "verbs/fix/fix_run.hpp"

namespace deck::cli::verb_fix {

std::optional<double> share(std::string text) {
  const bool percent = text.ends_with('%');
  if (percent) text.pop_back();
  const RealCell cell = read_real(text);
  if (cell.status != NumberStatus::ok) return std::nullopt;
  const double value = percent ? cell.value / 100 : cell.value;
  if (!(value >= 0 && value <= 1)) return std::nullopt;
  return value;
}

namespace {

/// What is wrong with the combination of options; empty: nothing.
std::string wrong_usage(const Options& o) {
  for (const std::string& s : o.strategies)
    if (std::count(o.strategies.begin(), o.strategies.end(), s) > 1)
      return "--strategy names " + s + " twice";
  if (o.strategies.empty())
    for (const auto& [given, option] : {std::pair{o.write.in_place, "--in-place"},
                                        {!o.write.directory.empty(), "-o"},
                                        {o.write.diff, "--diff"},
                                        {!o.html.empty(), "--html"}})
      if (given)
        return std::string(option) +
               " needs --strategy; without these options 'deck fix DECK' says what each would do";
  if (!o.html.empty() && o.common.decks.size() > 1) return "--html takes one deck at a time";
  if (std::string why; !o.html.empty() && !html_available(&why))
    return "--html: this build has no viewer: " + why;
  if (std::string wrong = deck::cli::usage_error(o.write); !wrong.empty()) return wrong;
  if (!share(o.max_moved)) return "--max-moved needs a share like 10% or 0.1";
  if (!share(o.min_gap)) return "--min-gap needs a share like 50% or 0.5";
  if (!o.fpenmax.empty() && !share(o.fpenmax)) return "--fpenmax needs a share like 80% or 0.8";
  if (o.write.diff && o.common.json == "-") return "--diff and --json - both want standard output";
  const RealCell limit = read_real(o.max_displacement);
  if (!o.max_displacement.empty() && !(limit.status == NumberStatus::ok && limit.value > 0))
    return "--max-displacement needs a length above 0";
  const RealCell reach = read_real(o.reach);
  if (!o.reach.empty() && !(reach.status == NumberStatus::ok && reach.value > 0))
    return "--reach needs a length above 0";
  return {};
}

/// Options of the strategies that change interface cards.
void add_card_options(CommandLine& line, Options& o) {
  CommandLine others = line.group("reduce-gap, inacti, fpenmax, tie");
  others.option("--min-gap", o.min_gap, "reduce-gap: least share of the present gap to keep")
      .show_default()
      .value("SHARE");
  others.option("--digits", o.digits, "reduce-gap: significant digits, rounded down")
      .range(1, 17)
      .show_default()
      .value("N");
  others
      .option("--inacti", o.inacti,
              "inacti: 0 (or 1000), 1, 2, 3, 5 or 6; TYPE24 and TYPE25: -1, 0 or 5 (default: 6 and "
              "5)")
      .one_of({-1, 0, 1, 2, 3, 5, 6, 1000})
      .value("N");
  others
      .option("--fpenmax", o.fpenmax,
              "fpenmax: switch off nodes deeper than this share of the gap (default: only "
              "nodes at distance 0, at which the solver stops)")
      .value("SHARE");
  others
      .option("--reach", o.reach,
              "tie: how far from its segment a node may be, working units (default: for each TYPE2 "
              "the mean side of its segments, as far as the solver looks by itself)")
      .value("LENGTH");
}

/// Options of the strategies that move nodes.
void add_move_options(CommandLine& line, Options& o) {
  CommandLine move = line.group("move-nodes, move-part");
  move.option("--lock", o.move.lock, "Nodes of these parts stay (also where shared)")
      .by_commas()
      .value("PART");
  move.option("--only", o.move.move, "Only nodes of these parts alone move")
      .by_commas()
      .value("PART");
  move.flag("--lock-rigid-bodies", o.move.lock_rigid_bodies, "Nodes of /RBODY stay");
  move.flag("--lock-boundary-conditions", o.move.lock_boundary_conditions, "Nodes of /BCS stay");
  move.flag("--secondary-only", o.move.secondary_only,
            "move-nodes: nodes of main sides do not move");
  move.option("--max-moved", o.max_moved,
              "move-nodes: share of the nodes of a part that may move; a part that needs more is "
              "left alone")
      .show_default()
      .value("SHARE");
  move.option("--max-displacement", o.max_displacement,
              "Farthest a node may move, working units (default of move-nodes: as far as its "
              "penetration is deep, which it never passes; of move-part: twice the deepest one)")
      .value("LENGTH");
  move.option("--clearance", o.move.clearance, "Distance left beyond the gap, share of it")
      .range(0.0, 1.0)
      .show_default()
      .value("SHARE");
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  Options& o = *options;
  add_common(line, o.common);
  line.option(
          "--strategy", o.strategies,
          "Without: say what each would do. move-nodes: out of each other's gap; move-part: one "
          "whole part, with everything connected to it, the way that frees the most; reduce-gap: "
          "the "
          "largest gap without a penetration; inacti: let the solver treat them; fpenmax: switch "
          "off deep ones; tie: raise dsearch of TYPE2 to what its untied nodes need. "
          "Several with commas: each acts on what the previous one left")
      .comma_list()
      .value("STRATEGY")
      .one_of({"move-nodes", "move-part", "reduce-gap", "inacti", "fpenmax", "tie"});
  line.option("--interface", o.interfaces, "Only these interface ids").by_commas().value("ID");
  line.flag(
      "--ties", o.ties,
      "Treat ties (TYPE10) like other contacts: nodes that are moved out of "
      "their gap are no longer tied. By default ties are not changed; those of a TYPE2 never are");
  add_write_options(line, o.write);
  line.option("--html", o.html,
              "Write a report with the deck as it is fixed, compared with before, to FILE")
      .value("FILE");
  line.option("--rows", o.rows, "Rows of the lists in the report").show_default();

  add_move_options(line, o);
  add_card_options(line, o);
  return [options] {
    options->common.rewrites = options->write.in_place;
    if (const std::string wrong = wrong_usage(*options); !wrong.empty())
      return failed(options->common, wrong);
    return run(*options);
  };
}

const VerbRegistration registration{
    {"fix", 35,
     "Repair initial penetrations and ties: move nodes, reduce gaps, set Inacti, Fpenmax or "
     "dsearch",
     "  deck fix car_0000.rad                                  what each strategy would do\n"
     "  deck fix car_0000.rad --strategy move-nodes            what this one would do\n"
     "  deck fix car_0000.rad --strategy move-nodes --diff     the same as a patch\n"
     "  deck fix car_0000.rad --strategy move-nodes --max-moved 100% --lock 12,13 --in-place "
     "--backup\n"
     "  deck fix car_0000.rad --strategy move-part --lock 12 --max-displacement 2 --diff\n"
     "  deck fix car_0000.rad --strategy reduce-gap --min-gap 80% -o fixed\n"
     "  deck fix car_0000.rad --strategy reduce-gap,move-nodes --html fixed.html --diff\n"
     "  deck fix car_0000.rad --strategy inacti --inacti 6 --interface 3 --in-place\n"
     "  deck fix car_0000.rad --strategy fpenmax --fpenmax 0.9 --diff | git apply\n"
     "  deck fix car_0000.rad --strategy tie --reach 5 -o fixed\n"
     "\n"
     "Which strategy? Moving nodes cures the cause and keeps the gap; it changes the mesh a "
     "little. Moving a part keeps the shape of both sides.\n"
     "Reducing the gap is right where gap and thickness disagree; the contact then acts later.\n"
     "Inacti leaves deck and mesh alone and lets the solver start with a smaller gap for the\n"
     "pairs that penetrate. Fpenmax takes nodes out of the interface: for a few hopeless ones.\n"
     "Nodes of a TYPE2 that find no segment fall off: tie raises its dsearch to what those within\n"
     "--reach need. A node that something else holds stays untied: another tie, a rigid body ...\n"
     "\n"
     "Every change is verified before it is shown: the deck is read again with the new values as\n"
     "printed. What would penetrate deeper than before, or come loose, is not written. A node "
     "moves\n"
     "along the normal of its penetration and no farther than it is deep. Moves never make a new\n"
     "penetration, cross elements, turn one inside out or halve one of its sides; what cannot be\n"
     "solved that way stays and is listed with its reason.\n"
     "Elements that cross already have no right side: they have to be separated by hand\n"
     "(deck gaps --crossings shows them).\n"
     "\n"
     "Several decks are fixed together: a file that they share is written once, and if they want\n"
     "different texts for it nothing is written (exit code 2).\n"
     "\n"
     "Exit code: 0 all treated or nothing to treat, 1 something remains, the solver stops with "
     "the\n"
     "result, or nothing was examined, 2 wrong usage, 3 unreadable input.\n",
     setup}};

}  // namespace
}  // namespace deck::cli::verb_fix
