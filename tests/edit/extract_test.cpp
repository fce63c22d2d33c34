// Extraction: a small deck whose contacts are those of the whole one.
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "../contact/small_deck.hpp"
#include "deck/edit/convert.hpp"
#include "edit/extract_support.hpp"

namespace deck {
namespace {

using edit_test::contact_text;
using edit_test::Whole;

Rewrite extract(const Whole& w, const std::vector<std::int64_t>& ids) {
  return extract_contacts(w.context(), ids);
}

/// The small deck, after checking that effective values and contacts are the same.
std::unique_ptr<Whole> same_contacts(const Whole& w, const std::vector<std::int64_t>& ids) {
  const Rewrite r = extract(w, ids);
  for (const LossEntry& e : r.losses)
    EXPECT_NE(e.loss, Loss::approximated) << e.field << " " << e.old_text << " " << e.new_text;
  auto small = w.after(r);
  const std::set<std::int64_t> only(ids.begin(), ids.end());
  edit_test::expect_same(contact_text(w, only), contact_text(*small, only));
  EXPECT_TRUE(small->deck.end_seen);
  return small;
}

/// A plate of 2 x 2 shells (part 1), one shell above it (part 2), one far away (part 9).
test::SmallDeck plates() {
  test::SmallDeck d;
  for (int i = 0; i < 9; ++i) d.node(i + 1, i % 3 * 10.0, i / 3 * 10.0, 0.0);
  for (int i = 0; i < 4; ++i) d.node(i + 11, 5 + i % 2 * 9.0, 5 + i / 2 * 9.0, 1.0);
  for (int i = 0; i < 4; ++i) d.node(i + 91, 500 + i % 2 * 9.0, i / 2 * 9.0, 0.0);
  d.shell_part(1, 1.5).shell_part(2, 2.5).shell_part(9, 3.5);
  d.shell(1, 1, 1, 2, 5, 4).shell(1, 2, 2, 3, 6, 5).shell(1, 3, 4, 5, 8, 7).shell(1, 4, 5, 6, 9, 8);
  d.shell(2, 11, 11, 12, 14, 13).shell(9, 91, 91, 92, 94, 93);
  d.group("/SURF/PART/1", {1}).group("/SURF/PART/2", {2}).group("/GRNOD/PART/2", {2});
  d.group("/SURF/PART/9", {9}).group("/GRNOD/PART/9", {9});
  return d;
}

TEST(Extract, KeepsWhatTheInterfaceNeedsAndNothingElse) {
  const auto w = Whole::text(plates()
                                 .add("@/INTER/TYPE7/1 Igap=1 Istf=4 Inacti=5")
                                 .add("@/INTER/TYPE7/2 grnd_IDs=9 surf_IDm=9 Igap=1")
                                 .text());
  const auto small = same_contacts(*w, {1});
  EXPECT_EQ(small->model.nodes.size(), 13u);
  EXPECT_EQ(small->model.shell4.size(), 5u);
  EXPECT_EQ(small->model.parts.size(), 2u);
  EXPECT_EQ(small->model.materials.size(), 1u);
  EXPECT_EQ(small->interfaces.ordered.size(), 1u);
  EXPECT_FALSE(small->contains("/SURF/PART/9"));
}

TEST(Extract, SeveralInterfacesInOneDeck) {
  const auto w = Whole::text(plates()
                                 .add("@/INTER/TYPE7/1 Igap=1 Istf=4 Inacti=5")
                                 .add("@/INTER/TYPE7/2 grnd_IDs=9 surf_IDm=9 Igap=1")
                                 .add("@/INTER/TYPE7/3 grnd_IDs=9 surf_IDm=1 Igap=1")
                                 .text());
  EXPECT_EQ(same_contacts(*w, {2, 1})->interfaces.ordered.size(), 2u);
}

TEST(Extract, ElementOfAnotherPartAtASharedNodeDecidesTheGap) {
  // Part 3 hangs on node 11 of the secondary side and is thicker than part 2.
  const auto w = Whole::text(plates()
                                 .shell_part(3, 8)
                                 .node(21, 0, 0, 50)
                                 .node(22, 9, 0, 50)
                                 .node(23, 9, 9, 50)
                                 .shell(3, 31, 11, 21, 22, 23)
                                 .add("@/INTER/TYPE7/1 Igap=1 Istf=4 Inacti=5")
                                 .text());
  const auto small = same_contacts(*w, {1});
  EXPECT_EQ(small->model.shell4.size(), 6u);
}

TEST(Extract, PlainSegmentsKeepTheirCarriers) {
  const auto w = Whole::text(plates()
                                 .segments("/SURF/SEG/5", {{1, 2, 5, 4}, {2, 3, 6, 5}})
                                 .group("/GRNOD/NODE/5", {11, 12, 93})
                                 .add("@/INTER/TYPE7/1 grnd_IDs=5 surf_IDm=5 Igap=1 Inacti=6")
                                 .text());
  const auto small = same_contacts(*w, {1});
  EXPECT_NE(small->model.nodes.map.find(93), no_index);
}

TEST(Extract, InnerSolidsStaySoThatOuterFacesStayOuter) {
  test::SmallDeck d = plates();
  d.solid_part(4);
  for (int i = 0; i < 64; ++i) d.node(101 + i, i % 4 * 10, i / 4 % 4 * 10, -50 + i / 16 * 10);
  int id = 100;
  for (int z = 0; z < 3; ++z)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x) {
        const int n = 101 + x + 4 * y + 16 * z;
        d.brick(4, ++id, {n, n + 1, n + 5, n + 4, n + 16, n + 17, n + 21, n + 20});
      }
  d.group("/SURF/PART/EXT/4", {4}).add("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=4 Gapmin=1");
  const auto small = same_contacts(*Whole::text(d.text()), {1});
  EXPECT_EQ(small->model.solid8.size(), 27u);
}

TEST(Extract, GroupsOfGroupsAndRemovedMembersStay) {
  const auto w = Whole::text(plates()
                                 .group("/GRNOD/NODE/7", {12, 13})
                                 .group("/GRNOD/GRNOD/8", {2, -7})
                                 .group("/SURF/SURF/8", {1, 9})
                                 .add("@/INTER/TYPE7/1 grnd_IDs=8 surf_IDm=8 Igap=1")
                                 .text());
  same_contacts(*w, {1});
}

TEST(Extract, SubsetsSelectTheWholeTree) {
  const std::string subsets = "/SUBSET/1\ntop\n         2\n/SUBSET/2\nleaf\n\n";
  std::string text = plates()
                         .add(subsets)
                         .group("/GRNOD/SUBSET/5", {1})
                         .add("@/INTER/TYPE7/1 grnd_IDs=5 surf_IDm=1 Igap=1")
                         .text();
  // Part 2 belongs to the child.
  const std::string part = "/PART/2\npart\n         2         1         0";
  const auto at = text.find(part);
  ASSERT_NE(at, std::string::npos);
  text[at + part.size() - 1] = '2';
  const auto w = Whole::text(text);
  const auto small = same_contacts(*w, {1});
  EXPECT_TRUE(small->contains("/SUBSET/2"));
}

TEST(Extract, SetsByEveryKindOfClause) {
  const std::string sets =
      "/SET/GENERAL/51\nnodes\nNODE              11        12        91\nPART               2\n"
      "/SET/GENERAL/52\nfaces\nSHELL              1         2\nSEG                1         4"
      "         5         8         7\nSHELL_D            1\n"
      "/SET/GENERAL/53\nall of them\nSET               51        52\n";
  const auto w = Whole::text(plates()
                                 .add("@/INTER/TYPE7/1 grnd_IDs=51 surf_IDm=52 Igap=1 Inacti=5")
                                 .add("@/INTER/TYPE19/2 surf_IDs=53 surf_IDm=53 Igap=1")
                                 .add(sets)
                                 .text());
  same_contacts(*w, {1});
  same_contacts(*w, {2});
}

TEST(Extract, BoxSelectionsKeepTheirElements) {
  const std::string box =
      "/BOX/RECTA/1\nbox\n\n               -1.00               -1.00               -1.00\n"
      "               15.00               15.00                2.00\n";
  const auto w = Whole::text(plates()
                                 .add(box)
                                 .group("/SURF/BOX/5", {1})
                                 .group("/GRNOD/BOX/5", {1})
                                 .add("@/INTER/TYPE7/1 grnd_IDs=5 surf_IDm=5 Igap=1")
                                 .text());
  same_contacts(*w, {1});
}

TEST(Extract, BoxSelectionsKeepElementsWithoutAPart) {
  const std::string box =
      "/BOX/RECTA/1\nbox\n\n               -1.00               -1.00               -1.00\n"
      "               15.00               15.00                2.00\n";
  test::SmallDeck d = plates();
  d.node(201, 400, 0, 0).node(202, 401, 0, 0).node(203, 401, 1, 0).node(204, 400, 1, 0);
  const auto w = Whole::text(d.shell(77, 201, 201, 202, 203, 204)
                                 .add(box)
                                 .group("/SURF/BOX/5", {1})
                                 .add("@/INTER/TYPE7/1 surf_IDm=5 Igap=1")
                                 .text());
  const auto small = same_contacts(*w, {1});
  EXPECT_TRUE(small->contains("/SHELL/77"));
}

TEST(Extract, FrictionFunctionsSensorsAndDefaultsComeAlong) {
  const std::string more =
      "/FUNCT/4\nramp\n                 0.0                 0.0\n                 1.0"
      "                 1.0\n/FUNCT/5\nunused\n                 0.0                 0.0\n"
      "/SENSOR/TIME/6\nlate\n                 5.0\n/FRICTION/7\nf\n\n\n"
      "                                     0.3\n"
      "                             1         2\n\n                                     0.4\n";
  const auto w = Whole::text(plates()
                                 .add(more)
                                 .add("@/DEFAULT/INTER/TYPE7 Igap=1 Inacti=5")
                                 .add("@/INTER/TYPE7/1 sens_ID=6 fct_IDF=4 fric_ID=7 AscaleF=2")
                                 .text());
  const auto small = same_contacts(*w, {1});
  EXPECT_TRUE(small->contains("/FUNCT/4\n"));
  EXPECT_FALSE(small->contains("/FUNCT/5\n"));
  EXPECT_TRUE(small->contains("/SENSOR/TIME/6\n"));
  EXPECT_TRUE(small->contains("/FRICTION/7\n"));
  EXPECT_TRUE(small->contains("/DEFAULT/INTER/TYPE7\n"));
}

/// /MOVE_FUNCT changes the function of its id; a cell that names a function may name a table.
TEST(Extract, FunctionsComeWithWhatMovesThemAndTablesWithTheirFunctions) {
  const auto ramp = [](const char* id) {
    return std::string("/FUNCT/") + id +
           "\nramp\n                 0.0                 0.0\n"
           "                 1.0                 1.0";
  };
  const auto move = [](const char* id) {
    return std::string("/MOVE_FUNCT/") + id + "\nmove\n                 1.0                 2.0";
  };
  const std::string more = ramp("4") + "\n" + ramp("5") + "\n" + ramp("8") + "\n" + move("4") +
                           "\n" + move("5") +
                           "\n/TABLE/1/6\ntable\n         1\n         8\n"
                           "/TABLE/1/7\nunused\n         1\n         5";
  const auto w =
      Whole::text(plates().add(more).add("@/INTER/TYPE7/1 fct_IDF=4 fct_IDK=6 Ithe=1").text());
  const auto small = w->after(extract(*w, {1}));
  for (const char* kept : {"/FUNCT/4\n", "/MOVE_FUNCT/4\n", "/TABLE/1/6\n", "/FUNCT/8\n"})
    EXPECT_TRUE(small->contains(kept)) << kept;
  for (const char* gone : {"/FUNCT/5\n", "/MOVE_FUNCT/5\n", "/TABLE/1/7\n"})
    EXPECT_FALSE(small->contains(gone)) << gone;
}

TEST(Extract, TransformationsOfKeptNodesStay) {
  const auto w = Whole::text(
      plates()
          .group("/GRNOD/PART/1", {1})
          .add("/TRANSFORM/TRA/1\nmove\n         1                 0.0                 0.0"
               "                0.25")
          .add("/TRANSFORM/TRA/2\nmove\n         9                 0.0                 0.0"
               "                0.25")
          .add("@/INTER/TYPE7/1 Igap=1")
          .text());
  const auto small = same_contacts(*w, {1});
  EXPECT_TRUE(small->contains("/TRANSFORM/TRA/1"));
  EXPECT_FALSE(small->contains("/TRANSFORM/TRA/2"));
}

TEST(Extract, NoiseNeedsAllNodesInTheirOrder) {
  const auto w = Whole::text(
      plates().add("/RANDOM\n                0.01").add("@/INTER/TYPE7/1 Igap=1").text());
  ASSERT_TRUE(w->model.has_random);
  EXPECT_EQ(same_contacts(*w, {1})->model.nodes.size(), w->model.nodes.size());
}

TEST(Extract, SubmodelsKeepTheirOffsets) {
  const auto w =
      Whole::text(plates()
                      .add("//SUBMODEL/3\nsub\n      1000\n")
                      .add("/NODE\n         1                 0.0                 0.0"
                           "                 0.5\n         2                 5.0"
                           "                 0.0                 0.5\n         3"
                           "                 5.0                 5.0                 0.5")
                      .add("/SH3N/1\n         1         1         2         3")
                      .add("/PART/1\nin\n         1         1")
                      .add("/PROP/SHELL/1\np\n\n\n         3                           0.7")
                      .add("/MAT/ELAST/1\nm\n               1e-06\n               100.0")
                      .add("/GRNOD/PART/1\ng\n         1")
                      .add("/RBODY/1\nr\n         1")
                      .add("//ENDSUB")
                      .add("//SUBMODEL/4\nother\n      2000\n\n/RBODY/1\nr\n         1")
                      .add("//ENDSUB")
                      .add("@/INTER/TYPE7/1 grnd_IDs=1001 Igap=1 Inacti=5")
                      .text());
  ASSERT_EQ(w->model.shell3.id.at(0), 1001);
  const auto small = same_contacts(*w, {1});
  EXPECT_EQ(small->deck.submodels.size(), 1u);
  EXPECT_FALSE(small->contains("/RBODY"));
}

TEST(Extract, SolidsOfTwoLinesAreCopiedWhole) {
  test::SmallDeck d = plates();
  d.solid_part(4);
  const double x[10][3] = {{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {0, 0, 8}, {4, 0, 0},
                           {4, 4, 0}, {0, 4, 0}, {0, 0, 4}, {4, 0, 4}, {0, 4, 4}};
  for (int i = 0; i < 10; ++i) d.node(201 + i, x[i][0], x[i][1], x[i][2] + 1.5);
  d.add(
      "/TETRA10/4\n# id\n       301\n       201       202       203       204       205       206"
      "       207       208       209       210");
  d.group("/SURF/PART/EXT/4", {4}).add("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=4 Gapmin=3");
  const auto small = same_contacts(*Whole::text(d.text()), {1});
  EXPECT_EQ(small->model.solid8.size(), 1u);
}

TEST(Extract, CarriageReturnsStay) {
  std::string text = plates().add("@/INTER/TYPE7/1 Igap=1").text(), crlf;
  for (const char c : text) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const auto w = Whole::text(crlf);
  const auto small = same_contacts(*w, {1});
  const std::string out = small->main_text();
  for (std::size_t at = out.find('\n'); at != std::string::npos; at = out.find('\n', at + 1))
    ASSERT_EQ(out[at - 1], '\r');
}

TEST(Extract, WorksThroughIncludesAndParameters) {
  std::string text = plates().add("@/INTER/TYPE7/1 Igap=1 Gapmin=&gap").text();
  const auto cut = text.find("\n/SHELL/1\n") + 1;
  ASSERT_NE(cut, 0u);
  const auto stop = text.find("/SURF/PART/1");
  const std::string part =
      "/PARAMETER/LOCAL/REAL/1\np\ngap                        9.5\n" + text.substr(cut, stop - cut);
  const std::string global = "/PARAMETER/GLOBAL/REAL/1\np\ngap                        0.5\n";
  const auto w = Whole::read(
      "main_0000.rad",
      {{"main_0000.rad", text.substr(0, cut) + global + "#include part.inc\n" + text.substr(stop)},
       {"part.inc", part}});
  ASSERT_EQ(w->interfaces.type7.at(0).Gapmin.value, 0.5);
  EXPECT_EQ(same_contacts(*w, {1})->deck.includes.size(), 0u);
}

TEST(Extract, NamesWhatWasLeftOut) {
  const auto w = Whole::text(
      plates()
          .add("/RBODY/1\nr\n         1\n/RBODY/2\nr\n         1\n@/INTER/TYPE7/1 Igap=1")
          .text());
  const Rewrite r = extract(*w, {1});
  bool found = false;
  for (const LossEntry& e : r.losses)
    if (e.keyword == "/RBODY") {
      found = true;
      EXPECT_EQ(e.loss, Loss::dropped);
      EXPECT_EQ(e.id, 1);
      EXPECT_EQ(e.note.substr(0, 2), "2 ");
    }
  EXPECT_TRUE(found);
}

TEST(Extract, EarlierInterfaceThatMovesNodesIsNamed) {
  const auto w = Whole::text(plates()
                                 .add("@/INTER/TYPE7/1 Igap=1 Inacti=3")
                                 .add("@/INTER/TYPE7/2 Igap=1 Inacti=5 Irem_i2=1")
                                 .add("@/INTER/TYPE2/3 Ignore=1 dsearch=3")
                                 .text());
  const Rewrite r = extract(*w, {2});
  std::size_t questions = 0;
  for (const LossEntry& e : r.losses)
    questions += e.field == "Inacti" || e.field == "Irem_i2" ? 1 : 0;
  EXPECT_EQ(questions, 2u);
}

TEST(Extract, ATieComesWithWhatItTiesAndAContactWithItsTies) {
  for (const char* type : {"24", "25"}) {
    SCOPED_TRACE(type);
    const auto w = Whole::text(
        plates()
            .add(std::string("@/INTER/TYPE") + type + "/2 surf_ID2=1 grnd_IDs=2 Inacti=5")
            .add("@/INTER/TYPE2/3 Ignore=2 dsearch=0 grnd_IDs=2 surf_IDm=1")
            .add("@/INTER/TYPE2/4 Ignore=1 dsearch=30 grnd_IDs=2 surf_IDm=1")
            .text());
    const auto irem = [](const Rewrite& r) {
      return std::count_if(r.losses.begin(), r.losses.end(),
                           [](const LossEntry& e) { return e.field == "Irem_i2"; });
    };
    EXPECT_EQ(irem(extract(*w, {2, 3})), 1);
    const Rewrite all = extract(*w, {2, 3, 4});
    EXPECT_EQ(irem(all), 0) << "its ties are all there";
    EXPECT_TRUE(all.refusals.empty());
    const Rewrite r = extract(*w, {3});
    ASSERT_TRUE(r.new_text.has_value());
    for (const LossEntry& e : r.losses) EXPECT_NE(e.loss, Loss::approximated) << e.field;
    const auto small = Whole::text(*r.new_text);
    const std::vector<Tie>&a = w->loaded.ties(), &b = small->loaded.ties();
    ASSERT_EQ(b.size(), 1u);
    ASSERT_EQ(a[0].nodes.size(), b[0].nodes.size());
    EXPECT_FALSE(a[0].nodes.empty());
    for (std::size_t i = 0; i < a[0].nodes.size(); ++i) {
      EXPECT_EQ(a[0].nodes[i].tied, b[0].nodes[i].tied);
      EXPECT_EQ(a[0].nodes[i].search, b[0].nodes[i].search);
      EXPECT_EQ(a[0].nodes[i].distance, b[0].nodes[i].distance);
    }
  }
}

TEST(Extract, UnknownIdsAreRefusedWithWhatThereIs) {
  const auto w = Whole::text(plates().add("@/INTER/TYPE7/1 Igap=1").text());
  const Rewrite r = extract(*w, {1, 77});
  ASSERT_EQ(r.refusals.size(), 1u);
  EXPECT_NE(r.refusals[0].find("77"), std::string::npos);
  EXPECT_NE(r.refusals[0].find("the deck has 1"), std::string::npos);
  EXPECT_FALSE(r.new_text.has_value());
  EXPECT_EQ(extract(*w, {}).refusals.size(), 1u);
}

TEST(Extract, DanglingReferencesAndLoopsDoNotHurt) {
  const auto w = Whole::text(plates()
                                 .group("/GRNOD/GRNOD/7", {8, 2, 555})
                                 .group("/GRNOD/GRNOD/8", {7})
                                 .group("/SURF/SURF/7", {7, 1, 444})
                                 .add("@/INTER/TYPE7/1 grnd_IDs=7 surf_IDm=7 fric_ID=9 sens_ID=8")
                                 .add("@/INTER/TYPE7/2 grnd_IDs=999 surf_IDm=998")
                                 .text());
  EXPECT_TRUE(extract(*w, {1}).new_text.has_value());
  EXPECT_TRUE(extract(*w, {2}).new_text.has_value());
}

/// Random meshes of several parts with shells, bricks and beams between shared nodes.
TEST(Extract, RandomModelsKeepTheirContacts) {
  std::mt19937 random(17);
  const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  for (int round = 0; round < 60; ++round) {
    test::SmallDeck d;
    constexpr int side = 5;
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < side * side; ++i)
        d.node(1 + i + 100 * k, i % side * 10.0 + 0.01 * pick(100), i / side * 10.0,
               k * (1.0 + 0.1 * pick(9)));
    for (int p = 1; p <= 4; ++p) d.shell_part(p, 0.5 + 0.5 * pick(4), pick(2) * 0.8);
    d.solid_part(5).beam_part(6, 2.0 + pick(3));
    int id = 0;
    for (int k = 0; k < 3; ++k)
      for (int y = 0; y + 1 < side; ++y)
        for (int x = 0; x + 1 < side; ++x) {
          const int n = 1 + x + side * y + 100 * k;
          ++id;
          if (k > 0 && pick(4) == 0)
            d.brick(
                5, id,
                {n - 100, n - 99, n - 99 + side, n - 100 + side, n, n + 1, n + 1 + side, n + side});
          else
            d.shell(1 + pick(4), id, n, n + 1, n + 1 + side, n + side, pick(3) == 0 ? 1.25 : 0);
          if (pick(5) == 0) d.bar("BEAM", 6, id, n, n + 1, n + side);
        }
    d.group("/SURF/PART/1", {1, 2}).group("/SURF/PART/EXT/2", {1, 5}).group("/SURF/PART/3", {-3});
    d.segments("/SURF/SEG/4", {{1, 2, 7, 6}, {102, 103, 108, 107}});
    d.group("/GRNOD/PART/1", {2, -1}).group("/GRNOD/PART/2", {5, 6}).group("/GRNOD/SURF/3", {3, 4});
    d.group("/LINE/EDGE/1", {1}).group("/LINE/SURF/2", {2}).group("/LINE/PART/3", {6});
    for (int i = 1; i <= 4; ++i)
      d.add("@/INTER/TYPE7/" + std::to_string(i) + " grnd_IDs=" + std::to_string(pick(4)) +
            " surf_IDm=" + std::to_string(1 + pick(4)) + " Igap=" + std::to_string(pick(4)) +
            " Inacti=5 Irem_gap=" + std::to_string(1 + pick(2)) +
            " Istf=" + std::to_string(pick(6)));
    d.add("@/INTER/TYPE11/5 line_IDs=" + std::to_string(1 + pick(3)) +
          " line_IDm=" + std::to_string(1 + pick(3)) + " Igap=1");
    d.add("@/INTER/TYPE19/6 surf_IDs=" + std::to_string(1 + pick(4)) +
          " surf_IDm=" + std::to_string(1 + pick(4)) + " Igap=1 Inacti=6");
    const auto w = Whole::text(d.text());
    for (std::int64_t i = 1; i <= 6; ++i) {
      same_contacts(*w, {i});
      if (::testing::Test::HasFailure()) FAIL() << "round " << round << " interface " << i;
    }
  }
}

TEST(Extract, RealDecksKeepTheContactsOfEveryInterface) {
  const std::string root = edit_test::corpus("README.md");
  if (root.empty()) GTEST_SKIP() << "no real decks here";
  std::size_t interfaces = 0;
  const auto dir = std::filesystem::path(root).parent_path();
  for (const auto& entry : std::filesystem::recursive_directory_iterator(dir)) {
    const std::string path = entry.path().string();
    if (!path.ends_with("_0000.rad") || entry.file_size() > 1500000) continue;
    const auto w = Whole::read(path);
    for (const InterBase* inter : w->interfaces.ordered) {
      same_contacts(*w, {inter->id});
      ++interfaces;
      if (::testing::Test::HasFailure()) FAIL() << path << " interface " << inter->id;
    }
  }
  EXPECT_GT(interfaces, 60u);
}

TEST(Extract, DummyWithSetsKeepsItsContacts) {
  const std::string path = edit_test::corpus("EuroSID_II/EuroSID_II_0000.rad");
  if (path.empty()) GTEST_SKIP() << "no real decks here";
  const auto w = Whole::read(path);
  for (const std::int64_t id : {15000004, 15000001, 15000011, 15000015, 15000027})
    EXPECT_LT(same_contacts(*w, {id})->model.nodes.size(), w->model.nodes.size() / 8);
}

TEST(Extract, SledWithItsIncludedDummy) {
  const std::string path = edit_test::corpus("EuroSID_II/example_es2_sled_0000.rad");
  if (path.empty()) GTEST_SKIP() << "no real decks here";
  same_contacts(*Whole::read(path), {15000007, 15000012});
}

}  // namespace
}  // namespace deck
