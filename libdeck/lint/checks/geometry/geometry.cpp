// Pages of the rules that geometry checks report through LintInput::extra_checks. Add a rule here
// and report it from the check; the engine does the rest.
#include "lint/rule_tables.hpp"

namespace deck::detail {
namespace {

using enum Severity;

void add_penetrations(std::vector<Rule>& out) {
  out.push_back(
      {.id = "DK301",
       .title = "initial penetrations",
       .severity = warning,
       .stage = RuleStage::extra,
       .problem = "Nodes of one part lie within the gap of another part before anything moves.",
       .why = "The contact starts with force and stored energy, K p g / (g - p) per node for "
              "penetration p of gap g, or with reduced gaps, moved or missing nodes, whatever "
              "Inacti asks for.",
       .solver = "it lists the pairs, and treats them according to Inacti and Fpenmax",
       .message = 343,
       .message_severity = warning,
       .fix = "move the parts apart or reduce the gap; Inacti 5 or 6 reduces it per pair",
       .ignore = "Where the depth is a small share of the gap and Inacti is 5 or 6.",
       .bad = "@/INTER/TYPE7/1 Gapmin=4 Inacti=6\n",
       .good = "@/INTER/TYPE7/1 Gapmin=2 Inacti=6\n"});
  out.push_back(
      {.id = "DK302",
       .title = "nodes exactly on a segment",
       .severity = error,
       .stage = RuleStage::extra,
       .problem = "A secondary node lies on a main segment, at distance zero.",
       .why = "No direction leads out of the penetration. The distance must be exactly zero: a "
              "node 1e-16 away is an ordinary penetration.",
       .solver = "it stops with error 612 (Inacti 0) or 611 (Inacti 3, 5, 6)",
       .message = 612,
       .message_severity = error,
       .fix = "move the node, join it to the mesh, or use Inacti 1 or 2, or Fpenmax",
       .ignore = "Never.",
       .bad = "/NODE\n        21                 5.0                 5.0                 0.0\n"
              "/GRNOD/NODE/3\non\n        21\n@/INTER/TYPE7/1 grnd_IDs=3 Gapmin=1\n",
       .good = "/NODE\n        21                 5.0                 5.0                 0.5\n"
               "/GRNOD/NODE/3\nover\n        21\n@/INTER/TYPE7/1 grnd_IDs=3 Gapmin=1\n"});
  out.push_back(
      {.id = "DK303",
       .title = "nodes on a segment, switched off or tied",
       .severity = warning,
       .stage = RuleStage::extra,
       .problem = "A secondary node lies on a main segment, at distance zero.",
       .why = "The options keep the solver from stopping, but the pair does not work: Inacti 1 and "
              "Fpenmax switch the node off, Inacti 2 the segment. Tied contacts keep it.",
       .solver = "it goes on",
       .fix = "move the node or join it to the mesh",
       .ignore = "For tied contacts, where touching is what is meant.",
       .bad = "/NODE\n        21                 5.0                 5.0                 0.0\n"
              "/GRNOD/NODE/3\non\n        21\n@/INTER/TYPE7/1 grnd_IDs=3 Gapmin=1 Inacti=1\n",
       .good = "/NODE\n        21                 5.0                 5.0                 0.5\n"
               "/GRNOD/NODE/3\nover\n        21\n@/INTER/TYPE7/1 grnd_IDs=3 Gapmin=1 Inacti=1\n"});
  out.push_back(
      {.id = "DK304",
       .title = "Fpenmax takes nodes out of the contact",
       .severity = warning,
       .stage = RuleStage::extra,
       .problem = "Nodes penetrate by more than Fpenmax times their gap.",
       .why = "They are switched off for the whole run, whatever Inacti says, and go through the "
              "main surface unhindered.",
       .solver = "a line in the listing without the node's id; the node's stiffness becomes 0",
       .fix = "move these nodes, or raise Fpenmax",
       .ignore = "Where the nodes belong to parts that are joined there.",
       .bad = "@/INTER/TYPE7/1 Gapmin=10 Inacti=6 Fpenmax=0.5\n",
       .good = "@/INTER/TYPE7/1 Gapmin=4 Inacti=6 Fpenmax=0.5\n"});
  out.push_back(
      {.id = "DK305",
       .title = "Inacti 3 moves a node of a spring",
       .severity = warning,
       .stage = RuleStage::extra,
       .problem = "The node is moved out of the gap, and a spring is fixed to it.",
       .why = "Springs get their length after the move: the spring starts longer or shorter than "
              "drawn, and one of length zero gets a direction.",
       .solver = "it moves the node and forms masses and lengths afterwards",
       .fix = "use Inacti 5 or 6, or move the parts by hand",
       .ignore = "Where the spring's length does not matter.",
       .bad = "/PROP/SPRING/7\nlink\n                 1.0\n                10.0\n/PART/7\nlink\n"
              "         7         0         0\n/SPRING/7\n         9        11        14\n"
              "@/INTER/TYPE7/1 Gapmin=4 Inacti=3\n",
       .good = "/PROP/SPRING/7\nlink\n                 1.0\n                10.0\n/PART/7\nlink\n"
               "         7         0         0\n/SPRING/7\n         9        11        14\n"
               "@/INTER/TYPE7/1 Gapmin=4 Inacti=6\n"});
  out.push_back(
      {.id = "DK306",
       .title = "edges that nearly touch are switched off",
       .severity = warning,
       .stage = RuleStage::extra,
       .problem = "With Inacti 5 or 6, edges that penetrate by 99.5 % of their gap or more get no "
                  "reduced gap.",
       .why = "Their stiffness becomes zero: the secondary edge is out of the contact with every "
              "other edge as well.",
       .solver = "a line '*** PENETRATION > GAP - 0.5%' in the listing",
       .fix = "move the edges apart",
       .ignore = "Where the edges belong to parts that are joined there.",
       .bad = "/NODE\n        21                 5.0                -5.0               0.001\n"
              "        22                 5.0                 5.0               0.001\n"
              "/PROP/TRUSS/7\nbar\n                 1.0\n/PART/7\nbar\n"
              "         7         1         0\n/TRUSS/7\n         9        21        22\n"
              "/LINE/SEG/3\nbar\n         1        21        22\n"
              "@/INTER/TYPE11/1 line_IDs=3 Gapmin=1 Inacti=6\n",
       .good = "/NODE\n        21                 5.0                -5.0                 0.5\n"
               "        22                 5.0                 5.0                 0.5\n"
               "/PROP/TRUSS/7\nbar\n                 1.0\n/PART/7\nbar\n"
               "         7         1         0\n/TRUSS/7\n         9        21        22\n"
               "/LINE/SEG/3\nbar\n         1        21        22\n"
               "@/INTER/TYPE11/1 line_IDs=3 Gapmin=1 Inacti=6\n"});
  out.push_back({.id = "DK390",
                 .title = "too many pairs within gap",
                 .severity = error,
                 .stage = RuleStage::extra,
                 .problem = "More pairs of an interface are within gap than can be evaluated.",
                 .why = "The gap is large against the whole model, often a unit mistake.",
                 .solver = "it allocates memory for all of them or stops",
                 .fix = "check the gap against the size of the model",
                 .ignore = "Never."});
}

void add_gaps(std::vector<Rule>& out) {
  out.push_back(
      {.id = "DK310",
       .title = "gap above half the side of a main segment",
       .severity = warning,
       .stage = RuleStage::extra,
       .problem = "The gap is larger than half of the shortest side of a main segment.",
       .why = "In self contact the neighbours of a node then lie within its gap: penetrations that "
              "the mesh itself makes. Elsewhere contact begins far outside the surface.",
       .solver = "it warns with the shortest side of the whole surface; here the place is named",
       .message = 94,
       .message_severity = warning,
       .fix = "reduce the gap, use Igap 3, Irem_gap 2 in self contact, or refine less",
       .ignore = "Where the short segments are away from any contact.",
       .bad = "@/INTER/TYPE7/1 Gapmin=6\n",
       .good = "@/INTER/TYPE7/1 Gapmin=6 Irem_gap=2\n"});
  out.push_back(
      {.id = "DK311",
       .title = "default Gapmin above Gapmax",
       .severity = warning,
       .stage = RuleStage::extra,
       .problem = "Gapmin is not given, and its default exceeds Gapmax.",
       .why = "Gapmin wins: Gapmax has no effect. The solver's search uses Gapmax all the same and "
              "can miss pairs.",
       .solver = "it raises the gap to Gapmin after cutting it at Gapmax",
       .fix = "give a Gapmin, or raise Gapmax",
       .ignore = "Never.",
       .bad = "@/INTER/TYPE7/1 Igap=2 Gapmax=0.5\n",
       .good = "@/INTER/TYPE7/1 Igap=2 Gapmax=0.5 Gapmin=0.1\n"});
  out.push_back(
      {.id = "DK312",
       .title = "constant gap wider than the shells",
       .severity = info,
       .stage = RuleStage::extra,
       .problem = "The gap on the card is more than the thickness of every main shell.",
       .why = "Two sheets of that thickness meet before their surfaces do: parts stay apart, and "
              "penetrations are reported where nothing touches.",
       .solver = "it takes the gap as given",
       .fix = "leave Gapmin blank for the mean thickness, or use Igap 1",
       .ignore = "Where a distance is meant, such as padding that is not modelled.",
       .bad = "@/INTER/TYPE7/1 Gapmin=1.5\n",
       .good = "@/INTER/TYPE7/1 Gapmin=0.9\n"});
  out.push_back({.id = "DK313",
                 .title = "radiation distance longer than the mesh",
                 .severity = warning,
                 .stage = RuleStage::extra,
                 .problem = "Drad exceeds the shortest side of the main segments.",
                 .why = "Every pair within Drad is a candidate: the search finds very many.",
                 .solver = "it warns",
                 .message = 918,
                 .message_severity = warning,
                 .fix = "reduce Drad",
                 .ignore = "For small models.",
                 .bad = "/HEAT/MAT/1\n               293.0               100.0\n"
                        "@/INTER/TYPE7/1 Ithe=1 Kthe=1 Frad=1 Drad=20 Gapmin=1\n",
                 .good = "/HEAT/MAT/1\n               293.0               100.0\n"
                         "@/INTER/TYPE7/1 Ithe=1 Kthe=1 Frad=1 Drad=2 Gapmin=1\n"});
  out.push_back(
      {.id = "DK314",
       .title = "no gap",
       .severity = error,
       .stage = RuleStage::extra,
       .problem = "Gapmin is not given, and its default is zero.",
       .why = "The default is the thickness of the main shells or a share of their sides; here "
              "there is neither.",
       .solver = "it stops",
       .message = 785,
       .message_severity = error,
       .fix = "give Gapmin, or the shells a thickness",
       .ignore = "Never.",
       .bad = "/NODE\n        21                20.0                 0.0                 0.0\n"
              "/SURF/SEG/3\npoint\n         1        21        21        21        21\n"
              "@/INTER/TYPE7/1 surf_IDm=3\n",
       .good = "@/INTER/TYPE7/1\n"});
  out.push_back(
      {.id = "DK315",
       .title = "Irem_gap 2 between different lists of edges",
       .severity = warning,
       .stage = RuleStage::extra,
       .problem = "Edges close along the mesh are to be left out, but the two sides are not the "
                  "same list.",
       .why = "The solver marks edges by their place in the main list and looks them up by their "
              "place in the secondary list: other edges are left out than meant.",
       .solver = "it leaves out the wrong edges, without a message",
       .fix = "use one line for both sides, or Irem_gap 1",
       .ignore = "Never.",
       .bad = "@/INTER/TYPE11/1 Gapmin=1 Irem_gap=2\n",
       .good = "@/INTER/TYPE11/1 line_IDs=1 line_IDm=1 Gapmin=1 Irem_gap=2\n"});
}

}  // namespace

void add_geometry_rules(std::vector<Rule>& out) {
  add_penetrations(out);
  add_gaps(out);
  add_geometry_segment_rules(out);
  add_geometry_manual_rules(out);
  add_cycle_rules(out);
}

}  // namespace deck::detail
