// Several strategies in turn, each on the result of the one before.
#include <algorithm>
#include <optional>

#include "edit/fix/fix_scene.hpp"

namespace deck {

Result<FixSequence> fix_in_order(const LoadedDeck& context, const std::vector<FixStep>& steps) {
  FixSequence out;
  std::optional<LoadedDeck> now;  // nullopt: the given deck
  for (const FixStep& step : steps) {
    const LoadedDeck& here = now ? *now : context;
    auto fix = step(here);
    if (!fix) return fix.error();
    auto changed = apply_rewrite(here.deck().sources, fix->rewrite);
    if (!changed) return changed.error();
    for (auto& [path, text] : *changed) out.changed[path] = std::move(text);
    const bool more = out.fixes.size() + 1 < steps.size();
    if (more && !changed->empty()) {
      auto again = detail::read_again(here, fix->rewrite);
      if (!again) return again.error();
      now.emplace(std::move(*again));
    }
    out.fixes.push_back(std::move(*fix));
  }
  return out;
}

FixScore score_of(const PenetrationFix& fix) {
  FixScore out;
  for (const FixedTie& tie : fix.ties) {
    out.solved += tie.before.lost() - std::min(tie.before.lost(), tie.after.lost());
    out.not_treated += tie.after.lost();
  }
  const bool flags = fix.strategy == "inacti" || fix.strategy == "fpenmax";
  for (const FixedInterface& i : fix.interfaces) {
    const std::uint64_t before = flags ? i.before.untreated : i.before.pairs;
    const std::uint64_t after = flags ? i.after.untreated : i.after.pairs;
    out.solved += before - std::min(before, after);
    out.treated_already += i.before.pairs - before;
    out.not_treated += after;
  }
  return out;
}

const PenetrationFix* best_of(const std::vector<PenetrationFix>& proposals) {
  const PenetrationFix* best = nullptr;
  FixScore score;
  for (const PenetrationFix& fix : proposals) {
    const FixScore s = score_of(fix);
    if (s.solved == 0 || fix.strategy == "tie") continue;
    if (best != nullptr && s.not_treated >= score.not_treated) continue;
    best = &fix;
    score = s;
  }
  return best;
}

PenetrationFix unchanged(const std::vector<PenetrationFix>& proposals) {
  PenetrationFix out;
  bool in_full = true;  // all wanted interfaces were evaluated
  for (const PenetrationFix& fix : proposals) {
    in_full &= fix.refused.empty();
    out.crossings_before = std::max(out.crossings_before, fix.crossings_before);
    for (const FixedTie& tie : fix.ties)
      out.ties.push_back({tie.id, tie.title, tie.reach, tie.before, tie.before, 0, {}, {}});
    if (fix.strategy == "tie") continue;
    out.tied_pairs = fix.tied_pairs;
    out.tied_nodes = fix.tied_nodes;
    for (const FixedInterface& i : fix.interfaces)
      if (std::none_of(out.interfaces.begin(), out.interfaces.end(),
                       [&](const FixedInterface& o) { return o.id == i.id; })) {
        out.interfaces.push_back(i);
        out.interfaces.back().changes.clear();
        out.interfaces.back().after = i.before;
      }
  }
  out.crossings_after = out.crossings_before;
  std::sort(out.interfaces.begin(), out.interfaces.end(),
            [](const FixedInterface& a, const FixedInterface& b) { return a.id < b.id; });
  out.complete = in_full && out.interfaces.empty() && out.crossings_before == 0 && out.ties.empty();
  return out;
}

PenetrationFix combined(const std::vector<PenetrationFix>& fixes) {
  PenetrationFix out;
  out.complete = true;
  std::vector<FixRefusal> of_ties;
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  for (const PenetrationFix& fix : fixes) {
    out.strategy += (out.strategy.empty() ? "" : ",") + fix.strategy;
    out.iterations += fix.iterations;
    out.crossings_before = std::max(out.crossings_before, fix.crossings_before);
    if (fix.strategy == "move-nodes" || fix.strategy == "move-part")
      out.crossings_after = fix.crossings_after;
    append(out.moved, fix.moved);  // from one step: each strategy runs once
    if (fix.strategy == "tie") {
      out.ties = fix.ties;
      of_ties = fix.refused;
      out.complete &= fix.complete;
      continue;
    }
    // an interface that this step no longer lists has no penetration
    for (FixedInterface& entry : out.interfaces) entry.after = {};
    for (const FixedInterface& i : fix.interfaces) {
      const auto entry = std::find_if(out.interfaces.begin(), out.interfaces.end(),
                                      [&](const FixedInterface& e) { return e.id == i.id; });
      if (entry == out.interfaces.end()) {
        out.interfaces.push_back(i);
        continue;
      }
      entry->after = i.after;
      append(entry->changes, i.changes);
    }
  }
  const auto of_contacts = [](const PenetrationFix& fix) { return fix.strategy != "tie"; };
  if (const auto first = std::find_if(fixes.begin(), fixes.end(), of_contacts);
      first != fixes.end()) {
    const PenetrationFix& last = *std::find_if(fixes.rbegin(), fixes.rend(), of_contacts);
    out.tied_pairs = first->tied_pairs;
    out.tied_nodes = first->tied_nodes;
    out.refused = last.refused;
    out.actions = last.actions;
    out.complete &= last.complete;
  }
  append(out.refused, of_ties);
  std::sort(out.interfaces.begin(), out.interfaces.end(),
            [](const FixedInterface& a, const FixedInterface& b) { return a.id < b.id; });
  return out;
}

}  // namespace deck
