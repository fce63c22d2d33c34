// Groups, surfaces, lines and sets over elements of every kind: each way to select against the
// members that stand there.
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
std::vector<Kind> make_kinds() {
  const std::vector<Ids> quads{{1, 2, 3, 4}, {3, 4, 5, 6}, {5, 6, 7, 8}};
  const std::vector<Ids> triangles{{5, 6, 7}, {7, 8, 9}, {8, 9, 10}};
  std::vector<Ids> bricks;
  for (std::int64_t n = 11; n < 23; n += 4)
    bricks.push_back({n, n + 1, n + 2, n + 3, n + 4, n + 5, n + 6, n + 7});
  return {
      {"GRSHEL", "SHEL", "SHELL", "grshel", {13, 11, 12}, {1, 1, 2}, quads},
      {"GRSH3N", "SH3N", "SH3N", "grsh3n", {23, 21, 22}, {1, 1, 2}, triangles},
      {"GRBRIC", "BRIC", "BRICK", "grbric", {33, 31, 32}, {4, 4, 5}, bricks},
      {"GRTRUS", "TRUS", "TRUSS", "grtrus", {43, 41, 42}, {3, 3, 6}, {{1, 9}, {9, 10}, {10, 27}}},
      {"GRBEAM", "BEAM", "BEAM", "grbeam", {53, 51, 52}, {3, 3, 6}, {{2, 10}, {10, 12}, {12, 28}}},
      {"GRSPRI",
       "SPRI",
       "SPRING",
       "grspri",
       {63, 61, 62},
       {3, 3, 6},
       {{3, 11}, {11, 13}, {13, 29}}},
  };
}
const std::vector<Kind> kinds = make_kinds();

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
    const bool in_subset = k.parts[0] != 3;  // subset 1 has subset 2 below it
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
  // Part 3 has trusses, beams and springs, part 6 one of each: what a beam of part 6 takes away
  // does not come back, what a truss took away comes back with a spring.
  BuiltModel m(zoo() + group("GRNOD", "PART", 1, {3, -6}) + group("GRNOD", "PART", 2, {3, 6}) +
               group("GRNOD", "PART", 3, {1, -2}) + group("GRNOD", "PART", 4, {-2, 1, 4}) +
               group("GRNOD", "PART", 5, {-1}));
  EXPECT_EQ(m.group(1), (Ids{1, 2, 3, 9, 10, 11}))
      << "10 goes with truss 42 and comes back with beams; 12 and 13 go with the last family";
  EXPECT_EQ(m.group(2), (Ids{1, 2, 3, 9, 10, 11, 12, 13, 27, 28, 29}));
  EXPECT_EQ(m.group(3), (Ids{1, 2, 3, 4, 5, 6, 7})) << "5, 6, 7 come back with triangles, 8, 9 not";
  EXPECT_EQ(m.group(5), Ids{});
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
      {group("GRNOD", "BOX", 1, {77}), RuleId::DK159, 690},
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

// ---- lines -------------------------------------------------------------------------------------

TEST(Lines, OfElementsAreThoseOfTrussesBeamsAndSprings) {
  BuiltModel m(zoo() + box(1, 9, 13) + box(2, 28, 29) + group("LINE", "PART", 1, {3}) +
               group("LINE", "PROP", 2, {3}) + group("LINE", "MAT", 3, {1}) +
               group("LINE", "SUBSET", 4, {1}) + group("LINE", "BOX", 5, {1}) +
               group("LINE", "BOX2", 6, {2}) + group("GRTRUS", "TRUS", 1, {42, 43}) +
               group("GRBEAM", "BEAM", 1, {52}) + group("GRSPRI", "SPRI", 1, {61}) +
               group("LINE", "GRTRUS", 7, {1}) + group("LINE", "GRBEAM", 8, {1}) +
               group("LINE", "GRSPRI", 9, {1}) + group("LINE", "LINE", 10, {8, 7, 9}) +
               group("LINE", "PART", 11, {6, 1}));
  EXPECT_EQ(m.line(1), (Faces{{1, 9}, {9, 10}, {2, 10}, {10, 12}, {3, 11}, {11, 13}}));
  EXPECT_EQ(m.line(2), (Faces{{10, 27}, {12, 28}, {13, 29}}));
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

}  // namespace
}  // namespace deck::test
