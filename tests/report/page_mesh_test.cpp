// Data blocks of the page: the mesh, moved nodes, and numbers that come back to the last bit.
#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "report/page.hpp"

namespace deck::test {
namespace {

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

TEST(PageMoved, ListsNodesThatStandElsewhereFarthestFirst) {
  SmallDeck before, now;
  before.node(1, 0, 0, 0).node(2, 1, 1, 1).node(3, 0, 0, 0).node(4, 5, 5, 5).node(9, 1, 2, 3);
  now.node(9, 1, 2, 9).node(1, 3, 4, 0).node(3, 0, 0, -5).node(4, 5, 5, 5).node(7, 8, 8, 8);
  const Built was(before);
  Page p(now);
  const SceneView view = make_view(p.b.scene);
  HtmlInput input;
  input.deck = &p.b.deck;
  input.scene = &p.b.scene;
  input.view = &view;
  input.before = &was.model;
  const std::vector<detail::DataBlock> blocks = detail::optional_blocks(input, p.nodes);
  p.nodes.number();
  ASSERT_EQ(p.nodes.list().size(), 3u);
  Json rows = Json::parse(PageBlock(blocks.at(0).make()).bytes());
  EXPECT_EQ(rows["total"], 3);
  for (Json& row : rows["rows"]) row[0] = p.id(row[0]);
  // 6 far; then 5 far both, in the order of the model. Nobody gave them a part.
  EXPECT_EQ(rows["rows"],
            Json({{9, 0.0, 0.0, 6.0, -1}, {1, 3.0, 4.0, 0.0, -1}, {3, 0.0, 0.0, -5.0, -1}}));
}

TEST(PageStream, DecimalsComeBackToTheLastBit) {
  const std::vector<std::vector<double>> lists{
      {},        {0, -1, 1e9, 12345.678, -0.1, 0.3, 1.0 / 1024}, {0.1 + 0.2}, {-0.0, 1}, {1e300, 1},
      {1.0 / 3}, {std::numeric_limits<double>::quiet_NaN(), 1}};
  for (const auto& list : lists) {
    detail::ByteStream out;
    out.decimals(list);
    PageBlock in(std::move(out).text());
    const std::vector<double> back = in.decimals(list.size());
    ASSERT_EQ(back.size(), list.size());
    for (std::size_t i = 0; i < list.size(); ++i)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(back[i]), std::bit_cast<std::uint64_t>(list[i]))
          << list[i];
    EXPECT_TRUE(in.done());
  }
}

TEST(PageStream, FewValuesAreNumberedInTheirOrder) {
  const std::vector<double> list{2, 2, 0, -0.0, 2, std::numeric_limits<double>::quiet_NaN(), 0};
  detail::ByteStream out;
  out.palette(list, [](double v) { return v; });
  PageBlock in(std::move(out).text());
  const std::vector<double> back = in.palette(list.size());
  for (std::size_t i = 0; i < list.size(); ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(back[i]), std::bit_cast<std::uint64_t>(list[i])) << i;
  EXPECT_TRUE(in.done());
}

}  // namespace
}  // namespace deck::test
