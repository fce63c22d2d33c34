// Pages of the rules about the first force evaluation.
#include "lint/rule_tables.hpp"

namespace deck::detail {

void add_cycle_rules(std::vector<Rule>& out) {
  using enum Severity;
  out.push_back(
      {.id = "DK401",
       .title = "contact force at the start",
       .severity = warning,
       .stage = RuleStage::extra,
       .problem = "A contact pushes before anything has moved.",
       .why = "Initial penetrations that the options leave in place act as loaded springs: force "
              "k g p / (g - p) for penetration p of gap g. Light nodes are thrown away, and the "
              "energy is none the model should have. Penetrations below a millionth of the gap do "
              "not count. `deck cycle` lists the pairs.",
       .solver = "it applies the force in the first cycle",
       .fix = "move the parts apart, reduce the gap, or let Inacti 5 or 6 take the penetration off "
              "the gap",
       .ignore = "Where parts are meant to be pressed together.",
       .bad = "@/INTER/TYPE7/1 Gapmin=4\n",
       .good = "@/INTER/TYPE7/1 Gapmin=4 Inacti=6\n"});
  out.push_back(
      {.id = "DK402",
       .title = "contact needs a smaller time step than the mesh",
       .severity = warning,
       .stage = RuleStage::extra,
       .problem = "The time step that contact allows at the start is below that of the elements.",
       .why = "A node with contact stiffness S and mass m needs dt <= 0.9 sqrt(2 m / S); a node "
              "that approaches needs half its way to the mid-surface, an interface 0.9 times its "
              "gap over the largest relative velocity. The element step is an estimate from sizes "
              "and wave speeds.",
       .solver = "it takes the smaller step, or deletes nodes where dtmin asks for it",
       .fix = "lower Stfac, widen the gap left, use Istf 4, or add mass to the node named",
       .ignore = "Where the run is short, or mass scaling sets the step.",
       .bad = "@/INTER/TYPE7/1 Gapmin=4\n",
       .good = "@/INTER/TYPE7/1 Gapmin=4 Stfac=0.1\n"});
  out.push_back(
      {.id = "DK403",
       .title = "pair near the end of its gap",
       .severity = warning,
       .stage = RuleStage::extra,
       .problem = "Less than a twentieth of the gap is left between the two sides.",
       .why = "Contact stiffness grows with the square of gap over distance: 400 times at a "
              "twentieth, without bound at the mid-surface. Edges reach that point at a tenth of "
              "their gap.",
       .solver = "it reduces the time step; at the mid-surface it takes the node out of the "
                 "interface for the rest of the run",
       .fix = "move the node, or use Inacti 5 or 6 with a gap that leaves more room",
       .ignore = "Where the nodes belong to parts that are joined there.",
       .bad = "/NODE\n        21                 5.0                 5.0                0.02\n"
              "/GRNOD/NODE/3\nclose\n        21\n@/INTER/TYPE7/1 grnd_IDs=3 Gapmin=1\n",
       .good = "/NODE\n        21                 5.0                 5.0                 0.5\n"
               "/GRNOD/NODE/3\nover\n        21\n@/INTER/TYPE7/1 grnd_IDs=3 Gapmin=1\n"});
}

}  // namespace deck::detail
