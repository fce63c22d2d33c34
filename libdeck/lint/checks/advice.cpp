// Known traps: legal cards that often do not give what their author wants. Nothing here needs
// geometry.
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "lint/check.hpp"
#include "lint/rule_tables.hpp"

namespace deck::detail {
namespace {

using Check = void (*)(const LintContext&, const Rule&, Reporter&);

/// Calls f(node) for the nodes that the start-up may move: the secondary ones, of a TYPE19 those of
/// both surfaces.
template <class F>
void each_secondary_node(Selections& selections, const ContactCard& card, F&& f) {
  const auto nodes = [&](const auto& list) {
    for (const NodeIndex n : list)
      if (n != no_index) f(n);
  };
  const auto id = [&](std::string_view field) {
    return static_cast<std::int64_t>(card.value(field));
  };
  if (card.type == 7)
    if (const NodeSet* set = selections.node_group(id("grnd_IDs"))) nodes(set->nodes);
  if (card.type == 11)
    if (const LineSet* set = selections.line(id("line_IDs")))
      for (const Edge& e : set->edges) nodes(e.nodes);
  if (card.type == 19)
    for (const std::string_view field : {"surf_IDs", "surf_IDm"})
      if (const Surface* set = selections.surface(id(field)))
        for (const Segment& s : set->segments) nodes(s.nodes);
}

void check_inacti3(const LintContext& c, const Rule& rule, Reporter& r) {
  if (c.model == nullptr || c.selections == nullptr || c.model->spring.size() == 0) return;
  std::vector<bool> on_spring(c.model->nodes.size(), false);
  for (const NodeIndex n : c.model->spring.nodes)
    if (n != no_index) on_spring[n] = true;
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

void check_inacti5(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    // Airbag unfolding is what 5 is made for.
    if (card.flag("Ibag") != 0 && c.model != nullptr && c.model->has_monitored_volume) return;
    if (card.flag("Inacti") == 5)
      report_at(r, rule, card, "Inacti", name_of(card) + " has " + card.show("Inacti"));
  });
}

void check_dtmin(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.input("dtmin") > 0)
      report_at(r, rule, card, "dtmin", name_of(card) + " has " + card.show("dtmin"));
  });
}

void check_idel(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (std::abs(card.flag("Idel")) == 1)
      report_at(r, rule, card, "Idel", name_of(card) + " has " + card.show("Idel"));
  });
}

void check_edge_removal(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.flag("Irem_gap") != 2) return;
    if (card.type == 7 && card.flag("Igap") != 3) return;
    const char* const where = card.type == 7    ? " with Igap = 3"
                              : card.type == 19 ? ", which its edge contact gets as well"
                                                : "";
    note_field(report_at(r, rule, card, "Irem_gap", name_of(card) + " has Irem_gap = 2" + where),
               card, "Igap");
  });
}

void check_icurv3(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.flag("Icurv") == 3)
      report_at(r, rule, card, "Icurv", name_of(card) + " has Icurv = 3 (bicubic surface)");
  });
}

void check_tied_lever(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    report_at(r, rule, card, "Gap",
              name_of(card) + " ties over a distance: " +
                  (card.input("Gap") > 0 ? card.show("Gap") : "the default gap, from the mesh"));
  });
}

void check_sph(const LintContext& c, const Rule& rule, Reporter& r) {
  bool sph = false;
  for (const Block& b : c.deck.blocks) sph = sph || b.header.starts_with("/SPHCEL");
  if (!sph) return;
  each(c, rule, [&](const ContactCard& card) {
    if (const auto istf = card.flag("Istf"); istf >= 2 && istf <= 5)
      report_at(r, rule, card, "Istf",
                name_of(card) + ": " + card.show("Istf") + " in a deck with SPH particles");
  });
}

void check_large_factor(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    const double factor = card.input("Stfac");
    if (card.flag("Istf") == 1 || !(factor > 100)) return;
    note_field(report_at(r, rule, card, "Stfac",
                         fmt::format("{}: Stfac = {} multiplies the computed stiffness",
                                     name_of(card), number_text(factor))),
               card, "Istf");
  });
}

void check_small_stiffness(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (card.flag("Istf") != 1) return;
    const FieldView* f = card.find("Stfac");
    const double written = f == nullptr || f->text.empty() ? 0 : read_real(f->text).value;
    if (written != 1) return;
    note_field(report_at(r, rule, card, "Stfac",
                         name_of(card) + ": Istf = 1 makes 1.0 the stiffness of the contact"),
               card, "Istf");
  });
}

void check_bumult(const LintContext& c, const Rule& rule, Reporter& r) {
  each(c, rule, [&](const ContactCard& card) {
    if (const double b = card.input("Bumult"); b > 1)
      report_at(r, rule, card, "Bumult", name_of(card) + " has Bumult = " + number_text(b));
  });
}

void check_same_sides(const LintContext& c, const Rule& rule, Reporter& r) {
  std::map<std::tuple<int, double, double>, const ContactCard*> seen;
  each(c, rule, [&](const ContactCard& card) {
    const std::string_view one = card.type == 11   ? "line_IDs"
                                 : card.type == 19 ? "surf_IDs"
                                                   : "grnd_IDs";
    const std::string_view two = card.type == 11 ? "line_IDm" : "surf_IDm";
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
  if (c.model == nullptr || c.selections == nullptr) return;
  for (const ContactCard& card : c.contacts) {
    if (card.type == 0 || card.type == 11 || card.flag("Istf") == 1) continue;
    const Surface* s = c.selections->surface(static_cast<std::int64_t>(card.value("surf_IDm")));
    if (s == nullptr) continue;
    std::set<std::uint32_t> parts;
    for (const Segment& g : s->segments) {
      if (g.element == no_index) continue;
      if (g.carrier == Carrier::shell4) parts.insert(c.model->shell4.part[g.element]);
      if (g.carrier == Carrier::shell3) parts.insert(c.model->shell3.part[g.element]);
    }
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

constexpr std::string_view spring =
    "/PROP/SPRING/9\nspring\n"
    "               0.001                                                           0\n"
    "                10.0                 0.0                 0.0                 0.0\n"
    "         0         0         0         0         0\n\n"
    "/PART/9\nspring\n         9         0\n/SPRING/9\n         9        11        12\n"
    "@/INTER/TYPE7/1 Inacti=3\n";

void add_penetration_advice(std::vector<Rule>& out) {
  add(out, "DK901", Severity::warning, "Inacti 3 moves nodes of springs",
      "Initial penetrations are removed by moving nodes, and secondary nodes belong to springs.",
      "A spring whose node was moved starts with a force and energy.",
      "it moves the node and does not correct the spring", "use Inacti 6",
      "When the springs are known to be far from any penetration.", spring,
      "@/INTER/TYPE7/1 Inacti=3\n", check_inacti3);
  add(out, "DK902", Severity::info, "Inacti 5 where 6 is smoother",
      "Initial penetrations reduce the gap exactly to the distance.",
      "A node right at the border of the gap switches between contact and none, which excites high "
      "frequencies. Inacti 6 leaves 5 per cent of the remaining gap.",
      "it reduces the gap to the distance", "write 6", "Airbag unfolding, where 5 is recommended.",
      "@/INTER/TYPE7/1 Inacti=5\n", "@/INTER/TYPE7/1 Inacti=6\n", check_inacti5);
  add(out, "DK903", Severity::info, "dtmin removes nodes from the contact",
      "A secondary node (of TYPE11 an edge) whose contact time step falls below dtmin leaves the "
      "contact for good.",
      "The run goes on quietly, with a hole in the contact. /DT/INTER/DEL of the Engine file does "
      "the same for all interfaces without dtmin.",
      "it removes the node and prints a warning in the listing",
      "watch the listing for removed nodes", "When the removal is meant.",
      "@/INTER/TYPE7/1 dtmin=1.e-5\n", "@/INTER/TYPE7/1\n", check_dtmin);
  add(out, "DK904", Severity::info, "Idel 1 costs more than Idel 2",
      "Segments are removed when all their elements are gone (Idel 1 or -1).",
      "All neighbours have to be searched whenever an element dies, be it by rupture or by /DEL "
      "of the Engine file.",
      "it does more work than for Idel 2", "use 2 where a segment has one element",
      "When segments between two elements must stay until both are gone.",
      "@/INTER/TYPE7/1 Idel=1\n", "@/INTER/TYPE7/1 Idel=2\n", check_idel);
  add(out, "DK905", Severity::info, "Irem_gap 2 depends on the build",
      "Irem_gap 2 is used in an edge contact, or together with Igap 3.",
      "Some builds of the reference solver lost contacts here, and some never ended for edges "
      "that are not symmetric.",
      "newer builds are corrected", "use a recent build, and watch the start-up time",
      "When the build is known to be good.", "@/INTER/TYPE11/1 line_IDs=1 line_IDm=1 Irem_gap=2\n",
      "@/INTER/TYPE11/1 line_IDs=1 line_IDm=1 Irem_gap=1\n", check_edge_removal);
  add(out, "DK906", Severity::info, "bicubic gap can become unstable",
      "Icurv 3 interpolates the main surface.",
      "The surface swings where its curvature is large or changes quickly.",
      "it computes the interpolation", "refine the mesh instead",
      "Smooth surfaces of nearly constant curvature.", "@/INTER/TYPE7/1 Icurv=3\n",
      "@/INTER/TYPE7/1\n", check_icurv3);
  add(out, "DK907", Severity::info, "tied contact over a distance",
      "A TYPE10 ties nodes that stand off the surface. Its gap is on the card, or comes from the "
      "thickness and the mesh; it is never 0.",
      "Force pairs at a distance make a moment that nothing balances.",
      "it does not add the moment", "keep the gap as small as the geometry allows",
      "When the distance is small against the parts.", "@/INTER/TYPE10/1\n", "@/INTER/TYPE7/1\n",
      check_tied_lever);
}

}  // namespace

void add_advice_rules(std::vector<Rule>& out) {
  add_penetration_advice(out);
  add(out, "DK908", Severity::warning, "combined stiffness with SPH",
      "Istf 2 to 5 combine the stiffness of both sides, and the deck has SPH particles.",
      "Particles have no nodal stiffness to combine.", "it computes with a stiffness of 0 for them",
      "use Istf 1 or 1000 for interfaces with particles", "When no particle is in the interface.",
      "/SPHCEL/1\n        11                 1.0\n@/INTER/TYPE7/1 Istf=4\n",
      "/SPHCEL/1\n        11                 1.0\n@/INTER/TYPE7/1 Istf=1000\n", check_sph);
  add(out, "DK909", Severity::warning, "stiffness factor that looks like a stiffness",
      "Stfac is above 100 although Istf makes it a factor.",
      "The contact time step falls with the root of the stiffness. Stfac is the stiffness itself "
      "for Istf 1 only.",
      "it multiplies the stiffness by Stfac", "set Istf 1, or write a factor",
      "Stiff bodies on foam, where factors above 100 are used.", "@/INTER/TYPE7/1 Stfac=5000.0\n",
      "@/INTER/TYPE7/1 Istf=1 Stfac=5000.0\n", check_large_factor);
  add(out, "DK910", Severity::warning, "stiffness that looks like a factor",
      "Stfac is exactly 1 and Istf makes it the stiffness.",
      "1 is the usual factor, but an arbitrary stiffness: 1 N/m or 1 kN/mm, depending on the "
      "units.",
      "it uses a stiffness of 1 in the units of the deck",
      "use Istf 4 or 1000, or write the "
      "stiffness",
      "When a stiffness of 1 is meant.", "@/INTER/TYPE7/1 Istf=1 Stfac=1.0\n",
      "@/INTER/TYPE7/1 Istf=4 Stfac=1.0\n", check_small_stiffness);
  add(out, "DK911", Severity::info, "large sorting margin", "Bumult is above 1.",
      "The margin of the contact search grows with Bumult: fewer searches, but many more pairs in "
      "each. The result does not change.",
      "it computes with the value", "write 0.2 or leave the cell blank",
      "When it was tuned for speed.", "@/INTER/TYPE7/1 Bumult=20.0\n",
      "@/INTER/TYPE7/1 Bumult=0.2\n", check_bumult);
  add(out, "DK912", Severity::warning, "two interfaces with the same sides",
      "Two interfaces of one type act between the same two sides at the same time.",
      "Every contact is counted twice: double stiffness, smaller time step.", "it computes both",
      "delete one of them", "When the two have gaps for different stages.",
      "@/INTER/TYPE7/1\n@/INTER/TYPE7/2\n", "@/INTER/TYPE7/1\n@/INTER/TYPE7/2 Tstart=5.0\n",
      check_same_sides);
  add(out, "DK913", Severity::warning, "void shells without stiffness",
      "Shells of a main surface have a void material without Young's modulus.",
      "Contact stiffness is E times thickness: the segments push back with nothing. Void shells on "
      "solids take the stiffness of the solids away as well.",
      "it computes a stiffness of 0", "give the void material the stiffness of what it covers",
      "When the void shells are there for output only and not on the main side.",
      "/MAT/VOID/9\nvoid\n                 0.0                 0.0                 0.0\n"
      "/PART/9\nskin\n         1         9\n/SHELL/9\n"
      "         9        11        12        13        14\n"
      "/SURF/PART/9\nskin\n         9\n@/INTER/TYPE7/1 surf_IDm=9\n",
      "/MAT/VOID/9\nvoid\n             7.8e-06               210.0                 0.3\n"
      "/PART/9\nskin\n         1         9\n/SHELL/9\n"
      "         9        11        12        13        14\n"
      "/SURF/PART/9\nskin\n         9\n@/INTER/TYPE7/1 surf_IDm=9\n",
      check_void);
}

}  // namespace deck::detail
