// Values of which the reference solver speaks: those with which it stops, those of which it warns,
// and those of which only some of its builds warn. They are cases on the pages of the rules.
#include <algorithm>
#include <map>
#include <stdexcept>

#include "lint/check.hpp"

namespace deck::detail {

const std::vector<Limit>& all_limits() {
  static const std::vector<Limit> limits = [] {
    std::vector<Limit> out;
    for (const Rule& rule : all_rules())
      for (const CellKeys& keys : rule.cells) {
        if (!keys.contains("keywords")) continue;
        auto some = Limit::read(rule.id, keys);
        if (!some)
          throw std::logic_error(std::string(id_text(rule.id)) + ": " + some.error().message);
        std::move(some->begin(), some->end(), std::back_inserter(out));
      }
    return out;
  }();
  return limits;
}

const std::vector<const Limit*>& limits_of(const Schema& schema) {
  using ByKeyword = std::map<std::string_view, std::vector<const Limit*>>;
  static const ByKeyword by_keyword = [] {
    ByKeyword out;
    for (const Limit& limit : all_limits()) out[limit.keyword].push_back(&limit);
    return out;
  }();
  static const std::vector<const Limit*> none;
  const auto it = by_keyword.find(schema.keyword);
  return it == by_keyword.end() ? none : it->second;
}

namespace {

/// Where a number was read, and what it is.
struct Reading {
  const DecodedCard* card = nullptr;  ///< nullptr: the line is not there
  const Cell* cell = nullptr;
  double value = 0;
};

double number_in(const Cell* cell) { return cell == nullptr ? 0 : number_of(*cell); }

/// The cell of that name that goes with a line: on it, in its round, or where nothing repeats.
const Cell* cell_beside(const DecodedBlock& d, const DecodedCard* line, std::string_view field) {
  if (line == nullptr) return d.find(field);
  if (const Cell* cell = cell_of(*line, field)) return cell;
  for (const int round : {line->round, 0})
    for (const DecodedCard& card : d.cards)
      if (card.round == round)
        if (const Cell* cell = cell_of(card, field)) return cell;
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
  if (limit.field.empty()) return {Reading{}};
  for (const DecodedCard& card : d.cards)
    for (const Cell& cell : card.cells)
      if (cell.field->name == limit.field) out.push_back({&card, &cell, number_in(&cell)});
  if (out.empty() && always_there(d, limit.field)) out.emplace_back();
  if (limit.sum && !out.empty()) {
    for (std::size_t i = 1; i < out.size(); ++i) out.front().value += out[i].value;
    out.resize(1);
  }
  return out;
}

/// A parameter that could not be replaced reads as 0 and says nothing.
bool known(const Reading& r) { return r.cell == nullptr || !r.cell->parameter || r.value != 0; }

/// "c = 0.1 and F_cut = 0": the cells that make the value what it is.
std::string circumstances(const DecodedBlock& d, const Limit& limit, const DecodedCard* card) {
  std::string out;
  for (const std::string& field : limit.fields())
    if (const Cell* cell = field == this_field ? nullptr : cell_beside(d, card, field))
      out += fmt::format("{}{} = {}", out.empty() ? "" : ", ", field, number_text(number_in(cell)));
  return out;
}

std::string message_of(const DecodedBlock& d, const Limit& limit, const Reading& at) {
  const std::string name = name_of(d);
  if (limit.field.empty()) return name + ": " + limit.says;
  const bool blank = at.cell == nullptr || at.cell->blank();
  std::string out =
      fmt::format("{}{} of {} is {}", limit.sum ? "the sum of " : "", limit.field, name,
                  limit.sum ? number_text(at.value)
                  : blank   ? std::string("blank")
                            : clipped(at.cell->text));
  if (const std::string also = circumstances(d, limit, at.card); !also.empty())
    out += ", with " + also;
  if (limit.message.severity == Severity::error)
    out += "; legal: " + (limit.not_a.empty() ? limit.legal : "a " + limit.not_a);
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
  if (!known(at)) return false;
  if (!limit.not_a.empty() && !is_other_kind(c, *d.block, limit, at.cell)) return false;
  return !limit.when || limit.when->evaluate([&](const Predicate::Node& n) {
    return n.name == this_field ? at.value : number_in(cell_beside(d, at.card, n.name));
  }) != 0;
}

bool has_limits(const Rule& rule, const Schema& schema) {
  const auto& limits = limits_of(schema);
  return std::any_of(limits.begin(), limits.end(),
                     [&](const Limit* limit) { return limit->rule == rule.id; });
}

void check_limits(const LintContext& c, const Rule& rule, Reporter& r, const DecodedBlock& d) {
  for (const Limit* limit : limits_of(*d.block->schema)) {
    if (limit->rule != rule.id) continue;
    for (const Reading& at : readings_of(d, *limit)) {
      if (!applies(c, d, *limit, at)) continue;
      Diagnostic& found = r.report(rule, *d.block, place_of(d, at.cell), message_of(d, *limit, at));
      found.reference = limit->message;
      if (!limit->fix.empty()) found.help = limit->fix;
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
