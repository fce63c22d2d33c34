// Reads unclean lines of a chunk and reports problem lines.
#include "model/bulk/bulk_read.hpp"

#include <algorithm>

#include "keyword/shared/reader.hpp"

namespace deck::detail {
namespace {

std::string place_of(const BlockPlan& plan, const Problem& problem) {
  return std::string(plan.block->keyword) + " " + std::to_string(problem.item);
}

void report_problem(Findings& findings, const BlockPlan& plan, const Problem& problem,
                    BulkRule rule, Span span, std::string message, Overrides overrides = {}) {
  Finding d = make_finding(bulk_rule_id(rule), span, std::move(message), std::move(overrides));
  d.keyword = std::string(plan.block->keyword);
  d.id = problem.item;
  findings.add(std::move(d));
}

void report_unknown_nodes(const BlockPlan& plan, const Problem& problem, const DecodedCard& card,
                          const Nodes& nodes, Findings& findings) {
  for (std::size_t i = 0; i < card.cells.size(); ++i) {
    const int n = node_of_cell(*plan.item, problem.card, i);
    if (n < 0) continue;
    const Cell& cell = card.cells[i];
    const std::int64_t written = cell.integer;
    if (written == 0 && n >= problem.required) continue;
    const std::int64_t id = written > 0 ? written + plan.node_offset : written;
    if (nodes.map.find(id) != no_index) continue;
    if (!findings.wants(bulk_rule_id(unknown_node))) continue;
    const bool last_of_shell = written == 0 && n == 3 && plan.format.kind == ElementKind::shell4;
    report_problem(findings, plan, problem, unknown_node,
                   cell.span.length > 0 ? cell.span : card.line.whole(),
                   place_of(plan, problem) + ": " + cell.field->name + " names node " +
                       std::to_string(id) + ", which does not exist",
                   {.fix = last_of_shell ? "write N4 = N3 for a triangle, or use /SH3N" : ""});
  }
}

/// A line of zeros is node 0 or an element with it: the solver stops, except for tetrahedra.
void report_blank_line(const BlockPlan& plan, const Problem& problem, Span line,
                       Findings& findings) {
  const std::string& kind = plan.block->schema->kind;
  const bool element = !plan.item->nodes.empty(), stops = element && kind != "tetra4";
  report_problem(findings, plan, problem, blank_line, line,
                 "a blank line in " + std::string(plan.block->header),
                 {.severity = stops ? Severity::error : Severity::warning,
                  .message = !stops             ? 0
                             : kind == "spring" ? 681
                                                : 78,
                  .solver = stops     ? "It takes the line as an element of node 0, and stops."
                            : element ? "It takes the line as an element without nodes."
                                      : "It takes the line as node 0 at the origin."});
}

}  // namespace

RuleId bulk_rule_id(std::size_t rule) {
  constexpr RuleId own[] = {RuleId::DK036, RuleId::DK037, RuleId::DK038, RuleId::DK029,
                            RuleId::DK101};
  return rule < blank_line ? line_rule_ids[rule] : own[rule - blank_line];
}

void UsualLine::learn_cells(const CardPlan& plan) {
  auto cell = plan.cells.begin();
  std::uint32_t at = 0;
  const auto count = [&](bool real, std::uint32_t width) {
    const auto begin = cell;
    while (cell != plan.cells.end() && cell->real == real && cell->first == at &&
           cell->last == at + width && at + width <= size) {
      ++cell;
      at += width;
    }
    return static_cast<std::uint32_t>(cell - begin);
  };
  ids = count(false, 10);
  reals = count(true, 20);
  const bool whole = at == size && std::all_of(cell, plan.cells.end(), [&](const CellPlan& behind) {
                       return behind.first >= size;
                     });
  layout = whole ? even : uneven;
}

int node_of_cell(const ItemPlan& plan, std::size_t card, std::size_t cell) {
  for (std::size_t n = 0; n < plan.nodes.size(); ++n)
    if (plan.nodes[n].present && plan.nodes[n].card == card && plan.nodes[n].cell == cell)
      return static_cast<int>(n);
  return -1;
}

bool sh3n_left_columns(std::string_view line) {
  if (line.find(',') != std::string_view::npos) return false;
  const std::string_view left = columns(line, 81, 90);
  if (left.find_first_not_of("0. ") == std::string_view::npos) return false;
  const auto filled = [&](std::size_t column) {
    return line.size() >= column && !is_blank(line[column - 1]);
  };
  // A number that ends in column 90 is an angle in columns 71-90, if these have no other number.
  return filled(91) || !filled(90) || (!trim(columns(line, 61, 80)).empty() && !filled(80));
}

void inspect_line(const Deck& deck, const BlockPlan& plan, std::size_t card, std::uint32_t file,
                  Unclean unclean, BulkItem& item) {
  const CardPlan& layout = plan.item->cards[card];
  const std::string_view line = item.text[card];
  const std::string_view text = line.substr(0, line_columns);
  const auto contains = [&](char c) { return text.find(c) != std::string_view::npos; };
  if (contains(',') || contains('&')) {
    const char* const data = deck.sources[file].bytes().data();
    const DecodedCard decoded =
        decode_line(deck, *plan.block, *layout.card,
                    {line, file, static_cast<std::uint64_t>(line.data() - data)}, nullptr);
    for (std::size_t i = 0; i < decoded.cells.size(); ++i) {
      item.line[card].integer[i] = decoded.cells[i].integer;
      item.line[card].real[i] = decoded.cells[i].real;
    }
    item.problem_of(card).decoded = true;
    return;
  }
  const auto count = [&](LineRule rule) {
    if (rule != LineRule::none) item.count(card, static_cast<std::uint8_t>(rule));
  };
  if (contains('\t')) count(LineRule::tab);
  if (contains('\0')) count(LineRule::nul);
  if ((unclean & outside_cells) != 0) {
    if (!tail_of(line).empty()) count(LineRule::tail);
    for_each_gap_text(layout.map, line, [&](int, int, bool after, bool zero) {
      if (!after || !zero) count(after ? LineRule::after : LineRule::gap);
    });
  }
  for (std::size_t i = 0; i < layout.cells.size(); ++i) {
    if ((unclean >> i & 1) == 0) continue;
    const CellPlan& cell = layout.cells[i];
    const std::string_view cell_text = trim(line.substr(cell.first, cell.last - cell.first));
    if (cell.real) {
      const RealCell r = read_real(cell_text);
      item.line[card].real[i] = r.value;
      count(number_rule(*cell.field, r.status, cell_text.size(), r.value));
    } else {
      const IntegerCell n = read_integer(cell_text);
      item.line[card].integer[i] = saturated(n.value);
      count(number_rule(*cell.field, narrowed(n), cell_text.size(), 0));
    }
  }
}

void report_problem(const Deck& deck, const BlockPlan& plan, std::uint32_t file,
                    const Problem& problem, const Nodes* nodes, Findings& findings) {
  const std::string_view bytes = deck.sources[file].bytes();
  const auto nl = std::min(bytes.find('\n', problem.offset), bytes.size());
  const Line line{trim_right(bytes.substr(problem.offset, nl - problem.offset)), file,
                  problem.offset};
  if (problem.counts[blank_line] > 0) {
    if (findings.wants(bulk_rule_id(blank_line)))
      report_blank_line(plan, problem, {file, 0, problem.offset}, findings);
    return;
  }
  const DecodedCard card =
      decode_line(deck, *plan.block, *plan.item->cards[problem.card].card, line, &findings);
  if (problem.counts[bad_id] > 0 && findings.wants(bulk_rule_id(bad_id)))
    report_problem(findings, plan, problem, bad_id, line.columns(1, 10),
                   std::string(plan.block->keyword) + ": id " + std::to_string(problem.item) +
                       " is not positive");
  if (problem.counts[sh3n_columns] > 0 && findings.wants(bulk_rule_id(sh3n_columns)))
    report_problem(findings, plan, problem, sh3n_columns, line.columns(81, 90),
                   place_of(plan, problem) + ": the thickness begins left of column 91; \"" +
                       std::string(trim(columns(line.text, 91, 100))) + "\" is read of it");
  if (problem.counts[unknown_node] > 0 && nodes != nullptr)
    report_unknown_nodes(plan, problem, card, *nodes, findings);
  if (problem.counts[incomplete] > 0 && findings.wants(bulk_rule_id(incomplete)))
    report_problem(findings, plan, problem, incomplete, line.whole(),
                   place_of(plan, problem) + " ends after " + std::to_string(problem.card + 1) +
                       " of " + std::to_string(plan.item->cards.size()) +
                       " lines; the element is left out",
                   {.message = 0});
}

}  // namespace deck::detail
