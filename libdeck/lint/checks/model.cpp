// Pages of the rules that the model stage finds: entities, groups, sets. A table of text, as long
// as it has to be.
#include "lint/rule_tables.hpp"

namespace deck::detail {
namespace {

void add_model_1(std::vector<Rule>& out) {
  out.push_back({.id = "DK036",
                 .title = "blank line among nodes or elements",
                 .severity = Severity::error,
                 .stage = RuleStage::model,
                 .problem = "A blank line stands in a block of nodes or elements.",
                 .why = "Blank lines are data: the block gets an item of id 0, and an element "
                        "without nodes ends the run.",
                 .solver = "among elements it crashes or hangs; among nodes it goes on with a node "
                           "of id 0, and blank lines at the end of a block do no harm (warnings "
                           "here)",
                 .message = 760,
                 .message_severity = Severity::error,
                 .fix = "delete the line",
                 .ignore = "Never.",
                 .bad = "/SHELL/1\n"
                        "         9         1         2         3         4\n"
                        "\n"
                        "        10         1         2         3         4\n",
                 .good = "/SHELL/1\n"
                         "         9         1         2         3         4\n"
                         "        10         1         2         3         4\n"});
  out.push_back({.id = "DK037",
                 .title = "id of a node or element is not positive",
                 .severity = Severity::warning,
                 .stage = RuleStage::model,
                 .problem = "The first cell of a node or element line is 0 or negative.",
                 .why = "Nothing can refer to the item; a shifted column is likely.",
                 .solver = "it goes on with an item of that id",
                 .fix = "write a positive id",
                 .ignore = "Never.",
                 .bad = "/NODE\n"
                        "        -5                 0.0                 0.0                 9.0\n",
                 .good =
                     "/NODE\n"
                     "        25                 0.0                 0.0                 9.0\n"});
  out.push_back({.id = "DK038",
                 .title = "thickness of a /SH3N outside its columns",
                 .severity = Severity::warning,
                 .stage = RuleStage::model,
                 .problem = "The thickness of a three-node shell begins left of column 91.",
                 .why = "Manuals place it in columns 81-100; the tables read columns 91-110 of a "
                        "line that ends at 100.",
                 .solver = "it reads what stands from column 91 on",
                 .fix = "write the thickness with at most 10 characters in columns 91-100",
                 .ignore = "Never.",
                 .bad = "/SH3N/1\n"
                        "         9         1         2         3                                  "
                        "   0.0        1.2500000000\n",
                 .good = "/SH3N/1\n"
                         "         9         1         2         3                                 "
                         "    0.0                1.25\n"});
  out.push_back({.id = "DK039",
                 .title = "element thicknesses under a unit id",
                 .severity = Severity::warning,
                 .stage = RuleStage::model,
                 .problem = "Elements with thicknesses of their own follow another unit system "
                            "than the deck.",
                 .why = "The reference solver converts only the first of them.",
                 .solver = "it takes the other thicknesses as numbers in working units",
                 .fix = "write the elements in the units of the deck",
                 .ignore = "When the units have the same length.",
                 .bad = "/UNIT/3\n"
                        "metres\n"
                        "                  kg                   m                  ms\n"
                        "/SHELL/1/3\n"
                        "        21         1         2         3         4                        "
                        "                     0.002\n"
                        "        22        11        12        13        14                        "
                        "                     0.002\n",
                 .good = "/SHELL/1\n"
                         "        21         1         2         3         4                       "
                         "                        2.0\n"
                         "        22        11        12        13        14                       "
                         "                        2.0\n"});
  out.push_back({.id = "DK100",
                 .title = "id defined twice",
                 .severity = Severity::error,
                 .stage = RuleStage::model,
                 .problem = "Two entities of one kind have the same id.",
                 .why = "Only one of them can be meant by a reference.",
                 .solver = "it stops with an error",
                 .message = 79,
                 .message_severity = Severity::error,
                 .fix = "give one of them another id",
                 .ignore = "Never.",
                 .bad = "/PART/1\n"
                        "again\n"
                        "         1         1\n",
                 .good = "/PART/7\n"
                         "again\n"
                         "         1         1\n"});
  out.push_back({.id = "DK101",
                 .title = "element of an unknown node",
                 .severity = Severity::error,
                 .stage = RuleStage::model,
                 .problem = "An element names a node that does not exist.",
                 .why = "The element is left out of groups and surfaces.",
                 .solver = "it stops with an error",
                 .message = 78,
                 .message_severity = Severity::error,
                 .fix = "correct the number or define the node",
                 .ignore = "When the node is in an include that cannot be read.",
                 .bad = "/SHELL/1\n"
                        "         9         1         2         3       999\n",
                 .good = "/SHELL/1\n"
                         "         9         1         2         3         4\n"});
}

void add_model_2(std::vector<Rule>& out) {
  out.push_back({.id = "DK102",
                 .title = "part without property",
                 .severity = Severity::error,
                 .stage = RuleStage::model,
                 .problem = "A part names a property that does not exist.",
                 .why = "Thickness, and with it gap and stiffness of contacts, come from the "
                        "property.",
                 .solver = "it reports an error and goes on with the first property",
                 .message = 178,
                 .message_severity = Severity::error,
                 .fix = "define the property or correct prop_ID",
                 .ignore = "When it is in an include that cannot be read.",
                 .bad = "/PART/9\n"
                        "lost\n"
                        "        99         1\n",
                 .good = "/PART/9\n"
                         "found\n"
                         "         1         1\n"});
  out.push_back({.id = "DK103",
                 .title = "part without material",
                 .severity = Severity::error,
                 .stage = RuleStage::model,
                 .problem = "A part with elements names a material that does not exist.",
                 .why = "The contact stiffness comes from the material.",
                 .solver = "it stops with an error",
                 .message = 179,
                 .message_severity = Severity::error,
                 .fix = "define the material or correct mat_ID",
                 .ignore = "When it is in an include that cannot be read.",
                 .bad = "/PART/9\n"
                        "lost\n"
                        "         1        99\n"
                        "/SHELL/9\n"
                        "         9         1         2         3         4\n",
                 .good = "/PART/9\n"
                         "found\n"
                         "         1         1\n"
                         "/SHELL/9\n"
                         "         9         1         2         3         4\n"});
  out.push_back({.id = "DK104",
                 .title = "elements of a part that does not exist",
                 .severity = Severity::error,
                 .stage = RuleStage::model,
                 .problem = "The header of an element block names an unknown part.",
                 .why = "The elements have no property and no material.",
                 .solver = "it stops with an error",
                 .message = 402,
                 .message_severity = Severity::error,
                 .fix = "define the part or correct the id",
                 .ignore = "When it is in an include that cannot be read.",
                 .bad = "/SHELL/99\n"
                        "         9         1         2         3         4\n",
                 .good = "/SHELL/1\n"
                         "         9         1         2         3         4\n"});
  out.push_back({.id = "DK105",
                 .title = "node or element defined twice",
                 .severity = Severity::error,
                 .stage = RuleStage::model,
                 .problem = "A node or element id appears twice.",
                 .why = "It is open which coordinates or nodes are meant.",
                 .solver = "it stops with an error",
                 .message = 79,
                 .message_severity = Severity::error,
                 .fix = "remove one of the lines",
                 .ignore = "Never.",
                 .bad = "/NODE\n"
                        "         1                 0.0                 0.0                 0.0\n",
                 .good =
                     "/NODE\n"
                     "        31                 0.0                 0.0                 0.0\n"});
  out.push_back({.id = "DK106",
                 .title = "shells without thickness",
                 .severity = Severity::error,
                 .stage = RuleStage::model,
                 .problem = "Shells have no thickness, neither their own nor from the property.",
                 .why = "Thickness enters stiffness and gap.",
                 .solver = "it stops with an error",
                 .message = 495,
                 .message_severity = Severity::error,
                 .fix = "give the property or the elements a thickness",
                 .ignore = "Never.",
                 .bad = "/PROP/SHELL/9\n"
                        "thin\n"
                        "        24\n"
                        "                 0.0\n"
                        "         5                           0.0\n"
                        "/PART/9\n"
                        "thin\n"
                        "         9         1\n"
                        "/SHELL/9\n"
                        "         9         1         2         3         4\n",
                 .good = "/PROP/SHELL/9\n"
                         "thin\n"
                         "        24\n"
                         "                 0.0\n"
                         "         5                           1.0\n"
                         "/PART/9\n"
                         "thin\n"
                         "         9         1\n"
                         "/SHELL/9\n"
                         "         9         1         2         3         4\n"});
  out.push_back({.id = "DK107",
                 .title = "quadrangles that are triangles",
                 .severity = Severity::warning,
                 .stage = RuleStage::model,
                 .problem = "Four-node shells repeat their third node.",
                 .why = "They work as degenerate quadrangles.",
                 .solver = "it keeps them and warns",
                 .message = 430,
                 .fix = "write them as /SH3N",
                 .ignore = "When the mesher cannot write triangles.",
                 .bad = "/SHELL/1\n"
                        "         9         1         2         3         3\n",
                 .good = "/SHELL/1\n"
                         "         9         1         2         3         4\n"});
}

void add_model_3(std::vector<Rule>& out) {
  out.push_back({.id = "DK108",
                 .title = "subset does not exist",
                 .severity = Severity::warning,
                 .stage = RuleStage::model,
                 .problem = "A part or subset names a subset that does not exist.",
                 .why = "Groups made from that subset miss the part.",
                 .solver = "it puts the part into the global subset",
                 .fix = "define the subset or blank the cell",
                 .ignore = "When the subset only orders the model tree.",
                 .bad = "/PART/9\n"
                        "part\n"
                        "         1         1        55\n",
                 .good = "/PART/9\n"
                         "part\n"
                         "         1         1         0\n"});
  out.push_back({.id = "DK109",
                 .title = "unit system does not exist",
                 .severity = Severity::error,
                 .stage = RuleStage::model,
                 .problem = "The header of a block names a unit id that is not defined.",
                 .why = "Every dimensional value of the block is in unknown units.",
                 .solver = "it stops with an error",
                 .message = 659,
                 .message_severity = Severity::error,
                 .fix = "define it with /UNIT or remove the id",
                 .ignore = "Never.",
                 .bad = "@/INTER/TYPE7/1/12\n",
                 .good = "@/INTER/TYPE7/1\n"});
  out.push_back({.id = "DK110",
                 .title = "transform that cannot be applied",
                 .severity = Severity::error,
                 .stage = RuleStage::model,
                 .problem = "A /TRANSFORM names a node, a node group or a submodel that does not "
                            "exist, or is degenerate.",
                 .why = "The nodes stay where they are.",
                 .solver = "it stops with an error",
                 .message = 1865,
                 .message_severity = Severity::error,
                 .fix = "correct the card",
                 .ignore = "Never.",
                 .bad = "/TRANSFORM/TRA/1\n"
                        "move\n"
                        "        99                 1.0                 0.0                 0.0\n",
                 .good =
                     "/TRANSFORM/TRA/1\n"
                     "move\n"
                     "         2                 1.0                 0.0                 0.0\n"});
  out.push_back({.id = "DK111",
                 .title = "deck without parts",
                 .severity = Severity::warning,
                 .stage = RuleStage::model,
                 .problem = "There is no /PART.",
                 .why = "There are no elements, so no contact has stiffness.",
                 .solver = "it warns",
                 .message = 1114,
                 .fix = "define parts",
                 .ignore = "When the deck only holds includes for others.",
                 .bad = "@bare\n"
                        "/NODE\n"
                        "         1                 0.0                 0.0                 0.0\n",
                 .good = "/TITLE\n"
                         "example\n"});
  out.push_back({.id = "DK112",
                 .title = "/INTTHICK/V5 given twice",
                 .severity = Severity::error,
                 .stage = RuleStage::model,
                 .problem = "The option appears twice.",
                 .why = "It is a switch for the whole deck.",
                 .solver = "it stops with an error",
                 .message = 725,
                 .message_severity = Severity::error,
                 .fix = "keep one of them",
                 .ignore = "Never.",
                 .bad = "/INTTHICK/V5\n"
                        "/INTTHICK/V5\n",
                 .good = "/INTTHICK/V5\n"});
  out.push_back({.id = "DK114",
                 .title = "id too large",
                 .severity = Severity::error,
                 .stage = RuleStage::model,
                 .problem = "An id, with the offset of its submodel, is above 2147483647.",
                 .why = "Ids are 31-bit numbers.",
                 .solver = "it stops with an error",
                 .message = 509,
                 .message_severity = Severity::error,
                 .fix = "use a smaller id or offset",
                 .ignore = "Never.",
                 .bad = "//SUBMODEL/1\n\n"
                        "         0         0         02147483000\n"
                        "/PART/999\npart\n         1         1\n//ENDSUB\n",
                 .good = "//SUBMODEL/1\n\n"
                         "         0         0         0      1000\n"
                         "/PART/999\npart\n         1         1\n//ENDSUB\n"});
}

void add_model_4(std::vector<Rule>& out) {
  out.push_back({.id = "DK119",
                 .title = "random noise that is not reproduced",
                 .severity = Severity::warning,
                 .stage = RuleStage::model,
                 .problem = "/RANDOM moves the nodes with a seed, or only those of a group.",
                 .why = "The noise of seed 0 on all nodes is reproduced; other noise is not, so "
                        "penetrations smaller than the noise may differ.",
                 .solver = "it moves the coordinates by up to the noise before it looks at contact",
                 .fix = "check penetrations with seed 0, or without noise",
                 .ignore = "Where the noise is far below every gap.",
                 .bad = "/RANDOM\n"
                        "               0.001                 0.5\n",
                 .good = "/RANDOM\n"
                         "               0.001                 0.0\n"});
  out.push_back({.id = "DK118",
                 .title = "data of a material that does not exist",
                 .severity = Severity::error,
                 .stage = RuleStage::model,
                 .problem = "/HEAT/MAT or an equation of state names an unknown material.",
                 .why = "The data have no effect.",
                 .solver = "it stops with an error",
                 .fix = "give it the id of its material",
                 .ignore = "Never.",
                 .bad = "/HEAT/MAT/99\n"
                        "               293.0                 3.8\n",
                 .good = "/HEAT/MAT/1\n"
                         "               293.0                 3.8\n"});
  out.push_back({.id = "DK150",
                 .title = "list names nodes that do not exist",
                 .severity = Severity::error,
                 .stage = RuleStage::model,
                 .problem = "A node group, surface or line lists unknown nodes.",
                 .why = "The entity is smaller than it looks.",
                 .solver = "it stops with an error",
                 .message = 78,
                 .message_severity = Severity::error,
                 .fix = "correct the id or remove it",
                 .ignore = "When the nodes are in an include that cannot be read.",
                 .bad = "/GRNOD/NODE/9\n"
                        "nodes\n"
                        "         1       999\n",
                 .good = "/GRNOD/NODE/9\n"
                         "nodes\n"
                         "         1         2\n"});
  out.push_back({.id = "DK151",
                 .title = "list names entities that do not exist",
                 .severity = Severity::warning,
                 .stage = RuleStage::model,
                 .problem = "A group, surface or line lists unknown parts, groups, surfaces ...",
                 .why = "The entity is smaller than it looks.",
                 .solver = "it ignores the entry and warns",
                 .message = 194,
                 .fix = "correct the id or remove it",
                 .ignore = "When variants of a model leave parts out on purpose.",
                 .bad = "/SURF/PART/9\n"
                        "parts\n"
                        "         1        77\n",
                 .good = "/SURF/PART/9\n"
                         "parts\n"
                         "         1         2\n"});
  out.push_back({.id = "DK152",
                 .title = "group that contains itself",
                 .severity = Severity::error,
                 .stage = RuleStage::model,
                 .problem = "A group, surface or line refers to itself, directly or through "
                            "others.",
                 .why = "It has no well-defined content.",
                 .solver = "it stops with an error",
                 .message = 176,
                 .message_severity = Severity::error,
                 .fix = "break the circle",
                 .ignore = "Never.",
                 .bad = "/SURF/SURF/9\n"
                        "self\n"
                        "         9\n",
                 .good = "/SURF/SURF/9\n"
                         "other\n"
                         "         1\n"});
  out.push_back({.id = "DK153",
                 .title = "node group without nodes",
                 .severity = Severity::warning,
                 .stage = RuleStage::model,
                 .problem = "A /GRNOD has no node.",
                 .why = "What uses it has no effect.",
                 .solver = "it warns and goes on",
                 .message = 690,
                 .fix = "check the ids and boxes it lists",
                 .ignore = "When variants of a model leave parts out on purpose.",
                 .bad = "/GRNOD/PART/9\n"
                        "nothing\n"
                        "        77\n",
                 .good = "/GRNOD/PART/9\n"
                         "lower\n"
                         "         1\n"});
  out.push_back({.id = "DK154",
                 .title = "line without edges",
                 .severity = Severity::warning,
                 .stage = RuleStage::model,
                 .problem = "A /LINE has no edge.",
                 .why = "What uses it has no effect.",
                 .solver = "it warns and goes on",
                 .message = 691,
                 .fix = "check the ids it lists",
                 .ignore = "When variants of a model leave parts out on purpose.",
                 .bad = "/LINE/SURF/9\n"
                        "nothing\n"
                        "        77\n",
                 .good = "/LINE/SURF/9\n"
                         "lower\n"
                         "         1\n"});
}

void add_model_5(std::vector<Rule>& out) {
  out.push_back({.id = "DK155",
                 .title = "solids without EXT or ALL",
                 .severity = Severity::error,
                 .stage = RuleStage::model,
                 .problem = "A surface made from parts selects solids and does not say which "
                            "faces.",
                 .why = "A solid has six faces; only the outer ones can touch.",
                 .solver = "it stops with an error",
                 .message = 1104,
                 .message_severity = Severity::error,
                 .fix = "write /SURF/PART/EXT for the outer faces",
                 .ignore = "Never.",
                 .bad = "/PROP/SOLID/9\n"
                        "solid\n"
                        "        24\n"
                        "                 0.0\n"
                        "                 0.0\n"
                        "/PART/9\n"
                        "solid\n"
                        "         9         1\n"
                        "/BRICK/9\n"
                        "         9         1         2         3         4        11        12    "
                        "    13        14\n"
                        "/SURF/PART/9\n"
                        "solid\n"
                        "         9\n",
                 .good = "/PROP/SOLID/9\n"
                         "solid\n"
                         "        24\n"
                         "                 0.0\n"
                         "                 0.0\n"
                         "/PART/9\n"
                         "solid\n"
                         "         9         1\n"
                         "/BRICK/9\n"
                         "         9         1         2         3         4        11        12   "
                         "     13        14\n"
                         "/SURF/PART/EXT/9\n"
                         "solid\n"
                         "         9\n"});
  out.push_back(
      {.id = "DK156",
       .title = "surface of quadratic solids",
       .severity = Severity::error,
       .stage = RuleStage::model,
       .problem = "A surface selects solids with 20 or 16 nodes.",
       .why = "Their faces have nodes on the sides, which segments do not have.",
       .solver = "it stops with an error",
       .message = 651,
       .message_severity = Severity::error,
       .fix = "use 8-node solids or 10-node tetrahedra in contacts",
       .ignore = "Never.",
       .bad = "/PROP/SOLID/9\n"
              "solid\n"
              "        24\n"
              "                 0.0\n"
              "                 0.0\n"
              "/PART/9\n"
              "solid\n"
              "         9         1\n"
              "/NODE\n"
              "        41                 1.0                 2.0                 3.0\n"
              "        42                 2.0                 2.0                 3.0\n"
              "        43                 3.0                 2.0                 3.0\n"
              "        44                 4.0                 2.0                 3.0\n"
              "        45                 5.0                 2.0                 3.0\n"
              "        46                 6.0                 2.0                 3.0\n"
              "        47                 7.0                 2.0                 3.0\n"
              "        48                 8.0                 2.0                 3.0\n"
              "        49                 9.0                 2.0                 3.0\n"
              "        50                10.0                 2.0                 3.0\n"
              "        51                11.0                 2.0                 3.0\n"
              "        52                12.0                 2.0                 3.0\n"
              "/BRIC20/9\n"
              "         9         1         2         3         4        11        12        13    "
              "    14\n"
              "        41        42        43        44        45        46        47        48\n"
              "        49        50        51        52\n"
              "/SURF/PART/EXT/9\n"
              "solid\n"
              "         9\n",
       .good = "/PROP/SOLID/9\n"
               "solid\n"
               "        24\n"
               "                 0.0\n"
               "                 0.0\n"
               "/PART/9\n"
               "solid\n"
               "         9         1\n"
               "/BRICK/9\n"
               "         9         1         2         3         4        11        12        13   "
               "     14\n"
               "/SURF/PART/EXT/9\n"
               "solid\n"
               "         9\n"});
  out.push_back({.id = "DK157",
                 .title = "/SURF/GRBRIC without EXT or FREE",
                 .severity = Severity::error,
                 .stage = RuleStage::model,
                 .problem = "A surface of a solid group does not say which faces.",
                 .why = "A solid has six faces.",
                 .solver = "it stops with an error",
                 .message = 479,
                 .message_severity = Severity::error,
                 .fix = "write /SURF/GRBRIC/EXT or /SURF/GRBRIC/FREE",
                 .ignore = "Never.",
                 .bad = "/PROP/SOLID/9\n"
                        "solid\n"
                        "        24\n"
                        "                 0.0\n"
                        "                 0.0\n"
                        "/PART/9\n"
                        "solid\n"
                        "         9         1\n"
                        "/BRICK/9\n"
                        "         9         1         2         3         4        11        12    "
                        "    13        14\n"
                        "/GRBRIC/BRIC/9\n"
                        "solids\n"
                        "         9\n"
                        "/SURF/GRBRIC/9\n"
                        "solid\n"
                        "         9\n",
                 .good = "/PROP/SOLID/9\n"
                         "solid\n"
                         "        24\n"
                         "                 0.0\n"
                         "                 0.0\n"
                         "/PART/9\n"
                         "solid\n"
                         "         9         1\n"
                         "/BRICK/9\n"
                         "         9         1         2         3         4        11        12   "
                         "     13        14\n"
                         "/GRBRIC/BRIC/9\n"
                         "solids\n"
                         "         9\n"
                         "/SURF/GRBRIC/EXT/9\n"
                         "solid\n"
                         "         9\n"});
  out.push_back({.id = "DK158",
                 .title = "analytical surface in a list of surfaces",
                 .severity = Severity::error,
                 .stage = RuleStage::model,
                 .problem = "A surface of surfaces lists a plane or an ellipsoid.",
                 .why = "It has no segments to add.",
                 .solver = "it stops with an error",
                 .message = 187,
                 .message_severity = Severity::error,
                 .fix = "list surfaces made of segments",
                 .ignore = "Never.",
                 .bad = "/SURF/PLANE/8\n"
                        "floor\n"
                        "                 0.0                 0.0                -5.0\n"
                        "                 0.0                 0.0                -4.0\n"
                        "/SURF/SURF/9\n"
                        "all\n"
                        "         8\n",
                 .good = "/SURF/PLANE/8\n"
                         "floor\n"
                         "                 0.0                 0.0                -5.0\n"
                         "                 0.0                 0.0                -4.0\n"
                         "/SURF/SURF/9\n"
                         "all\n"
                         "         1\n"});
  out.push_back({.id = "DK159",
                 .title = "box missing or not defined",
                 .severity = Severity::error,
                 .stage = RuleStage::model,
                 .problem = "A group refers to a box that does not exist, or a box has no extent.",
                 .why = "Nothing is inside.",
                 .solver =
                     "it stops with an error; a node group of missing boxes is merely empty (a "
                     "warning here)",
                 .message = 797,
                 .message_severity = Severity::error,
                 .fix = "define the box or correct the id",
                 .ignore = "Never.",
                 .bad = "/SURF/BOX/9\n"
                        "in box\n"
                        "        77\n",
                 .good = "/BOX/RECTA/5\n"
                         "box\n"
                         "                   0\n"
                         "                -1.0                -1.0                -1.0\n"
                         "                 5.0                 5.0                 5.0\n"
                         "/GRNOD/BOX/9\n"
                         "in box\n"
                         "         5\n"});
  out.push_back({.id = "DK160",
                 .title = "unknown clause of a set",
                 .severity = Severity::error,
                 .stage = RuleStage::model,
                 .problem = "A /SET has a clause that does not exist.",
                 .why = "The set is not what it should be.",
                 .solver = "it stops",
                 .message = 1906,
                 .message_severity = Severity::error,
                 .fix = "correct the clause keyword",
                 .ignore = "Never.",
                 .bad = "/SET/GENERAL/9\n"
                        "set\n"
                        "PARTS              1\n",
                 .good = "/SET/GENERAL/9\n"
                         "set\n"
                         "PART               1\n"});
}

void add_model_6(std::vector<Rule>& out) {
  out.push_back({.id = "DK161",
                 .title = "set names entities that do not exist",
                 .severity = Severity::warning,
                 .stage = RuleStage::model,
                 .problem = "A clause of a /SET names unknown ids.",
                 .why = "The set is smaller than it looks.",
                 .solver = "it ignores the entry and warns",
                 .message = 1902,
                 .fix = "correct the id or remove it",
                 .ignore = "When variants of a model leave parts out on purpose.",
                 .bad = "/SET/GENERAL/9\n"
                        "set\n"
                        "PART               1        77\n",
                 .good = "/SET/GENERAL/9\n"
                         "set\n"
                         "PART               1         2\n"});
  out.push_back({.id = "DK162",
                 .title = "segment of a set names unknown nodes",
                 .severity = Severity::error,
                 .stage = RuleStage::model,
                 .problem = "A SEG clause names nodes that do not exist.",
                 .why = "The segment is missing.",
                 .solver = "it stops with an error",
                 .message = 1903,
                 .message_severity = Severity::error,
                 .fix = "correct the node ids",
                 .ignore = "Never.",
                 .bad = "/SET/GENERAL/9\n"
                        "set\n"
                        "SEG                1         1         2         3       999\n",
                 .good = "/SET/GENERAL/9\n"
                         "set\n"
                         "SEG                1         1         2         3         4\n"});
  out.push_back({.id = "DK163",
                 .title = "set clause without such elements",
                 .severity = Severity::warning,
                 .stage = RuleStage::model,
                 .problem = "A clause of a /SET selects a kind of element that the model does not"
                            " have.",
                 .why = "The clause adds nothing.",
                 .solver = "it warns and ignores the clause",
                 .message = 2007,
                 .fix = "remove the clause",
                 .ignore = "When variants of a model leave parts out on purpose.",
                 .bad = "/SET/GENERAL/9\n"
                        "set\n"
                        "SOLID              1\n",
                 .good = "/SET/GENERAL/9\n"
                         "set\n"
                         "SHELL              1\n"});
  out.push_back({.id = "DK164",
                 .title = "set clause that is not evaluated here",
                 .severity = Severity::warning,
                 .stage = RuleStage::model,
                 .problem = "A clause of a /SET is legal, but this program does not evaluate it.",
                 .why = "Contacts that use the set may have more members than shown.",
                 .solver = "it evaluates the clause",
                 .fix = "use other clauses if the contacts of this set matter",
                 .ignore = "When no contact uses the set.",
                 .bad = "/SET/GENERAL/9\n"
                        "set\n"
                        "RBODY              1\n",
                 .good = "/SET/GENERAL/9\n"
                         "set\n"
                         "PART               1\n"});
  out.push_back({.id = "DK165",
                 .title = "keyword combination that defines nothing",
                 .severity = Severity::error,
                 .stage = RuleStage::model,
                 .problem = "The fields of a /SURF or /LINE header do not go together.",
                 .why = "The entity stays empty.",
                 .solver = "it stops with an error",
                 .message = 686,
                 .message_severity = Severity::error,
                 .fix = "correct the keyword",
                 .ignore = "Never."});
  out.push_back({.id = "DK166",
                 .title = "list names a subset without parts",
                 .severity = Severity::warning,
                 .stage = RuleStage::model,
                 .problem = "A group lists a subset that holds no part.",
                 .why = "The entry adds nothing.",
                 .solver = "it warns and goes on",
                 .message = 195,
                 .fix = "put parts into the subset or remove it",
                 .ignore = "When variants of a model leave parts out on purpose.",
                 .bad = "/SUBSET/9\n"
                        "empty\n"
                        "\n"
                        "/SURF/SUBSET/9\n"
                        "empty\n"
                        "         9\n",
                 .good = "/SUBSET/9\n"
                         "full\n"
                         "\n"
                         "/PART/9\n"
                         "part\n"
                         "         1         1         9\n"
                         "/SURF/SUBSET/9\n"
                         "full\n"
                         "         9\n"});
}

void add_model_7(std::vector<Rule>& out) {
  out.push_back({.id = "DK167",
                 .title = "group, surface or line defined twice",
                 .severity = Severity::error,
                 .stage = RuleStage::model,
                 .problem = "Two groups, surfaces, lines or sets of one kind have the same id.",
                 .why = "Only the first one is used here.",
                 .solver = "it stops with an error",
                 .message = 79,
                 .message_severity = Severity::error,
                 .fix = "give one of them another id",
                 .ignore = "Never.",
                 .bad = "/SURF/PART/1\n"
                        "again\n"
                        "         2\n",
                 .good = "/SURF/PART/9\n"
                         "other\n"
                         "         2\n"});
  out.push_back({.id = "DK168",
                 .title = "element group names elements that do not exist",
                 .severity = Severity::warning,
                 .stage = RuleStage::model,
                 .problem = "An element group lists unknown elements.",
                 .why = "The group is smaller than it looks.",
                 .solver = "it ignores the entry",
                 .fix = "correct the id or remove it",
                 .ignore = "When variants of a model leave parts out on purpose.",
                 .bad = "/GRSHEL/SHEL/9\n"
                        "shells\n"
                        "         1       999\n",
                 .good = "/GRSHEL/SHEL/9\n"
                         "shells\n"
                         "         1         2\n"});
}

}  // namespace

void add_model_rules(std::vector<Rule>& out) {
  add_model_1(out);
  add_model_2(out);
  add_model_3(out);
  add_model_4(out);
  add_model_5(out);
  add_model_6(out);
  add_model_7(out);
}

}  // namespace deck::detail
