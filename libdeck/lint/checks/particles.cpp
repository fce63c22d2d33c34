// What the solver says of particles (SPH) before the run.
#include <map>
#include <set>

#include "lint/check.hpp"
#include "lint/check_tables.hpp"

namespace deck::detail {
namespace {

/// Most boundaries that a particle may lie in before the solver warns.
constexpr int most_boundaries = 2;

void check_corners(const LintContext& c, const Rule& rule, Reporter& r) {
  if (c.model == nullptr || c.selections == nullptr) return;
  std::map<NodeIndex, int> boundaries;
  const Block* last = nullptr;
  for (const Block& block : c.deck.blocks) {
    if (block.schema == nullptr || block.schema->keyword != "/SPHBCS" || block.opaque) continue;
    const DecodedBlock d = decode(c.deck, block);
    const NodeSet* group =
        c.selections->node_group(c.resolved(block, "grnod", d.integer("grnod_ID")));
    if (group == nullptr) continue;
    last = &block;
    for (const NodeIndex n : std::set<NodeIndex>(group->nodes.begin(), group->nodes.end()))
      ++boundaries[n];
  }
  std::size_t count = 0;
  NodeIndex first = no_index;
  for (const auto& [node, times] : boundaries) {
    if (times <= most_boundaries) continue;
    if (count++ == 0) first = node;
  }
  if (count == 0) return;
  r.report(rule, *last, last->header_span,
           fmt::format("{} {} in {} or more /SPHBCS; first is node {}", count,
                       count == 1 ? "particle lies" : "particles lie", most_boundaries + 1,
                       c.model->node_id(first)));
}

}  // namespace

std::span<const Checked> particle_checks() {
  static constexpr Checked all[] = {{RuleId::DK643, check_corners}};
  return all;
}

}  // namespace deck::detail
