// Rules whose condition is a predicate of cells, as their pages say.
#include <algorithm>
#include <map>
#include <stdexcept>

#include "lint/cell_rule.hpp"
#include "lint/check.hpp"

namespace deck::detail {
namespace {

using Op = Predicate::Op;

bool deck_has(const LintContext& c, std::string_view fact) {
  const Model& model = *c.model;
  if (fact == "airbag") return model.has_monitored_volume;
  if (fact == "ale") return model.has_ale;
  if (fact == "sol2sph") return model.has_sol2sph;
  if (fact == "adaptive_mesh") return model.has_adaptive_mesh;
  if (fact == "thermal_material") return model.has_thermal_material;
  return std::any_of(c.deck.blocks.begin(), c.deck.blocks.end(),
                     [](const Block& b) { return b.header.starts_with("/SPHCEL"); });
}

bool in_working_units(const LintContext& c, const ContactCard& card) {
  const UnitSystem* units = c.deck.units_of(*card.block);
  return units == nullptr || *units == c.deck.begin.working;
}

/// Cells of a card as a rule asks for them; `at` is the field that a finding is about.
class CellReader {
 public:
  CellReader(const LintContext& c, const ContactCard& card, std::string_view at)
      : c_(c), card_(card), at_(at) {}

  bool holds(const Predicate& when) const {
    return when.evaluate([&](const Predicate::Node& n) { return leaf(n); }) != 0;
  }
  std::string_view field(std::string_view name) const { return name == this_field ? at_ : name; }
  std::string text_of(std::string_view message) const {
    std::string out;
    for (const MessagePiece& p : pieces_of(message)) out += piece(p);
    return out;
  }

 private:
  double leaf(const Predicate::Node& n) const {
    const std::string_view name = field(n.name);
    const FieldView* const f = card_.find(name);
    switch (n.op) {
      case Op::input:
        return card_.input(name);
      case Op::value:
        return card_.value(name);
      case Op::flag:
        return static_cast<double>(card_.flag(name));
      case Op::given:
        return card_.given(name);
      case Op::bounds:
        return card_.bounds(name);
      case Op::written:
        return f == nullptr || f->text.empty() ? 0 : read_real(f->text).value;
      case Op::has:
        return f != nullptr;
      case Op::exists:
        return f != nullptr && f->field != nullptr &&
               target_exists(c_, f->field->ref, static_cast<std::int64_t>(f->input)).value_or(true);
      case Op::from_default:
        return f != nullptr && f->origin == Origin::default_block;
      case Op::deck:
        return deck_has(c_, name);
      case Op::version:
        return card_.block->version;
      case Op::working_units:
        return in_working_units(c_, card_);
      default:
        return card_.type;
    }
  }

  std::string piece(const MessagePiece& p) const {
    if (p.what.empty()) return std::string(p.field);
    if (p.what == "name") return name_of(card_);
    if (p.what == this_field) return std::string(at_);
    const std::string_view name = field(p.field);
    if (p.what == "show") return card_.show(name);
    if (p.what == "input") return number_text(card_.input(name));
    if (p.what == "value") return number_text(card_.value(name));
    const FieldView* const f = card_.find(name);
    return f != nullptr ? std::string(f->text) : std::string();
  }

  const LintContext& c_;
  const ContactCard& card_;
  std::string_view at_;
};

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
  const auto check = [&](const ContactCard& card) {
    for (const std::string& at : cells.at) {
      const CellReader reader(c, card, at);
      if (!reader.holds(cells.when)) continue;
      Diagnostic* d = report_at(r, rule, card, at, reader.text_of(cells.message));
      for (const std::string& note : cells.notes) note_field(d, card, note);
      const auto& fix = cells.fix;
      if (fix && (!fix->when || reader.holds(*fix->when)))
        fix_field(d, c, card, reader.field(fix->field), fix->text, fix->safe,
                  reader.text_of(fix->title));
    }
  };
  if (cells.all_interfaces)
    for (const ContactCard& card : c.contacts) check(card);
  else
    each(c, rule, check);
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
