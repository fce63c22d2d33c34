// Evaluates the predicates of cells on rule pages.
#include <algorithm>

#include "lint/cell_rule.hpp"
#include "lint/check.hpp"
#include "lint/rule_pages.hpp"

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
  return has_block(c, "/SPHCEL");
}

bool in_working_units(const LintContext& c, const ContactCard& card) {
  const UnitSystem* units = c.deck.units_of(*card.block);
  return units == nullptr || *units == c.deck.begin.working;
}

/// True if a secondary node is on the main surface (TYPE7), or if a side is unknown.
bool share_nodes(const LintContext& c, const ContactCard& card) {
  const NodeSet* group = c.selections->node_group(card.id("grnd_IDs"));
  const auto main = c.selections->outline(card.id("surf_IDm"));
  if (group == nullptr || !main) return true;
  const std::vector<bool> on_main = nodes_of(*c.model, main->segments);
  return std::any_of(group->nodes.begin(), group->nodes.end(),
                     [&](NodeIndex n) { return n != no_index && on_main[n]; });
}

/// False if the two sides have no common node.
bool is_self_contact(const LintContext& c, const ContactCard& card) {
  const InterfaceTraits* const traits = traits_of(card.type);
  if (traits == nullptr) return true;
  const std::string_view one = traits->secondary.field, two = traits->main.field;
  if (!card.given(one) || !card.given(two)) return true;
  return card.type == 7 ? share_nodes(c, card) : card.input(one) == card.input(two);
}

/// Cells of a card for predicates; `at` is the field of the finding.
class CellReader {
 public:
  CellReader(const LintContext& c, const ContactCard& card, std::string_view at,
             std::size_t others = 0)
      : c_(c), card_(card), at_(at), others_(others) {}

  double value_of(const Predicate& p) const {
    return p.evaluate([&](const Predicate::Node& n) { return leaf(n); });
  }
  bool is_met(const Predicate& when) const { return value_of(when) != 0; }
  bool is_met(const std::optional<Predicate>& when) const { return !when || is_met(*when); }
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
      case Op::column:
        return f == nullptr || f->field == nullptr ? 0 : f->field->first;
      case Op::law: {
        const Friction* friction = c_.interfaces->friction(card_.id(name));
        return friction == nullptr ? 0 : static_cast<double>(friction->Ifric);
      }
      case Op::self_contact:
        return is_self_contact(c_, card_);
      case Op::others:
        return static_cast<double>(others_);
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
    if (p.what == "others") return std::to_string(others_);
    if (p.what == "=") return number_text(value_of(*Predicate::parse(p.field)));
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
  std::size_t others_;
};

void report_cell(const LintContext& c, const Rule& rule, Reporter& r, const CellRule::Case& one,
                 const ContactCard& card, const CellReader& reader) {
  const std::string_view at = reader.field(this_field);
  Finding& d = report_at(r, rule, card, at, reader.text_of(one.message));
  if (!is_friction(card))
    for (const std::string& note : one.notes) note_field(d, card, note);
  const auto& fix = one.fix;
  if (fix && reader.is_met(fix->when))
    fix_field(d, c, card, reader.field(fix->field), fix->text, fix->safe,
              reader.text_of(fix->title));
}

/// Reports each field of the card once, by the first true case.
void check_card(const LintContext& c, const Rule& rule, Reporter& r, const CellRule& cells,
                const ContactCard& card) {
  const bool of_types =
      std::find(rule.types.begin(), rule.types.end(), card.type) != rule.types.end();
  std::vector<std::string_view> reported;
  for (const CellRule::Case& one : cells.cases) {
    const bool wanted = of_types || one.all_interfaces;
    if (is_friction(card) ? !one.frictions : !one.interfaces || !wanted) continue;
    for (const std::string& at : one.at) {
      const CellReader reader(c, card, at);
      if (std::find(reported.begin(), reported.end(), at) != reported.end() ||
          !reader.is_met(cells.when) || !reader.is_met(one.when))
        continue;
      report_cell(c, rule, r, one, card, reader);
      reported.push_back(at);
      if (one.per_card) break;
    }
  }
}

/// Reports the first card for which the rule is true, with the number of others.
void check_deck(const LintContext& c, const Rule& rule, Reporter& r, const CellRule& cells) {
  const CellRule::Case& general = cells.cases.front();
  FirstCard first;
  std::string_view where;
  const auto test_card = [&](const ContactCard& card) {
    const auto at = std::find_if(
        general.at.begin(), general.at.end(),
        [&](const std::string& field) { return CellReader(c, card, field).is_met(cells.when); });
    if (at != general.at.end() && first.add(card)) where = *at;
  };
  for_each_contact(c, rule, test_card);
  if (general.frictions)
    for (const ContactCard& card : c.frictions) test_card(card);
  if (first.card == nullptr) return;
  const CellReader reader(c, *first.card, where, first.others);
  const auto one = std::find_if(cells.cases.begin(), cells.cases.end(),
                                [&](const CellRule::Case& k) { return reader.is_met(k.when); });
  if (one != cells.cases.end()) report_cell(c, rule, r, *one, *first.card, reader);
}

}  // namespace

void check_cells(const LintContext& c, const Rule& rule, Reporter& r) {
  const CellRule cells = *CellRule::read(rule.cells);
  if (cells.per_deck) return check_deck(c, rule, r, cells);
  for_each_card(c, [&](const ContactCard& card) { check_card(c, rule, r, cells, card); });
}

std::vector<Checked> cell_checks() {
  std::vector<Checked> out;
  for (const Rule& rule : all_rules())
    if (!rule.cells.empty() && !rule.cells.back().contains("keywords") && !is_team_rule(rule.id))
      out.push_back({rule.id, check_cells});
  return out;
}

}  // namespace deck::detail
