// Joins the findings of all stages, each once, and reads the cells that contacts depend on.
#include "front/findings.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "base/shared/parallel.hpp"
#include "deck/keyword.hpp"
#include "deck/model.hpp"
#include "deck/rule_id.hpp"

namespace deck::detail {
namespace {

/// Takes findings that are not there yet. Those that were counted only are counted on.
class FindingMerger {
 public:
  /// `incomplete`: what seems to be absent may be in a file that was not read, and is left out.
  FindingMerger(int per_rule, bool incomplete) : out_(per_rule), incomplete_(incomplete) {}

  void take(const Findings& list) {
    std::map<RuleId, std::uint64_t> kept;
    for (const Finding& d : list.all()) {
      ++kept[d.rule];
      take(d);
    }
    for (const auto& [rule, count] : list.counts())
      if (!left_out(rule)) out_.count(rule, count - kept[rule]);
  }
  void take(const Finding& d) {
    if (left_out(d.rule)) return;
    if (known_.emplace(d.rule, d.span.file, d.span.offset, d.message).second) out_.report(d);
  }
  Findings finish() { return std::move(out_); }

 private:
  bool left_out(RuleId rule) const { return incomplete_ && rule_of(rule).absence; }

  Findings out_;
  bool incomplete_;
  std::set<std::tuple<RuleId, std::uint32_t, std::uint64_t, std::string>> known_;
};

}  // namespace

FindingLists::FindingLists(const Findings& of_reading, int per_rule)
    : per_rule_(per_rule), mesh_(per_rule), added_(per_rule) {
  for (Findings& list : lists_) list = Findings(per_rule);
  of(Stage::deck) = of_reading;
}

void FindingLists::forget_scene() { of(Stage::scene) = Findings(per_rule_); }

void FindingLists::read_cells(const Deck& deck, int threads) {
  constexpr std::string_view kinds[] = {
      "inter",  "default_inter", "friction", "grnod",  "surf",   "line",   "set",       "box",
      "skew",   "grshel",        "grsh3n",   "grbric", "grquad", "grtria", "grtrus",    "grbeam",
      "grspri", "grpart",        "part",     "prop",   "mat",    "subset", "transform", "unit"};
  std::vector<const Block*> blocks;
  for (const Block& b : deck.blocks)
    if (b.schema != nullptr && !b.schema->bulk && !b.opaque &&
        std::find(std::begin(kinds), std::end(kinds), b.schema->kind) != std::end(kinds))
      blocks.push_back(&b);
  Findings found;
  constexpr std::size_t at_once = 16;
  run_in_order<Findings>((blocks.size() + at_once - 1) / at_once, effective_threads(threads),
                         [&](std::size_t piece, Findings& out) {
                           out = Findings();
                           const std::size_t end = std::min(blocks.size(), (piece + 1) * at_once);
                           for (std::size_t i = piece * at_once; i < end; ++i)
                             decode(deck, *blocks[i], &out);
                         },
                         [&](std::size_t, Findings& in) { found.merge(std::move(in)); });
  for (const Finding& d : found.all())
    if (d.severity == Severity::error) of(Stage::cells).report(d);
  cells_read_ = true;
}

bool FindingLists::incomplete() const {
  const auto& counts = lists_[static_cast<std::size_t>(Stage::deck)].counts();
  // Included files that are missing, form a cycle or exceed the limits.
  return counts.contains(RuleId::DK004) || counts.contains(RuleId::DK005) ||
         counts.contains(RuleId::DK006);
}

Findings FindingLists::joined(Stage until) const {
  FindingMerger out(per_rule_, incomplete());
  for (const Stage stage : {Stage::deck, Stage::model, Stage::interfaces, Stage::cells}) {
    if (stage > until) break;
    if (stage == Stage::cells) out.take(mesh_);
    out.take(lists_[static_cast<std::size_t>(stage)]);
  }
  out.take(added_);
  return out.finish();
}

Findings FindingLists::joined(const Model& model, const Findings& of_scene) const {
  FindingMerger out(per_rule_, incomplete());
  for (const Stage stage : {Stage::deck, Stage::model, Stage::interfaces})
    out.take(lists_[static_cast<std::size_t>(stage)]);
  out.take(mesh_);
  out.take(of_scene);
  out.take(lists_[static_cast<std::size_t>(Stage::cells)]);
  // The scene has reported DK332 itself.
  if (model.selections != nullptr)
    for (const Finding& d : model.selections->findings().all())
      if (d.severity == Severity::error && d.rule != RuleId::DK332) out.take(d);
  out.take(added_);
  return out.finish();
}

}  // namespace deck::detail
