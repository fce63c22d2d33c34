// Known traps: legal cards that often do not give what their author wants. Nothing here needs
// geometry.
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "lint/check.hpp"

namespace deck::detail {
namespace {

/// Calls f(node) for the nodes that the start-up may move: the secondary ones, of a TYPE19 those of
/// both surfaces.
template <class F>
void each_secondary_node(Selections& selections, const ContactCard& card, F&& f) {
  const auto nodes = [&](const auto& list) {
    for (const NodeIndex n : list)
      if (n != no_index) f(n);
  };
  if (card.type == 7)
    if (const NodeSet* set = selections.node_group(card.id("grnd_IDs"))) nodes(set->nodes);
  if (card.type == 11)
    if (const LineSet* set = selections.line(card.id("line_IDs")))
      for (const Edge& e : set->edges) nodes(e.nodes);
  if (card.type == 19)
    for (const std::string_view field : {"surf_IDs", "surf_IDm"})
      if (const auto set = selections.outline(card.id(field)))
        set->segments.each([&](const Segment& s) { nodes(s.nodes); });
}

void check_inacti3(const LintContext& c, const Rule& rule, Reporter& r) {
  if (c.model->spring.size() == 0) return;
  const std::vector<bool> on_spring = marked(*c.model, [&](auto&& mark) {
    for (const NodeIndex n : c.model->spring.nodes) mark(n);
  });
  each(c, rule, [&](const ContactCard& card) {
    if (card.flag("Inacti") != 3) return;
    NodeIndex found = no_index;
    each_secondary_node(*c.selections, card, [&](NodeIndex n) {
      if (found == no_index && on_spring[n]) found = n;
    });
    if (found == no_index) return;
    report_at(r, rule, card, "Inacti",
              fmt::format("{}: Inacti = 3 may move node {}, which belongs to a spring",
                          name_of(card), c.model->node_id(found)));
  });
}

void check_edge_removal(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.flag("Irem_gap") != 2) return;
    if (card.type == 7 && card.flag("Igap") != 3) return;
    const char* const where = card.type == 7    ? " with Igap = 3"
                              : card.type == 19 ? ", which its edge contact gets too"
                                                : "";
    note_field(report_at(r, rule, card, "Irem_gap", name_of(card) + " has Irem_gap = 2" + where),
               card, "Igap");
  });
}

void check_tied_lever(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    report_at(r, rule, card, "Gap",
              name_of(card) + " ties over a distance: " +
                  (card.input("Gap") > 0 ? card.show("Gap") : "the default gap, from the mesh"));
  });
}

void check_same_sides(const LintContext& c, const Rule& rule, Reporter& r) {
  std::map<std::tuple<int, double, double>, const ContactCard*> seen;
  each(c, rule, [&](const ContactCard& card) {
    const InterfaceTraits* const traits = traits_of(card.type);
    if (traits == nullptr) return;
    const std::string_view one = traits->secondary.field, two = traits->main.field;
    if (card.given("sens_ID") || card.given("Tstart") || card.given("Tstop")) return;
    if (!card.given(two)) return;
    const auto [it, fresh] =
        seen.emplace(std::tuple{card.type, card.value(one), card.value(two)}, &card);
    if (fresh) return;
    Diagnostic* d = report_at(
        r, rule, card, one,
        fmt::format("{} has the same two sides as {}", name_of(card), name_of(*it->second)));
    if (d != nullptr) d->notes.emplace_back(it->second->block->header_span, "the other interface");
  });
}

void check_void(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const ContactCard& card : c.contacts) {
    if (card.type == 0 || card.type == 11 || card.flag("Istf") == 1) continue;
    const auto s = c.selections->outline(card.id("surf_IDm"));
    if (!s) continue;
    std::set<std::uint32_t> parts;
    std::uint32_t last = no_index;  // segments of a part mostly follow each other
    s->segments.each([&](const Segment& g) {
      if (g.element == no_index) return;
      const Elements* shells = g.carrier == Carrier::shell4   ? &c.model->shell4
                               : g.carrier == Carrier::shell3 ? &c.model->shell3
                                                              : nullptr;
      if (shells == nullptr || shells->part[g.element] == last) return;
      last = shells->part[g.element];
      parts.insert(last);
    });
    for (const std::uint32_t p : parts) {
      if (p == no_index) continue;
      const Part& part = c.model->parts[p];
      if (part.mat == no_index) continue;
      const Material& m = c.model->materials[part.mat];
      if (m.law != 0 || m.young != 0 || !m.stiffness_known) continue;
      Diagnostic* d =
          report_at(r, rule, card, "surf_IDm",
                    fmt::format("{}: shells of part {} have material {} without Young's modulus, "
                                "so their contact stiffness is 0",
                                name_of(card), part.id, m.id));
      if (d != nullptr) d->notes.emplace_back(m.span, "the material is defined here");
    }
  }
}

}  // namespace

std::span<const Checked> advice_checks() {
  static constexpr Checked all[] = {
      {RuleId::DK901, check_inacti3},    {RuleId::DK905, check_edge_removal},
      {RuleId::DK907, check_tied_lever}, {RuleId::DK912, check_same_sides},
      {RuleId::DK913, check_void},
  };
  return all;
}

}  // namespace deck::detail
