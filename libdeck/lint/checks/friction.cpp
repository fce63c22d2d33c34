// Part pairs of /FRICTION, and groups, surfaces, lines and frictions that nothing uses.
// The functions that fill the table are as long as their pages.
#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "lint/check.hpp"
#include "lint/rule_tables.hpp"

namespace deck::detail {
namespace {

const Cell* cell_of(const DecodedCard& card, std::string_view name) {
  for (const Cell& cell : card.cells)
    if (cell.field->name == name) return &cell;
  return nullptr;
}

/// Calls f(block, card) for the first line of every part pair.
template <class F>
void each_pair(const LintContext& c, F&& f) {
  for (const DecodedBlock& block : c.frictions)
    for (const DecodedCard& card : block.cards)
      if (cell_of(card, "part_ID1") != nullptr && !card.missing()) f(block, card);
}

std::string friction_name(const DecodedBlock& block) {
  return "/FRICTION " + std::to_string(block.block->id.value);
}

void check_parts(const LintContext& c, const Rule& rule, Reporter& r) {
  if (c.model == nullptr || c.selections == nullptr) return;
  each_pair(c, [&](const DecodedBlock& block, const DecodedCard& card) {
    for (const Cell& cell : card.cells) {
      if (cell.field->type != FieldType::id || cell.integer <= 0) continue;
      const bool part = cell.field->ref == "part";
      const std::int64_t id = c.resolved(*block.block, cell.field->ref, cell.integer);
      const bool known =
          part ? c.model->part_of_id.count(id) > 0 : c.selections->part_group(id) != nullptr;
      if (!known)
        r.report(rule, *block.block, cell.span,
                 fmt::format("{} of {} is {}, and there is no {} of that id", cell.field->name,
                             friction_name(block), id, part ? "/PART" : "/GRPART or /SET"));
    }
  });
}

void check_repeated(const LintContext& c, const Rule& rule, Reporter& r) {
  using Key = std::tuple<const Block*, std::int64_t, std::int64_t, std::int64_t, std::int64_t>;
  std::map<Key, Span> seen;
  each_pair(c, [&](const DecodedBlock& block, const DecodedCard& card) {
    const auto id = [&](std::string_view name) {
      const Cell* cell = cell_of(card, name);
      return cell ? cell->integer : 0;
    };
    auto one = std::pair{id("grpart_ID1"), id("part_ID1")};
    auto two = std::pair{id("grpart_ID2"), id("part_ID2")};
    if (two < one) std::swap(one, two);
    const auto [it, fresh] = seen.emplace(
        Key{block.block, one.first, one.second, two.first, two.second}, card.line.whole());
    if (fresh) return;
    Diagnostic* d = r.report(rule, *block.block, card.line.whole(),
                             friction_name(block) + " gives the same pair of parts twice");
    if (d != nullptr) d->notes.emplace_back(it->second, "first given here");
  });
}

void check_incomplete(const LintContext& c, const Rule& rule, Reporter& r) {
  each_pair(c, [&](const DecodedBlock& block, const DecodedCard& card) {
    for (const std::string_view n : {"1", "2"}) {
      const Cell* group = cell_of(card, "grpart_ID" + std::string(n));
      const Cell* part = cell_of(card, "part_ID" + std::string(n));
      if ((group != nullptr && group->integer != 0) || (part != nullptr && part->integer != 0))
        continue;
      r.report(rule, *block.block, card.line.whole(),
               fmt::format("a pair of {} has neither grpart_ID{} nor part_ID{}",
                           friction_name(block), n, n));
    }
  });
}

bool used(const LintContext& c, std::string_view kind, std::int64_t id) {
  const auto it = c.referenced.find(kind);
  return (it != c.referenced.end() && it->second.count(id) > 0) || c.loose_numbers.count(id) > 0;
}

void check_unused_friction(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const DecodedBlock& block : c.frictions) {
    const std::int64_t id = c.resolved(*block.block, "friction", block.block->id.value);
    if (!used(c, "friction", id))
      r.report(rule, *block.block, block.span(), "no interface uses " + friction_name(block));
  }
}

void check_unused_groups(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const std::string_view kind : {"grnod", "surf", "line"}) {
    const auto all = c.defined.find(kind);
    if (all == c.defined.end()) continue;
    for (const auto& [id, block] : all->second)
      if (!used(c, kind, id))
        r.report(rule, *block, block->header_span,
                 fmt::format("nothing refers to {} {}", block->schema->keyword, id));
  }
}

}  // namespace

void add_friction_pair_rules(std::vector<Rule>& out) {
  out.push_back({.id = "DK183",
                 .title = "friction pair of an unknown part",
                 .severity = Severity::error,
                 .problem = "A pair of /FRICTION names a part or part group that does not exist.",
                 .why = "The pair would have no friction of its own.",
                 .solver = "it stops with an error",
                 .message = 1590,
                 .message_severity = Severity::error,
                 .fix = "correct the id",
                 .ignore = "When the part is in an include that cannot be read.",
                 .bad = "@/FRICTION/1 C1=0.0 Fric=0.1 part_ID1=1 part_ID2=77 C1_pair=0.0 "
                        "Fric_pair=0.2\n@/INTER/TYPE7/1 fric_ID=1\n",
                 .good = "@/FRICTION/1 C1=0.0 Fric=0.1 part_ID1=1 part_ID2=2 C1_pair=0.0 "
                         "Fric_pair=0.2\n@/INTER/TYPE7/1 fric_ID=1\n",
                 .check = check_parts});
  out.push_back({.id = "DK184",
                 .title = "friction pair given twice",
                 .severity = Severity::warning,
                 .problem = "The same two sides appear in two pairs of a /FRICTION.",
                 .why = "Which of the two is used is not settled.",
                 .solver = "it accepts both; which one wins is not documented",
                 .fix = "delete one of the pairs",
                 .ignore = "When both have the same values.",
                 .bad = "@/FRICTION/1 C1=0.0 Fric=0.1 part_ID1=1 part_ID2=2 C1_pair=0.0 "
                        "Fric_pair=0.2\n                             2         1\n"
                        "                 0.0\n                 0.0                 0.3\n"
                        "@/INTER/TYPE7/1 fric_ID=1\n",
                 .good = "@/FRICTION/1 C1=0.0 Fric=0.1 part_ID1=1 part_ID2=2 C1_pair=0.0 "
                         "Fric_pair=0.2\n@/INTER/TYPE7/1 fric_ID=1\n",
                 .check = check_repeated});
  out.push_back({.id = "DK185",
                 .title = "friction that no interface uses",
                 .severity = Severity::warning,
                 .problem = "A /FRICTION is defined, and no fric_ID refers to it.",
                 .why = "Its values have no effect.",
                 .solver = "it warns if there is no interface at all, and is silent otherwise",
                 .message = 1593,
                 .fix = "refer to it with fric_ID, or delete it",
                 .ignore = "When it is kept for later.",
                 .bad = "@/FRICTION/6 C1=0.0 Fric=0.1\n@/INTER/TYPE7/1\n",
                 .good = "@/FRICTION/6 C1=0.0 Fric=0.1\n@/INTER/TYPE7/1 fric_ID=6\n",
                 .check = check_unused_friction});
  out.push_back({.id = "DK186",
                 .title = "friction pair with one side only",
                 .severity = Severity::error,
                 .problem = "A pair names no part and no part group on one side.",
                 .why = "It is a pair of something with nothing, often a blank line too many.",
                 .solver = "it finds no part of id 0",
                 .message = 1590,
                 .message_severity = Severity::error,
                 .fix = "give both sides, or delete the pair",
                 .ignore = "Never.",
                 .bad = "@/FRICTION/1 C1=0.0 Fric=0.1 part_ID1=1 C1_pair=0.0 Fric_pair=0.2\n"
                        "@/INTER/TYPE7/1 fric_ID=1\n",
                 .good = "@/FRICTION/1 C1=0.0 Fric=0.1 part_ID1=1 part_ID2=2 C1_pair=0.0 "
                         "Fric_pair=0.2\n@/INTER/TYPE7/1 fric_ID=1\n",
                 .check = check_incomplete});
  out.push_back({.id = "DK188",
                 .title = "group, surface or line that nothing uses",
                 .severity = Severity::info,
                 .problem = "No card of the deck refers to this node group, surface or line.",
                 .why = "Left-overs hide what matters, and a contact that was to use it may be "
                        "missing.",
                 .solver = "it builds the group all the same",
                 .fix = "delete it, or refer to it",
                 .ignore = "When a library include defines more than one deck needs.",
                 .bad = "/SURF/PART/1234567\nspare\n         1\n",
                 .good = "@bare\n/SURF/PART/1234567\nspare\n         1\n"
                         "@/INTER/TYPE7/1 grnd_IDs=0 surf_IDm=1234567\n",
                 .check = check_unused_groups});
}

}  // namespace deck::detail
