// Rules whose condition is a predicate of cells, as their pages say.
#include <map>
#include <stdexcept>

#include "lint/cell_rule.hpp"
#include "lint/check.hpp"

namespace deck::detail {
namespace {

using Op = Predicate::Op;

bool deck_has(const Model& model, std::string_view fact) {
  if (fact == "airbag") return model.has_monitored_volume;
  if (fact == "ale") return model.has_ale;
  if (fact == "sol2sph") return model.has_sol2sph;
  if (fact == "adaptive_mesh") return model.has_adaptive_mesh;
  return model.has_thermal_material;
}

double leaf(const LintContext& c, const ContactCard& card, const Predicate::Node& n) {
  switch (n.op) {
    case Op::input:
      return card.input(n.name);
    case Op::value:
      return card.value(n.name);
    case Op::flag:
      return static_cast<double>(card.flag(n.name));
    case Op::given:
      return card.given(n.name);
    case Op::has:
      return card.find(n.name) != nullptr;
    case Op::from_default: {
      const FieldView* f = card.find(n.name);
      return f != nullptr && f->origin == Origin::default_block;
    }
    case Op::deck:
      return deck_has(*c.model, n.name);
    default:
      return card.type;
  }
}

std::string message_of(const CellRule& rule, const ContactCard& card) {
  std::string out;
  for (const MessagePiece& p : pieces_of(rule.message)) {
    if (p.what.empty())
      out += p.field;
    else if (p.what == "name")
      out += name_of(card);
    else if (p.what == "show")
      out += card.show(p.field);
    else
      out += number_text(p.what == "input" ? card.input(p.field) : card.value(p.field));
  }
  return out;
}

/// Conditions of all rules that are data. The tests read every page, so a tested library never
/// throws here.
const std::map<RuleId, CellRule>& cell_rules() {
  static const std::map<RuleId, CellRule> all = [] {
    std::map<RuleId, CellRule> out;
    for (const Rule& rule : all_rules()) {
      if (rule.cells.empty()) continue;
      auto cells = CellRule::read(rule.cells);
      if (!cells)
        throw std::logic_error(std::string(id_text(rule.id)) + ": " + cells.error().message);
      out.emplace(rule.id, std::move(*cells));
    }
    return out;
  }();
  return all;
}

void check_cells(const LintContext& c, const Rule& rule, Reporter& r) {
  const CellRule& cells = cell_rules().at(rule.id);
  each(c, rule, [&](const ContactCard& card) {
    if (cells.when.evaluate([&](const Predicate::Node& n) { return leaf(c, card, n); }) == 0)
      return;
    Diagnostic* d = report_at(r, rule, card, cells.at, message_of(cells, card));
    for (const std::string& note : cells.notes) note_field(d, card, note);
    if (const auto& fix = cells.fix)
      fix_field(d, c, card, fix->field, fix->text, fix->safe, fix->title);
  });
}

}  // namespace

std::span<const Checked> cell_checks() {
  static const std::vector<Checked> all = [] {
    std::vector<Checked> out;
    for (const auto& [id, cells] : cell_rules()) out.push_back({id, check_cells});
    return out;
  }();
  return all;
}

}  // namespace deck::detail
