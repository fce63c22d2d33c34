// What the solver cannot make sense of in loads and walls: flags and words other than those that
// the schemas call legal, walls without a normal, particles in too many boundaries.
#include <algorithm>
#include <map>
#include <set>

#include "lint/check.hpp"
#include "lint/check_tables.hpp"
#include "lint/targets.hpp"

namespace deck::detail {
namespace {

/// What is legal, where the cell is not; empty: it is.
std::string legal_codes(const Cell& cell) {
  const Field& f = *cell.field;
  const std::string_view text = trim(cell.text);
  if (f.type == FieldType::flag)  // of letters the solver says nothing
    return text.empty() || text[0] < '2' || text[0] > '9' ? std::string() : "0 and 1";
  if (std::find(f.words.begin(), f.words.end(), text) != f.words.end()) return {};
  return fmt::format("{}", fmt::join(f.words, ", "));
}

void check_codes(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const DecodedBlock& d : c.loads) {
    if (acts_on_nothing(c, d) != nullptr) continue;  // DK138 says so
    for (const DecodedCard& card : d.cards)
      for (const Cell& cell : card.cells) {
        if (!cell.field->wrong || card.missing()) continue;
        const std::string legal = legal_codes(cell);
        if (legal.empty()) continue;
        Diagnostic* found = r.report(
            rule, *d.block, cell.span.valid() ? cell.span : d.block->header_span,
            fmt::format("{} of {} {} is {}; legal: {}", cell.field->name, d.block->schema->keyword,
                        d.block->id.value,
                        cell.blank() ? "blank" : fmt::format("'{}'", clipped(trim(cell.text))),
                        legal));
        if (found != nullptr && *cell.field->wrong > 0)
          found->reference = {*cell.field->wrong, Severity::error};
      }
  }
}

double real_of(const DecodedBlock& d, std::string_view field) {
  const Cell* cell = d.find(field);
  return cell != nullptr ? cell->real : 0;
}

void check_normal(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const DecodedBlock& d : c.loads) {
    const std::string& keyword = d.block->schema->keyword;
    if (keyword != "/RWALL/PLANE" && keyword != "/RWALL/CYL") continue;
    // A wall that moves has its first point in a node.
    if (const Cell* node = d.find("node_ID"); node == nullptr || node->integer != 0) continue;
    if (real_of(d, "XM") != real_of(d, "XM1") || real_of(d, "YM") != real_of(d, "YM1") ||
        real_of(d, "ZM") != real_of(d, "ZM1"))
      continue;
    const Cell* second = d.find("XM1");
    r.report(rule, *d.block,
             second != nullptr && second->span.valid() ? second->span : d.block->header_span,
             fmt::format("both points of {} {} are at ({}, {}, {})", keyword, d.block->id.value,
                         number_text(real_of(d, "XM")), number_text(real_of(d, "YM")),
                         number_text(real_of(d, "ZM"))));
  }
}

/// Most boundaries that a particle may lie in before the solver warns.
constexpr int most_boundaries = 2;

void check_corners(const LintContext& c, const Rule& rule, Reporter& r) {
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

std::span<const Checked> load_checks() {
  static constexpr Checked all[] = {
      {RuleId::DK135, check_codes}, {RuleId::DK137, check_normal}, {RuleId::DK643, check_corners}};
  return all;
}

}  // namespace deck::detail
