// Extraction: a small deck whose contacts are those of the whole one.
#include <gtest/gtest.h>

#include <random>

#include "contact/meshes.hpp"
#include "deck/edit.hpp"
#include "edit/support.hpp"

namespace deck {
namespace {

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
  EXPECT_EQ(edit_test::changed_figure(w, *small, "--extract-contacts"), "");
  EXPECT_TRUE(small->deck.end_seen);
  return small;
}

/// A plate of 2 x 2 shells (part 1), one shell above it (part 2), one far away (part 9).
test::SmallDeck plates() {
  test::SmallDeck d;
  const auto square = [](double x, double y, double z, double side) {
    return [=](int i, int j) { return std::array{x + side * i, y + side * j, z}; };
  };
  d.shell_part(1, 1.5).shell_part(2, 2.5).shell_part(9, 3.5);
  test::add_sheet(d, 1, 1, 1, 2, 2, square(0, 0, 0, 10));
  test::add_sheet(d, 2, 11, 11, 1, 1, square(5, 5, 1, 9));
  test::add_sheet(d, 9, 91, 91, 1, 1, square(500, 0, 0, 9));
  d.group("/SURF/PART/1", {1}).group("/SURF/PART/2", {2}).group("/GRNOD/PART/2", {2});
  d.group("/SURF/PART/9", {9}).group("/GRNOD/PART/9", {9});
  return d;
}

/// A deck, and texts that its extracts have and have not.
struct KeptText {
  const char* what;
  test::SmallDeck deck;
  std::vector<const char*> kept = {}, gone = {};
};

TEST(Extract, TakesAlongWhatTheContactDependsOn) {
  const auto curve = [](const char* id) {
    return std::string("/FUNCT/") + id +
           "\ncurve\n                 0.0                 0.0\n"
           "                 1.0                 1.0\n";
  };
  const std::string shift = "\nmove\n                 1.0                 2.0\n";
  const std::string box =
      "/BOX/RECTA/1\nbox\n\n               -1.00               -1.00               -1.00\n"
      "               15.00               15.00                2.00\n";
  const std::string translation =
      "\nt\n%10d                 0.0                 0.0                0.25";
  const KeptText cases[] = {
      {"a group of groups without some members",
       plates()
           .group("/GRNOD/NODE/7", {12, 13})
           .group("/GRNOD/GRNOD/8", {2, -7})
           .group("/SURF/SURF/8", {1, 9})
           .add("@/INTER/TYPE7/1 grnd_IDs=8 surf_IDm=8 Igap=1")},
      {"sets by every kind of clause",
       plates()
           .add("@/INTER/TYPE7/1 grnd_IDs=51 surf_IDm=52 Igap=1 Inacti=5")
           .add("@/INTER/TYPE19/2 surf_IDs=53 surf_IDm=53 Igap=1")
           .add("/SET/GENERAL/51\nnodes\nNODE              11        12        91\nPART            "
                "   2\n"
                "/SET/GENERAL/52\nfaces\nSHELL              1         2\n"
                "SEG                1         4         5         8         7\nSHELL_D            "
                "1\n"
                "/SET/GENERAL/53\nall of them\nSET               51        52\n")},
      {"a box around an element without a part",
       plates()
           .node(201, 400, 0, 0)
           .node(202, 401, 0, 0)
           .node(203, 401, 1, 0)
           .node(204, 400, 1, 0)
           .shell(77, 201, 201, 202, 203, 204)
           .add(box)
           .group("/SURF/BOX/5", {1})
           .add("@/INTER/TYPE7/1 surf_IDm=5 Igap=1"),
       {"/SHELL/77"}},
      {"friction, a function, a sensor and defaults",
       plates()
           .add(curve("4") + curve("5") +
                "/SENSOR/TIME/6\nlate\n                 5.0\n/FRICTION/7\nf\n\n\n"
                "                                     0.3\n"
                "                             1         2\n\n                                     "
                "0.4")
           .add("@/DEFAULT/INTER/TYPE7 Igap=1 Inacti=5")
           .add("@/INTER/TYPE7/1 sens_ID=6 fct_IDF=4 fric_ID=7 AscaleF=2"),
       {"/FUNCT/4\n", "/SENSOR/TIME/6\n", "/FRICTION/7\n", "/DEFAULT/INTER/TYPE7\n"},
       {"/FUNCT/5\n"}},
      {"what moves a function, and the functions of a table",
       plates()
           .add(curve("4") + curve("5") + curve("8") + "/MOVE_FUNCT/4" + shift + "/MOVE_FUNCT/5" +
                shift +
                "/TABLE/1/6\ntable\n         1\n         8\n/TABLE/1/7\nunused\n         1\n       "
                "  5")
           .add("@/INTER/TYPE7/1 fct_IDF=4 fct_IDK=6 Ithe=1"),
       {"/FUNCT/4\n", "/MOVE_FUNCT/4\n", "/TABLE/1/6\n", "/FUNCT/8\n"},
       {"/FUNCT/5\n", "/MOVE_FUNCT/5\n", "/TABLE/1/7\n"}},
      {"what moves its nodes",
       plates()
           .group("/GRNOD/PART/1", {1})
           .add("/TRANSFORM/TRA/1" + fmt::sprintf(translation, 1))
           .add("/TRANSFORM/TRA/2" + fmt::sprintf(translation, 9))
           .add("@/INTER/TYPE7/1 Igap=1"),
       {"/TRANSFORM/TRA/1"},
       {"/TRANSFORM/TRA/2"}},
      {"switches of the run and failure of its materials, and not of others",
       plates()
           .add("/ANALY\n         0\n/IOFLAG\n         1\n/SPMD\n         0\n/AMS\n         1")
           .add("/MAT/ELAST/5\nm\n               1e-06\n               100.0")
           .add("/FAIL/JOHNSON/1\n/FAIL/JOHNSON/5\n@/BCS/2 Tx=1 grnod_ID=2")
           .add("@/INTER/TYPE7/1 Igap=1"),
       {"/ANALY\n", "/IOFLAG\n", "/SPMD\n", "/FAIL/JOHNSON/1\n"},
       {"/AMS\n", "/BCS/2", "/FAIL/JOHNSON/5", "/MAT/ELAST/5", "/SURF/PART/9"}}};
  for (const KeptText& c : cases) {
    SCOPED_TRACE(c.what);
    const auto w = Whole::text(c.deck.text());
    for (const InterBase* inter : w->interfaces.ordered) {
      const auto small = same_contacts(*w, {inter->id});
      for (const char* text : c.kept) EXPECT_TRUE(small->contains(text)) << text;
      for (const char* text : c.gone) EXPECT_FALSE(small->contains(text)) << text;
    }
  }
}

/// Nodes of group or set 5 against part 2: the parts that are left.
TEST(Extract, LeavesThePartsThatGroupsAndSetsName) {
  const auto left = [](const test::SmallDeck& d) {
    const auto w =
        Whole::text(test::SmallDeck(d).add("@/INTER/TYPE7/1 grnd_IDs=5 surf_IDm=2").text());
    std::vector<std::int64_t> out;
    const auto small = same_contacts(*w, {1});
    for (const Part& p : small->model.parts) out.push_back(p.id);
    return out;
  };
  using Ids = std::vector<std::int64_t>;
  // All parts have material 1; properties have the numbers of the parts.
  for (const auto& [header, ids, parts] :
       {std::tuple{"/GRNOD/GENE/5", std::vector{91, 92}, Ids{2, 9}},
        {"/GRNOD/GENE/5", {2, 3}, {1, 2}},
        {"/GRNOD/NODE/5", {93}, {2, 9}},
        {"/GRNOD/MAT/5", {1}, {1, 2, 9}},
        {"/GRNOD/PROP/5", {9}, {2, 9}},
        {"/GRNOD/PART/5", {1}, {1, 2}}})
    EXPECT_EQ(left(plates().group(header, ids)), parts) << header << ids[0];
  for (const auto& [clause, parts] : {std::pair{"SHELL             91", Ids{2, 9}},
                                      {"SHELL_G            1         2         1", {1, 2}},
                                      {"SHELL_G           90        91         1", {2, 9}},
                                      {"PART_G             9        99         1", {2, 9}},
                                      {"NODE_G            91        92         1", {2, 9}},
                                      {"ALL", {1, 2, 9}}})
    EXPECT_EQ(left(plates().add(std::string("/SET/GENERAL/5\ns\n") + clause)), parts) << clause;
}

TEST(Extract, KeepsSeveralInterfacesAndAllNoisyNodes) {
  const auto w = Whole::text(plates()
                                 .add("/RANDOM\n                0.01")
                                 .add("@/INTER/TYPE7/1 Igap=1 Istf=4 Inacti=5")
                                 .add("@/INTER/TYPE7/2 grnd_IDs=9 surf_IDm=9 Igap=1")
                                 .add("@/INTER/TYPE7/3 grnd_IDs=9 surf_IDm=1 Igap=1")
                                 .text());
  EXPECT_EQ(same_contacts(*w, {2, 1})->interfaces.ordered.size(), 2u);
  EXPECT_EQ(same_contacts(*w, {1})->model.nodes.size(), w->model.nodes.size());
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
    for (std::size_t i = 0; i < a[0].nodes.size(); ++i)
      EXPECT_EQ(std::tie(a[0].nodes[i].tied, a[0].nodes[i].search, a[0].nodes[i].distance),
                std::tie(b[0].nodes[i].tied, b[0].nodes[i].search, b[0].nodes[i].distance));
  }
}

/// Random meshes of several parts with shells, bricks and beams between shared nodes.
TEST(Extract, RandomModelsKeepTheirContacts) {
  std::mt19937 random(17);
  const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  for (int round = 0; round < 60; ++round) {
    test::SmallDeck d;
    for (int p = 1; p <= 4; ++p) d.shell_part(p, 0.5 + 0.5 * pick(4), pick(2) * 0.8);
    d.solid_part(5).beam_part(6, 2.0 + pick(3));
    int id = 0;
    for (int k = 0; k < 3; ++k) {
      const auto place = [&](int i, int j) {
        return std::array{10.0 * i + 0.01 * pick(100), 10.0 * j, k * (1.0 + 0.1 * pick(9))};
      };
      const auto element = [&](int, int, const test::Corners4& n) {
        ++id;
        if (k > 0 && pick(4) == 0)
          d.brick(5, id, {n[0] - 100, n[1] - 100, n[2] - 100, n[3] - 100, n[0], n[1], n[2], n[3]});
        else
          d.shell(1 + pick(4), id, n[0], n[1], n[2], n[3], pick(3) == 0 ? 1.25 : 0);
        if (pick(5) == 0) d.bar("BEAM", 6, id, n[0], n[1], n[3]);
      };
      test::add_grid(d, 1 + 100 * k, 4, 4, place, element);
    }
    d.group("/SURF/PART/1", {1, 2}).group("/SURF/PART/EXT/2", {1, 5}).group("/SURF/PART/3", {-3});
    d.segments("/SURF/SEG/4", {{1, 2, 7, 6}, {102, 103, 108, 107}});
    d.group("/GRNOD/PART/1", {2, -1}).group("/GRNOD/PART/2", {5, 6}).group("/GRNOD/SURF/3", {3, 4});
    d.group("/LINE/EDGE/1", {1}).group("/LINE/SURF/2", {2}).group("/LINE/PART/3", {6});
    for (int i = 1; i <= 4; ++i)
      d.add(fmt::sprintf(
          "@/INTER/TYPE7/%d grnd_IDs=%d surf_IDm=%d Igap=%d Inacti=5 Irem_gap=%d Istf=%d", i,
          pick(4), 1 + pick(4), pick(4), 1 + pick(2), pick(6)));
    d.add(
        fmt::sprintf("@/INTER/TYPE11/5 line_IDs=%d line_IDm=%d Igap=1", 1 + pick(3), 1 + pick(3)));
    d.add(fmt::sprintf("@/INTER/TYPE19/6 surf_IDs=%d surf_IDm=%d Igap=1 Inacti=6", 1 + pick(4),
                       1 + pick(4)));
    const auto w = Whole::text(d.text());
    for (std::int64_t i = 1; i <= 6; ++i) {
      same_contacts(*w, {i});
      if (::testing::Test::HasFailure()) FAIL() << "round " << round << " interface " << i;
    }
  }
}

}  // namespace
}  // namespace deck
