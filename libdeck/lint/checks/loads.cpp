// What the solver cannot make sense of in loads and walls: flags and words other than those that
// the schemas call legal, walls without a normal, particles in too many boundaries.
#include <algorithm>
#include <map>
#include <set>

#include "lint/check.hpp"

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
    each_cell(d, [&](const DecodedCard& card, const Cell& cell) {
      if (!cell.field->wrong || card.missing()) return;
      const std::string legal = legal_codes(cell);
      if (legal.empty()) return;
      Diagnostic& found = r.report(
          rule, *d.block, place_of(d, &cell),
          fmt::format("{} of {} is {}; legal: {}", cell.field->name, name_of(d),
                      cell.blank() ? "blank" : fmt::format("'{}'", clipped(trim(cell.text))),
                      legal));
      if (*cell.field->wrong > 0) found.reference = {*cell.field->wrong, Severity::error};
    });
  }
}

void check_normal(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const DecodedBlock& d : c.loads) {
    const std::string& keyword = d.block->schema->keyword;
    if (keyword != "/RWALL/PLANE" && keyword != "/RWALL/CYL") continue;
    // A wall that moves has its first point in a node.
    if (const Cell* node = d.find("node_ID"); node == nullptr || node->integer != 0) continue;
    if (d.real("XM") != d.real("XM1") || d.real("YM") != d.real("YM1") ||
        d.real("ZM") != d.real("ZM1"))
      continue;
    r.report(
        rule, *d.block, place_of(d, "XM1"),
        fmt::format("both points of {} are at ({}, {}, {})", name_of(d), number_text(d.real("XM")),
                    number_text(d.real("YM")), number_text(d.real("ZM"))));
  }
}

/// Most boundaries that a particle may lie in before the solver warns.
constexpr int most_boundaries = 2;

void check_corners(const LintContext& c, const Rule& rule, Reporter& r) {
  std::map<NodeIndex, int> boundaries;
  const Block* last = nullptr;
  each_block(c, "/SPHBCS", [&](const Block& block) {
    const DecodedBlock d = decode(c.deck, block);
    const NodeSet* group =
        c.selections->node_group(c.resolved(block, "grnod", d.integer("grnod_ID")));
    if (group == nullptr) return;
    last = &block;
    for (const NodeIndex n : std::set<NodeIndex>(group->nodes.begin(), group->nodes.end()))
      ++boundaries[n];
  });
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
