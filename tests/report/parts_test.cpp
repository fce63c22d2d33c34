// `deck parts`: which elements, interfaces and rigid bodies a part has, and every figure of the
// document, the table and the CSV file.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "model/shared/kinematics.hpp"
#include "model/shared/mesh.hpp"
#include "report/inspected.hpp"
#include "report/parts_rows.hpp"
#include "report/shared/parts.hpp"

namespace deck::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;
using Ids = std::vector<std::int64_t>;

/// Shells (parts 1 to 3), a brick and a tetrahedron (4), nothing (5), a truss, a beam and a spring
/// (6 to 8), a plate that nothing sees (9) and one without a material (10). Node 99 belongs to no
/// element, node 58 only orients the beam.
SmallDeck ten_parts() {
  SmallDeck d;
  const auto sheet = [&](int part, double z) {
    const int n = 10 * part;
    d.node(n + 1, 0, 0, z).node(n + 2, 10, 0, z).node(n + 3, 10, 20, z).node(n + 4, 0, 20, z);
    d.shell(part, part, n + 1, n + 2, n + 3, n + 4);
  };
  d.shell_part(1, 2).shell_part(2, 3, 0.75).shell_part(3, 1).solid_part(4).shell_part(5, 4);
  d.truss_part(6, 5).beam_part(7, 6).spring_part(8, 70).shell_part(9, 1);
  d.shell_part(10, 1, 0, 999);
  for (const int part : {1, 2, 3, 9, 10}) sheet(part, part);
  d.shell3(1, 100, 11, 12, 13);
  d.node(41, 0, 0, 40).node(42, 5, 0, 40).node(43, 5, 5, 40).node(44, 0, 5, 40);
  d.node(45, 0, 0, 45).node(46, 5, 0, 45).node(47, 5, 5, 45).node(48, 0, 5, 45).node(49, 9, 9, 49);
  d.brick(4, 101, {41, 42, 43, 44, 45, 46, 47, 48}).tetra(4, 102, 46, 47, 48, 49);
  d.node(51, 0, 0, 60).node(52, 5, 0, 60).node(53, 9, 0, 60).node(58, 0, 9, 60).node(54, 9, 5, 60);
  d.bar("TRUSS", 6, 103, 51, 52).bar("BEAM", 7, 104, 52, 53, 58).bar("SPRING", 8, 105, 53, 54);
  d.node(99, 0, 0, 99).node(98, 3, 3, 98);
  d.group("/GRNOD/PART/1", {1}).group("/GRNOD/PART/2", {2}).group("/GRNOD/PART/23", {2, 3});
  d.group("/GRNOD/PART/3", {3}).group("/SURF/PART/1", {1}).group("/SURF/PART/2", {2});
  d.group("/SURF/PART/3", {3}).group("/SURF/PART/12", {1, 2});
  return d;
}

struct Parted {
  explicit Parted(const SmallDeck& d)
      : loaded(LoadedDeck::from(
            std::move(*read_deck_text("parts_0000.rad", d.text(), SchemaSet::built_in())))),
        view(detail::view_parts(loaded)) {}
  const detail::PartView& part(std::int64_t id) const {
    return view.parts.at(loaded.model().part_of_id.at(id));
  }
  Ids seen_by(std::int64_t interface) const {
    Ids out;
    for (const Part& p : loaded.model().parts) {
      const Ids& all = part(p.id).interfaces;
      if (std::find(all.begin(), all.end(), interface) != all.end()) out.push_back(p.id);
    }
    return out;
  }
  LoadedDeck loaded;
  detail::PartsView view;
};

TEST(PartsView, CountsElementsByKindAndNamesWhatHasNone) {
  const Parted p(ten_parts());
  using Counts = std::array<std::uint64_t, 8>;
  EXPECT_EQ(p.part(1).elements, (Counts{1, 1, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(p.part(4).elements, (Counts{0, 0, 2, 0, 0, 0, 0, 0}));
  EXPECT_EQ(p.part(5).elements, Counts{});
  EXPECT_EQ(p.part(6).elements, (Counts{0, 0, 0, 0, 0, 1, 0, 0}));
  EXPECT_EQ(p.part(7).elements, (Counts{0, 0, 0, 0, 0, 0, 1, 0}));
  EXPECT_EQ(p.part(8).elements, (Counts{0, 0, 0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(p.part(1).count(), 2u);
  EXPECT_EQ(p.part(1).thickness, 2.0);
  EXPECT_EQ(p.part(2).thickness, 0.75) << "of the part, before that of its property";
  EXPECT_EQ(p.part(4).thickness, 0.0);
  EXPECT_EQ(p.view.empty_parts, (Ids{5}));
  EXPECT_EQ(p.view.unseen_parts, (Ids{1, 2, 3, 4, 6, 7, 8, 9, 10}));
  EXPECT_EQ(p.view.unconnected_nodes, 2u) << "98 and 99; the beam has node 58";
}

TEST(PartsView, KindsHaveNames) {
  std::vector<std::string> names;
  for (int k = 0; k < 8; ++k) names.emplace_back(detail::kind_name(static_cast<ElementKind>(k)));
  EXPECT_EQ(names, (std::vector<std::string>{"shell4", "shell3", "solid", "quad", "tria", "truss",
                                             "beam", "spring"}));
}

TEST(PartsView, AnInterfaceSeesThePartsOfItsGroupsSurfacesAndLines) {
  SmallDeck d = ten_parts();
  d.segments("/SURF/SEG/60", {{21, 22, 23, 24}, {31, 32, 33, 34}});
  d.segments("/LINE/SEG/70", {{51, 52}, {11, 12}}).segments("/LINE/SEG/71", {{31, 32}});
  d.group("/GRNOD/NODE/80", {41, 42, 43, 44, 52, 53, 54, 11, 12, 13})
      .group("/GRNOD/NODE/81", {46, 47, 48, 41, 42});
  d.add("@/INTER/TYPE7/1 grnd_IDs=23 surf_IDm=1 Gapmin=1");
  d.add("@/INTER/TYPE7/2 grnd_IDs=80 surf_IDm=60 Gapmin=1");
  d.add("@/INTER/TYPE11/3 line_IDs=70 line_IDm=71 Gapmin=1");
  d.add("@/INTER/TYPE7/4 grnd_IDs=81 surf_IDm=3 Gapmin=1");
  d.add("@/INTER/TYPE2/5 grnd_IDs=2 surf_IDm=3 dsearch=9");
  d.add("@/INTER/TYPE24/6 surf_ID1=2 surf_ID2=12");
  const Parted p(d);
  EXPECT_EQ(p.seen_by(1), (Ids{1, 2, 3}));
  // A face of the brick, both nodes of the beam (not the one that orients it) and of the spring,
  // the triangle of part 1; the segments are those of the shells of parts 2 and 3.
  EXPECT_EQ(p.seen_by(2), (Ids{1, 2, 3, 4, 7, 8}));
  EXPECT_EQ(p.seen_by(3), (Ids{1, 3, 6}));
  EXPECT_EQ(p.seen_by(4), (Ids{3, 4})) << "three nodes of the tetrahedron are a face";
  EXPECT_EQ(p.seen_by(5), (Ids{2, 3}));
  EXPECT_EQ(p.seen_by(6), (Ids{1, 2}));
  EXPECT_EQ(p.part(3).interfaces, (Ids{1, 2, 3, 4, 5}));
  EXPECT_EQ(p.view.unseen_parts, (Ids{9, 10}));
}

TEST(PartsView, NodesOfAnEdgeOrOfLessThanAnElementAreNoPart) {
  SmallDeck d = ten_parts().group("/GRNOD/NODE/80", {41, 42, 11, 12, 21, 52, 58});
  const Parted p(d.add("@/INTER/TYPE7/1 grnd_IDs=80 surf_IDm=3 Gapmin=1"));
  EXPECT_EQ(p.seen_by(1), (Ids{3}));
}

/// All groups of four nodes of a brick: four that have a coordinate in common are a face.
TEST(PartsView, ABrickIsSeenByItsSixFacesOnly) {
  SmallDeck d;
  const auto corner = [](int k) {
    return std::array{k % 4 == 1 || k % 4 == 2 ? 5 : 0, k % 4 >= 2 ? 7 : 0, k < 4 ? 0 : 9};
  };
  for (int k = 0; k < 8; ++k) d.node(k + 1, corner(k)[0], corner(k)[1], corner(k)[2]);
  d.node(11, 0, 0, 20).node(12, 5, 0, 20).node(13, 5, 5, 20).node(14, 0, 5, 20);
  d.solid_part(1).brick(1, 1, {1, 2, 3, 4, 5, 6, 7, 8});
  d.shell_part(2, 1).shell(2, 2, 11, 12, 13, 14).group("/SURF/PART/1", {2});
  Ids faces;
  int id = 0;
  for (int bits = 0; bits < 256; ++bits) {
    std::vector<int> nodes;
    std::array<std::set<int>, 3> places;
    for (int k = 0; k < 8; ++k) {
      if ((bits >> k & 1) == 0) continue;
      nodes.push_back(k + 1);
      for (std::size_t a = 0; a < 3; ++a) places[a].insert(corner(k)[a]);
    }
    if (nodes.size() != 4) continue;
    ++id;
    if (places[0].size() == 1 || places[1].size() == 1 || places[2].size() == 1)
      faces.push_back(id);
    d.group(("/GRNOD/NODE/" + std::to_string(100 + id)).c_str(), nodes);
    d.add("@/INTER/TYPE7/" + std::to_string(id) + " grnd_IDs=" + std::to_string(100 + id) +
          " surf_IDm=1 Gapmin=1");
  }
  ASSERT_EQ(id, 70);
  ASSERT_EQ(faces.size(), 6u);
  EXPECT_EQ(Parted(d).part(1).interfaces, faces);
}

TEST(PartsView, MoreThanSixtyFourGroupsAreAllLookedAt) {
  SmallDeck d = ten_parts();
  for (int i = 1; i <= 130; ++i)
    d.add("@/INTER/TYPE7/" + std::to_string(i) + " grnd_IDs=" + (i % 2 == 0 ? "2" : "3") +
          " surf_IDm=1 Gapmin=1");
  const Parted p(d);
  Ids even, odd;
  for (int i = 1; i <= 130; ++i) (i % 2 == 0 ? even : odd).push_back(i);
  EXPECT_EQ(p.part(2).interfaces, even);
  EXPECT_EQ(p.part(3).interfaces, odd);
}

TEST(PartsView, NamesContactsThatLetTheSamePartsTouch) {
  SmallDeck d = ten_parts();
  d.add("@/INTER/TYPE7/1 grnd_IDs=23 surf_IDm=12 Gapmin=1");  // 2 3 on 1 2
  d.add("@/INTER/TYPE7/2 grnd_IDs=3 surf_IDm=1 Gapmin=1");    // 3 on 1: repeats 1
  d.add("@/INTER/TYPE7/3 grnd_IDs=1 surf_IDm=3 Gapmin=1");    // 1 on 3: repeats 1 and 2, turned
  d.add("@/INTER/TYPE7/4 grnd_IDs=1 surf_IDm=1 Gapmin=1");    // 1 on itself: nothing has that
  d.add("@/INTER/TYPE2/5 grnd_IDs=3 surf_IDm=1 dsearch=9");   // a tie
  d.add("@/INTER/TYPE7/6 grnd_IDs=23 surf_IDm=12 Gapmin=1");  // as 1
  const Parted p(d);
  std::vector<Ids> all;
  for (const detail::RepeatedContacts& c : p.view.repeated)
    all.push_back({c.first, c.second, static_cast<std::int64_t>(c.pairs), c.part, c.other});
  // 1 and 6: 2-1 2-2 3-1 3-2; 2-2 is the same turned.
  EXPECT_EQ(all, (std::vector<Ids>{{1, 2, 1, 3, 1},
                                   {1, 3, 1, 3, 1},
                                   {1, 6, 4, 2, 1},
                                   {2, 3, 1, 3, 1},
                                   {2, 6, 1, 3, 1},
                                   {3, 6, 1, 1, 3}}));
}

TEST(PartsView, AContactWithOneSideIsOneWithItself) {
  SmallDeck d = ten_parts();
  d.add("@/INTER/TYPE24/1 surf_ID1=12").add("@/INTER/TYPE7/2 grnd_IDs=2 surf_IDm=1 Gapmin=1");
  const Parted p(d);
  ASSERT_EQ(p.view.repeated.size(), 1u);
  EXPECT_EQ(p.view.repeated[0].pairs, 1u);
  EXPECT_EQ(p.view.repeated[0].part, 2);
  EXPECT_EQ(p.view.repeated[0].other, 1);
}

TEST(PartsView, ARigidBodyHasThePartsAllNodesOfWhichItHas) {
  SmallDeck d = ten_parts();
  // Body 7 has the truss by its main node, body 8 the solids; body 9 has all but one node of part 1
  // and the truss once more.
  d.group("/GRNOD/NODE/80", {52}).group("/GRNOD/NODE/81", {41, 42, 43, 44, 45, 46, 47, 48, 49});
  d.group("/GRNOD/NODE/82", {11, 12, 13, 51, 52});
  d.add("@/RBODY/7 node_ID=51 grnd_ID=80\n@/RBODY/8 node_ID=98 grnd_ID=81");
  const Parted p(d.add("@/RBODY/9 node_ID=99 grnd_ID=82"));
  std::map<std::int64_t, std::int64_t> bodies;
  for (const Part& part : p.loaded.model().parts)
    if (p.part(part.id).rigid_body != 0) bodies[part.id] = p.part(part.id).rigid_body;
  EXPECT_EQ(bodies, (std::map<std::int64_t, std::int64_t>{{4, 8}, {6, 7}}));
}

TEST(PartsView, MoreThanSixtyFourRigidBodiesAreAllLookedAt) {
  SmallDeck d = ten_parts();
  for (int i = 1; i <= 66; ++i) {
    d.group(("/GRNOD/NODE/" + std::to_string(200 + i)).c_str(), {i == 66 ? 51 : 98, 52});
    d.add("@/RBODY/" + std::to_string(i) + " node_ID=99 grnd_ID=" + std::to_string(200 + i));
  }
  const Parted p(d);
  EXPECT_EQ(p.part(6).rigid_body, 66);
  EXPECT_EQ(p.part(7).rigid_body, 0);
}

// ---- the document ---------------------------------------------------------------------------

Json known(double v) { return std::isnan(v) ? Json() : Json(v); }
Json step(double dt) { return std::isnan(dt) || dt >= 1e29 ? Json() : Json(dt); }

/// The members of a part, or of all, that the mesh gives.
Json figures(const Model& model, const PartFigures& f) {
  const bool placed = f.mass > 0;
  Json element;
  if (f.slowest.element != no_index)
    element = {{"kind", std::string(detail::kind_name(f.slowest.kind))},
               {"id", model.family(f.slowest.kind).id[f.slowest.element]}};
  return {{"mass", known(f.mass)},
          {"centre", placed ? Json(f.centre) : Json()},
          {"inertia", placed ? Json(f.inertia) : Json()},
          {"dt", {{"min", step(f.dt)}, {"element", element}, {"not_computed", f.not_computed}}}};
}

SmallDeck with_everything() {
  SmallDeck d = ten_parts();
  d.add("@/INTER/TYPE7/1 grnd_IDs=23 surf_IDm=12 Gapmin=1");
  d.add("@/INTER/TYPE7/2 grnd_IDs=3 surf_IDm=1 Gapmin=1");
  d.group("/GRNOD/NODE/80", {51, 52});
  return d.add("@/BCS/3 Tx=1 grnod_ID=80\n@/RBODY/7 node_ID=98 grnd_ID=80");
}

TEST(PartsJson, HasEveryFigureOfEveryPart) {
  const Parted p(with_everything());
  const Model& model = p.loaded.model();
  const Mesh& mesh = p.loaded.mesh();
  const Json all = Json::parse(parts_json(p.loaded, false));
  EXPECT_EQ(all["schema"], Json({{"id", "deck/parts"}, {"version", 1}}));
  EXPECT_EQ(all["deck"]["path"], "parts_0000.rad");
  EXPECT_EQ(all["deck"]["counts"]["parts"], 10);
  EXPECT_EQ(all["deck"]["counts"]["interfaces"], 2);
  const std::map<std::int64_t, Json> elements{{1, {{"shell4", 1}, {"shell3", 1}}},
                                              {4, {{"solid", 2}}},
                                              {5, Json::object()},
                                              {6, {{"truss", 1}}},
                                              {7, {{"beam", 1}}},
                                              {8, {{"spring", 1}}}};
  ASSERT_EQ(all["parts"].size(), model.parts.size());
  for (std::size_t i = 0; i < model.parts.size(); ++i) {
    const Part& part = model.parts[i];
    Json expected = figures(model, mesh.parts[i]);
    const auto own = elements.find(part.id);
    const detail::PartView& v = p.part(part.id);
    expected["id"] = part.id;
    expected["title"] = "part";
    expected["elements"] = own != elements.end() ? own->second : Json({{"shell4", 1}});
    expected["material"] = part.id == 10 ? 999 : 1;
    expected["property"] = part.id;
    expected["thickness"] = v.thickness;
    expected["interfaces"] = v.interfaces;
    expected["rigid_body"] = part.id == 6 ? Json(7) : Json();
    EXPECT_EQ(all["parts"][i], expected) << part.id;
  }
  EXPECT_EQ(all["total"], figures(model, mesh.total));
  // By hand: areas 200 and 100, thickness 2, density 1e-6.
  EXPECT_NEAR(all["parts"][0]["mass"].get<double>(), 300 * 2 * 1e-6, 1e-15);
  EXPECT_EQ(all["parts"][4]["centre"], Json()) << "without mass there is no centre";
  EXPECT_EQ(all["unconnected"],
            Json({{"nodes", 2}, {"parts", {5}}, {"unseen_parts", {4, 6, 7, 8, 9, 10}}}));
  EXPECT_EQ(all["repeated_contacts"],
            Json::array({{{"interfaces", {1, 2}}, {"pairs", 1}, {"parts", {3, 1}}}}));
  Json left_out = Json::array();
  for (const auto* list : {&mesh.left_out, &p.loaded.kinematics().left_out})
    for (const LeftOut& l : *list)
      left_out.push_back({{"what", l.what}, {"why", l.why}, {"count", l.count}});
  EXPECT_EQ(all["not_computed"], left_out);
  const Kinematics& k = p.loaded.kinematics();
  ASSERT_EQ(k.several.size(), 2u) << "both nodes of the truss are in /BCS and /RBODY";
  EXPECT_EQ(all["kinematics"]["conflicts"], k.conflicts);
  EXPECT_EQ(all["kinematics"]["nodes"].size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const Json& node = all["kinematics"]["nodes"][i];
    EXPECT_EQ(node["node"], model.node_id(k.several[i]));
    Json types = Json::array();
    for (std::size_t t = 0; t < condition_types; ++t)
      if ((k.types[k.several[i]] >> t & 1) != 0)
        types.push_back(to_string(static_cast<ConditionType>(t)));
    EXPECT_EQ(node["types"], types);
    EXPECT_EQ(types.size(), 2u);
  }
  EXPECT_FALSE(all.contains("elements"));
  EXPECT_FALSE(all.contains("nodes"));
}

TEST(PartsJson, OfAllHasTheStepsOfElementsAndNodes) {
  const Parted p(with_everything());
  const Model& model = p.loaded.model();
  const Mesh& mesh = p.loaded.mesh();
  const Json all = Json::parse(parts_json(p.loaded, true));
  Json elements = Json::array(), nodes = Json::array();
  for (std::size_t k = 0; k < 8; ++k) {
    const Elements& family = model.family(static_cast<ElementKind>(k));
    for (std::size_t e = 0; e < family.size(); ++e)
      elements.push_back({{"kind", std::string(detail::kind_name(static_cast<ElementKind>(k)))},
                          {"id", family.id[e]},
                          {"dt", step(mesh.elements[k].dt[e])}});
  }
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
    nodes.push_back({{"node", model.nodes.id[n]},
                     {"dt", step(mesh.nodes.dt[n])},
                     {"mass", known(mesh.nodes.mass[n])},
                     {"stiffness", known(mesh.nodes.stiffness[n])}});
  EXPECT_EQ(all["elements"], elements);
  EXPECT_EQ(all["nodes"], nodes);
}

// ---- text -----------------------------------------------------------------------------------

std::string short_real(double v) {
  char out[32];
  std::snprintf(out, sizeof out, "%.6g", v);
  return out;
}

TEST(PartsText, HasARowPerPartAndWhatIsWorthALook) {
  const Parted p(with_everything());
  const Mesh& mesh = p.loaded.mesh();
  const std::string text = parts_text(p.loaded);
  const auto row = [&](const std::string& pattern) {
    EXPECT_THAT(text, ::testing::ContainsRegex("\n *" + pattern + "\n"));
  };
  const auto slowest = [&](std::size_t i) { return short_real(mesh.parts[i].dt); };
  row("1 +part +1 shell4, 1 shell3 +1 +1 +2 +0\\.0006 +" + slowest(0) +
      " +shell[34] +?[0-9]+ +1, 2");
  row("2 +part +1 shell4 +1 +2 +0\\.75 +0\\.0006 +" + slowest(1) + " +shell4 2 +1");
  row("4 +part +2 solid +1 +4 .*");
  row("5 +part +none +1 +5 +4");
  row("6 +part +1 truss +1 +6 .* truss 103 +7");
  EXPECT_THAT(text, HasSubstr("\nMass of all elements: " + short_real(mesh.total.mass) + "\n"));
  EXPECT_THAT(text,
              HasSubstr("\nSmallest time step of an element: " + short_real(mesh.total.dt) + " ("));
  double least = 1e30;
  std::int64_t node = 0;
  for (std::size_t n = 0; n < mesh.nodes.dt.size(); ++n)
    if (mesh.nodes.dt[n] < least) {
      least = mesh.nodes.dt[n];
      node = p.loaded.model().nodes.id[n];
    }
  EXPECT_THAT(text, HasSubstr("\nSmallest time step of a node: " + short_real(least) + " (node " +
                              std::to_string(node) + ")\n"));
  EXPECT_THAT(text, HasSubstr("\n2 nodes belong to no element\n"));
  EXPECT_THAT(text, HasSubstr("\n6 parts are in no contact and no tie: 4, 6, 7, 8, 9, 10\n"));
  EXPECT_THAT(text, HasSubstr("\nContacts 1 and 2 cover the same 1 pair of parts: 3 and 1\n"));
  EXPECT_THAT(text, HasSubstr(" on 2 nodes (warning 312)\n"));
  EXPECT_THAT(text, Not(HasSubstr("more pair")));
}

TEST(PartsText, ShortensListsOfIdsUnlessAllIsAskedFor) {
  SmallDeck d = ten_parts();
  for (int i = 11; i < 21; ++i)
    d.add("@/INTER/TYPE7/" + std::to_string(i) + " grnd_IDs=3 surf_IDm=1 Gapmin=1");
  for (int i = 30; i < 38; ++i) {
    d.shell_part(i, 1).node(10 * i, 0, 0, i).node(10 * i + 1, 1, 0, i).node(10 * i + 2, 1, 1, i);
    d.shell3(i, i, 10 * i, 10 * i + 1, 10 * i + 2);
  }
  const Parted p(d);
  const std::string text = parts_text(p.loaded);
  EXPECT_THAT(text, HasSubstr("11, 12, 13, 14, 15, 16, 17, 18 and 2 more"));
  EXPECT_THAT(text,
              HasSubstr("15 parts are in no contact and no tie: 2, 4, 6, 7, 8, 9, 10, 30, 31, "
                        "32, 33, 34 and 3 more\n"));
  // Ten contacts are 45 pairs of contacts, of which five are named.
  EXPECT_THAT(text, HasSubstr("\nContacts 11 and 16 cover the same 1 pair of parts: 3 and 1\n"));
  EXPECT_THAT(text, Not(HasSubstr("Contacts 11 and 17")));
  EXPECT_THAT(text, HasSubstr("\n40 more pairs of contacts that cover the same parts ("));
  PartsTextOptions all;
  all.all = true;
  EXPECT_THAT(parts_text(p.loaded, all), HasSubstr("11, 12, 13, 14, 15, 16, 17, 18, 19, 20"));
}

TEST(PartsText, NamesAnExampleOfSeveralPairsAndAPartWithItself) {
  SmallDeck d = ten_parts();
  d.add("@/INTER/TYPE7/1 grnd_IDs=23 surf_IDm=1 Gapmin=1");
  d.add("@/INTER/TYPE7/2 grnd_IDs=23 surf_IDm=1 Gapmin=1");
  EXPECT_THAT(parts_text(Parted(d).loaded),
              HasSubstr("cover the same 2 pairs of parts, for example 2 and 1\n"));
  SmallDeck self = ten_parts();
  for (const char* id : {"1", "2"})
    self.add(std::string("@/INTER/TYPE7/") + id + " grnd_IDs=2 surf_IDm=2 Gapmin=1");
  EXPECT_THAT(parts_text(Parted(self).loaded),
              HasSubstr("cover the same 1 pair of parts: 2 with itself\n"));
}

/// Fields of a line of a CSV file; quotes keep commas.
std::vector<std::string> csv_fields(const std::string& line) {
  std::vector<std::string> out(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      out.emplace_back();
    else
      out.back() += c;
  }
  return out;
}

TEST(PartsCsv, HasALinePerPartWithAllFigures) {
  const Parted p(with_everything());
  const Mesh& mesh = p.loaded.mesh();
  const std::string text = parts_csv(p.loaded);
  std::vector<std::vector<std::string>> lines;
  for (std::size_t at = 0; at < text.size(); at = text.find("\r\n", at) + 2)
    lines.push_back(csv_fields(text.substr(at, text.find("\r\n", at) - at)));
  ASSERT_EQ(lines.size(), 11u);
  EXPECT_EQ(lines[0].size(), 21u);
  for (std::size_t i = 0; i < 10; ++i) {
    const auto& line = lines[i + 1];
    ASSERT_EQ(line.size(), 21u);
    const Part& part = p.loaded.model().parts[i];
    const PartFigures& f = mesh.parts[i];
    const detail::PartView& v = p.part(part.id);
    EXPECT_EQ(line[0], std::to_string(part.id));
    EXPECT_EQ(line[3], std::to_string(part.mat_id));
    EXPECT_EQ(line[4], std::to_string(part.prop_id));
    const auto is = [&](std::size_t column, double value) {
      if (std::isnan(value))
        EXPECT_EQ(line[column], "") << part.id << " " << column;
      else
        EXPECT_EQ(std::strtod(line[column].c_str(), nullptr), value) << part.id << " " << column;
    };
    is(5, v.thickness);
    is(6, f.mass);
    for (std::size_t k = 0; k < 3; ++k) is(7 + k, f.centre[k]);
    for (std::size_t k = 0; k < 6; ++k) is(10 + k, f.inertia[k]);
    is(16, f.dt >= 1e29 ? std::numeric_limits<double>::quiet_NaN() : f.dt);
    EXPECT_EQ(line[17].empty(), f.slowest.element == no_index);
    EXPECT_EQ(line[20], part.id == 6 ? "7" : "");
  }
  EXPECT_EQ(lines[1][2], "1 shell4, 1 shell3");
  EXPECT_EQ(lines[1][19], "1 2");
  EXPECT_EQ(lines[6][17], "truss");
  EXPECT_EQ(lines[6][18], "103");
  EXPECT_EQ(lines[5][2], "none");
}

}  // namespace
}  // namespace deck::test
