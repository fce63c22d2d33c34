// Values of which the reference solver speaks: those with which it stops, those of which it warns,
// and those of which only some of its builds warn. The embedded table of limits is checked against
// its JSON schema and the keyword schemas by tests, not here.
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "base/shared/embedded.hpp"
#include "lint/check.hpp"

namespace deck::detail {
namespace {

using Json = nlohmann::json;

NumberTest test_of(const Json& json, std::string field) {
  NumberTest out;
  out.field = std::move(field);
  const auto bound = [&](const char* key) {
    const auto it = json.find(key);
    return it == json.end() ? std::nullopt : std::optional(it->get<double>());
  };
  out.is = json.value("is", std::vector<double>());
  out.is_not = json.value("is_not", std::vector<double>());
  out.above = bound("above");
  out.below = bound("below");
  out.at_least = bound("at_least");
  out.at_most = bound("at_most");
  return out;
}

Limit limit_of(const Json& json, std::string keyword, std::string field) {
  Limit out;
  out.keyword = std::move(keyword);
  out.of = test_of(json, std::move(field));
  out.sum = json.value("sum", false);
  out.not_a = json.value("not_a", "");
  if (const auto when = json.find("when"); when != json.end())
    for (const Json& test : *when) out.when.push_back(test_of(test, test.value("field", "")));
  const bool error = json.contains("error"), warning = json.contains("warning");
  out.severity = error ? Severity::error : warning ? Severity::warning : Severity::info;
  out.message = json.value(error ? "error" : warning ? "warning" : "info", 0);
  const RuleId general = error ? RuleId::DK640 : warning ? RuleId::DK641 : RuleId::DK642;
  out.rule = json.value("rule", std::string(id_text(general)));
  out.says = json.value("says", "");
  out.fix = json.value("fix", "");
  out.known_from = json.value("known_from", "");
  return out;
}

}  // namespace

bool NumberTest::holds(double value) const {
  if (!is.empty() && std::find(is.begin(), is.end(), value) == is.end()) return false;
  if (std::find(is_not.begin(), is_not.end(), value) != is_not.end()) return false;
  return (!above || value > *above) && (!below || value < *below) &&
         (!at_least || value >= *at_least) && (!at_most || value <= *at_most);
}

const std::vector<Limit>& all_limits() {
  static const std::vector<Limit> limits = [] {
    std::vector<Limit> out;
    for (const EmbeddedFile& file : embedded_limits()) {
      const Json json = Json::parse(file.text);
      for (const Json& entry : json.at("limits"))
        for (const Json& keyword : entry.at("keywords"))
          for (const Json& field : entry.value("of", Json::array({""})))
            out.push_back(limit_of(entry, keyword.get<std::string>(), field.get<std::string>()));
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
  const std::string name = name_of(d);
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
  for (const Limit* limit : limits_of(*d.block->schema)) {
    if (limit->rule != id_text(rule.id)) continue;
    for (const Reading& at : readings_of(d, *limit)) {
      if (!applies(c, d, *limit, at)) continue;
      Diagnostic* found = r.report(rule, *d.block, place_of(d, at.cell), message_of(d, *limit, at));
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
