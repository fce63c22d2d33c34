// Tests of penetration fixes: random scenes, and an oracle: plain loops over all pairs with the
// solver's formulas, which the tests of closest points and crossings hold to exact arithmetic.
#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "contact/meshes.hpp"
#include "contact/shared/closest.hpp"
#include "deck/edit.hpp"
#include "edit/shared/depenetrate.hpp"
#include "where.hpp"

namespace deck::test {

// ---- oracle -------------------------------------------------------------------------------------

using P = std::array<double, 3>;
inline P operator-(const P& a, const P& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline P operator+(const P& a, const P& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline double dot(const P& a, const P& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline P cross(const P& a, const P& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// interface id, role, secondary ids, sorted main ids
using OraclePair = std::tuple<std::int64_t, int, std::vector<std::int64_t>, std::set<std::int64_t>>;

/// Every penetrating pair with its depth, unless rounding (1e-9 of the gap) makes it one.
inline std::map<OraclePair, double> oracle_penetrations(const Built& b) {
  std::map<OraclePair, double> out;
  const Nodes& nodes = b.model.nodes;
  const auto at = [&](NodeIndex n) { return Point3<double>{nodes.x[n], nodes.y[n], nodes.z[n]}; };
  const auto gap_of = [](const Contact& c, double g, std::ptrdiff_t s, std::ptrdiff_t m) {
    const auto at = [](const auto& list, std::ptrdiff_t i) { return *(list.begin() + i); };
    if (c.igap == 0) return c.gapmin;
    if (c.igap == 3) g = std::min(g, at(c.secondary_length, s) + at(c.main_length, m));
    return std::max(std::min(g, c.gapmax), c.gapmin);
  };
  for (const Contact& c : b.scene.contacts) {
    const auto note = [&](std::vector<std::int64_t> s, std::set<std::int64_t> m, double depth,
                          double gap) {
      if (!(depth > 1e-9 * gap)) return;
      double& kept = out[{c.inter->id, static_cast<int>(c.role), std::move(s), std::move(m)}];
      kept = std::max(kept, depth);
    };
    for (const SecondaryNode& s : c.secondary)
      for (const MainSegment& m : c.main) {
        if (std::find(m.nodes.begin(), m.nodes.end(), s.node) != m.nodes.end()) continue;
        const double gap = gap_of(c, s.gap + m.gap, &s - c.secondary.data(), &m - c.main.data());
        const std::array<Point3<double>, 4> corners{at(m.nodes[0]), at(m.nodes[1]), at(m.nodes[2]),
                                                    at(m.nodes[3])};
        const double d =
            closest_on_segment<Form::reference>(at(s.node), corners, m.nodes[2] == m.nodes[3])
                .distance();
        const auto ids = b.ids(m.nodes);
        note({nodes.id[s.node]}, {ids.begin(), ids.end()}, gap - d, gap);
      }
    for (const ContactEdge& s : c.secondary_edges)
      for (const ContactEdge& m : c.main_edges) {
        if (s.nodes[0] == m.nodes[0] || s.nodes[0] == m.nodes[1] || s.nodes[1] == m.nodes[0] ||
            s.nodes[1] == m.nodes[1])
          continue;
        const double gap =
            gap_of(c, s.gap + m.gap, &s - c.secondary_edges.data(), &m - c.main_edges.data());
        const double d = closest_between_edges<Form::reference>(at(s.nodes[0]), at(s.nodes[1]),
                                                                at(m.nodes[0]), at(m.nodes[1]))
                             .distance;
        std::vector<std::int64_t> ids{nodes.id[s.nodes[0]], nodes.id[s.nodes[1]]};
        std::sort(ids.begin(), ids.end());
        note(ids, {nodes.id[m.nodes[0]], nodes.id[m.nodes[1]]}, gap - d, gap);
      }
  }
  return out;
}

/// Edges of shells, bars and bricks that pass through a shell: (edge ids, shell id).
inline std::set<std::tuple<std::int64_t, std::int64_t, std::int64_t>> oracle_crossings(
    const Built& b) {
  const Nodes& nodes = b.model.nodes;
  std::set<std::array<NodeIndex, 2>> unique;
  std::vector<std::array<NodeIndex, 4>> segments;
  std::vector<std::int64_t> shells;
  for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3, ElementKind::truss,
                                 ElementKind::beam, ElementKind::solid8}) {
    const Elements& f = b.model.family(kind);
    std::vector<std::array<int, 2>> local{{0, 1}};
    if (kind == ElementKind::shell4) local = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
    if (kind == ElementKind::shell3) local = {{0, 1}, {1, 2}, {2, 0}};
    if (kind == ElementKind::solid8)
      local = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
               {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
    for (std::size_t e = 0; e < f.size(); ++e) {
      const NodeIndex* n = f.of(e);
      for (const auto& [i, j] : local) unique.insert({std::min(n[i], n[j]), std::max(n[i], n[j])});
      if (kind != ElementKind::shell4 && kind != ElementKind::shell3) continue;
      segments.push_back({n[0], n[1], n[2], n[f.width - 1]});
      shells.push_back(f.id[e]);
    }
  }
  const std::vector<std::array<NodeIndex, 2>> edges(unique.begin(), unique.end());
  std::set<std::tuple<std::int64_t, std::int64_t, std::int64_t>> out;
  for (const CandidatePair& c : find_crossing_pairs({nodes.x, nodes.y, nodes.z}, edges, segments))
    out.insert({nodes.id[edges[c.secondary][0]], nodes.id[edges[c.secondary][1]], shells[c.main]});
  return out;
}

// ---- fixing -------------------------------------------------------------------------------------

inline const LoadedDeck& context_of(const Built& b) { return b.loaded; }

/// The main file's text after the fix.
inline std::string text_after(const Built& b, const PenetrationFix& fix) {
  auto changed = apply_rewrite(b.deck.sources, fix.rewrite);
  EXPECT_TRUE(changed.ok()) << changed.error().message;
  const auto it = changed->find(b.deck.sources[0].path());
  return it == changed->end() ? std::string(b.deck.sources[0].bytes()) : it->second;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

inline PenetrationFix reduced(const Built& b, ReduceGapOptions options = {}, double least = 0.1) {
  options.least_share = least;
  auto fix = reduce_gaps(context_of(b), options);
  EXPECT_TRUE(fix.ok()) << fix.error().message;
  return std::move(*fix);
}

inline const FieldChange* change(const PenetrationFix& fix, std::string_view field) {
  for (const FixedInterface& i : fix.interfaces)
    for (const FieldChange& c : i.changes)
      if (c.field == field) return &c;
  return nullptr;
}

/// The text with the sixth digit of a new value raised.
inline std::string with_more(std::string text, const FieldChange& c) {
  const double step = std::pow(10.0, std::floor(std::log10(c.new_value)) - 5);
  char larger[64];
  std::snprintf(larger, sizeof larger, "%.6g", c.new_value + 2 * step);
  for (auto at = text.find(" " + c.new_text); at != std::string::npos;
       at = text.find(" " + c.new_text, at + 1)) {
    const std::size_t end = at + 1 + c.new_text.size(), size = std::string(larger).size();
    text.replace(end - size, size, larger);
  }
  return text;
}

/// True if a reason for what is not done has this text.
inline bool says(const PenetrationFix& fix, const std::string& text) {
  return std::any_of(fix.refused.begin(), fix.refused.end(),
                     [&](const FixRefusal& r) { return r.reason.find(text) != std::string::npos; });
}

/// True if pairs of TYPE10 interface `id` are in the deck.
inline bool ties(const Built& b, std::int64_t id) {
  return std::any_of(b.interfaces.ordered.begin(), b.interfaces.ordered.end(),
                     [&](const InterBase* i) { return i->id == id && i->type == 10; });
}

/// No node moves along a normal by more than the depth of the penetrations it is in, and the margin
/// of that share of the gap, which is 2 at most in these scenes. In a corner that is longer than
/// deep.
inline void expect_within_depth(const Built& before, const PenetrationFix& fix, double clearance) {
  std::map<std::int64_t, double> depth;
  for (const auto& [pair, d] : oracle_penetrations(before)) {
    for (const std::int64_t n : std::get<2>(pair)) depth[n] = std::max(depth[n], d);
    for (const std::int64_t n : std::get<3>(pair)) depth[n] = std::max(depth[n], d);
  }
  for (const MovedNode& m : fix.moved) {
    ASSERT_TRUE(depth.contains(m.id)) << "node " << m.id << " is in no penetration";
    EXPECT_LE(m.distance, std::sqrt(3.0) * (depth[m.id] + 2 * clearance)) << "node " << m.id;
  }
}

/// Everything a fix by moving nodes promises, held against the oracle. Returns the deck afterwards.
/// With `ties_too` ties were treated.
inline std::unique_ptr<Built> expect_harmless(const Built& before, const PenetrationFix& fix,
                                              bool ties_too = false) {
  auto after = std::make_unique<Built>(text_after(before, fix));
  const auto was = oracle_penetrations(before), is = oracle_penetrations(*after);
  if (!ties_too)
    for (const auto& [pair, depth] : was)
      if (ties(before, std::get<0>(pair))) {
        EXPECT_TRUE(is.contains(pair)) << "came off its tie: node " << std::get<2>(pair)[0];
      }
  for (const auto& [pair, depth] : is) {
    const auto it = was.find(pair);
    EXPECT_TRUE(it != was.end()) << "new penetration of node " << std::get<2>(pair)[0];
    if (it != was.end() && (ties_too || !ties(before, std::get<0>(pair)))) {
      EXPECT_LE(depth, it->second * (1 + 1e-8));
    }
  }
  const auto crossed = oracle_crossings(before), crosses = oracle_crossings(*after);
  EXPECT_TRUE(std::includes(crossed.begin(), crossed.end(), crosses.begin(), crosses.end()))
      << "new crossed elements";

  // No shell is turned over at a corner, and no side of one is halved.
  const auto at = [](const Built& b, NodeIndex n) {
    return P{b.model.nodes.x[n], b.model.nodes.y[n], b.model.nodes.z[n]};
  };
  for (const Elements* f : {&before.model.shell4, &before.model.shell3})
    for (std::size_t e = 0; e < f->size(); ++e)
      for (int k = 0; k < f->width; ++k) {
        const NodeIndex n = f->of(e)[k], next = f->of(e)[(k + 1) % f->width],
                        last = f->of(e)[(k + f->width - 1) % f->width];
        const auto side = [&](const Built& b) { return at(b, next) - at(b, n); };
        const auto normal = [&](const Built& b) { return cross(side(b), at(b, last) - at(b, n)); };
        EXPECT_GE(dot(side(*after), side(*after)), 0.2499 * dot(side(before), side(before)));
        EXPECT_GT(dot(normal(before), normal(*after)), 0) << "shell " << f->id[e];
      }

  // Only the columns of moved coordinates change.
  std::map<std::int64_t, P> by;
  for (const MovedNode& m : fix.moved) by[m.id] = m.by;
  const auto a = lines_of(text_after(before, {})), b = lines_of(text_after(before, fix));
  EXPECT_EQ(a.size(), b.size());
  std::size_t changed = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == b[i]) continue;
    ++changed;
    const std::int64_t id = std::stoll(a[i].substr(0, 10));
    EXPECT_TRUE(by.contains(id)) << b[i];
    EXPECT_EQ(a[i].substr(0, 10), b[i].substr(0, 10));
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (by[id][axis] == 0) {
        EXPECT_EQ(a[i].substr(10 + 20 * axis, 20), b[i].substr(10 + 20 * axis, 20));
      }
    const std::size_t end = std::min<std::size_t>(a[i].size(), 70);
    EXPECT_EQ(a[i].substr(end), b[i].substr(end));
  }
  EXPECT_EQ(changed, by.size());
  return after;
}

// ---- scenes -------------------------------------------------------------------------------------

/// A sheet whose elements have the numbers of its first nodes.
template <class Shape>
void add_sheet(SmallDeck& d, int part, int first, int columns, int rows, const Shape& shape) {
  add_sheet(d, part, first, first, columns, rows, shape);
}

/// Two wavy plates of different meshes, the upper one turned, at `height`.
inline SmallDeck two_plates(unsigned seed, double height, const std::string& interface_card) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(-0.05, 0.05);
  SmallDeck d;
  d.shell_part(1, 1.0).shell_part(2, 0.6);
  add_sheet(d, 1, 1, 6, 6, [&](int i, int j) { return P{2.0 * i, 2.0 * j, noise(random)}; });
  const double angle = 0.3 + 0.1 * noise(random);
  add_sheet(d, 2, 1001, 5, 4, [&](int i, int j) {
    const double u = 1.7 * i - 1, v = 1.9 * j - 1;
    return P{3 + u * std::cos(angle) - v * std::sin(angle),
             2 + u * std::sin(angle) + v * std::cos(angle), height + noise(random)};
  });
  d.group("/GRNOD/PART/1", {2}).group("/SURF/PART/1", {1}).group("/SURF/PART/2", {2});
  d.group("/LINE/SURF/1", {1}).group("/LINE/SURF/2", {2});
  d.add(interface_card);
  return d;
}

/// A hairpin in section: two flanks 1.5 apart that open into a wide bend, one mesh. The flanks are
/// far from one another along it.
inline SmallDeck hairpin(unsigned seed, const std::string& interface_card) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(-0.03, 0.03);
  const std::vector<std::array<double, 2>> section{
      {0, 0},     {2, 0},     {4, 0},     {6, 0},      {8, 0},  {10, -1}, {12, -2.5},
      {14, -2.5}, {15.5, -1}, {16, 0.75}, {15.5, 2.5}, {14, 4}, {12, 4},  {10, 2.5},
      {8, 1.5},   {6, 1.5},   {4, 1.5},   {2, 1.5},    {0, 1.5}};
  SmallDeck d;
  d.shell_part(1, 1.0);
  add_sheet(d, 1, 1, static_cast<int>(section.size()) - 1, 4, [&](int i, int j) {
    const auto& s = section[static_cast<std::size_t>(i)];
    return P{s[0] + noise(random), 2.0 * j, s[1] + noise(random)};
  });
  d.group("/GRNOD/PART/1", {1}).group("/SURF/PART/1", {1});
  d.add(interface_card);
  return d;
}

/// Two blocks of bricks of different meshes with rough faces, `apart`.
inline SmallDeck two_blocks(unsigned seed, double apart, const std::string& interface_card) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(-0.05, 0.05);
  SmallDeck d;
  d.solid_part(1).solid_part(2);
  const auto block = [&](int part, int first, const P& corner, double size, int nx, int ny) {
    add_box(d, part, first, {nx, ny, 2}, [&](int i, int j, int k) {
      return corner +
             P{size * i + noise(random), size * j + noise(random), size * k + noise(random)};
    });
  };
  block(1, 1, {0, 0, 0}, 2, 4, 4);
  block(2, 1001, {1.3, 1.1, 4 + apart}, 1.7, 3, 2);
  d.group("/SURF/PART/EXT/1", {1}).group("/SURF/PART/EXT/2", {2}).group("/GRNOD/SURF/1", {2});
  return d.add(interface_card);
}

/// Sheets above one another, 0.6 apart, in self-contact.
inline SmallDeck stack_of_sheets(unsigned seed, int layers, const std::string& interface_card) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(-0.04, 0.04);
  SmallDeck d;
  std::vector<int> parts;
  for (int l = 0; l < layers; ++l) {
    d.shell_part(l + 1, 1.0);
    parts.push_back(l + 1);
    const double x = 10 * noise(random), y = 10 * noise(random);
    add_sheet(d, l + 1, 1 + 100 * l, 4, 4, [&](int i, int j) {
      return P{2.0 * i + x, 2.0 * j + y, 0.6 * l + noise(random)};
    });
  }
  d.group("/GRNOD/PART/1", parts).group("/SURF/PART/1", parts);
  return d.add(interface_card);
}

}  // namespace deck::test
