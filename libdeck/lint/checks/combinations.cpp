// Fields that contradict one another. Each check is one rule.
#include <array>
#include <cmath>
#include <numbers>

#include "lint/check.hpp"

namespace deck::detail {
namespace {

/// What a Renard curve needs: 0 < C5 < C6, C4 < C1 < C3 and C4 < C2 < C3. Empty: fine.
std::string renard_problem(const std::array<double, 6>& k) {
  const double cs = k[0], cd = k[1], cmax = k[2], cmin = k[3], v1 = k[4], v2 = k[5];
  if (!(v1 > 0)) return "C5, the first critical speed, must be above 0";
  if (!(v2 > v1)) return "C6, the second critical speed, must be above C5";
  if (!(cmin < cs) || !(cs < cmax))
    return "C1 (static) must lie between C4 (least) and C3 (largest)";
  if (!(cmin < cd) || !(cd < cmax))
    return "C2 (dynamic) must lie between C4 (least) and C3 (largest)";
  return {};
}

void check_renard(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.input("Ifric") != 3 || card.given("fric_ID")) return;
    const std::array<double, 6> k = {card.input("C1"), card.input("C2"), card.input("C3"),
                                     card.input("C4"), card.input("C5"), card.input("C6")};
    if (const std::string problem = renard_problem(k); !problem.empty())
      note_field(report_at(r, rule, card, "C1", name_of(card) + ": " + problem), card, "Ifric");
  });
  for (const DecodedBlock& block : c.frictions) {
    if (block.integer("Ifric") != 3) continue;
    const std::array<double, 6> k = {block.real("C1"), block.real("C2"), block.real("C3"),
                                     block.real("C4"), block.real("C5"), block.real("C6")};
    const Cell* at = block.find("C1");
    if (const std::string problem = renard_problem(k); !problem.empty())
      r.report(rule, *block.block, at ? at->span : block.span(), name_of(block) + ": " + problem);
  }
}

void check_heat_sum(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    const double sum = card.input("Fheats") + card.input("Fheatm");
    if (!(sum > 1)) return;
    Diagnostic* d = report_at(
        r, rule, card, "Fheats",
        fmt::format("Fheats + Fheatm of {} is {}, more than 1", name_of(card), number_text(sum)));
    note_field(d, card, "Fheatm");
  });
}

/// The two nodes of the axis are one node, or stand at the same place.
bool axis_is_a_point(const LintContext& c, const ContactCard& card) {
  if (card.value("node_ID1") == card.value("node_ID2")) return true;
  const auto place = [&](std::string_view field) { return c.model->find_node(card.id(field)); };
  const NodeIndex a = place("node_ID1"), b = place("node_ID2");
  if (a == no_index || b == no_index) return false;
  const auto& x = c.model->nodes;
  return x.x[a] == x.x[b] && x.y[a] == x.y[b] && x.z[a] == x.z[b];
}

void check_curvature_nodes(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
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
    Diagnostic* d = report_at(
        r, rule, card, first ? "node_ID2" : "node_ID1",
        icurv == 1 ? name_of(card) + ": Icurv = 1 needs node_ID1, the centre of the sphere"
                   : name_of(card) + ": Icurv = 2 needs node_ID1 and node_ID2 on the axis");
    if (d != nullptr) {
      d->reference = rule.message(icurv == 1 ? 1727 : 1728);
      note_field(d, card, "Icurv");
    }
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
  each(c, rule, [&](const ContactCard& card) {
    if (card.given("fric_ID")) return;
    const std::string problem =
        filter_problem(static_cast<std::int64_t>(card.input("Ifiltr")), card.input("Xfreq"));
    if (!problem.empty())
      note_field(report_at(r, rule, card, "Xfreq", name_of(card) + ": " + problem), card, "Ifiltr");
  });
  for (const DecodedBlock& block : c.frictions) {
    const Cell* cell = block.find("Xfreq");
    if (cell == nullptr) continue;
    const std::string problem =
        filter_problem(block.integer("Ifiltr"), working_value(c.deck, block, *cell));
    if (problem.empty()) continue;
    Diagnostic* d = r.report(rule, *block.block, cell->span, name_of(block) + ": " + problem);
    if (d != nullptr) d->reference = rule.message(1591);
  }
}

void check_angles(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (!card.given("fric_ID")) return;
    const Friction* f = c.interfaces->friction(card.id("fric_ID"));
    if (f == nullptr || f->Ifric == 0) return;
    Diagnostic* d = report_at(
        r, rule, card, "fric_ID",
        fmt::format("{} uses /FRICTION {} with Ifric = {}", name_of(card), f->id, f->Ifric));
    if (d != nullptr) d->notes.emplace_back(f->span, "the friction is defined here");
  });
}

}  // namespace

std::span<const Checked> combination_checks() {
  static constexpr Checked all[] = {
      {RuleId::DK250, check_renard},          {RuleId::DK251, check_heat_sum},
      {RuleId::DK253, check_curvature_nodes}, {RuleId::DK260, check_filter},
      {RuleId::DK264, check_angles},
  };
  return all;
}

}  // namespace deck::detail
