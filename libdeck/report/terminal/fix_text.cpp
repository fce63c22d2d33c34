// The result of `deck fix` as text: before, after, what moved, what was refused.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/shared/count.hpp"
#include "base/shared/escape.hpp"
#include "report/shared/fix.hpp"
#include "report/shared/text_table.hpp"
#include "report/terminal/words.hpp"

namespace deck {
namespace {

FixCount total(const PenetrationFix& fix, FixCount FixedInterface::*which) {
  FixCount sum;
  for (const FixedInterface& i : fix.interfaces) {
    const FixCount& c = i.*which;
    sum.pairs += c.pairs;
    sum.nodes += c.nodes;
    sum.untreated += c.untreated;
    sum.on_surface += c.on_surface;
    sum.deepest = std::max(sum.deepest, c.deepest);
  }
  return sum;
}

bool changes_flags(const PenetrationFix& fix) {
  return fix.strategy == "inacti" || fix.strategy == "fpenmax";
}

std::string names(const std::vector<std::int64_t>& ids) {
  std::string text;
  for (const std::int64_t id : ids) text += fmt::format("{}{}", text.empty() ? "" : "-", id);
  return text;
}

/// "Gapmin 1.25 -> 0.9"; a blank cell with what is in effect in brackets.
std::string change_text(const std::vector<FieldChange>& changes) {
  std::string text;
  for (const FieldChange& c : changes) {
    const bool by_pair = c.field == "dsearch" && c.old_value == 0;
    const std::string old = !c.old_text.empty() ? c.old_text
                            : by_pair           ? "(by pair)"
                                                : fmt::format("({:.6g})", c.old_value);
    text += fmt::format("{}{} {} -> {}", text.empty() ? "" : ", ", c.field, old, c.new_text);
  }
  return text;
}

std::string interface_table(const PenetrationFix& fix, const FixTextOptions& options) {
  const bool flags = changes_flags(fix);
  TextTable table({{"interface", Align::right},
                   {"type"},
                   {flags ? "pairs" : "pairs before", Align::right},
                   {flags ? "untreated before" : "after", Align::right},
                   {flags ? "after" : "deepest before", Align::right},
                   {flags ? "deepest" : "after", Align::right},
                   {"changed"},
                   {"title"}});
  for (const FixedInterface& i : fix.interfaces) {
    const std::string changed = change_text(i.changes);
    const std::uint64_t left = flags ? i.after.untreated : i.after.pairs;
    const Tone tone = left == 0 ? Tone::green : Tone::yellow;
    if (flags)
      table.row({fmt::format("{}", i.id),
                 fmt::format("TYPE{}", i.type),
                 fmt::format("{}", i.after.pairs),
                 fmt::format("{}", i.before.untreated),
                 {fmt::format("{}", left), tone},
                 fmt::format("{:.4g}", i.after.deepest),
                 changed.empty() ? "-" : changed,
                 i.title});
    else
      table.row({fmt::format("{}", i.id),
                 fmt::format("TYPE{}", i.type),
                 fmt::format("{}", i.before.pairs),
                 {fmt::format("{}", left), tone},
                 fmt::format("{:.4g}", i.before.deepest),
                 fmt::format("{:.4g}", i.after.deepest),
                 changed.empty() ? "-" : changed,
                 i.title});
  }
  return table.fitted(options.width, options.color, 2);
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
  std::string text = "\nmoved, by part:";
  std::size_t shown = 0;
  for (const auto& [part, n] : parts) {
    if (shown++ == options.rows) {
      text += fmt::format(" and {} more parts", parts.size() - options.rows);
      break;
    }
    text += part == 0 ? fmt::format("{} {} of no part", shown > 1 ? "," : "", n)
                      : fmt::format("{} {} of part {}", shown > 1 ? "," : "", n, part);
  }
  text += "\nfarthest moves:\n";
  TextTable table({{"node", Align::right},
                   {"part", Align::right},
                   {"distance", Align::right},
                   {"x", Align::right},
                   {"y", Align::right},
                   {"z", Align::right}});
  for (std::size_t i = 0; i < order.size() && i < options.rows; ++i) {
    const MovedNode& m = *order[i];
    table.row({fmt::format("{}", m.id), m.part == 0 ? "-" : fmt::format("{}", m.part),
               fmt::format("{:.4g}", m.distance), fmt::format("{:.4g}", m.by[0]),
               fmt::format("{:.4g}", m.by[1]), fmt::format("{:.4g}", m.by[2])});
  }
  text += table.fitted(options.width, options.color, 2);
  if (order.size() > options.rows)
    text += fmt::format("  ... and {} more (--json lists all)\n", order.size() - options.rows);
  return text;
}

/// Lines of what was not treated, each behind `lead`.
std::string refused_lines(const PenetrationFix& fix, const FixTextOptions& options,
                          const std::string& lead) {
  struct Group {
    std::int64_t interface_id;
    std::string reason;
    std::size_t count = 0;
    double deepest = 0, farthest = 0;
    std::vector<std::string> examples;
  };
  std::vector<Group> groups;
  for (const FixRefusal& r : fix.refused) {
    auto g = std::find_if(groups.begin(), groups.end(), [&](const Group& x) {
      return x.interface_id == r.interface_id && x.reason == r.reason;
    });
    if (g == groups.end()) {
      groups.push_back({r.interface_id, r.reason, 0, 0, 0, {}});
      g = groups.end() - 1;
    }
    g->deepest = std::max(g->deepest, r.depth);
    g->farthest = std::max(g->farthest, r.distance);
    if (r.nodes.empty()) continue;
    ++g->count;
    if (g->examples.size() < 5) g->examples.push_back(names(r.nodes));
  }
  std::string text;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (i == options.rows) {
      text += fmt::format("  ... and {} (--json lists all)\n",
                          count(groups.size() - i, "more group", "more groups"));
      break;
    }
    const Group& g = groups[i];
    text += fmt::format("  {}interface {}", lead, g.interface_id);
    if (g.count > 0)
      text += ", " + (g.farthest > 0 ? count(g.count, "node", "nodes")
                                     : count(g.count, "node or edge", "nodes or edges"));
    if (g.farthest > 0) text += fmt::format(", up to {:.6g} away", g.farthest);
    if (g.deepest > 0) text += fmt::format(", up to {:.4g} deep", g.deepest);
    text += ": " + terminal_text(g.reason);
    if (g.count > 0) {
      text += " (";
      for (std::size_t k = 0; k < g.examples.size(); ++k)
        text += (k == 0 ? "" : ", ") + g.examples[k];
      text += g.count > g.examples.size() ? ", ...)" : ")";
    }
    text += "\n";
  }
  return text;
}

std::string refused_text(const PenetrationFix& fix, const FixTextOptions& options) {
  return fix.refused.empty() ? "" : "\nnot treated:\n" + refused_lines(fix, options, "");
}

/// "64 pairs tied (28 nodes)"; nothing without ties.
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
    if (shown++ == options.rows) {
      text += "  ... (--json lists every pair)\n";
      break;
    }
    static constexpr const char* words[] = {"do nothing",
                                            "switch the node off for the whole interface",
                                            "switch the segment off",
                                            "move the node",
                                            "reduce the gap",
                                            "switch the edge off",
                                            "ignore the penetration",
                                            "take the penetration off from then on",
                                            "start with a force",
                                            "leave the pair to its tie",
                                            "stop with error 611",
                                            "stop with error 612"};
    static_assert(std::size(words) == penetration_actions);
    text += fmt::format("  interface {}: {} for {}\n", key.first,
                        words[static_cast<std::size_t>(key.second)], count(n, "pair", "pairs"));
  }
  return text;
}

const std::string nothing_to_fix = "no initial penetrations: nothing to fix";
const std::string nothing_evaluated = "no initial penetrations where they were evaluated";
const std::string nothing_untied = "no node of a TYPE2 is untied: nothing to fix";

/// False if contacts were left out because not all of them is evaluated.
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
  if (fix.ties.empty()) return fix.refused.empty() ? nothing_untied : "tie: nothing done";
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
  if (fix.ties.empty()) return {};
  TextTable table(make_table({">interface", ">nodes", ">not tied before", ">after", ">reach",
                              ">farthest tied", "changed", "title"}));
  for (const FixedTie& tie : fix.ties) {
    const Tone tone = tie.after.lost() == 0 ? Tone::green : Tone::yellow;
    table.row({fmt::format("{}", tie.id),
               fmt::format("{}", tie.before.nodes),
               fmt::format("{}", tie.before.lost()),
               {fmt::format("{}", tie.after.lost()), tone},
               fmt::format("{:.6g}", tie.reach),
               tie.nodes.empty() ? "-" : fmt::format("{:.6g}", tie.needed),
               tie.changes.empty() ? "-" : change_text(tie.changes),
               tie.title});
  }
  return table.fitted(options.width, options.color, 2);
}

}  // namespace

std::string fix_verdict(const PenetrationFix& fix) {
  const FixCount before = total(fix, &FixedInterface::before),
                 after = total(fix, &FixedInterface::after);
  if (fix.strategy == "tie") return tie_verdict(fix);
  const std::string ties = fix.ties.empty() ? std::string() : "; " + tie_verdict(fix);
  if (fix.interfaces.empty()) return (in_full(fix) ? nothing_to_fix : nothing_evaluated) + ties;
  std::string text;
  if (changes_flags(fix)) {
    text = fmt::format("{}: {}, {} without treatment before, {} after", fix.strategy,
                       count(before.pairs, "penetration", "penetrations"), before.untreated,
                       after.untreated);
  } else {
    text = fmt::format("{}: {} before (deepest {:.4g}), {} after", fix.strategy,
                       count(before.pairs, "penetration", "penetrations"), before.deepest,
                       after.pairs);
    if (after.pairs > 0) text += fmt::format(" (deepest {:.4g})", after.deepest);
  }
  if (!fix.moved.empty()) {
    double far = 0;
    for (const MovedNode& m : fix.moved) far = std::max(far, m.distance);
    text +=
        fmt::format("; {} moved by up to {:.4g}", count(fix.moved.size(), "node", "nodes"), far);
    if (fix.iterations > 0)
      text += " in " + count(static_cast<std::uint64_t>(fix.iterations), "iteration", "iterations");
  }
  return text + ties;
}

namespace {

std::string crossings_text(std::uint64_t crossings) {
  if (crossings == 0) return {};
  return "\n" + count(crossings, "crossed element stays", "crossed elements stay") +
         ": no fix separates crossed elements. deck gaps --crossings lists them; separate their "
         "parts in the mesh\n";
}

}  // namespace

std::string fix_text(const PenetrationFix& fix, const FixTextOptions& options) {
  const Tone tone = fix.complete ? Tone::green : Tone::yellow;
  std::string text = toned(fix_verdict(fix), tone, options.color) + "\n";
  if (!fix.interfaces.empty()) text += "\n" + interface_table(fix, options);
  if (!fix.ties.empty()) text += "\n" + tie_table(fix, options);
  if (fix.tied_pairs > 0) text += "\n" + tied_text(fix) + ", as before\n";
  text += moved_text(fix, options);
  text += actions_text(fix, options);
  text += refused_text(fix, options);
  text += crossings_text(fix.crossings_after);
  return text;
}

namespace {

/// "Gapmin 1.25 -> 0.9" of one interface or of how many, and how many nodes move how far.
std::string changes_of(const PenetrationFix& fix) {
  std::size_t interfaces = 0;
  std::string first;
  for (const FixedInterface& i : fix.interfaces) {
    interfaces += !i.changes.empty();
    if (!first.empty()) continue;
    first = change_text(i.changes);
  }
  if (interfaces > 1) first += fmt::format(", ... of {} interfaces", interfaces);
  if (!fix.moved.empty()) {
    double far = 0;
    for (const MovedNode& m : fix.moved) far = std::max(far, m.distance);
    first += fmt::format("{} moved by up to {:.4g}", count(fix.moved.size(), "node", "nodes"), far);
  }
  return first.empty() ? "-" : first;
}

/// What the strategy tie would do, behind what is said of penetrations.
std::string tie_proposal(const std::vector<PenetrationFix>& proposals,
                         const std::function<std::string(std::string_view)>& command,
                         const FixTextOptions& options, std::string text) {
  for (const PenetrationFix& fix : proposals) {
    if (fix.strategy != "tie" || (fix.ties.empty() && fix.refused.empty())) continue;
    if (!text.ends_with('\n')) text += "\n";
    text += "\n" +
            toned(untied_text(fix, &FixedTie::before) + " of TYPE2 are not tied", Tone::yellow,
                  options.color) +
            "\n" + tie_table(fix, options) + refused_text(fix, options);
    if (score_of(fix).solved > 0)
      text += fmt::format("\nto tie them:\n  {}\n", terminal_text(command("tie")));
  }
  return text;
}

}  // namespace

std::string fix_proposals_text(const std::vector<PenetrationFix>& proposals,
                               const std::function<std::string(std::string_view)>& command,
                               const FixTextOptions& options) {
  const PenetrationFix now = unchanged(proposals);
  const FixCount found = total(now, &FixedInterface::before);
  if (now.complete)
    return nothing_to_fix + (now.tied_pairs > 0 ? "; " + tied_text(now) : std::string()) + "\n";
  if (now.interfaces.empty() && now.crossings_before == 0) {
    const auto it = std::find_if(proposals.begin(), proposals.end(), [](const PenetrationFix& fix) {
      return fix.strategy != "tie" && !fix.refused.empty();
    });
    if (it == proposals.end())
      return tie_proposal(proposals, command, options,
                          toned(nothing_to_fix, Tone::green, options.color));
    return tie_proposal(
        proposals, command, options,
        toned(nothing_evaluated, Tone::yellow, options.color) + "\n" + refused_text(*it, options));
  }
  std::string text = count(found.pairs, "penetration", "penetrations");
  if (found.pairs > 0) text += fmt::format(" (deepest {:.4g})", found.deepest);
  if (now.crossings_before > 0)
    text += ", " + count(now.crossings_before, "crossed element", "crossed elements");
  if (now.tied_pairs > 0) text += "; " + tied_text(now) + ", left alone";
  text = toned(text, Tone::yellow, options.color) + "\n\nwhat each strategy would do:\n";
  TextTable table(make_table({"strategy", ">solved", ">left", ">not treated", "changes"}));
  std::string reasons;
  FixTextOptions few = options;
  few.rows = std::min<std::size_t>(options.rows, 3);
  for (const PenetrationFix& fix : proposals) {
    if (fix.strategy == "tie") continue;
    const FixScore s = score_of(fix);
    const Tone tone = s.all() > s.solved ? Tone::yellow : Tone::green;
    table.row({fix.strategy,
               fmt::format("{}", s.solved),
               fmt::format("{}", s.left),
               {fmt::format("{}", s.not_treated), tone},
               changes_of(fix)});
    reasons += refused_lines(fix, few, fix.strategy + ", ");
  }
  text += table.fitted(options.width, options.color, 2);
  if (!reasons.empty()) text += "\nnot treated:\n" + reasons;
  text += crossings_text(now.crossings_before);
  const PenetrationFix* best = best_of(proposals);
  text += best == nullptr
              ? "\nno strategy solves any of them\n"
              : fmt::format("\nto do it:\n  {}\n", terminal_text(command(best->strategy)));
  return tie_proposal(proposals, command, options, text);
}

}  // namespace deck
