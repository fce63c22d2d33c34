// Groups, surfaces and lines: what is selected, in which order, and what is said about mistakes.
// The blocks with what they select are in selection.txt.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "model/selection_deck.hpp"
#include "model/shared/faces.hpp"
#include "where.hpp"

namespace deck::test {
namespace {

/// A block of selection.txt as lines of a deck.
std::string block_of(const std::string& line) {
  std::istringstream words(line);
  std::string header, out;
  words >> header;
  constexpr const char* without_title[] = {"/NODE",   "/SHELL", "/SH3N",   "/TETRA4", "/TETRA10",
                                           "/PENTA6", "/BRICK", "/BRIC20", "/ANALY",  "//ENDSUB"};
  const bool titled =
      std::none_of(std::begin(without_title), std::end(without_title), [&](const char* keyword) {
        return header == keyword || header.starts_with(std::string(keyword) + "/");
      });
  out = header + (titled ? "\nt\n" : "\n");
  std::size_t cells = 0;
  for (std::string word; words >> word; ++cells) {
    const bool number = word.find_first_not_of("-0123456789.") == word.npos;
    if (word == "|" || cells == 10) {
      out += "\n";
      cells = 0;
      if (word == "|") {
        --cells;
        continue;
      }
    }
    const std::size_t width = number && word.find('.') != word.npos ? 20 : 10;
    if (word == "_") word = " ";
    word.insert(number ? 0 : word.size(), width - word.size(), ' ');
    out += word;
  }
  return out + "\n";
}

std::string joined(const Ids& ids) {
  std::string out;
  for (const std::int64_t id : ids) out += (out.empty() ? "" : " ") + std::to_string(id);
  return out;
}

/// One case of selection.txt.
struct Selected {
  std::string title, blocks, base = "parts quads cubes";
  int version = 2024;
  std::vector<std::string> questions;
  std::string deck() const {
    std::string out;
    if (base.find("parts") != base.npos) out += parts();
    if (base.find("grid") != base.npos) out += grid_nodes();
    if (base.find("quads") != base.npos) out += quads();
    if (base.find("cubes") != base.npos) out += cube_nodes() + cubes();
    return out + blocks;
  }
  void expect_answers() const {
    BuiltModel b(deck(), "kg mm ms", version);
    for (const std::string& q : questions) {
      const auto end = q.find(": ");
      const std::string wanted = q.substr(end + 2);
      EXPECT_EQ(answer(b, q.substr(0, end), wanted), wanted) << title << ": " << q;
    }
  }

 private:
  static std::string answer(BuiltModel& b, const std::string& question, const std::string& wanted) {
    const auto slash = question.find('/');
    const std::string kind = question.substr(0, slash);
    if (slash == question.npos) {
      const auto rule = static_cast<RuleId>(std::stoi(question.substr(2)));
      b.selections().resolve_all();
      return wanted[0] == 'x' ? "x" + std::to_string(b.findings(rule))
                              : std::to_string(b.message(rule));
    }
    const std::int64_t id = std::stoll(question.substr(slash + 1));
    std::vector<Ids> found;
    bool known = true;
    if (kind == "surf" || kind == "line") {
      known = kind == "surf" ? b.selections().surface(id) != nullptr
                             : b.selections().line(id) != nullptr;
      found = kind == "surf" ? b.surface(id) : b.line(id);
    } else {
      Ids ids;
      known = members(b, kind, id, ids);
      for (const std::int64_t one : ids) found.push_back({one});
    }
    if (!known) return "no such";
    if (found.empty()) return "none";
    for (const char* unit : {" nodes", " segments", " edges"})
      if (wanted.ends_with(unit)) return std::to_string(found.size()) + unit;
    std::string out;
    const std::string between = kind == "surf" || kind == "line" ? ", " : " ";
    for (const Ids& one : found) out += (out.empty() ? "" : between) + joined(one);
    return out;
  }
  static bool members(BuiltModel& b, const std::string& kind, std::int64_t id, Ids& out) {
    const Model& m = b.model();
    if (kind == "node") {
      const NodeIndex n = m.find_node(id);
      if (n == no_index) return false;
      for (const auto* x : {&m.nodes.x, &m.nodes.y, &m.nodes.z})
        out.push_back(std::llround((*x)[n]));
      return true;
    }
    if (kind == "grnod") {
      if (b.selections().node_group(id) == nullptr) return false;
      out = b.group(id);
      return true;
    }
    const auto* group =
        kind == "grpart" ? b.selections().part_group(id) : b.selections().element_group(kind, id);
    if (group == nullptr) return false;
    for (const std::uint32_t i : *group)
      out.push_back(kind == "grpart" ? m.parts[i].id : m.shell4.id[i]);
    return true;
  }
};

TEST(Selections, AreThoseOfSelectionTxt) {
  std::ifstream in(source_dir() / "tests/model/selection.txt");
  std::vector<Selected> all;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("== ")) {
      all.emplace_back().title = line.substr(3);
    } else if (all.empty()) {
      continue;
    } else if (line.starts_with("base: ")) {
      all.back().base = line.substr(6);
    } else if (line.starts_with("version: ")) {
      all.back().version = std::stoi(line.substr(9));
    } else if (line.starts_with("= ")) {
      all.back().questions.push_back(line.substr(2));
    } else if (line.starts_with("/")) {
      all.back().blocks += block_of(line);
    }
  }
  EXPECT_GT(all.size(), 50u);
  for (const Selected& one : all) one.expect_answers();
}

/// An outline, asked first or last, has the segments of the surface, wherever a piece begins.
void expect_outline(const std::string& blocks, std::int64_t id, bool by_elements) {
  BuiltModel first(blocks), last(blocks);
  const auto outline = first.selections().outline(id);
  ASSERT_TRUE(outline);
  EXPECT_EQ(outline->segments.is_from_shells(), by_elements);
  const Surface* surface = last.selections().surface(id);
  ASSERT_NE(surface, nullptr);
  const auto same = [](const Segment& a, const Segment& b) {
    return a.nodes == b.nodes && a.carrier == b.carrier && a.element == b.element;
  };
  const auto expect_same = [&](const SegmentList& list) {
    ASSERT_EQ(list.size(), surface->segments.size());
    std::vector<Segment> room;
    for (std::size_t begin = 0; begin <= list.size(); ++begin)
      for (std::size_t end = begin; end <= list.size(); ++end) {
        const auto some = list.some(begin, end, room);
        EXPECT_TRUE(std::equal(some.begin(), some.end(), surface->segments.begin() + begin,
                               surface->segments.begin() + end, same))
            << begin << " " << end;
      }
  };
  expect_same(outline->segments);
  expect_same(last.selections().outline(id)->segments);
  const Surface* again = first.selections().surface(id);
  ASSERT_NE(again, nullptr);
  EXPECT_EQ(again->title, surface->title);
  EXPECT_EQ(again->span.offset, surface->span.offset);
  expect_same({first.model(), again->segments});
  first.selections().resolve_all();
  last.selections().resolve_all();
  EXPECT_EQ(first.selections().findings().counts(), last.selections().findings().counts());
}

TEST(Surface, OutlineHasTheSegmentsOfTheSurface) {
  const std::string shells = parts() + grid_nodes() + "/SHELL/1\n" + cells({1, 1, 2, 5, 4}) +
                             "/SHELL/2\n" + cells({2, 2, 3, 6, 5}) + "/SHELL/1\n" +
                             cells({3, 4, 5, 8, 7}) + cells({4, 5, 6, 9, 8}) + "/SH3N/3\n" +
                             cells({1, 1, 2, 5}) + cells({2, 2, 6, 5});
  const auto of = [](const Ids& parts) { return "/SURF/PART/1\ntitle\n" + cells(parts); };
  expect_outline(shells + of({2, 3}), 1, true);
  expect_outline(shells + of({1, -3}), 1, true);
  expect_outline(shells + of({-1, 9}), 1, true);
  expect_outline(shells + of({9}), 1, true);
  expect_outline(shells + of({1, 2}), 1, false);  // the order is that of the ids: 1 2 3 4
  expect_outline(shells + "/SHELL/3\n" + cells({9, 1, 2, 5, 77}) + of({3}), 1, false);
  expect_outline(shells + of({1}) + "/SURF/SURF/2\ns\n" + cells({1}), 2, false);
  const std::string bricks = "/BRICK/4\n" + cells({1, 1, 2, 5, 4, 11, 12, 15, 14});
  expect_outline(shells + bricks + of({1, 4}), 1, false);
  expect_outline(shells + bricks + "/SURF/PART/EXT/1\ns\n" + cells({1}), 1, true);
  BuiltModel none(shells + of({1}));
  EXPECT_FALSE(none.selections().outline(2));
}

TEST(Surface, AnOutlineCountsAsHeld) {
  const std::string blocks = parts() + grid_nodes() + "/SHELL/1\n" + cells({1, 1, 2, 5, 4}) +
                             cells({2, 2, 3, 6, 5}) + "/SURF/PART/1\ns\n" + cells({1});
  for (const std::size_t room : {1, 2}) {
    Limits limits;
    limits.selection_bytes = room * sizeof(Segment);
    BuiltModel b(blocks);
    b.selections().set_limits(limits);
    const auto outline = b.selections().outline(1);
    ASSERT_TRUE(outline);
    EXPECT_EQ(outline->segments.size(), room == 2 ? 2u : 0u);
    EXPECT_EQ(b.selections().surface(1)->segments.size(), outline->segments.size());
    EXPECT_EQ(b.selections().complete(), room == 2);
  }
}

TEST(SolidFaces, ATenNodeFaceWithOneOrTwoMidsIsCutAtTheFirst) {
  const std::array<NodeIndex, 3> corners{10, 20, 30};
  std::array<std::array<NodeIndex, 4>, 4> out;
  using Tri = std::array<NodeIndex, 4>;
  ASSERT_EQ(detail::cut_triangle(corners, {no_index, 25, no_index}, out), 2);
  EXPECT_EQ(out[0], (Tri{20, 25, 10, 10}));
  EXPECT_EQ(out[1], (Tri{25, 30, 10, 10}));
  // Two: no quadrangle, the second mid is left aside.
  ASSERT_EQ(detail::cut_triangle(corners, {no_index, 25, 31}, out), 2);
  EXPECT_EQ(out[0], (Tri{20, 25, 10, 10}));
  EXPECT_EQ(out[1], (Tri{25, 30, 10, 10}));
  ASSERT_EQ(detail::cut_triangle(corners, {15, no_index, 31}, out), 2);
  EXPECT_EQ(out[0], (Tri{10, 15, 30, 30}));
  EXPECT_EQ(out[1], (Tri{15, 20, 30, 30}));
}

TEST(Selections, FollowTheirModelWhenItMoves) {
  BuiltModel b(parts() + quads() + "/SURF/PART/1\ns\n" + cells({1}));
  const Model moved = std::move(b.model());
  EXPECT_EQ(moved.selections->surface(1)->segments.size(), 2u);
}

// ---- bounds ------------------------------------------------------------------------------------

std::string deck() { return parts() + quads(); }

TEST(SelectionBounds, WhatExceedsTheMemoryIsLeftOutWithOneFinding) {
  std::string text = deck();
  for (int k = 1; k <= 60; ++k)
    text += "/SURF/SURF/" + std::to_string(k) + "\ns\n" + cells({k + 100, k + 1});
  for (int k = 1; k <= 60; ++k)
    text += "/SURF/SURF/" + std::to_string(k + 100) + "\ns\n" + cells({k + 1});
  text += "/SURF/PART/61\ns\n" + cells({1});
  BuiltModel b(text);
  Limits limits;
  limits.selection_bytes = 1 << 20;
  Selections bounded(b.model(), SchemaSet::built_in(), limits);
  bounded.resolve_all();
  EXPECT_FALSE(bounded.complete());
  EXPECT_EQ(bounded.findings().counts().at(RuleId::DK332), 1u);
  Selections small(b.model(), SchemaSet::built_in(), limits);
  EXPECT_EQ(small.surface(55)->segments.size(), 2u << 6);
  EXPECT_TRUE(small.complete());
}

}  // namespace
}  // namespace deck::test
