// Values of which the reference solver speaks: those with which it stops, those of which it warns,
// and those of which only some of its builds warn.
#include "lint/limits.hpp"

#include <algorithm>

#include "lint/check.hpp"
#include "lint/check_tables.hpp"

namespace deck::detail {
namespace {

/// Where a number was read, and what it is.
struct Reading {
  const DecodedCard* card = nullptr;  ///< nullptr: the line is not there
  const Cell* cell = nullptr;
  double value = 0;
};

double number_in(const Cell* cell) {
  if (cell == nullptr) return 0;
  return cell->field->type == FieldType::real ? cell->real : static_cast<double>(cell->integer);
}

/// The cell of that name that goes with a line: on it, in its round, or where nothing repeats.
const Cell* cell_beside(const DecodedBlock& d, const DecodedCard* line, std::string_view field) {
  const auto in = [&](const DecodedCard& card) -> const Cell* {
    for (const Cell& cell : card.cells)
      if (cell.field->name == field) return &cell;
    return nullptr;
  };
  if (line == nullptr) return d.find(field);
  if (const Cell* cell = in(*line)) return cell;
  for (const int round : {line->round, 0})
    for (const DecodedCard& card : d.cards)
      if (card.round == round)
        if (const Cell* cell = in(card)) return cell;
  return nullptr;
}

/// Whether the block has the cell in any case: a line that is missing then counts as blank.
bool always_there(const DecodedBlock& d, std::string_view field) {
  for (const CardSchema& card : d.block->schema->cards)
    for (const Field& f : card.fields)
      if (f.name == field && card.in_version(d.block->version) && f.in_version(d.block->version) &&
          card.when.empty() && f.when.empty() && card.repeat == Repeat::once)
        return true;
  return false;
}

std::vector<Reading> readings_of(const DecodedBlock& d, const Limit& limit) {
  std::vector<Reading> out;
  if (limit.of.field.empty()) return {Reading{}};
  for (const DecodedCard& card : d.cards)
    for (const Cell& cell : card.cells)
      if (cell.field->name == limit.of.field) out.push_back({&card, &cell, number_in(&cell)});
  if (out.empty() && always_there(d, limit.of.field)) out.emplace_back();
  if (limit.sum && !out.empty()) {
    for (std::size_t i = 1; i < out.size(); ++i) out.front().value += out[i].value;
    out.resize(1);
  }
  return out;
}

/// A parameter that could not be replaced reads as 0 and says nothing.
bool known(const Reading& r) { return r.cell == nullptr || !r.cell->parameter || r.value != 0; }

std::string list_of_numbers(const std::vector<double>& values) {
  std::string out;
  for (const double v : values) out += (out.empty() ? "" : " or ") + number_text(v);
  return out;
}

/// "above 0": what is legal, where `test` is not.
std::string legal_instead(const NumberTest& test) {
  std::string out;
  const auto add = [&](const std::optional<double>& bound, const char* word) {
    if (bound) out += fmt::format("{}{}{}", out.empty() ? "" : " or ", word, number_text(*bound));
  };
  add(test.at_most, "above ");
  add(test.below, "from ");
  add(test.at_least, "below ");
  add(test.above, "up to ");
  if (!test.is.empty()) out += (out.empty() ? "not " : ", not ") + list_of_numbers(test.is);
  if (!test.is_not.empty()) out += (out.empty() ? "" : " or ") + list_of_numbers(test.is_not);
  return out;
}

/// "c = 0.1 and F_cut = 0": the cells that make the value what it is.
std::string circumstances(const DecodedBlock& d, const Limit& limit, const DecodedCard* card) {
  std::string out;
  for (const NumberTest& test : limit.when) {
    const Cell* cell = cell_beside(d, card, test.field);
    if (cell == nullptr) continue;
    out +=
        fmt::format("{}{} = {}", out.empty() ? "" : ", ", test.field, number_text(number_in(cell)));
  }
  return out;
}

std::string message_of(const DecodedBlock& d, const Limit& limit, const Reading& at) {
  const std::string name = fmt::format("{} {}", d.block->schema->keyword, d.block->id.value);
  if (limit.of.field.empty()) return name + ": " + limit.says;
  const bool blank = at.cell == nullptr || at.cell->blank();
  std::string out =
      fmt::format("{}{} of {} is {}", limit.sum ? "the sum of " : "", limit.of.field, name,
                  limit.sum ? number_text(at.value)
                  : blank   ? std::string("blank")
                            : clipped(at.cell->text));
  if (const std::string also = circumstances(d, limit, at.card); !also.empty())
    out += ", with " + also;
  if (limit.severity == Severity::error)
    out += "; legal: " + (limit.not_a.empty() ? legal_instead(limit.of) : "a " + limit.not_a);
  if (!limit.says.empty()) out += " (" + limit.says + ")";
  return out;
}

/// The id names something, and all that it names is of another keyword.
bool is_other_kind(const LintContext& c, const Block& block, const Limit& limit, const Cell* cell) {
  if (cell == nullptr) return false;
  const auto all = c.defined.find(cell->field->ref);
  if (all == c.defined.end()) return false;
  const auto [first, last] =
      all->second.equal_range(c.resolved(block, cell->field->ref, cell->integer));
  return first != last && std::none_of(first, last, [&](const auto& entry) {
           return entry.second->schema->keyword.starts_with(limit.not_a);
         });
}

bool applies(const LintContext& c, const DecodedBlock& d, const Limit& limit, const Reading& at) {
  const bool circumstances_hold =
      std::all_of(limit.when.begin(), limit.when.end(), [&](const NumberTest& test) {
        return test.holds(number_in(cell_beside(d, at.card, test.field)));
      });
  if (!known(at) || !circumstances_hold) return false;
  return limit.not_a.empty() ? limit.of.field.empty() || limit.of.holds(at.value)
                             : is_other_kind(c, *d.block, limit, at.cell);
}

bool has_limits(const Rule& rule, const Schema& schema) {
  const auto& limits = limits_of(schema);
  return std::any_of(limits.begin(), limits.end(),
                     [&](const Limit* limit) { return limit->rule == id_text(rule.id); });
}

void check_limits(const LintContext& c, const Rule& rule, Reporter& r, const DecodedBlock& d) {
  const Block& block = *d.block;
  for (const Limit* limit : limits_of(*block.schema)) {
    if (limit->rule != id_text(rule.id)) continue;
    for (const Reading& at : readings_of(d, *limit)) {
      if (!applies(c, d, *limit, at)) continue;
      const bool placed = at.cell != nullptr && at.cell->span.valid();
      Diagnostic* found = r.report(rule, block, placed ? at.cell->span : block.header_span,
                                   message_of(d, *limit, at));
      if (found == nullptr) continue;
      const Severity theirs =
          limit->severity == Severity::info ? Severity::warning : limit->severity;
      found->reference = ReferenceMessage{limit->message, theirs};
      if (!limit->fix.empty()) found->help = limit->fix;
    }
  }
}

}  // namespace

std::span<const BlockChecked> limit_checks() {
  static constexpr BlockChecked all[] = {{RuleId::DK124, has_limits, check_limits},
                                         {RuleId::DK640, has_limits, check_limits},
                                         {RuleId::DK641, has_limits, check_limits},
                                         {RuleId::DK642, has_limits, check_limits}};
  return all;
}

}  // namespace deck::detail
