// Data blocks of the page beside its contacts: the mesh and where its elements are defined, crossed
// elements, moved nodes, forces, and who touches whom.
#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <set>

#include "deck/cycle/scene_cycle.hpp"
#include "report/page.hpp"

namespace deck::test {
namespace {

using ::testing::HasSubstr;

/// Two bricks with a common face (part 2), a tetrahedron (3), shells of every shape (1), lines (4
/// to 6), and what the picture leaves out: a shell with a node that is missing, a truss from a node
/// to itself. Shell 105 is of no part.
SmallDeck shapes() {
  SmallDeck d;
  int id = 0;
  for (const double z : {0.0, 7.0})
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(3, 0), std::pair(3, 5), std::pair(0, 5)})
      d.node(++id, x, y, z);
  d.node(9, 10, 0, 0).node(10, 10, 5, 0).node(11, 10, 5, 7).node(12, 10, 0, 7);
  d.node(21, 20, 0, 0).node(22, 23, 0, 0).node(23, 20, 5, 0).node(24, 20, 0, 7);
  d.node(31, 0, 20, 0.3).node(32, 3, 20, 0).node(33, 3.7, 25, 0).node(34, 0, 25, 0);
  d.node(41, 0, 40, 0).node(42, 3, 40, 1).node(43, 3, 45, 2).node(44, 0, 45, 3);
  d.shell_part(1, 2).solid_part(2).solid_part(3).truss_part(4, 1).beam_part(5, 1);
  d.spring_part(6, 10);
  d.brick(2, 301, {1, 2, 3, 4, 5, 6, 7, 8}).brick(2, 302, {2, 9, 10, 3, 6, 12, 11, 7});
  d.tetra(3, 303, 21, 22, 23, 24);
  d.shell(1, 101, 31, 32, 33, 34, 1.5).shell(1, 102, 31, 33, 34, 34).shell3(1, 103, 31, 32, 34);
  d.shell(1, 104, 31, 32, 33, 999).shell(77, 105, 32, 33, 34, 31, 2.5);
  d.bar("TRUSS", 4, 201, 41, 42).bar("BEAM", 5, 202, 42, 43, 44).bar("SPRING", 6, 203, 43, 44);
  return d.bar("TRUSS", 4, 204, 41, 41);
}

/// A face or line of the picture.
struct Drawn {
  ElementKind kind{};
  std::int64_t element = 0;
  Ids nodes;
  friend bool operator==(const Drawn&, const Drawn&) = default;
};

struct DrawnPart {
  std::map<std::int64_t, std::array<double, 3>> places;
  std::array<double, 3> steps{};
  std::vector<Drawn> items;
};

/// The mesh of a page by the ids of its parts.
std::map<std::int64_t, DrawnPart> drawn_parts(const Page& p, const std::string& text) {
  PageBlock in(text);
  const Ids ids = in.deltas(in.u());
  EXPECT_EQ(ids.size(), p.nodes.list().size());
  for (std::size_t i = 0; i < ids.size(); ++i) EXPECT_EQ(ids[i], p.id(static_cast<int>(i)));
  std::map<std::int64_t, DrawnPart> out;
  for (std::uint64_t parts = in.u(); parts > 0; --parts) {
    const std::uint64_t part = in.u();
    DrawnPart& to = out[part == 0 ? 0 : p.b.model.parts.at(part - 1).id];
    const Ids local = in.deltas(in.u());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::vector<double> frame = in.reals(2);
      to.steps[axis] = frame[1];
      const Ids at = in.deltas(local.size());
      for (std::size_t i = 0; i < local.size(); ++i)
        to.places[p.id(local[i])][axis] = frame[0] + frame[1] * static_cast<double>(at[i]);
    }
    std::int64_t next = 0;
    for (std::uint64_t groups = in.u(); groups > 0; --groups) {
      const auto kind = static_cast<ElementKind>(in.u());
      const std::uint64_t corners = in.u(), count = in.u();
      const std::size_t first = to.items.size();
      for (std::uint64_t k = 0; k < count; ++k) {
        to.items.push_back({kind, 0, {}});
        for (std::uint64_t c = 0; c < corners; ++c) {
          const std::int64_t i = next - static_cast<std::int64_t>(in.u());
          if (i == next) ++next;
          to.items.back().nodes.push_back(p.id(local.at(static_cast<std::size_t>(i))));
        }
      }
      const Ids elements = in.deltas(count);
      for (std::size_t k = 0; k < count; ++k) to.items[first + k].element = elements[k];
    }
  }
  EXPECT_TRUE(in.done());
  return out;
}

struct Shapes : Page {
  Shapes() : Page(shapes()) {
    mesh = detail::collect_mesh(b.model, nodes);
    nodes.number();
  }
  std::map<std::int64_t, DrawnPart> drawn() const {
    return drawn_parts(*this, detail::mesh_block(b.model, mesh, nodes));
  }
  std::vector<detail::MeshPart> mesh;
};

TEST(PageMesh, ShellsAndLinesHaveTheirNodesInOrder) {
  const auto drawn = Shapes().drawn();
  Ids parts;
  for (const auto& [id, part] : drawn) parts.push_back(id);
  EXPECT_EQ(parts, (Ids{0, 1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(drawn.at(1).items, (std::vector<Drawn>{{ElementKind::shell4, 101, {31, 32, 33, 34}},
                                                   {ElementKind::shell4, 102, {31, 33, 34}},
                                                   {ElementKind::shell3, 103, {31, 32, 34}}}));
  EXPECT_EQ(drawn.at(0).items, (std::vector<Drawn>{{ElementKind::shell4, 105, {32, 33, 34, 31}}}));
  EXPECT_EQ(drawn.at(4).items, (std::vector<Drawn>{{ElementKind::truss, 201, {41, 42}}}));
  EXPECT_EQ(drawn.at(5).items, (std::vector<Drawn>{{ElementKind::beam, 202, {42, 43}}}));
  EXPECT_EQ(drawn.at(6).items, (std::vector<Drawn>{{ElementKind::spring, 203, {43, 44}}}));
}

TEST(PageMesh, SolidsHaveTheirOuterFacesTurnedOutward) {
  const Shapes p;
  const auto drawn = p.drawn();
  const std::map<std::int64_t, std::set<std::set<std::int64_t>>> expected{
      {301, {{1, 2, 3, 4}, {5, 6, 7, 8}, {1, 2, 5, 6}, {3, 4, 7, 8}, {1, 4, 5, 8}}},
      {302, {{2, 3, 9, 10}, {6, 7, 11, 12}, {2, 6, 9, 12}, {9, 10, 11, 12}, {3, 7, 10, 11}}},
      {303, {{21, 22, 23}, {21, 22, 24}, {21, 23, 24}, {22, 23, 24}}}};
  std::map<std::int64_t, std::set<std::set<std::int64_t>>> faces;
  std::size_t count = 0;
  for (const int part : {2, 3})
    for (const Drawn& f : drawn.at(part).items) {
      ++count;
      EXPECT_EQ(f.kind, ElementKind::solid8);
      faces[f.element].insert({f.nodes.begin(), f.nodes.end()});
      // Outward: the corners turn to the left as seen from outside the solid.
      const auto at = [&](std::int64_t id) {
        const NodeIndex n = p.b.model.nodes.map.find(id);
        return Vec{p.b.model.nodes.x[n], p.b.model.nodes.y[n], p.b.model.nodes.z[n]};
      };
      const Vec inside = f.element == 301   ? Vec{1.5, 2.5, 3.5}
                         : f.element == 302 ? Vec{6.5, 2.5, 3.5}
                                            : Vec{20.5, 0.5, 0.5};
      const Vec a = at(f.nodes[0]), normal = cross(at(f.nodes[1]) - a, at(f.nodes[2]) - a);
      EXPECT_GT(dot(normal, a - inside), 0) << f.element;
    }
  EXPECT_EQ(faces, expected);
  EXPECT_EQ(count, 14u);
}

TEST(PageMesh, PlacesLieOnAGridOfItsPart) {
  const Shapes p;
  const auto drawn = p.drawn();
  std::size_t places = 0;
  for (const auto& [part, d] : drawn)
    for (const auto& [id, at] : d.places) {
      ++places;
      const NodeIndex n = p.b.model.nodes.map.find(id);
      const double exact[] = {p.b.model.nodes.x[n], p.b.model.nodes.y[n], p.b.model.nodes.z[n]};
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(at[k], exact[k], 0.5 * d.steps[k]) << part << " " << id;
    }
  EXPECT_EQ(places, 4u + 4 + 12 + 4 + 2 + 2 + 2);
  // 2^20 - 1 steps between the lowest and the highest; a part without extent has steps of 1.
  EXPECT_EQ(drawn.at(2).steps, (std::array{10 / 1048575.0, 5 / 1048575.0, 7 / 1048575.0}));
  EXPECT_EQ(drawn.at(1).steps, (std::array{3.7 / 1048575.0, 5 / 1048575.0, 0.3 / 1048575.0}));
  EXPECT_EQ(drawn.at(4).steps, (std::array{3 / 1048575.0, 1.0, 1 / 1048575.0}));
}

/// Line of the first card that begins with this id behind the header of its block.
std::int64_t line_of(const Built& b, const std::string& header, int id) {
  const std::string text(b.deck.sources[0].bytes());
  char digits[32];
  std::snprintf(digits, sizeof digits, "\n%10d", id);
  const auto at = text.find(digits, text.find("\n" + header));
  EXPECT_NE(at, std::string::npos) << header << " " << id;
  return std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at) + 1, '\n') + 1;
}

TEST(PageElements, KnowTheirLineAndTheirOwnThickness) {
  const Shapes p;
  PageBlock in(detail::elements_block(p.b.model, p.mesh));
  for (const detail::MeshPart& part : p.mesh)
    for (const detail::MeshGroup& g : part.groups) {
      const std::size_t count = g.element.size();
      EXPECT_EQ(in.deltas(count), Ids(count, 0)) << "all in the first file";
      Ids lines;
      std::vector<double> thickness;
      const char* blocks[] = {"/SHELL/", "/SH3N/", "", "", "", "/TRUSS/", "/BEAM/", "/SPRING/"};
      for (const std::uint32_t e : g.element) {
        const auto id = static_cast<int>(p.b.model.family(g.kind).id[e]);
        const std::string header = g.kind == ElementKind::solid8
                                       ? id == 303 ? "/TETRA4/" : "/BRICK/"
                                       : blocks[static_cast<int>(g.kind)];
        lines.push_back(line_of(p.b, header, id));
        thickness.push_back(id == 101 ? 1.5 : id == 105 ? 2.5 : 0);
      }
      EXPECT_EQ(in.deltas(count), lines);
      EXPECT_EQ(in.palette(count), thickness);
    }
  EXPECT_TRUE(in.done());
}

TEST(PageCrossings, HaveEdgeElementAndSegment) {
  Page p(shapes());
  const auto n = [&](int id) { return p.b.model.nodes.map.find(id); };
  const auto shell4 = ElementKind::shell4, truss = ElementKind::truss;
  const std::vector<Crossing> all{{3, {n(33), n(34)}, shell4, 1, 5},
                                  {4, {n(41), n(42)}, truss, 0, 6}};
  detail::use_nodes(all, p.nodes);
  p.nodes.number();
  ASSERT_EQ(p.nodes.list().size(), 4u);
  EXPECT_EQ(p.id(0), 33);
  EXPECT_EQ(p.id(3), 42);
  EXPECT_EQ(Json::parse(PageBlock(detail::crossings_block(p.b.model, all, p.nodes)).bytes()),
            Json({{"total", 2}, {"rows", Json({{3, 0, 1, 0, 102, 5}, {4, 2, 3, 5, 201, 6}})}}));
}

TEST(PageMoved, ListsNodesThatStandElsewhereFarthestFirst) {
  SmallDeck before, now;
  before.node(1, 0, 0, 0).node(2, 1, 1, 1).node(3, 0, 0, 0).node(4, 5, 5, 5).node(9, 1, 2, 3);
  now.node(9, 1, 2, 9).node(1, 3, 4, 0).node(3, 0, 0, -5).node(4, 5, 5, 5).node(7, 8, 8, 8);
  const Built was(before);
  Page p(now);
  detail::use_moved(p.b.model, was.model, p.nodes);
  p.nodes.number();
  ASSERT_EQ(p.nodes.list().size(), 3u);
  Json rows = Json::parse(PageBlock(detail::moved_block(p.b.model, was.model, p.nodes)).bytes());
  EXPECT_EQ(rows["total"], 3);
  for (Json& row : rows["rows"]) row[0] = p.id(row[0]);
  // 6 far; then 5 far both, in the order of the model.
  EXPECT_EQ(rows["rows"], Json({{9, 0.0, 0.0, 6.0}, {1, 3.0, 4.0, 0.0}, {3, 0.0, 0.0, -5.0}}));
}

TEST(PageForces, ContactsHaveTheirSumsAndPairs) {
  Page p(shapes());
  p.nodes.number();
  cycle::SceneOutcome o;
  o.contact_dt = 0.375;
  o.structure.dt = 0.5;
  o.contacts.resize(4);
  cycle::ContactOutcome& c = o.contacts[0];
  c.complete = false;
  c.step.dt = 0.25;
  c.step.source = cycle::StepLimit::Source::kinematic;
  c.pairs_with_force = 3;
  c.totals.total_abs = 4.5;
  c.largest_force = 2.5;
  c.largest_acceleration = 1.5;
  c.totals.elastic_energy = 0.75;
  c.pairs.resize(2);
  c.pairs[0].at = {1, 2};
  c.pairs[0].force = {3, -4, 12};
  c.pairs[0].k_nodal = 9;
  c.pairs[1].at = {5, 6};
  c.pairs[1].force = {0, 0, 2};
  c.pairs[1].k_nodal = 8;
  o.contacts[1].active = false;
  o.contacts[1].step.source = cycle::StepLimit::Source::nodal;
  o.contacts[1].step.dt = 0.125;
  o.contacts[2].step.source = cycle::StepLimit::Source::velocity;
  const auto contact = [](bool active, bool complete, Json dt, const char* because) {
    return Json({{"active", active},
                 {"complete", complete},
                 {"dt", std::move(dt)},
                 {"because", because},
                 {"with_force", 0},
                 {"force", 0.0},
                 {"largest", 0.0},
                 {"acceleration", 0.0},
                 {"elastic", 0.0},
                 {"rows", Json::array()}});
  };
  Json first = contact(true, false, 0.25, "closing speed");
  first["with_force"] = 3;
  first["force"] = 4.5;
  first["largest"] = 2.5;
  first["acceleration"] = 1.5;
  first["elastic"] = 0.75;
  first["rows"] = Json({{1, 2, 13.0, 9.0}, {5, 6, 2.0, 8.0}});
  const Json expected{
      {"structure_dt", 0.5},
      {"contact_dt", 0.375},
      {"structure_element", nullptr},
      {"contacts",
       {first, contact(false, true, 0.125, "contact stiffness and nodal mass"),
        contact(true, true, nullptr, "speed of the interface"), contact(true, true, nullptr, "")}},
      {"nodes", Json::array()}};
  EXPECT_EQ(Json::parse(PageBlock(detail::cycle_block(o, {}, p.nodes, p.b.model)).bytes()),
            expected);
  // 1e30 means that there is no limit.
  o.contact_dt = o.structure.dt = 1e30;
  const Json none = Json::parse(PageBlock(detail::cycle_block(o, {}, p.nodes, p.b.model)).bytes());
  EXPECT_EQ(none["structure_dt"], Json());
  EXPECT_EQ(none["contact_dt"], Json());
}

/// A floor (part 1), a sheet 0.5 over it (2), one 1.5 over it (3, with a long title), one far away
/// (4), and a truss without a part's title. Parts 2 and 4 in interface 5, 2 to 4 in interface 8.
std::string touching() {
  SmallDeck d;
  const auto sheet = [&](int part, double z) {
    const int n = 10 * part;
    d.node(n + 1, 1, 1, z).node(n + 2, 9, 1, z).node(n + 3, 9, 9, z).node(n + 4, 1, 9, z);
    d.shell_part(part, 0.5).shell(part, part, n + 1, n + 2, n + 3, n + 4);
  };
  sheet(1, 0);
  sheet(2, 0.5);
  sheet(3, 1.5);
  sheet(4, 900);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/PART/2", {2, 4}).group("/GRNOD/PART/3", {2, 3, 4});
  d.add("@/INTER/TYPE7/5 grnd_IDs=2 surf_IDm=1 Gapmin=1");
  std::string text = d.add("@/INTER/TYPE7/8 grnd_IDs=3 surf_IDm=1 Gapmin=1").text();
  text.replace(text.find("/PART/3\npart") + 8, 4,
               "\xc3\xa4 title of more than twenty-eight letters");
  return text;
}

struct Touching {
  Touching() : b(touching()), view(make_view(b.scene)) {
    input.path = "x";
    input.deck = &b.deck;
    input.scene = &b.scene;
    input.view = &view;
    detail::PageNodes nodes(b.model.nodes.size());
    all = detail::collect_touches(input, detail::collect_contacts(input, nodes));
  }
  Built b;
  SceneView view;
  HtmlInput input;
  std::vector<detail::Touch> all;
};

TEST(PageTouches, ArePairsOfPartsWithTheirInterfacesAndDepths) {
  const Touching t;
  ASSERT_EQ(t.all.size(), 2u);
  // Positions of parts and interfaces; four nodes in two interfaces, 1 - 0.5 deep.
  EXPECT_EQ(t.all[0].secondary, 1);
  EXPECT_EQ(t.all[0].main, 0);
  EXPECT_EQ(t.all[0].interfaces, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(t.all[0].pairs, 8u);
  EXPECT_EQ(t.all[0].depth, 0.5);
  EXPECT_EQ(t.all[1].secondary, 2);
  EXPECT_EQ(t.all[1].main, 0);
  EXPECT_EQ(t.all[1].interfaces, (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(t.all[1].pairs, 0u);
  EXPECT_EQ(members([&](JsonWriter& j) { detail::write_touches(j, t.all); })["touches"],
            Json({{1, 0, 0, 1}, {2, 0, 1}}));
}

/// Numbers of all attributes `name` in the order of a drawing.
std::vector<double> numbers(const std::string& svg, const std::string& name) {
  std::vector<double> out;
  const std::string mark = " " + name + "=\"";
  for (auto at = svg.find(mark); at != svg.npos; at = svg.find(mark, at + 1))
    out.push_back(std::strtod(svg.c_str() + at + mark.size(), nullptr));
  return out;
}

TEST(PageTouches, AreDrawnInCellsOfEqualSize) {
  const Touching t;
  const std::string svg = detail::touches_drawing(t.input, t.all);
  EXPECT_EQ(svg, touches_svg(t.input));
  // The longest name has 28 letters, of which the middle is cut.
  const double left = 14 + 8.6 * 28, top = 14 + 8.6 * 6;
  EXPECT_THAT(svg,
              HasSubstr(">3 \xc3\xa4 title of mo\xe2\x80\xa6ight letters<title>3 \xc3\xa4 title "
                        "of more than twenty-eight letters</title></text>"));
  EXPECT_NEAR(numbers(svg, "width")[0], left + 24 + 8, 1e-9);
  EXPECT_NEAR(numbers(svg, "height")[0], top + 48 + 8, 1e-9);
  const std::vector<double> x = numbers(svg, "x"), y = numbers(svg, "y");
  // Per row: its name, the box of its cell and the number in it.
  ASSERT_EQ(x.size(), 6u);
  for (std::size_t row = 0; row < 2; ++row) {
    const double at = top + 24 * static_cast<double>(row);
    EXPECT_NEAR(x[3 * row], left - 8, 1e-9);
    EXPECT_NEAR(y[3 * row], at + 16, 1e-9);
    EXPECT_NEAR(x[3 * row + 1], left + 1, 1e-9);
    EXPECT_NEAR(y[3 * row + 1], at + 1, 1e-9);
    EXPECT_NEAR(x[3 * row + 2], left + 12, 1e-9);
    EXPECT_NEAR(y[3 * row + 2], at + 16, 1e-9);
    EXPECT_EQ(numbers(svg, "width")[1 + row], 22);
    EXPECT_EQ(numbers(svg, "height")[1 + row], 22);
  }
  const auto turned = svg.find("translate(");
  EXPECT_NEAR(std::strtod(svg.c_str() + turned + 10, nullptr), left + 16, 1e-9);
  EXPECT_NEAR(std::strtod(svg.c_str() + svg.find(' ', turned), nullptr), top - 6, 1e-9);
}

TEST(PageTouches, SayWhoTouchesWhomHowOften) {
  Touching t;
  const auto said = [&](std::size_t touch) {
    const std::string svg = detail::touches_drawing(t.input, t.all);
    const auto& x = t.all[touch];
    const auto at = svg.find("data-s=\"" + std::to_string(x.secondary) + "\" data-m=\"" +
                             std::to_string(x.main) + "\"><title>");
    EXPECT_NE(at, svg.npos);
    const std::string cell = svg.substr(at, svg.find("</g>", at) - at);
    return cell.substr(cell.find("<title>") + 7);
  };
  const auto title = [&](std::size_t i) {
    const std::string& own = t.b.scene.interfaces->ordered[i]->title;
    return own.empty() ? "" : " " + own;
  };
  EXPECT_THAT(said(0), HasSubstr("2 part and 1 part: 5" + title(0) + ", 8" + title(1) +
                                 "; 8 penetrations, deepest 0.5</title>"));
  EXPECT_THAT(said(0), HasSubstr(" class=\"deep\"/>"));
  EXPECT_THAT(said(0), HasSubstr("class=\"n\">2</text>"));
  EXPECT_THAT(said(1), HasSubstr("letters and 1 part: 8" + title(1) + "</title>"));
  EXPECT_THAT(said(1), HasSubstr(" class=\"near\"/>"));
  EXPECT_THAT(said(1), HasSubstr("class=\"m\">1</text>"));
  t.all[0].pairs = 1;
  EXPECT_THAT(said(0), HasSubstr("; 1 penetration, deepest"));
  t.all[0].secondary = -1;
  EXPECT_THAT(said(0), HasSubstr("(no part) and 1 part: 5"));
}

TEST(PageTouches, DeepestPartsComeFirstThenThoseWithMostNeighbours) {
  Touching t;
  const auto touch = [](int s, int m, double depth) {
    detail::Touch x;
    x.secondary = s;
    x.main = m;
    x.depth = depth;
    x.pairs = depth > 0;
    return x;
  };
  // Rows: 3 (0.5 deep), 1 (two neighbours), 0, 2; columns: 0 (0.5 deep), 1, 3 with one each.
  t.all = {touch(0, 0, 0), touch(1, 1, 0), touch(1, 0, 0), touch(2, 3, 0), touch(3, 0, 0.5)};
  const std::string svg = detail::touches_drawing(t.input, t.all);
  const auto place = [&](int s, int m) {
    const auto at = svg.find("data-s=\"" + std::to_string(s) + "\" data-m=\"" + std::to_string(m));
    EXPECT_NE(at, svg.npos);
    const std::string cell = svg.substr(at);
    return std::pair(numbers(cell, "x")[0], numbers(cell, "y")[0]);
  };
  const auto [x, y] = place(3, 0);
  const auto is_at = [&](std::pair<double, double> p, int column, int row) {
    EXPECT_NEAR(p.first, x + 24 * column, 1e-9);
    EXPECT_NEAR(p.second, y + 24 * row, 1e-9);
  };
  is_at(place(1, 0), 0, 1);
  is_at(place(1, 1), 1, 1);
  is_at(place(0, 0), 0, 2);
  is_at(place(2, 3), 2, 3);
  // Twelve cells, of which five touch.
  std::size_t none = 0;
  for (auto at = svg.find("class=\"none\""); at != svg.npos;
       at = svg.find("class=\"none\"", at + 1))
    ++none;
  EXPECT_EQ(none, 7u);
}

}  // namespace
}  // namespace deck::test
