// Pages of the geometry rules about segments, edges and crossed elements.
#include <string>

#include "lint/rule_tables.hpp"

namespace deck::detail {

void add_geometry_segment_rules(std::vector<Rule>& out) {
  using enum Severity;
  out.push_back(
      {.id = "DK320",
       .title = "segments without stiffness",
       .severity = warning,
       .stage = RuleStage::extra,
       .problem = "Main segments have contact stiffness zero.",
       .why =
           "Stiffness is Young's modulus times thickness, or S^2 B / V for solids. Where that is "
           "zero, as for /MAT/VOID without E, the segment never meets anything.",
       .solver = "it leaves them out of the search, without a message",
       .fix = "give the material of the shells E > 0, or use Istf 1",
       .ignore = "Where the segments are not meant to work.",
       .bad = "/MAT/VOID/9\nempty\n               1e-06                 0.0                 0.3\n"
              "/PROP/VOID/9\nskin\n                 1.0\n/PART/9\nskin\n"
              "         9         9         0\n"
              "/NODE\n        21                20.0                 0.0                 0.0\n"
              "        22                30.0                 0.0                 0.0\n"
              "        23                30.0                10.0                 0.0\n"
              "/SH3N/9\n         9        21        22        23\n/SURF/PART/9\nskin\n         9\n"
              "@/INTER/TYPE7/1 surf_IDm=9\n",
       .good = "/MAT/VOID/9\nempty\n               1e-06               210.0                 0.3\n"
               "/PROP/VOID/9\nskin\n                 1.0\n/PART/9\nskin\n"
               "         9         9         0\n"
               "/NODE\n        21                20.0                 0.0                 0.0\n"
               "        22                30.0                 0.0                 0.0\n"
               "        23                30.0                10.0                 0.0\n"
               "/SH3N/9\n         9        21        22        23\n/SURF/PART/9\nskin\n         9\n"
               "@/INTER/TYPE7/1 surf_IDm=9\n"});
  out.push_back(
      {.id = "DK321",
       .title = "segments of elements without material",
       .severity = warning,
       .stage = RuleStage::extra,
       .problem = "The part behind main segments names no material.",
       .why = "Without a material there is no contact stiffness: the segments never meet anything.",
       .solver = "it warns per segment and leaves them out",
       .message = 96,
       .message_severity = warning,
       .fix = "give the part a material; /MAT/VOID with E > 0 for contact only",
       .ignore = "Where the segments are not meant to work.",
       .bad = "/PROP/SHELL/9\nskin\n         0\n\n         3                           1.0\n"
              "/PART/9\nskin\n         9         0         0\n"
              "/NODE\n        21                20.0                 0.0                 0.0\n"
              "        22                30.0                 0.0                 0.0\n"
              "        23                30.0                10.0                 0.0\n"
              "/SH3N/9\n         9        21        22        23\n/SURF/PART/9\nskin\n         9\n"
              "@/INTER/TYPE7/1 surf_IDm=9\n",
       .good = "/PROP/SHELL/9\nskin\n         0\n\n         3                           1.0\n"
               "/PART/9\nskin\n         9         1         0\n"
               "/NODE\n        21                20.0                 0.0                 0.0\n"
               "        22                30.0                 0.0                 0.0\n"
               "        23                30.0                10.0                 0.0\n"
               "/SH3N/9\n         9        21        22        23\n/SURF/PART/9\nskin\n         9\n"
               "@/INTER/TYPE7/1 surf_IDm=9\n"});
  out.push_back(
      {.id = "DK322",
       .title = "segments or edges of no element",
       .severity = error,
       .stage = RuleStage::extra,
       .problem = "No element has all nodes of a segment, or both nodes of an edge.",
       .why = "Contact stiffness comes from the element behind a segment.",
       .solver = "it stops",
       .message = 482,
       .message_severity = error,
       .fix = "remove the segment, or put shells of /PROP/VOID there",
       .ignore = "Never.",
       .bad = "/SURF/SEG/3\nbetween\n         1         1         2        12        11\n"
              "@/INTER/TYPE7/1 surf_IDm=3\n",
       .good = "/SURF/SEG/3\non the shell\n         1         1         2         3         4\n"
               "@/INTER/TYPE7/1 surf_IDm=3\n"});
  out.push_back(
      {.id = "DK323",
       .title = "segments without area or crossed",
       .severity = error,
       .stage = RuleStage::extra,
       .problem = "The corners of a main segment are on a line, or in the wrong order.",
       .why = "Such a segment has no normal. Two nodes exchanged on a segment make a bow tie.",
       .solver = "it stops",
       .message = 558,
       .message_severity = error,
       .fix = "put the nodes of the segment in order round its boundary",
       .ignore = "Never.",
       .bad = "/SURF/SEG/3\ncrossed\n         1         1         3         2         4\n"
              "@/INTER/TYPE7/1 surf_IDm=3\n",
       .good = "/SURF/SEG/3\nround\n         1         1         2         3         4\n"
               "@/INTER/TYPE7/1 surf_IDm=3\n"});
  out.push_back(
      {.id = "DK324",
       .title = "segments with a node given twice",
       .severity = warning,
       .stage = RuleStage::extra,
       .problem = "A segment repeats a node, and not its third as its fourth.",
       .why = "It is taken for a triangle; which one depends on the place of the repetition.",
       .solver = "it repairs the segment and warns",
       .message = 106,
       .message_severity = warning,
       .fix = "write triangles with the fourth node blank or equal to the third",
       .ignore = "Where a triangle is meant.",
       .bad = "/SURF/SEG/3\nrepeated\n         1         1         2         2         4\n"
              "@/INTER/TYPE7/1 surf_IDm=3\n",
       .good = "/SURF/SEG/3\ntriangle\n         1         1         2         4         4\n"
               "@/INTER/TYPE7/1 surf_IDm=3\n"});
  out.push_back(
      {.id = "DK325",
       .title = "segments turned to look out of their solids",
       .severity = info,
       .stage = RuleStage::extra,
       .problem = "Segments on solids were given with their normals inward.",
       .why = "Distances have no sign, so the contact is the same; only the order of the nodes in "
              "listings changes.",
       .solver = "it turns them and warns",
       .message = 3025,
       .message_severity = warning,
       .fix = "nothing needs to be done",
       .ignore = "Always, unless the listing is compared with the deck.",
       .bad = "/NODE\n        21                20.0                 0.0                 0.0\n"
              "        22                22.0                 0.0                 0.0\n"
              "        23                20.0                 2.0                 0.0\n"
              "        24                20.0                 0.0                 2.0\n"
              "/PROP/SOLID/9\nblock\n\n\n/PART/9\nblock\n         9         1         0\n"
              "/TETRA4/9\n         9        21        22        23        24\n"
              "/SURF/SEG/3\ninward\n         1        21        22        23        23\n"
              "@/INTER/TYPE7/1 surf_IDm=3\n",
       .good = "/NODE\n        21                20.0                 0.0                 0.0\n"
               "        22                22.0                 0.0                 0.0\n"
               "        23                20.0                 2.0                 0.0\n"
               "        24                20.0                 0.0                 2.0\n"
               "/PROP/SOLID/9\nblock\n\n\n/PART/9\nblock\n         9         1         0\n"
               "/TETRA4/9\n         9        21        22        23        24\n"
               "/SURF/SEG/3\noutward\n         1        22        21        23        23\n"
               "@/INTER/TYPE7/1 surf_IDm=3\n"});
  out.push_back(
      {.id = "DK326",
       .title = "main segment given twice",
       .severity = warning,
       .stage = RuleStage::extra,
       .problem = "Two main segments have the same nodes.",
       .why = "A node in front of them meets both: twice the force.",
       .solver = "it keeps both",
       .fix = "remove one of the two segments or shells",
       .ignore = "Where two layers of shells are meant and their stiffness adds.",
       .bad = "/SURF/SEG/3\ntwice\n         1         1         2         3         4\n"
              "         2         2         3         4         1\n@/INTER/TYPE7/1 surf_IDm=3\n",
       .good = "/SURF/SEG/3\nonce\n         1         1         2         3         4\n"
               "@/INTER/TYPE7/1 surf_IDm=3\n"});
  out.push_back(
      {.id = "DK327",
       .title = "TYPE19 without edges",
       .severity = warning,
       .stage = RuleStage::extra,
       .problem = "A side of a TYPE19 has no edge to offer.",
       .why = "The part of the interface that lets edges meet edges does not exist.",
       .solver = "it warns and leaves the edges out",
       .message = 1577,
       .message_severity = warning,
       .fix = "check the surface; with Iedge = 1 (from /DEFAULT only) a closed one has no edges",
       .ignore = "Where nodes against segments are enough.",
       .bad = "@/INTER/TYPE19/1 surf_IDs=2 surf_IDm=7 Gapmin=1\n",
       .good = "@/INTER/TYPE19/1 surf_IDs=2 surf_IDm=1 Gapmin=1\n"});
  out.push_back(
      {.id = "DK328",
       .title = "crossed elements",
       .severity = warning,
       .stage = RuleStage::extra,
       .problem = "Edges of elements of the secondary side pass through main segments.",
       .why = "The parts already are through each other. Nodes beyond the surface are held there "
              "by the contact: the parts hook. Depths do not show it, and often no node is near.",
       .solver = "it has no such check",
       .fix = "move the parts apart",
       .ignore = "Where the parts are joined there and the contact is switched off.",
       .bad = "/NODE\n        21                 5.0                 2.0                -1.0\n"
              "        22                 5.0                 8.0                -1.0\n"
              "        23                 5.0                 5.0                 8.0\n"
              "/SH3N/2\n         9        21        22        23\n@/INTER/TYPE7/1 Gapmin=0.1\n",
       .good = "/NODE\n        21                 5.0                 2.0                 1.0\n"
               "        22                 5.0                 8.0                 1.0\n"
               "        23                 5.0                 5.0                 8.0\n"
               "/SH3N/2\n         9        21        22        23\n@/INTER/TYPE7/1 Gapmin=0.1\n"});
  // Examples of the rules about solids. Rules keep views of them.
  static const std::string two_tetras =
      "/NODE\n"
      "        21                20.0                 0.0                 0.0\n"
      "        22                22.0                 0.0                 0.0\n"
      "        23                20.0                 2.0                 0.0\n"
      "        24                20.0                 0.0                 2.0\n"
      "        25                20.0                 0.0                -2.0\n"
      "        26                22.0                 2.0                 2.0\n"
      "/PROP/SOLID/9\nblock\n\n\n/PART/9\nblock\n         9         1         0\n"
      "/TETRA4/9\n"
      "         9        21        22        23        24\n"
      "        10        21        23        22        25\n";
  static const std::string plain_face =
      "/SURF/SEG/3\nface\n         1        22        21        23        23\n"
      "@/INTER/TYPE7/1 surf_IDm=3\n";
  static const std::string three_on_a_face =
      two_tetras + "        11        21        22        23        26\n" + plain_face;
  static const std::string two_on_a_face = two_tetras + plain_face;
  static const std::string block =
      "/NODE\n"
      "        21                20.0                 0.0                 0.0\n"
      "        22                22.0                 0.0                 0.0\n"
      "        23                22.0                 2.0                 0.0\n"
      "        24                20.0                 2.0                 0.0\n"
      "        25                20.0                 0.0                 2.0\n"
      "        26                22.0                 0.0                 2.0\n"
      "        27                22.0                 2.0                 2.0\n"
      "        28                20.0                 2.0                 2.0\n"
      "        29                24.0                 2.0                 0.0\n"
      "        30                24.0                 2.0                 2.0\n"
      "/PROP/SOLID/9\nblock\n\n\n/PART/9\nblock\n         9         1         0\n"
      "/BRICK/9\n";
  static const std::string brick =
      "         9        21        22        23        24        25        26        27        "
      "28\n";
  static const std::string skin =
      "/SURF/PART/EXT/3\nblock\n         9\n@/INTER/TYPE7/1 surf_IDm=3\n";
  static const std::string overlapping =
      block +
      "         9        21        22        29        23        25        26        30        27\n"
      "        10        21        22        23        24        25        26        27        "
      "28\n" +
      skin;
  static const std::string single = block + brick + skin;
  static const std::string filled =
      block + brick + "/INIBRI/FILL\n         9                 0.5\n" + skin;
  out.push_back({.id = "DK329",
                 .title = "plain segments in more than two solids",
                 .severity = warning,
                 .stage = RuleStage::extra,
                 .problem = "More than two solids have all the nodes of a main segment.",
                 .why = "Two solids can share a face, three can not: solids overlap, or an element "
                        "is there twice.",
                 .solver = "it warns and takes the stiffness of the solid with the largest id",
                 .message = 3062,
                 .message_severity = warning,
                 .fix = "remove the solid that is too much",
                 .ignore = "Where the mesh is meant to be double there.",
                 .bad = three_on_a_face,
                 .good = two_on_a_face});
  out.push_back(
      {.id = "DK330",
       .title = "segments inside other solids",
       .severity = warning,
       .stage = RuleStage::extra,
       .problem =
           "All nodes of a face of a solid belong to another solid, of which they are no face.",
       .why = "The two solids overlap. A node of the other side can get in touch with a face that "
              "is inside the material.",
       .solver = "it has no such check; it takes such a face for an interior one where a face of "
                 "the other "
                 "solid has as many nodes, the same smallest one, and the second node of this face "
                 "just before it, and keeps it elsewhere: those reported here are kept",
       .fix = "mend the mesh: neighbours share whole faces",
       .ignore = "Where the other side never gets there.",
       .bad = overlapping,
       .good = single});
  out.push_back(
      {.id = "DK331",
       .title = "fill fractions of solids",
       .severity = info,
       .stage = RuleStage::extra,
       .problem = "Main segments lie on solids, and the deck has fill fractions (/INIBRI/FILL).",
       .why = "The solver multiplies the stiffness of these segments by the fraction; libdeck does "
              "not read it and shows the stiffness of full solids.",
       .solver = "it reads the fractions",
       .fix = "multiply the stiffness shown by the fraction of the solid",
       .ignore = "Where all solids of the surface are full.",
       .bad = filled,
       .good = single});
}

}  // namespace deck::detail
