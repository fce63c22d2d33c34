// VTK files of the geometry stage: read back by VTK itself (Debian: python3-vtk9) and compared
// value by value; the tests that need it are skipped where it is not installed.
#include "report/shared/vtk.hpp"

#include <gtest/gtest.h>

#include "contact/small_deck.hpp"
#include "report/vtk_reading.hpp"

namespace deck::test {
namespace {

/// A quad and a triangle of a floor (part 1) with nodes over it, two trusses that cross.
SmallDeck scene_deck() {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(5, 20, 5, 0);
  d.node(101, 3, 4, 0.4).node(102, 12, 5, 1.0 / 3).node(103, 5, 5, 0).node(104, 0, 0, 30);
  d.node(201, -1, 0, 50).node(202, 1, 0, 50).node(203, 0, -1, 50.5).node(204, 0, 1, 50.5);
  d.shell_part(1, 2).truss_part(2, 0.09).shell(1, 7, 1, 2, 3, 4).shell3(1, 8, 2, 5, 3);
  d.bar("TRUSS", 2, 9, 201, 202).bar("TRUSS", 2, 10, 203, 204).bar("TRUSS", 2, 11, 104, 101);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {101, 102, 103, 104, 2});
  d.segments("/LINE/SEG/1", {{201, 202}}).segments("/LINE/SEG/2", {{203, 204}});
  d.add("@/INTER/TYPE7/1 Igap=1 Gapmin=0.6 Inacti=1").add("@/INTER/TYPE11/2 Gapmin=1 Inacti=6");
  return d.add("@/INTER/TYPE19/3 surf_IDs=1 surf_IDm=1 Gapmin=0.1");
}

std::vector<std::string> names(const std::vector<VtkFile>& files) {
  std::vector<std::string> out;
  for (const VtkFile& f : files) out.push_back(f.name);
  return out;
}

TEST(Vtk, OneFilePerSideAndThePenetrations) {
  const Built b(scene_deck());
  const std::vector<std::string> expected = {"interface_1_main.vtp",
                                             "interface_1_secondary.vtp",
                                             "interface_2_main.vtp",
                                             "interface_2_secondary.vtp",
                                             "interface_3_main.vtp",
                                             "interface_3_secondary.vtp",
                                             "interface_3_edges_main.vtp",
                                             "interface_3_edges_secondary.vtp",
                                             "penetrations.vtp"};
  EXPECT_EQ(names(gaps_vtk(b.scene, make_view(b.scene))), expected);
}

TEST(Vtk, SceneWithoutContactsStillHasAPenetrationFile) {
  SmallDeck d;
  d.node(1, 0, 0, 0);
  const Built b(d);
  const auto files = gaps_vtk(b.scene, make_view(b.scene));
  ASSERT_EQ(files.size(), 1u);
  const json read = read_with_vtk(files);
  if (read.is_null()) GTEST_SKIP() << "no python3 with VTK (Debian: python3-vtk9)";
  EXPECT_TRUE(read["penetrations.vtp"]["points"].empty());
}

TEST(Vtk, TiesAreLinesFromNodesToTheirSegments) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(101, 4, 5, 0.5).node(102, 4, 5, 40).shell_part(1, 2).shell(1, 7, 1, 2, 3, 4);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/9", {101, 102});
  d.add("@/INTER/TYPE2/7 grnd_IDs=9 surf_IDm=1 Ignore=1 dsearch=2");
  SceneOptions options;
  options.ties = true;
  const Built b(d, options);
  const auto files = gaps_vtk(b.scene, make_view(b.scene));
  EXPECT_EQ(names(files), (std::vector<std::string>{"interface_7_ties.vtp", "penetrations.vtp"}));
  EXPECT_NE(paraview_script(files).bytes.find("interface_7_ties.vtp\", \"lost\""),
            std::string::npos);
  const json read = read_with_vtk(files);
  if (read.is_null()) GTEST_SKIP() << "no python3 with VTK (Debian: python3-vtk9)";
  const json& file = read["interface_7_ties.vtp"];
  ASSERT_EQ(file["cells"].size(), 2u);
  EXPECT_EQ(file["points"], json({{4, 5, 0.5}, {4, 5, 0}, {4, 5, 40}, {4, 5, 0}}));
  EXPECT_EQ(file["cell"]["lost"], json({{0}, {1}}));
  EXPECT_EQ(file["cell"]["distance"], json({{0.5}, {40.0}}));
}

/// The scene as VTK reads it.
class ReadByVtk : public ::testing::Test {
 protected:
  void SetUp() override {
    read = read_with_vtk(gaps_vtk(b.scene, view));
    if (read.is_null()) GTEST_SKIP() << "no python3 with VTK (Debian: python3-vtk9)";
  }
  const Built b{scene_deck()};
  const SceneView view = make_view(b.scene);
  json read;
};

TEST_F(ReadByVtk, MainSegmentsAreCells) {
  const json& file = read["interface_1_main.vtp"];
  const Contact& c = b.contact(1);
  ASSERT_EQ(file["cells"].size(), c.main.size());
  EXPECT_EQ(file["types"], json({9, 5})) << "VTK_QUAD, VTK_TRIANGLE";
  for (std::size_t i = 0; i < c.main.size(); ++i) {
    const MainSegment& m = c.main[i];
    for (std::size_t k = 0; k < file["cells"][i].size(); ++k) {
      const std::size_t point = file["cells"][i][k];
      const NodeIndex n = m.nodes[k];
      EXPECT_EQ(file["points"][point],
                json({b.model.nodes.x[n], b.model.nodes.y[n], b.model.nodes.z[n]}));
      EXPECT_EQ(file["point"]["node"][point][0], b.model.node_id(n));
    }
    double deepest = 0;
    for (const PenetrationRow& r : c.penetrations)
      if (r.main == i) deepest = std::max(deepest, r.depth);
    EXPECT_GT(deepest, 0);
    EXPECT_EQ(file["cell"]["stiffness"][i][0], m.stiffness);
    EXPECT_EQ(file["cell"]["gap"][i][0], m.gap);
    EXPECT_EQ(file["cell"]["depth"][i][0], deepest);
    EXPECT_EQ(file["cell"]["off"][i][0], 0);
    EXPECT_EQ(file["cell"]["part"][i][0], 1);
    EXPECT_EQ(file["cell"]["element"][i][0], i == 0 ? 7 : 8);
  }
  for (const auto& gap : file["point"]["gap"]) EXPECT_EQ(gap[0], 1);
}

TEST_F(ReadByVtk, SecondaryNodesAreVertices) {
  const json& file = read["interface_1_secondary.vtp"];
  const Contact& c = b.contact(1);
  ASSERT_EQ(file["cells"].size(), c.secondary.size());
  for (std::size_t i = 0; i < c.secondary.size(); ++i) {
    EXPECT_EQ(file["types"][i], 1) << "VTK_VERTEX";
    const std::size_t point = file["cells"][i][0];
    EXPECT_EQ(file["point"]["node"][point][0], b.model.node_id(c.secondary[i].node));
    EXPECT_EQ(file["cell"]["gap"][i][0], c.secondary[i].gap);
    EXPECT_EQ(file["cell"]["off"][i][0], c.secondary[i].off ? 1 : 0);
  }
}

TEST_F(ReadByVtk, EdgesAreLines) {
  const json& file = read["interface_2_main.vtp"];
  ASSERT_EQ(file["cells"].size(), 1u);
  EXPECT_EQ(file["types"][0], 3) << "VTK_LINE";
  EXPECT_EQ(file["points"], json({{-1.0, 0.0, 50.0}, {1.0, 0.0, 50.0}}));
  EXPECT_EQ(file["cell"]["stiffness"][0][0], b.contact(2).main_edges[0].stiffness);
  EXPECT_EQ(file["cell"]["depth"][0][0], b.contact(2).penetrations.at(0).depth);
  EXPECT_EQ(file["cell"]["element"][0][0], 9);
}

TEST_F(ReadByVtk, PenetrationsArePoints) {
  const json& file = read["penetrations.vtp"];
  ASSERT_EQ(file["points"].size(), view.penetrations.size());
  ASSERT_GE(view.penetrations.size(), 4u);
  for (std::size_t i = 0; i < view.penetrations.size(); ++i) {
    const NamedPenetration& p = view.penetrations[i];
    const Contact& c = b.scene.contacts[p.contact];
    const PenetrationRow& r = c.penetrations[p.row];
    const json& data = file["point"];
    EXPECT_EQ(file["points"][i], json(p.at));
    EXPECT_EQ(data["normal"][i], json(r.normal));
    EXPECT_EQ(data["arrow"][i],
              json({r.depth * r.normal[0], r.depth * r.normal[1], r.depth * r.normal[2]}));
    EXPECT_EQ(data["depth"][i][0], r.depth);
    EXPECT_EQ(data["gap"][i][0], r.gap);
    EXPECT_EQ(data["ratio"][i][0], r.depth / r.gap);
    EXPECT_EQ(data["action"][i][0], static_cast<int>(r.action));
    EXPECT_EQ(data["on_surface"][i][0], r.on_surface ? 1 : 0);
    EXPECT_EQ(data["node"][i][0], p.secondary[0]);
    EXPECT_EQ(data["interface"][i][0], c.inter->id);
  }
}

}  // namespace
}  // namespace deck::test
