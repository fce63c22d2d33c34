// What belongs beside a contact: edges that TYPE7 does not see, the recommended friction, radiation
// factors that emissivities can give. One finding per deck or per interface, never per element.
#include <algorithm>
#include <cmath>
#include <vector>

#include "lint/check.hpp"
#include "lint/rule_tables.hpp"

namespace deck::detail {
namespace {

/// The sides of a surface's segments, each as (smaller node, larger node), sorted.
std::vector<std::pair<NodeIndex, NodeIndex>> sides_of(const Surface& surface) {
  std::vector<std::pair<NodeIndex, NodeIndex>> out;
  out.reserve(4 * surface.segments.size());
  for (const Segment& s : surface.segments)
    for (std::size_t k = 0; k < 4; ++k) {
      const NodeIndex a = s.nodes[k], b = s.nodes[(k + 1) % 4];
      if (a != b && a != no_index && b != no_index) out.push_back(std::minmax(a, b));
    }
  std::sort(out.begin(), out.end());
  return out;
}

/// Sides that belong to one segment only: the border of the surface.
std::size_t count_free_edges(const Surface& surface) {
  const auto sides = sides_of(surface);
  std::size_t count = 0;
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t j = i + 1;
    while (j < sides.size() && sides[j] == sides[i]) ++j;
    count += j - i == 1;
    i = j;
  }
  return count;
}

void check_edge_companion(const LintContext& c, const Rule& rule, Reporter& r) {
  if (c.selections == nullptr) return;
  bool edges_seen = false;
  each(c, {11, 19}, [&](const ContactCard&) { edges_seen = true; });
  if (edges_seen) return;
  const ContactCard* first = nullptr;
  std::size_t interfaces = 0, free = 0;
  each(c, {7}, [&](const ContactCard& card) {
    const Surface* s = c.selections->surface(static_cast<std::int64_t>(card.value("surf_IDm")));
    const std::size_t n = s == nullptr ? 0 : count_free_edges(*s);
    if (n == 0) return;
    if (first == nullptr) {
      first = &card;
      free = n;
    }
    ++interfaces;
  });
  if (first == nullptr) return;
  report_at(r, rule, *first, "surf_IDm",
            fmt::format("the main surface of {} has {} free edge{}{}, and no interface of the deck "
                        "sees edges (TYPE11, TYPE19)",
                        name_of(*first), free, free == 1 ? "" : "s",
                        interfaces == 1 ? ""
                                        : fmt::format(" (as have those of {} more interfaces)",
                                                      interfaces - 1)));
}

void check_formulation(const LintContext& c, const Rule& rule, Reporter& r) {
  const ContactCard* first = nullptr;
  std::size_t interfaces = 0;
  each(c, {7, 11, 19}, [&](const ContactCard& card) {
    if (card.given("fric_ID") || !(card.given("Fric") || card.given("Ifric"))) return;
    if (card.find("Iform") == nullptr || card.flag("Iform") == 2) return;
    if (first == nullptr) first = &card;
    ++interfaces;
  });
  if (first == nullptr) return;
  report_at(
      r, rule, *first, "Iform",
      fmt::format("{}{} {} friction with Iform 1, the viscous formulation", name_of(*first),
                  interfaces == 1 ? "" : fmt::format(" and {} more interfaces", interfaces - 1),
                  interfaces == 1 ? "has" : "have"));
}

/// Stefan-Boltzmann constant, W/(m2 K4) (CODATA 2018, exact).
constexpr double stefan_boltzmann = 5.670374419e-8;

void check_radiation_factor(const LintContext& c, const Rule& rule, Reporter& r) {
  if (!c.deck.begin.has_working && !c.deck.begin.has_input) return;  // units unknown
  const UnitSystem& u = c.deck.begin.has_working ? c.deck.begin.working : c.deck.begin.input;
  // M T^-3 per kelvin^4: so many kg/s3 are one unit of the deck.
  const double sigma = stefan_boltzmann / (u.mass / (u.time * u.time * u.time));
  if (!std::isfinite(sigma) || !(sigma > 0)) return;
  each(c, {7, 11, 19}, [&](const ContactCard& card) {
    const double frad = card.value("Frad");
    if (card.input("Ithe") != 1 || !(frad > 0)) return;
    // 1 / (1/e1 + 1/e2 - 1) is at most 1, and above 1e-3 for any surface that people make.
    if (frad <= sigma * (1 + 1e-6) && frad >= 1e-3 * sigma) return;
    report_at(r, rule, card, "Frad",
              fmt::format("{}: Frad = {} is {} what two surfaces can radiate: the "
                          "Stefan-Boltzmann constant is {:.6g} in the units of the deck",
                          name_of(card), number_text(frad),
                          frad > sigma ? "more than" : "far below", sigma));
  });
}

}  // namespace

void add_companion_rules(std::vector<Rule>& out) {
  out.push_back({.id = "DK916",
                 .title = "free edges that no interface sees",
                 .severity = Severity::info,
                 .problem = "The deck has TYPE7 interfaces on surfaces with free edges, and no "
                            "TYPE11 or TYPE19.",
                 .why = "TYPE7 holds nodes off segments. Two edges that cross between their nodes "
                        "are not seen: sheets cut into one another at their borders. TYPE11 "
                        "beside TYPE7 sees edges; TYPE19 is both in one.",
                 .solver = "it computes node-to-surface contact only",
                 .fix = "add a TYPE11 for the borders, or use TYPE19",
                 .ignore = "When borders cannot meet.",
                 .bad = "@/INTER/TYPE7/1\n",
                 .good = "@/INTER/TYPE7/1\n@/INTER/TYPE11/2\n",
                 .check = check_edge_companion});
  out.push_back({.id = "DK918",
                 .title = "viscous friction where the incremental one is recommended",
                 .severity = Severity::info,
                 .problem = "Friction is computed with Iform 1 (TYPE7, TYPE11, TYPE19).",
                 .why = "Iform 1 is a damper with a limit: under a constant load things creep, and "
                        "the force depends on the time step. Iform 2 sticks with a stiffness. "
                        "Manuals recommend it for explicit and implicit runs.",
                 .solver = "it computes with Iform 1, its default",
                 .fix = "write Iform 2, or set it in /DEFAULT/INTER",
                 .ignore = "When results must stay comparable with earlier runs.",
                 .bad = "@/INTER/TYPE7/1 Fric=0.2\n",
                 .good = "@/INTER/TYPE7/1 Fric=0.2 Iform=2\n",
                 .check = check_formulation});
  out.push_back({.id = "DK919",
                 .title = "radiation factor that no pair of surfaces has",
                 .severity = Severity::warning,
                 .problem = "Frad is above the Stefan-Boltzmann constant, or below a thousandth of "
                            "it (TYPE7, TYPE11, TYPE19).",
                 .why = "Between two surfaces of emissivities e1 and e2 it is sigma / (1/e1 + 1/e2 "
                        "- 1), with sigma = 5.670374e-8 W/(m2 K4) in the units of the deck "
                        "(mass / time^3). A value outside is in other units.",
                 .solver = "it computes with the value",
                 .fix = "convert the value to the units of the deck",
                 .ignore = "When more than two surfaces take part on purpose.",
                 .bad = "@/INTER/TYPE7/1 Ithe=1 Kthe=1.0 Tint=293.0 Frad=5.67e-8 Drad=5.0\n",
                 .good = "@/INTER/TYPE7/1 Ithe=1 Kthe=1.0 Tint=293.0 Frad=4.e-17 Drad=5.0\n",
                 .check = check_radiation_factor});
}

}  // namespace deck::detail
