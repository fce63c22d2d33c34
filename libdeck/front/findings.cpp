// Merges the findings of all stages without duplicates, and reads the cells of all blocks.
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

/// Adds findings without duplicates; also adds the counts of dropped ones.
class FindingMerger {
 public:
  /// `incomplete`: drops findings about missing entities, which may be in a file that was not read.
  FindingMerger(int per_rule, bool incomplete) : out_(per_rule), incomplete_(incomplete) {}

  void add(const Findings& list) {
    std::map<RuleId, std::uint64_t> kept;
    for (const Finding& d : list.all()) {
      ++kept[d.rule];
      add(d);
    }
    for (const auto& [rule, count] : list.counts())
      if (!left_out(rule)) out_.count(rule, count - kept[rule]);
  }
  void add(const Finding& d) {
    if (left_out(d.rule)) return;
    if (known_.emplace(d.rule, d.span.file, d.span.offset, d.message).second) out_.report(d);
  }
  Findings merged() { return std::move(out_); }

 private:
  bool left_out(RuleId rule) const { return incomplete_ && rule_of(rule).absence; }

  Findings out_;
  bool incomplete_;
  std::set<std::tuple<RuleId, std::uint32_t, std::uint64_t, std::string>> known_;
};

}  // namespace

FindingLists::FindingLists(const Findings& of_reading, int per_rule)
    : per_rule_(per_rule), mesh_(per_rule), added_(per_rule), all_cells_(per_rule) {
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
    if (b.schema != nullptr && !b.schema->bulk && !b.opaque) blocks.push_back(&b);
  constexpr std::size_t at_once = 16;
  run_in_order<std::vector<Findings>>(
      (blocks.size() + at_once - 1) / at_once, effective_threads(threads),
      [&](std::size_t piece, std::vector<Findings>& out) {
        const std::size_t begin = piece * at_once;
        out.assign(std::min(at_once, blocks.size() - begin), Findings(per_rule_));
        for (std::size_t i = 0; i < out.size(); ++i) decode(deck, *blocks[begin + i], &out[i]);
      },
      [&](std::size_t piece, std::vector<Findings>& in) {
        for (std::size_t i = 0; i < in.size(); ++i) {
          const std::string& kind = blocks[piece * at_once + i]->schema->kind;
          if (std::find(std::begin(kinds), std::end(kinds), kind) != std::end(kinds))
            for (const Finding& d : in[i].all())
              if (d.severity == Severity::error) of(Stage::cells).report(d);
          all_cells_.merge(std::move(in[i]));
        }
      });
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
    if (stage == Stage::cells) out.add(mesh_);
    out.add(lists_[static_cast<std::size_t>(stage)]);
  }
  out.add(added_);
  return out.merged();
}

Findings FindingLists::joined(const Model& model, const Findings& of_scene) const {
  FindingMerger out(per_rule_, incomplete());
  for (const Stage stage : {Stage::deck, Stage::model, Stage::interfaces})
    out.add(lists_[static_cast<std::size_t>(stage)]);
  out.add(mesh_);
  out.add(of_scene);
  out.add(lists_[static_cast<std::size_t>(Stage::cells)]);
  // The scene reports DK332 itself.
  if (model.selections != nullptr)
    for (const Finding& d : model.selections->findings().all())
      if (d.severity == Severity::error && d.rule != RuleId::DK332) out.add(d);
  out.add(added_);
  return out.merged();
}

}  // namespace deck::detail
