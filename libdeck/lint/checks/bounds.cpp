// Rules about numbers and selections that are beyond what can be computed with.
#include "lint/rule_tables.hpp"

namespace deck::detail {

void add_bound_rules(std::vector<Rule>& out) {
  using enum Severity;
  out.push_back(
      {.id = "DK332",
       .title = "groups with too many members in all",
       .severity = error,
       .stage = RuleStage::extra,
       .problem = "The members of all groups, surfaces, lines and sets together need more "
                  "memory than is allowed.",
       .why = "Groups that list one another several times over grow exponentially. Members "
              "are left out from there on, and contacts that use them are not evaluated.",
       .solver = "it allocates memory for all of them or stops",
       .fix = "flatten groups that list one another; --max-memory raises the bound",
       .ignore = "Never."});
  out.push_back(
      {.id = "DK333",
       .title = "coordinate that is no finite number",
       .severity = error,
       .stage = RuleStage::model,
       .problem = "A node has a coordinate that is infinite or not a number in working units.",
       .why = "No distance to such a node can be computed: contacts it belongs to are not "
              "evaluated.",
       .solver = "it computes with the infinite number",
       .fix = "correct the coordinate, its unit system or the transformation that moves the node",
       .ignore = "Never.",
       .bad = "/UNIT/3\nkilometres\n                  kg                  km                  ms\n"
              "/NODE/3\n        21             1.e+305                 0.0                 0.0\n",
       .good =
           "/UNIT/3\nkilometres\n                  kg                  km                  ms\n"
           "/NODE/3\n        21                 0.01                 0.0                 0.0\n"});
  out.push_back(
      {.id = "DK334",
       .title = "coordinate beyond the range of distances",
       .severity = warning,
       .stage = RuleStage::model,
       .problem = "A coordinate is above 1e75 in working units.",
       .why = "The distance of a node to a segment is computed from products of four lengths, "
              "which overflow.",
       .solver = "its distances become infinite",
       .fix = "correct the coordinate",
       .ignore = "When the node is in no contact.",
       .bad = "/NODE\n        21             1.e+154                 0.0                 0.0\n",
       .good = "/NODE\n        21                 10.0                 0.0                 0.0\n"});
  out.push_back({.id = "DK335",
                 .title = "id or offset beyond 32 bits",
                 .severity = error,
                 .stage = RuleStage::reading,
                 .problem =
                     "The id of a header, or an offset of a submodel with those of the submodels "
                     "around it, does not fit into 32 bits.",
                 .why = "Ids are 32-bit numbers: a larger one cannot be referred to.",
                 .solver = "it reads an undefined value",
                 .message = 100103,
                 .message_severity = error,
                 .fix = "use smaller numbers",
                 .ignore = "Never.",
                 .bad = "/GRNOD/NODE/4294967299\nwide\n         1\n",
                 .good = "/GRNOD/NODE/2147483\nfits\n         1\n"});
  out.push_back({.id = "DK380",
                 .title = "contact with coordinates that are no numbers",
                 .severity = error,
                 .stage = RuleStage::extra,
                 .problem = "A node of the contact has a coordinate that is infinite or not a "
                            "number.",
                 .why = "Whether anything penetrates cannot be said.",
                 .solver = "it computes with the infinite number",
                 .fix = "correct the nodes that DK333 names",
                 .ignore = "Never."});
  out.push_back(
      {.id = "DK381",
       .title = "contact whose forces were not evaluated",
       .severity = warning,
       .stage = RuleStage::extra,
       .problem = "More pairs are within reach than there is memory for, or a value of the "
                  "card is beyond 1e30.",
       .why = "Whether the contact pushes at the start, and which time step it allows, is "
              "not known.",
       .solver = "it evaluates all pairs, however many",
       .fix = "check gap, Drad and stiffness against the mesh; --max-memory raises the "
              "bound for pairs",
       .ignore = "When forces at the start do not matter.",
       .bad = "@/INTER/TYPE7/1 Gapmin=1e200\n",
       .good = "@/INTER/TYPE7/1 Gapmin=1\n"});
}

}  // namespace deck::detail
