// Legal cards with a frequent unwanted effect; without geometry.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "base/shared/vec.hpp"
#include "lint/check.hpp"

namespace deck::detail {
namespace {

/// Calls f(node) for the nodes of a side: of a group, edges or segments.
template <class F>
void for_each_node_of(const LintContext& c, const ContactCard& card, std::string_view field,
                      F&& f) {
  const auto nodes = [&](const auto& list) {
    for (const NodeIndex n : list)
      if (n != no_index) f(n);
  };
  if (field == "grnd_IDs") {
    if (const NodeSet* set = c.selections->node_group(card.id(field))) nodes(set->nodes);
  } else if (field == "line_IDs") {
    if (const LineSet* set = c.selections->line(card.id(field)))
      for (const Edge& e : set->edges) nodes(e.nodes);
  } else if (const auto set = c.selections->outline(card.id(field))) {
    set->segments.for_each([&](const Segment& s) { nodes(s.nodes); });
  }
}

/// The first marked node of some sides; no_index: none.
NodeIndex first_of_sides(const LintContext& c, const ContactCard& card,
                         std::initializer_list<std::string_view> fields,
                         const std::vector<bool>& marks) {
  NodeIndex found = no_index;
  for (const std::string_view field : fields)
    for_each_node_of(c, card, field, [&](NodeIndex n) {
      if (found == no_index && marks[n]) found = n;
    });
  return found;
}

void check_inacti3(const LintContext& c, const Rule& rule, Reporter& r) {
  if (c.model->spring.size() == 0) return;
  const std::vector<bool> on_spring = marked(*c.model, [&](auto&& mark) {
    for (const NodeIndex n : c.model->spring.nodes) mark(n);
  });
  for_each_contact(c, rule, [&](const ContactCard& card) {
    if (card.flag("Inacti") != 3) return;
    // TYPE19: start-up can move the nodes of both surfaces.
    const NodeIndex found =
        card.type == 19
            ? first_of_sides(c, card, {"surf_IDs", "surf_IDm"}, on_spring)
            : first_of_sides(c, card, {traits_of(card.type)->secondary.field}, on_spring);
    if (found == no_index) return;
    report_at(r, rule, card, "Inacti",
              fmt::format("{}: Inacti = 3 may move node {}, which belongs to a spring",
                          name_of(card), c.model->node_id(found)));
  });
}

void check_same_sides(const LintContext& c, const Rule& rule, Reporter& r) {
  std::map<std::tuple<int, double, double>, const ContactCard*> seen;
  for_each_contact(c, rule, [&](const ContactCard& card) {
    const InterfaceTraits* const traits = traits_of(card.type);
    if (traits == nullptr) return;
    const std::string_view one = traits->secondary.field, two = traits->main.field;
    if (card.given("sens_ID") || card.given("Tstart") || card.given("Tstop")) return;
    if (!card.given(two)) return;
    const auto [it, fresh] =
        seen.emplace(std::tuple{card.type, card.value(one), card.value(two)}, &card);
    if (fresh) return;
    Finding& d = report_at(r, rule, card, one,
                           fmt::format("{} has the same two sides as {}: every contact acts twice",
                                       name_of(card), name_of(*it->second)));
    d.notes.emplace_back(it->second->block->header_span, "the other interface");
  });
}

void check_void(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const ContactCard& card : c.contacts) {
    if (card.type == 0 || card.type == 11 || card.flag("Istf") == 1) continue;
    const auto s = c.selections->outline(card.id("surf_IDm"));
    if (!s) continue;
    std::set<std::uint32_t> parts;
    std::uint32_t last = no_index;  // segments of a part are mostly consecutive
    s->segments.for_each([&](const Segment& g) {
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
      Finding& d =
          report_at(r, rule, card, "surf_IDm",
                    fmt::format("{}: shells of part {} have material {} without Young's modulus, "
                                "so their contact stiffness is 0",
                                name_of(card), part.id, m.id));
      d.notes.emplace_back(m.span, "the material is defined here");
    }
  }
}

/// Number of edges of one segment only (border of the surface).
std::size_t count_free_edges(const Selections& selections, const SegmentList& surface) {
  const auto edges = selections.edges_of(surface, true);
  return static_cast<std::size_t>(std::count_if(
      edges.begin(), edges.end(), [](const Edge& e) { return e.nodes[1] != no_index; }));
}

void check_edge_companion(const LintContext& c, const Rule& rule, Reporter& r) {
  bool edges_seen = false;
  for (const ContactCard& card : c.contacts)
    edges_seen = edges_seen || card.type == 11 || card.type == 19;
  if (edges_seen) return;
  FirstCard first;
  std::size_t free = 0;
  for_each_contact(c, rule, [&](const ContactCard& card) {
    const auto s = c.selections->outline(card.id("surf_IDm"));
    const std::size_t n = s ? count_free_edges(*c.selections, s->segments) : 0;
    if (n > 0 && first.add(card)) free = n;
  });
  if (first.card == nullptr) return;
  report_at(r, rule, *first.card, "surf_IDm",
            fmt::format("the main surface of {} has {} free edge{}{}, but the deck has no "
                        "interface for edges (TYPE11, TYPE19)",
                        name_of(*first.card), free, free == 1 ? "" : "s",
                        first.others == 0
                            ? ""
                            : fmt::format(" (as have those of {} more interfaces)", first.others)));
}

/// Secondary nodes of rigid bodies.
std::vector<bool> rigid_nodes(const LintContext& c) {
  return marked(*c.model, [&](auto&& mark) {
    for (const DecodedBlock& d : c.blocks_with_checked_ids) {
      if (d.block->schema->keyword != "/RBODY") continue;
      const std::int64_t group = c.resolved(*d.block, "grnod", d.integer("grnd_ID"));
      if (const NodeSet* set = c.selections->node_group(group))
        for (const NodeIndex n : set->nodes) mark(n);
    }
  });
}

/// Shortest side of a surface; 0: no side.
double shortest_side(const Model& model, const SegmentList& surface) {
  const auto& x = model.nodes;
  double least = 0;
  surface.for_each([&](const Segment& s) {
    for (std::size_t k = 0; k < 4; ++k) {
      const NodeIndex a = s.nodes[k], b = s.nodes[(k + 1) % 4];
      if (a == b || a == no_index || b == no_index) continue;
      const double length = length3(x.x[a] - x.x[b], x.y[a] - x.y[b], x.z[a] - x.z[b]);
      if (length > 0 && (least == 0 || length < least)) least = length;
    }
  });
  return least;
}

/// Nodes that a TYPE2 ties to a surface.
struct Ties {
  const ContactCard* card;
  const NodeSet* nodes;
  std::vector<bool> on_main;  ///< per node
};

std::vector<Ties> ties_of(const LintContext& c) {
  std::vector<Ties> out;
  for (const ContactCard& card : c.contacts) {
    if (card.block->schema->keyword != "/INTER/TYPE2") continue;
    const auto id = [&](std::string_view field, std::string_view kind) {
      return c.resolved(*card.block, kind, card.id(field));
    };
    const NodeSet* nodes = c.selections->node_group(id("grnd_IDs", "grnod"));
    const auto main = c.selections->outline(id("surf_IDm", "surf"));
    if (nodes == nullptr || !main) continue;
    out.push_back({&card, nodes, nodes_of(*c.model, main->segments)});
  }
  return out;
}

/// First node of `tie` that the contact can push off its surface.
NodeIndex pushed_tied_node(const LintContext& c, const ContactCard& card, const Ties& tie) {
  const auto main = c.selections->outline(card.id("surf_IDm"));
  if (!main) return no_index;
  const std::vector<bool> secondary = marked(*c.model, [&](auto&& mark) {
    for_each_node_of(c, card, card.type == 7 ? "grnd_IDs" : "surf_IDs", mark);
  });
  const auto met = [&](const Segment& s) {
    return std::any_of(s.nodes.begin(), s.nodes.end(),
                       [&](NodeIndex n) { return n != no_index && tie.on_main[n]; });
  };
  if (!main->segments.find(met)) return no_index;
  for (const NodeIndex n : tie.nodes->nodes)
    if (n != no_index && secondary[n]) return n;
  return no_index;
}

/// One finding per deck: spot welds in a general contact are common.
void check_tied_nodes(const LintContext& c, const Rule& rule, Reporter& r) {
  const std::vector<Ties> ties = ties_of(c);
  if (ties.empty()) return;
  FirstCard first;
  const Ties* tie = nullptr;
  NodeIndex node = no_index;
  for_each_contact(c, rule, [&](const ContactCard& card) {
    const FieldView* f = card.find("Irem_i2");
    if (f == nullptr || f->field == nullptr || card.value("Irem_i2") == 1) return;
    for (const Ties& t : ties) {
      const NodeIndex n = pushed_tied_node(c, card, t);
      if (n == no_index) continue;
      if (!first.add(card)) return;
      tie = &t;
      node = n;
      return;
    }
  });
  if (first.card == nullptr) return;
  Finding& d =
      report_at(r, rule, *first.card, "Irem_i2",
                fmt::format("{}{}: node {} may be pushed off the surface that {} ties it to",
                            name_of(*first.card),
                            first.others == 0 ? "" : fmt::format(" (and {} more)", first.others),
                            c.model->node_id(node), name_of(*tie->card)));
  d.notes.emplace_back(tie->card->block->header_span, "the tie");
}

void check_rigid_gap(const LintContext& c, const Rule& rule, Reporter& r) {
  if (c.model->rbodies.empty()) return;
  constexpr double small = 0.02;  // of the shortest main side; usual gaps are a tenth or more
  std::vector<bool> rigid;
  for_each_contact(c, rule, [&](const ContactCard& card) {
    const double gap = card.input("Gapmin");
    // With a variable gap Gapmin is only its lower limit.
    if (!(gap > 0) || card.flag("Igap") != 0) return;
    const auto main = c.selections->outline(card.id("surf_IDm"));
    if (!main) return;
    const double side = shortest_side(*c.model, main->segments);
    if (!(gap < small * side)) return;
    if (rigid.empty()) rigid = rigid_nodes(c);
    const std::string_view secondary = card.type == 19 ? "surf_IDs" : "grnd_IDs";
    const NodeIndex n = first_of_sides(c, card, {secondary, "surf_IDm"}, rigid);
    if (n == no_index) return;
    report_at(
        r, rule, card, "Gapmin",
        fmt::format("{}: {} is {:.2g} of the shortest main side ({:.4g}), and node {} follows "
                    "a rigid body",
                    name_of(card), card.show("Gapmin"), gap / side, side, c.model->node_id(n)));
  });
}

/// Stefan-Boltzmann constant, W/(m2 K4) (CODATA 2018, exact).
constexpr double stefan_boltzmann = 5.670374419e-8;

void check_radiation_factor(const LintContext& c, const Rule& rule, Reporter& r) {
  if (!c.deck.begin.has_working && !c.deck.begin.has_input) return;  // units unknown
  const UnitSystem& u = c.deck.begin.has_working ? c.deck.begin.working : c.deck.begin.input;
  // M T^-3 per kelvin^4: converts kg/s3 to units of the deck.
  const double sigma = stefan_boltzmann / (u.mass / (u.time * u.time * u.time));
  if (!std::isfinite(sigma) || !(sigma > 0)) return;
  for_each_contact(c, rule, [&](const ContactCard& card) {
    const double frad = card.value("Frad");
    if (card.input("Ithe") != 1 || !(frad > 0)) return;
    // 1 / (1/e1 + 1/e2 - 1) is at most 1, and above 1e-3 for real surfaces.
    if (frad <= sigma * (1 + 1e-6) && frad >= 1e-3 * sigma) return;
    report_at(r, rule, card, "Frad",
              fmt::format("{}: Frad = {} is {} what two surfaces can radiate: the "
                          "Stefan-Boltzmann constant is {:.6g} in the units of the deck",
                          name_of(card), number_text(frad),
                          frad > sigma ? "more than" : "far below", sigma));
  });
}

}  // namespace

std::vector<Checked> pitfall_checks() {
  return {{RuleId::DK901, check_inacti3},   {RuleId::DK912, check_same_sides},
          {RuleId::DK913, check_void},      {RuleId::DK916, check_edge_companion},
          {RuleId::DK917, check_rigid_gap}, {RuleId::DK919, check_radiation_factor},
          {RuleId::DK920, check_tied_nodes}};
}

}  // namespace deck::detail
