// Reads rule pages of the library and of a team; checks their fields against the keyword schemas.
#include "lint/rule_pages.hpp"

#include <algorithm>

#include "deck/model.hpp"
#include "lint/cell_rule.hpp"

namespace deck::detail {
namespace {

/// Checks a page; empty result: no problem.
class PageCheck {
 public:
  PageCheck(const RulePage& page, const FindSchema& find) : page_(page), find_(find) {
    for (const int type : page.rule.types) keywords_.push_back(interface_of(type));
  }
  static std::string interface_of(int type) { return "/INTER/TYPE" + std::to_string(type); }

  const Field* field_of(const std::string& keyword, std::string_view name) const {
    if (const Schema* schema = find_(keyword))
      for (const CardSchema& card : schema->cards)
        for (const Field& field : card.fields)
          if (field.name == name) return &field;
    return nullptr;
  }

  /// Problem in values with solver messages.
  std::string problem_of_limits(std::size_t of) const {
    const auto limits = Limit::read(page_.rule.id, page_.rule.cells[of]);
    if (!limits) return page_.problem("keywords", limits.error().message, of);
    for (const Limit& limit : *limits) {
      std::vector<std::string> names = limit.fields();
      names.push_back(limit.field);
      std::erase_if(names, [](const auto& name) { return name.empty() || name == this_field; });
      if (find_(limit.keyword) == nullptr)
        return page_.problem("keywords", "no keyword " + limit.keyword, of);
      for (const std::string& name : names)
        if (const Field* field = field_of(limit.keyword, name);
            field == nullptr || field->type == FieldType::text)
          return page_.problem("keywords", limit.keyword + " has no number " + name, of);
    }
    return {};
  }

  /// Problem in the predicate of the page (0) or of a case (1, 2, ...).
  std::string problem_of_cells(std::size_t of) const {
    std::vector<CellKeys> keys = {page_.rule.cells.front()};
    if (of > 0) keys.push_back(page_.rule.cells[of]);
    const auto read = CellRule::read(keys);
    if (!read) {
      const std::string& what = read.error().message;
      return page_.problem(what.substr(0, what.find(':')), what, of);
    }
    for (const std::string& name : read->fields())
      if (std::none_of(keywords_.begin(), keywords_.end(),
                       [&](const std::string& keyword) { return field_of(keyword, name); }))
        return page_.problem(key_with(name, of), "no interface of its types has a field " + name,
                             of);
    const CellRule::Case& one = read->cases.front();
    for (const std::string& name : one.at) {
      if (!page_.rule.fields.empty() && page_.rule.field(name) == nullptr)
        return page_.problem("at", "expected one of the 'fields' of the page, not " + name, of);
      for (const std::string& keyword : keywords_)
        if (one.fix &&
            !fits(one.fix->text,
                  field_of(keyword, one.fix->field == this_field ? name : one.fix->field)))
          return page_.problem("fix", "expected a text for the cell, not '" + one.fix->text + "'",
                               of);
    }
    return {};
  }

 private:
  static bool fits(const std::string& text, const Field* cell) {
    return cell == nullptr || text.empty() ||
           (text.size() <= static_cast<std::size_t>(cell->last - cell->first + 1) &&
            (cell->type == FieldType::text || read_real(text).status == NumberStatus::ok));
  }
  /// The key with a field name.
  std::string key_with(const std::string& name, std::size_t of) const {
    for (const std::size_t i : {of, std::size_t{0}})
      for (const auto& [key, value] : page_.rule.cells[i])
        if (value.find(name) != value.npos) return key;
    return "when";
  }

  const RulePage& page_;
  const FindSchema& find_;
  std::vector<std::string> keywords_ = {"/FRICTION"};
};

/// Completes a team page; `types`: all types with the first field of `at`.
void complete(Rule& rule, const CellRule& cells, const PageCheck& check, bool types) {
  if (rule.problem.empty()) rule.problem = rule.title;
  if (types)
    std::erase_if(rule.types, [&](int type) {
      return check.field_of(PageCheck::interface_of(type), cells.cases.front().at.front()) ==
             nullptr;
    });
  for (const CellRule::Case& one : cells.cases)
    if (one.fix && rule.fixable != Fixable::unsafe)
      rule.fixable = one.fix->safe ? Fixable::safe : Fixable::unsafe;
}

}  // namespace

Result<RulePage> read_rule_page(const std::string& path, std::string_view text,
                                const FindSchema& find) {
  RulePage page{path, {}, {}};
  auto read = parse_rule_page(path, text, &page.places);
  if (!read) return read.error();
  Rule& rule = page.rule = std::move(*read);
  if (rule.cells.empty()) return page;
  const bool team = is_team_rule(rule.id), all_types = team && rule.types.empty();
  for (const InterfaceTraits* traits : interface_types)
    if (all_types) rule.types.push_back(traits->type);
  const bool of_limits = rule.cells.back().contains("keywords");
  const auto whole = of_limits ? CellRule{} : CellRule::read(rule.cells);
  std::string problem;
  for (const int type : rule.types)
    if (traits_of(type) == nullptr)
      problem = page.problem("types", "expected types of interfaces that have rules");
  const PageCheck check(page, find);
  for (std::size_t i = rule.cells.size() > 1 ? 1 : 0; i < rule.cells.size() && problem.empty(); ++i)
    problem = of_limits ? check.problem_of_limits(i) : check.problem_of_cells(i);
  if (problem.empty() && !whole) problem = page.problem("when", whole.error().message);
  if (!problem.empty()) return Error{Error::Code::config, problem};
  if (team) complete(rule, *whole, check, all_types);
  return page;
}

}  // namespace deck::detail
