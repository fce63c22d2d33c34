// What each stage of a loaded deck is made from, and what is made anew after another setting.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact/small_deck.hpp"
#include "deck/deck.hpp"
#include "deck/model.hpp"
#include "deck/rule_id.hpp"
#include "lint/support.hpp"
#include "model/shared/kinematics.hpp"
#include "model/shared/mesh.hpp"

namespace deck::test {
namespace {

LoadedDeck of_text(const std::string& text, const LoadOptions& options = {}) {
  auto deck = read_deck_text("small_0000.rad", text, SchemaSet::built_in(), options.read);
  EXPECT_TRUE(deck.ok());
  return LoadedDeck::from(std::move(*deck), options);
}

/// A plate of part 1 in the plane z = 0, one of part 2 above it that is not even, and cards.
struct Two {
  std::string contact = "Gapmin=0.7";
  std::string more = "";
  std::string text() const {
    SmallDeck d;
    d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
    d.node(5, 1, 1, 0.5).node(6, 9, 1, 0.5).node(7, 9, 9, 0.5).node(8, 1, 9, 0.25);
    d.shell_part(1, 1.0).shell(1, 1, 1, 2, 3, 4).shell_part(2, 1.0).shell(2, 2, 5, 6, 7, 8);
    d.group("/SURF/PART/1", {1}).group("/GRNOD/PART/2", {2});
    if (!contact.empty()) d.add("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 " + contact);
    return d.add(more).text();
  }
};

/// A plate, and nodes 11 .. 14 of a second one: beside its middle, beyond its rim, far away. Groups
/// 3 and 4 hold the first two and the others.
std::string tied(const std::string& first, const std::string& second = "") {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(11, 3, 4, 0.25).node(12, 10.25, 4, 0.25).node(13, 10.25, 8, 9).node(14, 3, 8, 0.25);
  d.shell_part(1, 1.0).shell(1, 1, 1, 2, 3, 4).shell_part(2, 1.0).shell(2, 2, 11, 12, 13, 14);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/3", {11, 12}).group("/GRNOD/NODE/4", {13, 14});
  d.add("@/INTER/TYPE2/8 grnd_IDs=3 surf_IDm=1 Ignore=1 dsearch=1 " + first);
  if (!second.empty()) d.add("@/INTER/TYPE2/9 grnd_IDs=4 surf_IDm=1 Ignore=1 dsearch=1 " + second);
  return d.text();
}

/// Ids of the nodes that a tie holds.
std::vector<std::int64_t> tied_nodes(const LoadedDeck& d) {
  std::vector<std::int64_t> out;
  const Kinematics& k = d.kinematics();
  for (NodeIndex n = 0; n < k.types.size(); ++n)
    if ((k.types[n] >> static_cast<int>(ConditionType::tied) & 1) != 0)
      out.push_back(d.model().node_id(n));
  return out;
}

std::vector<double> steps(const Mesh& mesh) { return mesh.of(ElementKind::shell4).dt; }

using Ids = std::vector<std::int64_t>;

TEST(Load, ReadsEngineFilesWithTheDeckWhereAsked) {
  const Folder folder;
  const std::string path = folder.write("d_0000.rad", Two{}.text());
  folder.write("d_0001.rad", "/RUN/d/1\n1.0\n");
  LoadOptions how;
  const auto later = load(path, how);
  how.engine_files = true;
  const auto with = load(path, how);
  ASSERT_TRUE(later);
  ASSERT_TRUE(with);
  EXPECT_EQ(with->deck().sources.size(), 2u);
  EXPECT_EQ(later->deck().sources.size(), 1u);
  EXPECT_EQ(later->engine_files().files.size(), 1u);
  EXPECT_EQ(later->deck().sources.size(), 2u);
  EXPECT_EQ(&later->engine_files(), &later->engine_files());
  EXPECT_EQ(later->deck().sources.size(), 2u);
}

TEST(Load, IsIncompleteWithoutAnIncludedFile) {
  const Folder folder;
  const auto incomplete = [&](const std::string& file, int depth) {
    folder.write("a.inc", "#include b.inc\n");
    folder.write("b.inc", file);
    LoadOptions how;
    how.read.limits.include_depth = depth;
    std::string text = Two{}.text();
    text.insert(text.rfind("/END"), "#include a.inc\n");
    const auto loaded = load(folder.write("d_0000.rad", text), how);
    EXPECT_TRUE(loaded);
    std::set<RuleId> rules;
    for (const auto& [rule, n] : loaded->found_by(Stage::deck).counts()) rules.insert(rule);
    return std::pair(loaded->incomplete(), rules);
  };
  using Found = std::pair<bool, std::set<RuleId>>;
  EXPECT_EQ(incomplete("# nothing\n", 9), (Found{false, {}}));
  EXPECT_EQ(incomplete("#include none.inc\n", 9), (Found{true, {RuleId::DK004}}));
  EXPECT_EQ(incomplete("#include a.inc\n", 9), (Found{true, {RuleId::DK005}}));
  EXPECT_EQ(incomplete("# nothing\n", 1), (Found{true, {RuleId::DK006}}));
}

TEST(With, ReadsFilesAgainAndKeepsTheNameOfTheDeck) {
  const Folder folder;
  const auto text = [](const char* gap) {
    Two two;
    two.contact = gap;
    return two.text();
  };
  const std::string path = folder.write("d_0000.rad", text("Gapmin=0.5"));
  const auto loaded = load(path);
  ASSERT_TRUE(loaded);
  const auto gap = [](const Result<LoadedDeck>& d) {
    return d->interfaces().type7.front().Gapmin.value;
  };
  EXPECT_EQ(gap(loaded), 0.5);
  folder.write("d_0000.rad", text("Gapmin=0.25"));
  const auto again = loaded->with({});
  ASSERT_TRUE(again);
  EXPECT_EQ(gap(again), 0.25) << "the file has changed";
  const auto other = loaded->with({{path, text("Gapmin=0.125")}});
  ASSERT_TRUE(other);
  EXPECT_EQ(gap(other), 0.125);
  EXPECT_EQ(other->path(), path);
  EXPECT_EQ(other->options().read.overlay, nullptr);
  const LoadedDeck memory = of_text(text("Gapmin=0.5"));
  const auto changed = memory.with({{"small_0000.rad", text("Gapmin=0.75")}});
  ASSERT_TRUE(changed);
  EXPECT_EQ(gap(changed), 0.75) << "not the text that was there";
}

TEST(Ties, AreThoseOfTheSceneOrFoundOnceBesideIt) {
  LoadedDeck beside = of_text(tied("", "Iproj=1")), within = of_text(tied("", "Iproj=1"));
  SceneOptions options = within.scene_options();
  options.ties = true;
  within.set_scene_options(options);
  EXPECT_EQ(&within.ties(), &within.scene().ties);
  EXPECT_TRUE(beside.scene().ties.empty());
  EXPECT_EQ(beside.scene().examined, Examined::contacts);
  const std::vector<Tie>& ties = beside.ties();
  EXPECT_EQ(&beside.ties(), &ties);
  ASSERT_EQ(ties.size(), 2u);
  ASSERT_EQ(within.ties().size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_EQ(ties[i].nodes.size(), 2u);
    EXPECT_EQ(ties[i].inter->id, within.ties()[i].inter->id);
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_EQ(std::pair(ties[i].nodes[k].tied, ties[i].nodes[k].s),
                std::pair(within.ties()[i].nodes[k].tied, within.ties()[i].nodes[k].s));
  }
  options.ties = false;
  options.only = {9};
  beside.set_scene_options(options);
  ASSERT_EQ(beside.ties().size(), 1u) << "of another scene";
  EXPECT_EQ(beside.ties()[0].inter->id, 9);
}

/// What the mesh needs of ties, by hand.
std::vector<TiedNodes> by_hand(const LoadedDeck& d, bool rim) {
  std::vector<TiedNodes> out;
  for (const Tie& tie : d.ties()) {
    TiedNodes& t = out.emplace_back();
    t.block = tie.inter->block;
    t.spotflag = tie.spotflag;
    t.rim = rim;
    for (const TiedNode& n : tie.nodes)
      if (n.tied) t.rows.push_back({n.node, tie.main[n.segment], n.s, n.t, n.penalty});
  }
  return out;
}

void expect_same(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.nodes.mass, b.nodes.mass);
  EXPECT_EQ(a.nodes.inertia, b.nodes.inertia);
  const auto same = [](const std::vector<double>& x, const std::vector<double>& y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(), [](double p, double q) {
      return p == q || (std::isnan(p) && std::isnan(q));
    });
  };
  EXPECT_TRUE(same(a.nodes.stiffness, b.nodes.stiffness));
  EXPECT_TRUE(same(a.nodes.dt, b.nodes.dt));
}

TEST(Ties, CarryMassesToTheRimUnlessIprojSaysOtherwise) {
  for (const auto& [card, rim] : {std::pair("", true),
                                  {"Iproj=1", true},
                                  {"Iproj=2", false},
                                  {"Spotflag=27", true},
                                  {"Spotflag=27 Iproj=2", false},
                                  {"Spotflag=1", true},
                                  {"Spotflag=28", true},
                                  {"Spotflag=25", true}}) {
    const LoadedDeck d = of_text(tied(card));
    const std::vector<TiedNodes> known = by_hand(d, rim), other = by_hand(d, !rim);
    ASSERT_EQ(known.size(), 1u);
    ASSERT_EQ(known[0].rows.size(), 2u) << card;
    EXPECT_GT(std::abs(known[0].rows[1].s), 1) << "beyond the rim";
    MeshOptions how;
    how.ties = &known;
    expect_same(d.mesh(), make_mesh(d.model(), how));
    how.ties = &other;
    const bool by_place = d.ties()[0].spotflag == 0 || d.ties()[0].spotflag == 27;
    EXPECT_EQ(make_mesh(d.model(), how).nodes.mass == d.mesh().nodes.mass, !by_place) << card;
  }
}

TEST(MovedNodes, AreWhereTheMeshIsMeasured) {
  Two two;
  two.contact = "Gapmin=0.7 Inacti=3";
  LoadedDeck d = of_text(two.text());
  const auto expect_moved = [&](double height) {
    EXPECT_NEAR(d.scene().coordinates.z[d.model().find_node(8)], height,
                1e-8 * height);  // and a little more
    MeshOptions moved;
    moved.coordinates = &d.scene().coordinates;
    EXPECT_EQ(steps(d.mesh()), steps(make_mesh(d.model(), moved)));
    EXPECT_NE(steps(d.mesh()), steps(make_mesh(d.model())));
    EXPECT_EQ(&d.mesh(), &d.mesh());
  };
  static_cast<void>(d.mesh());
  EXPECT_EQ(d.reached(), Stage::scene) << "which moves them";
  expect_moved(0.7);
  SceneOptions options = d.scene_options();
  options.what_if.resize(1);
  options.what_if.front().interface_id = 1;
  options.what_if.front().Gapmin = 0.4;
  d.set_scene_options(options);
  expect_moved(0.4);
}

TEST(MovedNodes, AreTiedWhereTheyAreAfterwards) {
  // Node 8 is within reach of the plate until the contact has moved it to its gap.
  Two two;
  two.contact = "Gapmin=0.7 Inacti=3";
  two.more =
      "/GRNOD/NODE/3\ng\n         8\n@/INTER/TYPE2/9 grnd_IDs=3 surf_IDm=1 Ignore=1 "
      "dsearch=0.5";
  LoadedDeck d = of_text(two.text());
  EXPECT_EQ(tied_nodes(d), Ids{});
  two.contact = "Gapmin=0.7 Inacti=5";
  EXPECT_EQ(tied_nodes(of_text(two.text())), Ids{8});
}

}  // namespace
}  // namespace deck::test
