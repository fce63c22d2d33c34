// Groups, surfaces, lines and sets over elements of every kind: each way to select against the
// members that stand there.
// Over 600 lines: independent tests of one resolver.
#include <algorithm>

#include "model/selection_deck.hpp"

namespace deck::test {
namespace {

/// Elements of every kind in two parts; node k lies at (k, 0, 0).
struct Kind {
  const char *group, *member, *family, *group_kind;  ///< GRSHEL, SHEL, SHELL, grshel
  Ids ids;                                           ///< of elements, in the order of the deck
  Ids parts;
  std::vector<Ids> nodes;
};
const std::vector<Kind> kinds{
    {"GRSHEL",
     "SHEL",
     "SHELL",
     "grshel",
     {13, 11, 12},
     {1, 1, 2},
     {{1, 2, 3, 4}, {3, 4, 5, 6}, {5, 6, 7, 8}}},
    {"GRSH3N",
     "SH3N",
     "SH3N",
     "grsh3n",
     {23, 21, 22},
     {1, 1, 2},
     {{5, 6, 7}, {7, 8, 9}, {8, 9, 10}}},
    {"GRBRIC",
     "BRIC",
     "BRICK",
     "grbric",
     {33, 31, 32},
     {4, 4, 5},
     {{11, 12, 13, 14, 15, 16, 17, 18},
      {15, 16, 17, 18, 19, 20, 21, 22},
      {19, 20, 21, 22, 23, 24, 25, 26}}},
    {"GRTRUS", "TRUS", "TRUSS", "grtrus", {43, 41, 42}, {6, 6, 3}, {{1, 9}, {9, 10}, {10, 27}}},
    {"GRBEAM", "BEAM", "BEAM", "grbeam", {53, 51, 52}, {6, 6, 3}, {{2, 10}, {10, 12}, {12, 28}}},
    {"GRSPRI", "SPRI", "SPRING", "grspri", {63, 61, 62}, {6, 6, 3}, {{3, 11}, {11, 13}, {13, 29}}},
};

std::string zoo() {
  std::string out = parts() + "/NODE\n";
  for (int n = 1; n <= 30; ++n) out += node(n, n, 0, 0);
  for (const Kind& k : kinds)
    for (std::size_t e = 0; e < 3; ++e) {
      Ids line{k.ids[e]};
      line.insert(line.end(), k.nodes[e].begin(), k.nodes[e].end());
      if (std::string(k.member) == "BEAM") line.push_back(30);
      out += "/" + std::string(k.family) + "/" + std::to_string(k.parts[e]) + "\n" + cells(line);
    }
  return out;
}

/// A box that holds nodes from `from` to `to`.
std::string box(std::int64_t id, double from, double to) {
  return "/BOX/RECTA/" + std::to_string(id) + "\nb\n" + cells({0, 0, 0}) + reals({from, -1, -1}) +
         reals({to, 1, 1});
}
std::string group(const std::string& kind, const std::string& type, std::int64_t id,
                  const Ids& list) {
  return "/" + kind + "/" + type + "/" + std::to_string(id) + "\ng\n" + cells(list);
}

/// Ids of the elements of a group, in its order.
Ids elements(BuiltModel& b, const Kind& k, std::int64_t id) {
  const auto* members = b.selections().element_group(k.group_kind, id);
  if (members == nullptr) return {-1};
  Ids out;
  for (ElementKind kind : {ElementKind::shell4, ElementKind::shell3, ElementKind::solid8,
                           ElementKind::truss, ElementKind::beam, ElementKind::spring}) {
    const Elements& family = b.model().family(kind);
    if (family.size() > 0 && std::find(k.ids.begin(), k.ids.end(), family.id[0]) != k.ids.end())
      for (const std::uint32_t e : *members) out.push_back(family.id[e]);
  }
  return out;
}

Ids nodes_of(const Kind& k, const Ids& ids) {
  Ids out;
  for (std::size_t e = 0; e < 3; ++e)
    if (std::find(ids.begin(), ids.end(), k.ids[e]) != ids.end())
      out.insert(out.end(), k.nodes[e].begin(), k.nodes[e].end());
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

TEST(ElementGroups, HoldWhatTheirTypeSays) {
  for (const Kind& k : kinds) {
    const std::string g = k.group;
    const std::int64_t a = k.ids[0], b = k.ids[1], c = k.ids[2];  // in the order of the deck
    BuiltModel m(zoo() + box(1, 5, 18) + group(g, k.member, 1, {c, a, c}) +
                 group(g, "PART", 2, {k.parts[2], 9}) + group(g, "PROP", 3, {1, 2, 3}) +
                 group(g, "PART", 4, {k.parts[0], -k.parts[2], k.parts[2]}) +
                 group(g, "GENE", 5, {b, c}) + group(g, "GEN_INCR", 6, {b, a, 2}) +
                 group(g, g, 7, {3, -1, 5}) + group(g, "MAT", 8, {1}) + group(g, "MAT", 9, {7}) +
                 group(g, "SUBSET", 10, {1}) + group(g, g, 11, {-1}));
    EXPECT_EQ(elements(m, k, 1), (Ids{c, a})) << g << ": the order of the list";
    EXPECT_EQ(elements(m, k, 2), (Ids{c})) << g;
    EXPECT_EQ(elements(m, k, 3), k.ids) << g << ": the order of the deck";
    EXPECT_EQ(elements(m, k, 4), k.ids) << g << ": listed with both signs, it is in";
    EXPECT_EQ(elements(m, k, 5), (Ids{b, c})) << g;
    EXPECT_EQ(elements(m, k, 6), (Ids{a, b})) << g << ": the middle id is left out";
    EXPECT_EQ(elements(m, k, 7), (Ids{b})) << g;
    EXPECT_EQ(elements(m, k, 8), k.ids);
    EXPECT_EQ(elements(m, k, 9), Ids{});
    const bool in_subset = k.parts[0] != 6;  // subset 1 has subset 2 below it
    EXPECT_EQ(elements(m, k, 10), in_subset ? k.ids : Ids{}) << g;
    EXPECT_EQ(elements(m, k, 11), Ids{});
    EXPECT_EQ(elements(m, k, 99), Ids{-1});
  }
}

TEST(ElementGroups, OfBoxesNeedAllNodesOrOne) {
  for (const Kind& k : kinds)
    for (std::size_t e = 0; e < 3; ++e) {
      const auto [low, high] = std::minmax_element(k.nodes[e].begin(), k.nodes[e].end());
      const double from = static_cast<double>(*low), to = static_cast<double>(*high);
      const auto inside = [&](double x, double y, bool any) {
        Ids out;
        for (std::size_t i = 0; i < 3; ++i) {
          const auto in = std::count_if(k.nodes[i].begin(), k.nodes[i].end(), [&](std::int64_t n) {
            return static_cast<double>(n) >= x && static_cast<double>(n) <= y;
          });
          if (any ? in > 0 : in == static_cast<std::ptrdiff_t>(k.nodes[i].size()))
            out.push_back(k.ids[i]);
        }
        return out;
      };
      BuiltModel m(zoo() + box(1, from, to) + box(2, from, from) + box(3, from + 0.5, to) +
                   group(k.group, "BOX", 1, {1}) + group(k.group, "BOX2", 2, {2}) +
                   group(k.group, "BOX", 3, {3}) + group(k.group, "BOX2", 4, {1, -2}) +
                   group(k.group, "BOX", 5, {1, 3, -1}));
      EXPECT_EQ(elements(m, k, 1), inside(from, to, false)) << k.group;
      EXPECT_EQ(elements(m, k, 2), inside(from, from, true)) << k.group;
      EXPECT_EQ(elements(m, k, 3), inside(from + 0.5, to, false)) << k.group;
      Ids all = inside(from, to, true);
      std::erase_if(all, [&](std::int64_t id) {
        const Ids gone = inside(from, from, true);
        return std::find(gone.begin(), gone.end(), id) != gone.end();
      });
      EXPECT_EQ(elements(m, k, 4), all) << k.group;
      EXPECT_EQ(elements(m, k, 5), Ids{}) << k.group;
    }
}

TEST(ElementGroups, OfBoxesLookAtTheNodesThatAreThere) {
  // Shell 1 has one node in the model, shell 2 none.
  const std::string shells = parts() + grid_nodes() + "/SHELL/1\n" + cells({1, 1, 97, 98, 99}) +
                             cells({2, 95, 97, 98, 99});
  BuiltModel m(shells + box(1, -1, 5) + group("GRSHEL", "BOX", 1, {1}) +
               group("GRSHEL", "BOX2", 2, {1}));
  EXPECT_EQ(*m.selections().element_group("grshel", 1), (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(*m.selections().element_group("grshel", 2), (std::vector<std::uint32_t>{0}));
}

TEST(NodeGroups, OfElementsHaveTheirNodesLessThoseOfOthers) {
  for (const Kind& k : kinds) {
    const std::string g = k.group;
    const std::int64_t a = k.ids[0], b = k.ids[1], c = k.ids[2];
    BuiltModel m(zoo() + group(g, k.member, 1, {c, a}) + group(g, k.member, 2, {b}) +
                 group("GRNOD", g, 1, {1}) + group("GRNOD", g, 2, {1, 2}) +
                 group("GRNOD", g, 3, {1, -2}) + group("GRNOD", g, 4, {9}) +
                 group("GRNOD", "PART", 5, {k.parts[0], -k.parts[2]}));
    EXPECT_EQ(m.group(1), nodes_of(k, {a, c})) << g;
    EXPECT_EQ(m.group(2), nodes_of(k, k.ids)) << g;
    Ids rest;
    const Ids all = nodes_of(k, {a, c}), gone = nodes_of(k, {b});
    std::set_difference(all.begin(), all.end(), gone.begin(), gone.end(), std::back_inserter(rest));
    EXPECT_EQ(m.group(3), rest) << g;
    EXPECT_EQ(m.group(4), Ids{});
    EXPECT_EQ(m.message(RuleId::DK151), 172);
  }
}

TEST(NodeGroups, OfPartsTakeFamilyByFamily) {
  // Part 6 has trusses, beams and springs, part 3 one of each: what a beam of part 3 takes away
  // does not come back, what a truss took away comes back with a spring.
  BuiltModel m(zoo() + group("GRNOD", "PART", 1, {6, -3}) + group("GRNOD", "PART", 2, {6, 3}) +
               group("GRNOD", "PART", 3, {1, -2}) + group("GRNOD", "PART", 4, {-2, 1, 4}) +
               group("GRNOD", "PART", 5, {-1}));
  EXPECT_EQ(m.group(1), (Ids{1, 2, 3, 9, 10, 11}))
      << "10 goes with truss 42 and comes back with beams; 12 and 13 go with the last family";
  EXPECT_EQ(m.group(2), (Ids{1, 2, 3, 9, 10, 11, 12, 13, 27, 28, 29}));
  EXPECT_EQ(m.group(3), (Ids{1, 2, 3, 4, 5, 6, 7})) << "5, 6, 7 come back with triangles, 8, 9 not";
  EXPECT_EQ(m.group(5), Ids{});
}

TEST(NodeGroups, OfSurfacesAndLinesHaveTheirNodes) {
  BuiltModel m(zoo() + group("SURF", "PART", 1, {2}) + group("SURF", "PART", 2, {1}) +
               group("LINE", "PART", 3, {3}) + group("LINE", "PART", 4, {6}) +
               group("GRNOD", "SURF", 1, {1}) + group("GRNOD", "SURF", 2, {2, 1, 9}) +
               group("GRNOD", "LINE", 3, {3}) + group("GRNOD", "LINE", 4, {4, 3, 9}));
  EXPECT_EQ(m.group(1), (Ids{5, 6, 7, 8, 9, 10}));
  EXPECT_EQ(m.group(2), (Ids{1, 2, 3, 4, 5, 6, 7, 8, 9, 10}));
  EXPECT_EQ(m.message(RuleId::DK151), 193);
  EXPECT_EQ(m.group(3), (Ids{10, 12, 13, 27, 28, 29}));
  EXPECT_EQ(m.group(4), (Ids{1, 2, 3, 9, 10, 11, 12, 13, 27, 28, 29}));
}

TEST(NodeGroups, OfBoxesAreThoseOfTheLastBoxThatHoldsTheNode) {
  BuiltModel m(zoo() + box(1, 3, 9) + box(2, 8, 12) + box(3, 5, 5) +
               group("GRNOD", "BOX", 1, {1, 2}) + group("GRNOD", "BOX", 2, {1, -3}) +
               group("GRNOD", "BOX2", 3, {-3, 1}) + group("GRNOD", "BOX", 4, {2, 9}));
  EXPECT_EQ(m.group(1), (Ids{3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));
  EXPECT_EQ(m.group(2), (Ids{3, 4, 6, 7, 8, 9}));
  EXPECT_EQ(m.group(3), (Ids{3, 4, 6, 7, 8, 9}));
  EXPECT_EQ(m.group(4), (Ids{8, 9, 10, 11, 12}));
  EXPECT_EQ(m.message(RuleId::DK159), 690);
}

TEST(NodeGroups, OfGroupsKeepTheirOrderWhereAskedTo) {
  BuiltModel m(zoo() + group("GRNOD", "NODENS", 1, {9, 4, 7}) +
               group("GRNOD", "NODENS", 2, {5, 4}) + group("GRNOD", "GRNODNS", 3, {2, 1}) +
               group("GRNOD", "GRNOD", 4, {2, 1}) + group("GRNOD", "GRNODNS", 5, {1, -2}) +
               group("GRNOD", "GRNODNS", 6, {-2, 1, 9}));
  EXPECT_EQ(m.group(3), (Ids{5, 4, 9, 7}));
  EXPECT_EQ(m.group(4), (Ids{4, 5, 7, 9}));
  EXPECT_EQ(m.group(5), (Ids{9, 7}));
  EXPECT_EQ(m.group(6), (Ids{9, 7}));
}

TEST(NodeGroups, OfRangesVisitIdsOrNodesWithTheSameResult) {
  // Few nodes and a long range: the nodes are visited; the other way round: the ids.
  const std::string nodes = "/NODE\n" + node(4, 0, 0, 0) + node(1, 1, 0, 0) + node(10, 2, 0, 0) +
                            node(7, 3, 0, 0) + node(1000, 4, 0, 0);
  BuiltModel m(nodes + group("GRNOD", "GENE", 1, {4, 8}) + group("GRNOD", "GENE", 2, {4, 9}) +
               group("GRNOD", "GENE", 3, {4, 999}) + group("GRNOD", "GENE", 4, {4, 1000}) +
               group("GRNOD", "GENE", 5, {7, 7}) + group("GRNOD", "GENE", 6, {9, 4}) +
               group("GRNOD", "GEN_INCR", 7, {1, 10, 3}) +
               group("GRNOD", "GEN_INCR", 8, {4, 1000, 6}) + group("GRNOD", "GENE", 9, {1, 4, 10}) +
               group("GRNOD", "GEN_INCR", 10, {1, 10, 0}));
  EXPECT_EQ(m.group(1), (Ids{4, 7}));
  EXPECT_EQ(m.group(2), (Ids{4, 7}));
  EXPECT_EQ(m.group(3), (Ids{4, 7, 10}));
  EXPECT_EQ(m.group(4), (Ids{4, 7, 10, 1000}));
  EXPECT_EQ(m.group(5), (Ids{7}));
  EXPECT_EQ(m.group(6), Ids{});
  EXPECT_EQ(m.group(7), (Ids{1, 4, 7, 10}));
  EXPECT_EQ(m.group(8), (Ids{4, 10, 1000}));
  EXPECT_EQ(m.group(9), (Ids{1, 4})) << "a first id without a last one";
  EXPECT_EQ(m.group(10), Ids{});
}

TEST(NodeGroups, AreInTheOrderOfIdsHoweverFarApartTheyLie) {
  // Nodes of a deck in an order of their own; few of many, many of few.
  std::string nodes = "/NODE\n";
  Ids order;
  for (int i = 0; i < 100; ++i) order.push_back(1 + (i * 37) % 100);
  for (const auto id : order) nodes += node(id, 0, 0, 0);
  BuiltModel m(nodes + group("GRNOD", "NODE", 1, {100, 1}) +
               group("GRNOD", "NODE", 2, {100, 50, 1, 17}) +
               group("GRNOD", "NODE", 3, {33, 31, 32, 30}) + group("GRNOD", "GENE", 4, {1, 100}));
  EXPECT_EQ(m.group(1), (Ids{1, 100}));
  EXPECT_EQ(m.group(2), (Ids{1, 17, 50, 100}));
  EXPECT_EQ(m.group(3), (Ids{30, 31, 32, 33}));
  Ids all;
  for (int i = 1; i <= 100; ++i) all.push_back(i);
  EXPECT_EQ(m.group(4), all);
}

// ---- what is missing ---------------------------------------------------------------------------

TEST(MissingMembers, AreNamedWithTheMessageOfTheSolver) {
  struct Row {
    std::string text;
    RuleId rule;
    int message;
  };
  const Row rows[] = {
      {group("GRNOD", "NODE", 1, {1, 77}), RuleId::DK150, 78},
      {group("GRNOD", "PART", 1, {1, 77}), RuleId::DK151, 194},
      {group("GRNOD", "MAT", 1, {1, 77}), RuleId::DK151, 194},
      {group("GRNOD", "PROP", 1, {1, 77}), RuleId::DK151, 194},
      {group("GRNOD", "SUBSET", 1, {1, 77}), RuleId::DK151, 194},
      {group("GRNOD", "SUBMODEL", 1, {77}), RuleId::DK151, 194},
      {group("GRNOD", "GRNOD", 1, {77}), RuleId::DK151, 174},
      {group("GRNOD", "SURF", 1, {77}), RuleId::DK151, 193},
      {group("GRNOD", "LINE", 1, {77}), RuleId::DK151, 193},
      {group("GRNOD", "GRSHEL", 1, {77}), RuleId::DK151, 172},
      {group("GRSHEL", "SHEL", 1, {77}), RuleId::DK168, 70},
      {group("GRQUAD", "QUAD", 1, {77}), RuleId::DK168, 0},
      {group("GRSHEL", "GRSHEL", 1, {77}), RuleId::DK151, 172},
      {group("GRSHEL", "BOX", 1, {77}), RuleId::DK159, 798},
      {group("GRPART", "GRPART", 1, {77}), RuleId::DK151, 172},
      {group("GRPART", "PART", 1, {77}), RuleId::DK151, 194},
      {group("SURF", "SURF", 1, {77}), RuleId::DK151, 188},
      {group("SURF", "DSURF", 1, {77}), RuleId::DK151, 188},
      {group("SURF", "GRSHEL", 1, {77}), RuleId::DK151, 192},
      {group("SURF", "BOX", 1, {77}), RuleId::DK159, 800},
      {group("SURF", "SEG", 1, {1, 2, 3, 4, 77}), RuleId::DK150, 78},
      {group("LINE", "LINE", 1, {77}), RuleId::DK139, 180},
      {group("LINE", "BOX", 1, {77}), RuleId::DK159, 799},
      {group("LINE", "SEG", 1, {1, 2, 77}), RuleId::DK150, 78},
      {group("BOX", "BOX", 1, {77}), RuleId::DK159, 795},
      {group("BOX", "BOX", 1, {}), RuleId::DK159, 801},
      {set(1, clause("NODE", {77})), RuleId::DK161, 1902},
      {set(1, clause("PART", {77})), RuleId::DK161, 1902},
      {set(1, clause("SHELL", {77})), RuleId::DK161, 1902},
      {set(1, clause("BOX", {77})), RuleId::DK159, 796},
  };
  for (const Row& r : rows) {
    BuiltModel m(zoo() + r.text);
    m.selections().resolve_all();
    EXPECT_GE(m.findings(r.rule), 1u) << r.text;
    EXPECT_EQ(m.message(r.rule), r.message) << r.text;
  }
}

TEST(MissingMembers, AreListedUpToFive) {
  const auto message = [](const Ids& ids) {
    BuiltModel m(zoo() + group("GRNOD", "NODE", 1, ids));
    m.group(1);
    return m.selections().diagnostics().all().at(0).message;
  };
  EXPECT_EQ(message({71}), "/GRNOD/NODE 1 lists node 71, which does not exist");
  EXPECT_EQ(message({71, 1, 72}), "/GRNOD/NODE 1 lists node 71, 72, which do not exist");
  EXPECT_EQ(message({71, 72, 73, 74, 75}),
            "/GRNOD/NODE 1 lists node 71, 72, 73, 74, 75, which do not exist");
  EXPECT_EQ(message({71, 72, 73, 74, 75, 76, 77}),
            "/GRNOD/NODE 1 lists node 71, 72, 73, 74, 75 and 2 more, which do not exist");
}

TEST(MissingMembers, OfASubsetWithoutPartsAreSaid) {
  BuiltModel m(zoo() + "/SUBSET/9\nempty\n\n" + group("GRNOD", "SUBSET", 1, {1, 9}));
  EXPECT_EQ(m.group(1).size(), 26u);
  EXPECT_EQ(m.findings(RuleId::DK166), 1u);
  BuiltModel full(zoo() + group("GRNOD", "SUBSET", 1, {1}));
  full.group(1);
  EXPECT_EQ(full.findings(RuleId::DK166), 0u);
}

TEST(MissingMembers, ParticlesOfAPartAreNotEvaluated) {
  const std::string particles = "/SPHCEL/2\n         1         1\n";
  const auto findings = [&](const std::string& text) {
    BuiltModel m(zoo() + particles + text);
    m.selections().resolve_all();
    return m.findings(RuleId::DK164);
  };
  EXPECT_EQ(findings(group("GRNOD", "PART", 1, {1})), 0u);
  EXPECT_EQ(findings(group("GRNOD", "PART", 1, {1, 2})), 1u);
  EXPECT_EQ(findings(set(1, clause("PART", {2}))), 1u);
  EXPECT_EQ(findings(set(1, clause("PART", {1}))), 0u);
}

TEST(PartGroups, HoldWhatTheirTypeSays) {
  BuiltModel m(zoo() + group("GRPART", "PART", 1, {5, 2, 99}) + group("GRPART", "GENE", 2, {2, 4}) +
               group("GRPART", "GEN_INCR", 3, {1, 6, 2}) +
               group("GRPART", "GRPART", 4, {2, 3, -1}) + group("GRPART", "PROP", 5, {2}) +
               group("GRPART", "SUBSET", 6, {1, -2}) + group("GRPART", "PART", 7, {3, -3, -4}) +
               set(8, clause("PART", {6, 1})));
  const auto parts = [&](std::int64_t id) {
    Ids out;
    if (const auto* list = m.selections().part_group(id))
      for (const std::uint32_t p : *list) out.push_back(m.model().parts[p].id);
    return out;
  };
  EXPECT_EQ(parts(1), (Ids{2, 5}));
  EXPECT_EQ(parts(2), (Ids{2, 3, 4}));
  EXPECT_EQ(parts(3), (Ids{1, 3, 5}));
  EXPECT_EQ(parts(4), (Ids{1, 3, 4}));
  EXPECT_EQ(parts(5), (Ids{4, 5}));
  EXPECT_EQ(parts(6), (Ids{1, 2, 4, 5})) << "listed already";
  EXPECT_EQ(parts(7), (Ids{3}));
  EXPECT_EQ(parts(8), (Ids{1, 6}));
  EXPECT_EQ(m.selections().part_group(99), nullptr);
}

// ---- surfaces ----------------------------------------------------------------------------------

using Faces = std::vector<Ids>;

TEST(Surfaces, OfShellsAreSelectedByAllTheirOwners) {
  BuiltModel m(zoo() + box(1, 1, 6) + box(2, 5, 7) + group("SURF", "PROP", 1, {1}) +
               group("SURF", "MAT", 2, {7}) + group("SURF", "BOX", 3, {1}) +
               group("SURF", "BOX", 4, {-1}) + group("SURF", "BOX", 5, {1, -1}) +
               group("SURF", "BOX2", 6, {2}) + group("SURF", "BOX2", 7, {-2}) +
               group("GRSH3N", "SH3N", 1, {22, 23}) + group("SURF", "GRSH3N", 8, {1}) +
               group("SURF", "GRSH3N", 9, {-1}) + group("SURF", "BOX", 10, {-2, 1}));
  const Faces four{{3, 4, 5, 6}, {5, 6, 7, 8}, {1, 2, 3, 4}};  // by ids 11, 12, 13
  const Faces three{{7, 8, 9, 9}, {8, 9, 10, 10}, {5, 6, 7, 7}};
  Faces all = four;
  all.insert(all.end(), three.begin(), three.end());
  EXPECT_EQ(m.surface(1), all);
  EXPECT_EQ(m.surface(2), Faces{});
  EXPECT_EQ(m.surface(3), (Faces{{3, 4, 5, 6}, {1, 2, 3, 4}}));
  EXPECT_EQ(m.surface(4), (Faces{{6, 5, 4, 3}, {4, 3, 2, 1}}));
  EXPECT_EQ(m.surface(5), m.surface(3)) << "the plain one counts";
  EXPECT_EQ(m.surface(6), (Faces{{3, 4, 5, 6}, {5, 6, 7, 8}, {7, 8, 9, 9}, {5, 6, 7, 7}}));
  EXPECT_EQ(m.surface(7), (Faces{{6, 5, 4, 3}, {8, 7, 6, 5}, {9, 8, 7, 7}, {7, 6, 5, 5}}));
  EXPECT_EQ(m.surface(8), (Faces{{8, 9, 10, 10}, {5, 6, 7, 7}}));
  EXPECT_EQ(m.surface(9), (Faces{{10, 9, 8, 8}, {7, 6, 5, 5}}));
  EXPECT_EQ(m.surface(10), (Faces{{3, 4, 5, 6}, {1, 2, 3, 4}, {7, 6, 5, 5}}));
}

TEST(Surfaces, WithoutAWholeShellLeaveItOut) {
  const std::string shells = parts() + grid_nodes() + "/SHELL/1\n" + cells({1, 1, 2, 5, 99}) +
                             cells({2, 2, 3, 6, 5}) + group("SURF", "PART", 1, {1});
  BuiltModel m(shells);
  EXPECT_EQ(m.surface(1), (Faces{{2, 3, 6, 5}}));
}

TEST(Surfaces, AreSortedByCarrierAndIdsOfAnySize) {
  // Ids above 2^32 are read as they are; those of equal lower halves differ above.
  const std::int64_t big = std::int64_t{1} << 32;
  std::string text = parts() + grid_nodes() + "/SHELL/1\n";
  const auto wide = [](std::int64_t id, const Ids& nodes) {
    char line[32];
    std::snprintf(line, sizeof line, "%10lld", static_cast<long long>(id));
    return std::string(line) + cells(nodes);
  };
  text += wide(big + 1, {4, 5, 8, 7}) + wide(5, {1, 2, 5, 4}) + wide(big + 5, {2, 3, 6, 5}) +
          wide(1, {5, 6, 9, 8});
  BuiltModel m(text + group("SURF", "PART", 1, {1}) + group("GRSHEL", "PART", 2, {1}) +
               group("SURF", "GRSHEL", 3, {2}));
  const Faces sorted{{5, 6, 9, 8}, {1, 2, 5, 4}, {4, 5, 8, 7}, {2, 3, 6, 5}};
  EXPECT_EQ(m.surface(1), sorted);
  EXPECT_EQ(m.surface(3), sorted);
}

TEST(Surfaces, OfSegmentsNeedThreeNodesThatAreThere) {
  BuiltModel m(zoo() + "/SURF/SEG/1\ns\n" + cells({1, 1, 2, 3, 4}) + cells({2, 5, 6, 7}) +
               cells({3, 5, 6, 7, 0}) + cells({4, 5, 0, 7, 8}) + cells({5, 5, 6, 77, 8}) +
               cells({6, 5, 6, 0, 0}) + cells({7, 0, 6, 7, 8}));
  EXPECT_EQ(m.surface(1), (Faces{{1, 2, 3, 4}, {5, 6, 7, 7}, {5, 6, 7, 7}}));
}

TEST(Surfaces, DifferenceComparesSegmentsFromTheirSmallestNode) {
  BuiltModel m(zoo() + "/SURF/SEG/1\na\n" + cells({1, 3, 4, 1, 2}) + cells({2, 9, 8, 7}) +
               cells({3, 5, 6, 7, 8}) + cells({4, 8, 5, 6, 7}) + "/SURF/SEG/2\nb\n" +
               cells({1, 4, 1, 2, 3}) + "/SURF/SEG/3\nc\n" + cells({1, 7, 9, 8}) +
               "/SURF/SEG/4\nd\n" + cells({1, 7, 8, 9}) + group("SURF", "DSURF", 5, {1, -2}) +
               group("SURF", "DSURF", 6, {1, -3}) + group("SURF", "DSURF", 7, {1, -4}) +
               group("SURF", "DSURF", 8, {-1, 2}));
  EXPECT_EQ(m.surface(5), (Faces{{5, 6, 7, 8}, {7, 9, 8, 8}}));
  EXPECT_EQ(m.surface(6), (Faces{{1, 2, 3, 4}, {5, 6, 7, 8}}));
  EXPECT_EQ(m.surface(7), (Faces{{1, 2, 3, 4}, {5, 6, 7, 8}, {7, 9, 8, 8}})) << "the other sense";
  EXPECT_EQ(m.surface(8), Faces{});
}

TEST(Surfaces, OfSolidsNameTheFirstOneWithoutFaces) {
  const auto message = [](const std::string& text, RuleId rule) {
    BuiltModel m(zoo() + text);
    m.surface(1);
    for (const Diagnostic& d : m.selections().diagnostics().all())
      if (d.rule == rule) return d.message;
    return std::string();
  };
  EXPECT_EQ(message(group("SURF", "PART", 1, {4}), RuleId::DK155),
            "/SURF/PART 1 selects 2 solids but does not say which faces; the first is solid 33 of "
            "part 4");
  EXPECT_EQ(message(group("SURF", "PART", 1, {5}), RuleId::DK155),
            "/SURF/PART 1 selects 1 solid but does not say which faces; the first is solid 32 of "
            "part 5");
  EXPECT_EQ(message(group("SURF", "PART", 1, {1}), RuleId::DK155), "");
}

// ---- lines -------------------------------------------------------------------------------------

TEST(Lines, OfElementsAreThoseOfTrussesBeamsAndSprings) {
  BuiltModel m(zoo() + box(1, 9, 13) + box(2, 28, 29) + group("LINE", "PART", 1, {6}) +
               group("LINE", "PROP", 2, {3}) + group("LINE", "MAT", 3, {1}) +
               group("LINE", "SUBSET", 4, {1}) + group("LINE", "BOX", 5, {1}) +
               group("LINE", "BOX2", 6, {2}) + group("GRTRUS", "TRUS", 1, {42, 43}) +
               group("GRBEAM", "BEAM", 1, {52}) + group("GRSPRI", "SPRI", 1, {61}) +
               group("LINE", "GRTRUS", 7, {1}) + group("LINE", "GRBEAM", 8, {1}) +
               group("LINE", "GRSPRI", 9, {1}) + group("LINE", "LINE", 10, {8, 7, 9}) +
               group("LINE", "PART", 11, {3, 1}));
  EXPECT_EQ(m.line(1), (Faces{{1, 9}, {9, 10}, {2, 10}, {10, 12}, {3, 11}, {11, 13}}));
  EXPECT_EQ(m.line(2), (Faces{{1, 9}, {9, 10}, {2, 10}, {10, 12}, {3, 11}, {11, 13}}));
  EXPECT_EQ(m.line(3), (Faces{{1, 9}, {9, 10}, {10, 27}, {2, 10}, {10, 12}, {12, 28}}))
      << "without springs";
  EXPECT_EQ(m.line(4), Faces{});
  EXPECT_EQ(m.line(5), (Faces{{9, 10}, {10, 12}, {11, 13}}));
  EXPECT_EQ(m.line(6), (Faces{{12, 28}, {13, 29}}));
  EXPECT_EQ(m.line(7), (Faces{{10, 27}, {1, 9}})) << "in the order of the list";
  EXPECT_EQ(m.line(8), (Faces{{12, 28}}));
  EXPECT_EQ(m.line(9), (Faces{{11, 13}}));
  EXPECT_EQ(m.line(10), (Faces{{12, 28}, {10, 27}, {1, 9}, {11, 13}}));
  EXPECT_EQ(m.line(11), (Faces{{10, 27}, {12, 28}, {13, 29}}));
}

TEST(Lines, KnowTheElementBehindEachEdge) {
  BuiltModel m(zoo() + group("LINE", "PART", 1, {3}) + group("SURF", "PART", 1, {1}) +
               group("LINE", "SURF", 2, {1}) + "/LINE/SEG/3\nl\n" + cells({1, 5, 2}));
  const auto carriers = [&](std::int64_t id) {
    std::vector<std::pair<Carrier, std::uint32_t>> out;
    for (const Edge& e : m.selections().line(id)->edges) out.emplace_back(e.carrier, e.element);
    return out;
  };
  EXPECT_EQ(carriers(1), (std::vector<std::pair<Carrier, std::uint32_t>>{
                             {Carrier::truss, 2}, {Carrier::beam, 2}, {Carrier::spring, 2}}));
  EXPECT_EQ(carriers(3),
            (std::vector<std::pair<Carrier, std::uint32_t>>{{Carrier::none, no_index}}));
  for (const Edge& e : m.selections().line(2)->edges) {
    const Elements& family =
        m.model().family(e.carrier == Carrier::shell4 ? ElementKind::shell4 : ElementKind::shell3);
    const NodeIndex* n = family.of(e.element);
    for (const NodeIndex end : e.nodes)
      EXPECT_NE(std::find(n, n + family.width, end), n + family.width);
  }
}

TEST(Lines, LeaveOutElementsWithoutLengthAndSegmentsWithoutNodes) {
  BuiltModel m(parts() + grid_nodes() + "/SPRING/6\n" + cells({1, 1, 1}) + cells({2, 1, 2}) +
               cells({3, 1, 99}) + cells({4, 5}) + group("LINE", "PART", 1, {6}) +
               "/LINE/SEG/2\nl\n" + cells({1, 5, 99}) + cells({2, 99, 5}) + cells({3, 5, 0}) +
               cells({4, 3, 5}));
  EXPECT_EQ(m.line(1), (Faces{{1, 2}}));
  EXPECT_EQ(m.line(2), (Faces{{3, 5}}));
  EXPECT_EQ(m.message(RuleId::DK150), 78);
}

TEST(Lines, FreeEdgesAreThoseOfOneSegment) {
  BuiltModel m(zoo() + "/SURF/SEG/1\ns\n" + cells({1, 4, 3, 2, 1}) + cells({2, 3, 4, 5}) +
               cells({3, 4, 3, 6}) + group("LINE", "EDGE", 1, {1}) + group("LINE", "SURF", 2, {1}));
  EXPECT_EQ(m.line(1), (Faces{{1, 2}, {2, 3}, {1, 4}, {3, 5}, {4, 5}, {3, 6}, {4, 6}}));
  EXPECT_EQ(m.line(2), (Faces{{1, 2}, {2, 3}, {1, 4}, {3, 4}, {3, 5}, {4, 5}, {3, 6}, {4, 6}}));
}

// ---- sets --------------------------------------------------------------------------------------

TEST(Sets, HaveElementsOfEveryKind) {
  const char* names[] = {"SHELL", "SH3N", "SOLID", "TRUSS", "BEAM", "SPRING"};
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const Kind& k = kinds[i];
    const std::int64_t a = k.ids[0], b = k.ids[1], c = k.ids[2];
    const std::string name = names[i];
    BuiltModel m(zoo() + set(1, clause(name, {c, a})) + set(2, clause(name + "_G", {b, a, 1})) +
                 set(3, clause(name + "_G", {b, a, 2})) +
                 set(4, clause("ALL", {}) + clause(name + "_I", {b})) +
                 set(5, clause(name, {a, b, c}) + clause(name + "_D", {b})) +
                 set(6, clause(name, {a, 77})));
    const auto nodes = [&](const Ids& ids) { return nodes_of(k, ids); };
    EXPECT_EQ(m.group(1), nodes({a, c})) << name;
    EXPECT_EQ(elements(m, k, 1), (Ids{a, c})) << name;
    EXPECT_EQ(m.group(2), nodes(k.ids)) << name;
    EXPECT_EQ(m.group(3), nodes({a, b})) << name;
    EXPECT_EQ(elements(m, k, 4), Ids{b}) << name;
    EXPECT_EQ(elements(m, k, 5), (Ids{a, c})) << name;
    EXPECT_EQ(m.group(5), nodes({a, c})) << name;
    EXPECT_EQ(m.group(6), nodes({a})) << name;
    if (k.nodes[0].size() > 2) continue;
    EXPECT_EQ(m.line(1), (Faces{k.nodes[0], k.nodes[2]})) << name;
  }
}

TEST(Sets, TakeNodesAwayAndGiveThemBack) {
  BuiltModel m(zoo() + set(1, clause("SHELL", {11, 12}) + clause("NODE_D", {5, 6})) +
               set(2, clause("SHELL", {11, 12}) + clause("NODE_D", {5, 6}) + clause("NODE", {6})) +
               set(3, clause("NODE", {1, 2, 3}) + clause("NODE_I", {2, 3, 4})) +
               set(4, clause("SHELL", {11}) + clause("NODE_I", {1, 3, 6})) +
               set(5, clause("NODE", {1, 2}) + clause("NODE_D", {2, 9}) + clause("NODE", {3})));
  EXPECT_EQ(m.group(1), (Ids{3, 4, 7, 8}));
  EXPECT_EQ(m.group(2), (Ids{3, 4, 6, 7, 8}));
  EXPECT_EQ(m.group(3), (Ids{2, 3}));
  EXPECT_EQ(m.group(4), (Ids{3, 6}));
  EXPECT_EQ(m.group(5), (Ids{1, 3}));
}

TEST(Sets, TakeSegmentsAndEdgesAwayInAnySense) {
  const std::string all = clause("SEG", {1, 1, 2, 3, 4}) + clause("", {2, 5, 6, 7}) +
                          clause("", {3, 8, 9}) + clause("", {4, 9, 10});
  BuiltModel m(zoo() + set(1, all) +
               set(2, all + clause("SEG_D", {1, 4, 3, 2, 1}) + clause("", {2, 9, 8})) +
               set(3, all + clause("SEG_I", {1, 7, 5, 6}) + clause("", {2, 10, 9})));
  EXPECT_EQ(m.surface(1), (Faces{{5, 6, 7, 7}, {1, 2, 3, 4}}));
  EXPECT_EQ(m.line(1).size(), 2u + 3u + 4u);
  EXPECT_EQ(m.surface(2), (Faces{{5, 6, 7, 7}}));
  const auto has = [&](std::int64_t id, const Ids& edge) {
    const auto lines = m.line(id);
    return std::find(lines.begin(), lines.end(), edge) != lines.end();
  };
  EXPECT_FALSE(has(2, {8, 9}));
  EXPECT_TRUE(has(2, {9, 10}));
  EXPECT_EQ(m.surface(3), (Faces{{5, 6, 7, 7}}));
  EXPECT_FALSE(has(3, {8, 9}));
  EXPECT_TRUE(has(3, {9, 10}));
}

TEST(Sets, OfBoxesHaveElementsAndNodes) {
  BuiltModel m(zoo() + box(1, 3, 8) + box(2, 28, 30) + set(1, clause("BOX", {1})) +
               set(2, clause("BOX2", {2})) + set(3, clause("BOX", {1, 2})));
  EXPECT_EQ(m.surface(1), (Faces{{3, 4, 5, 6}, {5, 6, 7, 8}, {5, 6, 7, 7}}));
  EXPECT_EQ(m.group(1), (Ids{3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(m.line(2), (Faces{{12, 28}, {13, 29}}));
  EXPECT_EQ(m.group(2), (Ids{12, 13, 28, 29, 30}));
  EXPECT_EQ(m.group(3), (Ids{3, 4, 5, 6, 7, 8, 28, 29, 30}));
}

TEST(Sets, OfPartsGenerateThemAndKeepTheirParts) {
  BuiltModel m(zoo() + set(1, clause("PART_G", {1, 3, 2})) + set(2, clause("SUBS_G", {2, 9, 1})) +
               set(3, clause("PART", {1, 2, 3}) + clause("PART_D", {2})) +
               set(4, clause("PART", {1, 2, 3}) + clause("PART_I", {2, 3, 4})) +
               set(5, clause("SET_G", {1, 3, 2})) + set(6, clause("SET", {1, 2})) +
               set(7, clause("SUBS", {1})));
  const auto parts = [&](std::int64_t id) {
    Ids out;
    for (const std::uint32_t p : *m.selections().part_group(id))
      out.push_back(m.model().parts[p].id);
    return out;
  };
  EXPECT_EQ(parts(1), (Ids{1, 3}));
  EXPECT_EQ(parts(2), (Ids{4, 5}));
  EXPECT_EQ(parts(3), (Ids{1, 3}));
  EXPECT_EQ(parts(4), (Ids{2, 3}));
  EXPECT_EQ(parts(5), (Ids{1, 3}));
  EXPECT_EQ(parts(6), (Ids{1, 3, 4, 5}));
  EXPECT_EQ(parts(7), (Ids{1, 2, 4, 5}));
}

TEST(Sets, OptionsReverseAndShowAllFacesOfTheirElementsAlone) {
  BuiltModel m(zoo() + set(1, clause("SHELL_O", {11}) + clause("SHELL", {12})) +
               set(2, clause("SH3N_O", {21}) + clause("SH3N", {22})) +
               set(3, clause("SOLID_A", {33, 31})) + set(4, clause("SOLID", {33, 31})) +
               set(5, clause("PART_O", {2})));
  EXPECT_EQ(m.surface(1), (Faces{{6, 5, 4, 3}, {5, 6, 7, 8}}));
  EXPECT_EQ(m.surface(2), (Faces{{9, 8, 7, 7}, {8, 9, 10, 10}}));
  EXPECT_EQ(m.surface(3).size(), 12u);
  EXPECT_EQ(m.surface(4).size(), 10u);
  EXPECT_EQ(m.surface(5), (Faces{{8, 7, 6, 5}, {10, 9, 8, 8}}));
}

TEST(Sets, HaveTheirThreeViewsAtOnce) {
  BuiltModel m(zoo() + set(1, clause("PART", {1}) + clause("TRUSS", {42}) + clause("NODE", {30})) +
               set(2, clause("PART", {1}) + clause("TRUSS", {42}) + clause("NODE", {30})));
  const SetGeneral* s = m.selections().set(1);
  ASSERT_NE(s, nullptr);
  EXPECT_EQ(s->id, 1);
  EXPECT_EQ(s->title, "set");
  EXPECT_EQ(m.ids(s->nodes), m.group(2));
  EXPECT_EQ(m.ids(s->nodes), (Ids{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 27, 30}));
  EXPECT_EQ(s->segments.size(), m.surface(2).size());
  EXPECT_EQ(s->segments.size(), 4u);
  EXPECT_EQ(m.edges(s->edges), m.line(2));
  EXPECT_EQ(s->parts, (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(m.surface(1), m.surface(2));
  EXPECT_EQ(m.selections().set(9), nullptr);
  EXPECT_TRUE(m.selections().complete());
  EXPECT_EQ(m.selections().ids("set"), (Ids{1, 2}));
  EXPECT_TRUE(m.selections().where("set", 2));
  EXPECT_FALSE(m.selections().where("set", 9));
}

TEST(Sets, AreThereBothWaysWhereSurfaceWasAskedFirst) {
  BuiltModel m(zoo() + set(1, clause("PART", {1})));
  const Faces first = m.surface(1);
  EXPECT_EQ(m.selections().set(1)->segments.size(), first.size());
  EXPECT_EQ(m.surface(1), first);
}

}  // namespace
}  // namespace deck::test
