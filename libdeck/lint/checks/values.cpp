// Illegal values.
//
// Numbers: signs and limits from their meaning. Flags: the schemas have the legal values, so a rule
// covers all keywords and versions with the flag; some values have their own rule and message.
// Keywords without rules, such as those of users' schemas: all values against the schema.
// Combinations on one card that need the mesh or the solver's arithmetic (other combinations are
// data, see cells.cpp). Values with a solver message: cases on the rule pages.
#include <algorithm>
#include <map>
#include <numbers>
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

/// A number and its place.
struct Reading {
  const DecodedCard* card = nullptr;  ///< nullptr: missing line
  const Cell* cell = nullptr;
  double value = 0;
};

double number_in(const Cell* cell) { return cell == nullptr ? 0 : number_of(*cell); }

/// True if the solver reads the cell; a missing line then counts as blank.
bool is_read(const DecodedBlock& d, std::string_view field) {
  const auto are_met = [&](const std::vector<Condition>& when) {
    return std::all_of(when.begin(), when.end(), [&](const Condition& c) {
      return c.field != Condition::data_lines && c.accepts(d.integer(c.field));
    });
  };
  for (const CardSchema& card : d.block->schema->cards)
    for (const Field& f : card.fields)
      if (f.name == field && card.in_version(d.block->version) && f.in_version(d.block->version) &&
          are_met(card.when) && are_met(f.when) && card.repeat == Repeat::once)
        return true;
  return false;
}

std::vector<Reading> readings_of(const DecodedBlock& d, const Limit& limit) {
  std::vector<Reading> out;
  if (limit.field.empty()) return {Reading{}};
  for (const DecodedCard& card : d.cards)
    for (const Cell& cell : card.cells)
      if (cell.field->name == limit.field) out.push_back({&card, &cell, number_in(&cell)});
  if (out.empty() && is_read(d, limit.field)) out.emplace_back();
  if (limit.sum && !out.empty()) {
    for (std::size_t i = 1; i < out.size(); ++i) out.front().value += out[i].value;
    out.resize(1);
  }
  return out;
}

/// An unresolved parameter reads as 0 and cannot be judged.
bool known(const Reading& r) { return r.cell == nullptr || !r.cell->parameter || r.value != 0; }

/// "c = 0.1 and F_cut = 0": the cells in the condition.
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

/// True if the id exists only for entities of other keywords.
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
    return n.op == Predicate::Op::version ? d.block->version
           : n.name == this_field         ? at.value
                                          : number_in(cell_beside(d, at.card, n.name));
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
      Finding& found = r.report(rule, *d.block, place_of(d, at.cell), message_of(d, *limit, at));
      found.reference = limit->message;
      if (!limit->fix.empty()) found.help = limit->fix;
    }
  }
}

void check_sign(const LintContext& c, const Rule& rule, Reporter& r) {
  for_each_card(c, [&](const ContactCard& card) {
    for_each_cell(card.decoded, [&](const DecodedCard&, const Cell& cell) {
      const std::string& field = cell.field->name;
      if (cell.blank() || !(number_of(cell) < 0) || rule.field(field) == nullptr) return;
      r.report(rule, field, *card.block, cell.span,
               fmt::format("{} of {} is negative: {}", field, name_of(card), cell.text));
    });
  });
}

/// The flags of a rule: its fields, or that of its key `flag`.
bool is_about(const Rule& rule, const std::string& field) {
  return rule.field(field) != nullptr || rule.lists("flag", field);
}

/// True for values with their own rule: "/INTER/TYPE19 Istf 6", "/INTER/TYPE19 Iedge" (all).
bool is_excepted(const Rule& rule, std::string_view keyword, std::string_view field,
                 std::int64_t value) {
  const std::string all = fmt::format("{} {}", keyword, field);
  return rule.lists("except", all) || rule.lists("except", fmt::format("{} {}", all, value));
}

void add_doc(Finding& d, const Field& f) {
  if (!f.doc.empty()) d.help += " " + f.name + ": " + f.doc + ".";
}

/// `only`: the only field to check; empty: all.
void check_block(const Rule& rule, const DecodedBlock& block, Reporter& r,
                 std::string_view only = {}) {
  for_each_illegal_flag(block, [&](const Cell& cell) {
    const Field& f = *cell.field;
    if (!is_about(rule, f.name) || (!only.empty() && f.name != only) ||
        is_excepted(rule, block.block->schema->keyword, f.name, cell.integer))
      return;
    add_doc(r.report(rule, f.name, *block.block, cell.span,
                     fmt::format("{} of {} is {}; legal values are {}", f.name, name_of(block),
                                 cell.integer, list_of(f.values))),
            f);
  });
}

void check_flag(const LintContext& c, const Rule& rule, Reporter& r) {
  for_each_card(c, [&](const ContactCard& card) { check_block(rule, card.decoded, r); });
  // Iedge is read from /DEFAULT only; DK505 checks the other flags of defaults.
  for (const DecodedBlock& block : c.defaults) check_block(rule, block, r, "Iedge");
}

void check_ibc(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const ContactCard& card : c.contacts)
    for (const std::string_view name : {"IBCX", "IBCY", "IBCZ"}) {
      const Cell* cell = card.decoded.find(name);
      if (cell == nullptr || cell->blank() || cell->text == "0" || cell->text == "1") continue;
      Finding& d = r.report(rule, *card.block, cell->span,
                            fmt::format("column {} ({}) of {} holds '{}'; only 1 has an effect",
                                        cell->field->first, name, name_of(card), cell->text));
      d.fix = Fix{"write 0", true, {{cell->span, "0"}}};
    }
}

/// True if the two nodes of the axis are one node or at one place.
bool axis_is_a_point(const LintContext& c, const ContactCard& card) {
  if (card.value("node_ID1") == card.value("node_ID2")) return true;
  const auto place = [&](std::string_view field) { return c.model->find_node(card.id(field)); };
  const NodeIndex a = place("node_ID1"), b = place("node_ID2");
  if (a == no_index || b == no_index) return false;
  const auto& x = c.model->nodes;
  return x.x[a] == x.x[b] && x.y[a] == x.y[b] && x.z[a] == x.z[b];
}

void check_curvature_nodes(const LintContext& c, const Rule& rule, Reporter& r) {
  for_each_contact(c, rule, [&](const ContactCard& card) {
    const auto icurv = card.flag("Icurv");
    const bool first = card.given("node_ID1"), second = card.given("node_ID2");
    if (icurv == 2 && first && second && axis_is_a_point(c, card)) {
      note_field(report_at(r, rule, card, "node_ID2",
                           fmt::format("{}: Icurv = 2, but node_ID1 and node_ID2 are at one place: "
                                       "the axis has no direction",
                                       name_of(card))),
                 card, "node_ID1");
      return;
    }
    if ((icurv != 1 && icurv != 2) || (first && (icurv == 1 || second))) return;
    Finding& d = report_at(
        r, rule, card, first ? "node_ID2" : "node_ID1",
        icurv == 1 ? name_of(card) + ": Icurv = 1 needs node_ID1, the centre of the sphere"
                   : name_of(card) + ": Icurv = 2 needs node_ID1 and node_ID2 on the axis");
    d.reference = rule.message(icurv == 1 ? 1727 : 1728);
    note_field(d, card, "Icurv");
  });
}

/// The solver's filter factor of Xfreq.
double filter_factor(std::int64_t ifiltr, double xfreq) {
  constexpr double two_pi = 2 * std::numbers::pi;
  if (ifiltr == 1) return xfreq;
  return ifiltr == 2 ? two_pi / xfreq : two_pi * xfreq;
}

std::string filter_problem(std::int64_t ifiltr, double xfreq) {
  if (ifiltr < 1 || ifiltr > 3 || xfreq == 0) return {};
  const double alpha = filter_factor(ifiltr, xfreq);
  if (alpha < 0) return "the filter factor is negative: " + number_text(alpha);
  if (alpha > 1 && ifiltr <= 2)
    return "the filter factor is " + number_text(alpha) + "; it must be at most 1";
  return {};
}

void check_filter(const LintContext& c, const Rule& rule, Reporter& r) {
  const auto check = [&](const ContactCard& card, double xfreq) {
    if (card.given("fric_ID")) return;
    const std::string problem =
        filter_problem(static_cast<std::int64_t>(card.input("Ifiltr")), xfreq);
    if (problem.empty()) return;
    Finding& d = report_at(r, rule, card, "Xfreq", name_of(card) + ": " + problem);
    if (is_friction(card))
      d.reference = rule.message(1591);
    else
      note_field(d, card, "Ifiltr");
  };
  for_each_contact(c, rule, [&](const ContactCard& card) { check(card, card.input("Xfreq")); });
  for (const ContactCard& friction : c.frictions)
    if (const Cell* cell = friction.decoded.find("Xfreq"); cell != nullptr)
      check(friction, working_value(c.deck, friction.decoded, *cell));
}

void check_angles(const LintContext& c, const Rule& rule, Reporter& r) {
  for_each_contact(c, rule, [&](const ContactCard& card) {
    if (!card.given("fric_ID")) return;
    const Friction* f = c.interfaces->friction(card.id("fric_ID"));
    if (f == nullptr || f->Ifric == 0) return;
    Finding& d =
        report_at(r, rule, card, "fric_ID",
                  fmt::format("{} uses /FRICTION {} with Ifric = {}, a law that edge contact lacks",
                              name_of(card), f->id, f->Ifric));
    d.notes.emplace_back(f->span, "the friction is defined here");
  });
}

bool bounded(const Field& f) { return !f.values.empty() || f.min || f.max; }

/// Contacts, defaults and frictions have a rule for every field.
bool has_own_rules(const Schema& s) {
  if (s.keyword.ends_with("/INTER/TYPE24")) return false;  // rules of flags exclude it
  return s.kind == "inter" || s.kind == "friction" || s.keyword.starts_with("/DEFAULT/INTER");
}

bool within(const Field& f, double value) {
  if (f.min && (value < *f.min || (f.min_open && value == *f.min))) return false;
  return !f.max || !(value > *f.max || (f.max_open && value == *f.max));
}

std::string range_of(const Field& f) {
  const auto bound = [](double v, bool open, std::string_view word) {
    return fmt::format("{} {}{}", word, number_text(v), open ? " (not itself)" : "");
  };
  std::string out;
  if (f.min) out = bound(*f.min, f.min_open, "from");
  if (f.max) out += (out.empty() ? "" : " ") + bound(*f.max, f.max_open, "up to");
  return out;
}

/// Legal values, if the cell is illegal; else empty.
std::string legal_instead(const Cell& cell) {
  const Field& f = *cell.field;
  if (cell.status != NumberStatus::ok && cell.status != NumberStatus::implicit_exponent) return {};
  const double value = number_of(cell);
  if (value == 0) return {};  // 0 and blank are the default
  if (!within(f, value)) return range_of(f);
  if (f.type == FieldType::real || is_legal(f, cell.integer)) return {};
  return list_of(f.values);
}

/// True if the solver has a message for this value, which another rule reports.
bool solver_speaks(const Schema& schema, const Cell& cell) {
  const auto value = [&](const Predicate::Node&) { return number_of(cell); };
  const auto& limits = limits_of(schema);
  return std::any_of(limits.begin(), limits.end(), [&](const Limit* limit) {
    const auto fields = limit->fields();
    const bool alone = std::all_of(fields.begin(), fields.end(),
                                   [](const std::string& f) { return f == this_field; });
    return limit->field == cell.field->name && alone && !limit->sum && limit->when &&
           limit->when->evaluate(value) != 0;
  });
}

bool has_bounds(const Rule&, const Schema& schema) {
  return !has_own_rules(schema) &&
         std::any_of(schema.cards.begin(), schema.cards.end(), [](const CardSchema& card) {
           return std::any_of(card.fields.begin(), card.fields.end(), bounded);
         });
}

void check_bounds(const LintContext&, const Rule& rule, Reporter& r, const DecodedBlock& d) {
  for_each_cell(d, [&](const DecodedCard&, const Cell& cell) {
    if (cell.field == nullptr || !bounded(*cell.field)) return;
    const std::string legal = legal_instead(cell);
    if (legal.empty() || solver_speaks(*d.block->schema, cell)) return;
    add_doc(r.report(rule, *d.block, cell.span,
                     fmt::format("{} of {} is {}; legal: {}", cell.field->name, name_of(d),
                                 clipped(cell.text), legal)),
            *cell.field);
  });
}

}  // namespace

std::vector<Checked> value_checks() {
  return {{RuleId::DK221, check_sign},
          {RuleId::DK201, check_flag},
          {RuleId::DK217, check_ibc},
          {RuleId::DK352, check_flag},
          {RuleId::DK353, check_flag},
          {RuleId::DK354, check_flag},
          {RuleId::DK355, check_flag},
          {RuleId::DK356, check_flag},
          {RuleId::DK253, check_curvature_nodes},
          {RuleId::DK260, check_filter},
          {RuleId::DK264, check_angles}};
}

std::span<const BlockChecked> all_block_checks() {
  static constexpr BlockChecked all[] = {{RuleId::DK096, has_bounds, check_bounds},
                                         {RuleId::DK124, has_limits, check_limits},
                                         {RuleId::DK640, has_limits, check_limits},
                                         {RuleId::DK641, has_limits, check_limits},
                                         {RuleId::DK642, has_limits, check_limits}};
  return all;
}

}  // namespace deck::detail
