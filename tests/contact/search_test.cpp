// The pair search finds exactly the pairs of the brute-force loop, on meshes made to break it:
// orders, kernels, threads and limits are tried on the same scenes.
#include "deck/contacts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <random>

#include "contact/search/box_tree.hpp"
#include "contact/search/sweep.hpp"
#include "contact/search_scenes.hpp"
#include "contact/shared/sides.hpp"

namespace deck {
namespace {

using scenes::Dice;
using scenes::Mesh;

NodeSegmentInput node_input(const Mesh& mesh) {
  return {mesh.nodes(), mesh.secondary, {}, {}, {}, mesh.segments, {}, {}, {}};
}
EdgeEdgeInput edge_input(const Mesh& mesh) {
  return {mesh.nodes(), mesh.edges, {}, {}, {}, mesh.edges, {}, {}, {}};
}

// Options of every kind, by the number of the scene.
SearchOptions options_for(int scene, double gap) {
  SearchOptions o;
  const int igap = scene % 4;
  o.gap = PairGap::from_igap(igap, igap == 0 ? gap : 0.3 * gap, igap >= 2 ? 1.2 * gap : 1e30);
  if (scene % 3 == 1) o.margin = 0.25 * gap;
  if (scene % 5 == 2) o.drad = 1.1 * gap;
  o.form = scene % 2 == 0 ? Form::reference : Form::robust;
  return o;
}

template <class Find, class Input>
void expect_brute_force(const Find& find, const Input& in, SearchOptions o, int family) {
  const auto expected = scenes::brute_force(in, o);
  for (const int threads : {1, 2}) {
    o.threads = threads;
    const SearchResult result = find(in, o);
    EXPECT_TRUE(result.complete);
    EXPECT_EQ(result.pairs, expected) << "family " << family << ", threads " << threads;
    EXPECT_GE(result.tested, result.pairs.size());
  }
}

class SceneFamily : public testing::TestWithParam<int> {};

TEST_P(SceneFamily, NodeSegmentPairsEqualBruteForce) {
  std::size_t found = 0;
  for (int k = 0; k < 60; ++k) {
    Dice dice(static_cast<std::uint64_t>(1000 * GetParam() + k));
    double gap = 0;
    const Mesh mesh = scenes::make(GetParam(), dice, gap);
    const std::size_t n = mesh.secondary.size(), m = mesh.segments.size();
    const auto gs = scenes::random_gaps(dice, n, gap), gm = scenes::random_gaps(dice, m, gap);
    const auto ls = scenes::random_gaps(dice, n, gap), lm = scenes::random_gaps(dice, m, gap);
    const auto ks = scenes::random_stiffness(dice, n), km = scenes::random_stiffness(dice, m);
    NodeSegmentInput in = node_input(mesh);
    in.secondary_gap = gs;
    in.segment_gap = gm;
    in.secondary_length = ls;
    in.segment_length = lm;
    if (k % 2 == 1) {
      in.secondary_stiffness = ks;
      in.segment_stiffness = km;
    }
    const SearchOptions o = options_for(k, gap);
    expect_brute_force(find_node_segment_pairs, in, o, GetParam());
    found += find_node_segment_pairs(in, o).pairs.size();
  }
  EXPECT_GT(found, 1000U);  // the scenes are not empty
}

TEST_P(SceneFamily, EdgeEdgePairsEqualBruteForce) {
  std::size_t found = 0;
  for (int k = 0; k < 40; ++k) {
    Dice dice(static_cast<std::uint64_t>(1000 * GetParam() + k + 500));
    double gap = 0;
    const Mesh mesh = scenes::make(GetParam(), dice, gap);
    const std::size_t n = mesh.edges.size();
    const auto gs = scenes::random_gaps(dice, n, gap), gm = scenes::random_gaps(dice, n, gap);
    const auto ks = scenes::random_stiffness(dice, n);
    EdgeEdgeInput in = edge_input(mesh);
    in.secondary_gap = gs;
    in.main_gap = gm;
    if (k % 2 == 1) in.main_stiffness = ks;
    const SearchOptions o = options_for(k, gap);
    expect_brute_force(find_edge_edge_pairs, in, o, GetParam());
    found += find_edge_edge_pairs(in, o).pairs.size();
  }
  EXPECT_GT(found, 1000U);
}

// One sweep in both forms against a brute-force loop in each of them.
template <class Input>
std::size_t expect_both_forms(const Input& in, SearchOptions o, double robust_margin, int family) {
  o.form = Form::reference;
  const auto expected = scenes::brute_force(in, o);
  SearchOptions robust = o;
  robust.form = Form::robust;
  robust.margin = robust_margin;
  const auto near = scenes::brute_force(in, robust);
  std::vector<CandidatePair> only;
  std::set_difference(near.begin(), near.end(), expected.begin(), expected.end(),
                      std::back_inserter(only));
  for (const int threads : {1, 2}) {
    o.threads = threads;
    const sweep::BothForms both = sweep::find_both_forms(in, o, robust_margin);
    EXPECT_TRUE(both.result.complete);
    EXPECT_EQ(both.result.pairs, expected) << "family " << family;
    EXPECT_EQ(both.robust_only, only) << "family " << family;
  }
  return only.size();
}

TEST_P(SceneFamily, OneSweepInBothFormsEqualsTwoSearches) {
  std::size_t nodes = 0, edges = 0;
  for (int k = 0; k < 40; ++k) {
    Dice dice(static_cast<std::uint64_t>(1000 * GetParam() + k + 700));
    double gap = 0;
    const Mesh mesh = scenes::make(GetParam(), dice, gap);
    const auto gs = scenes::random_gaps(dice, mesh.secondary.size(), gap);
    NodeSegmentInput in = node_input(mesh);
    in.secondary_gap = gs;
    const SearchOptions o = options_for(k, gap);
    const double margin = k % 4 == 0 ? 0.0 : k % 4 == 1 ? 1e-6 * gap : 0.4 * gap;
    nodes += expect_both_forms(in, o, margin, GetParam());
    edges += expect_both_forms(edge_input(mesh), o, margin, GetParam());
  }
  if (GetParam() >= 4) return;  // of the others some have hardly a pair beyond the gap
  EXPECT_GT(nodes, 100U);
  EXPECT_GT(edges, 100U);
}

TEST_P(SceneFamily, NoPairIsNearerThanTheNearest) {
  for (int k = 0; k < 20; ++k) {
    Dice dice(static_cast<std::uint64_t>(1000 * GetParam() + k + 900));
    double gap = 0;
    const Mesh mesh = scenes::make(GetParam(), dice, gap);
    Contact c;
    for (const auto node : mesh.secondary) c.secondary.emplace_back().node = node;
    for (const auto& nodes : mesh.segments) c.main.push_back({.nodes = nodes, .stiffness = 1});
    SearchOptions nearer;
    nearer.margin = 4 * gap;
    const auto at = [&](std::uint32_t n) { return sweep::point(mesh.nodes(), n); };
    const auto reach_after = [&](const CandidatePair& p) {
      const auto& [a, b, d, e] = mesh.segments[p.main];
      const auto closest = closest_on_segment<Form::reference>(
          at(mesh.secondary[p.secondary]), {at(a), at(b), at(d), at(e)}, d == e);
      return nearer.margin = std::min(nearer.margin, closest.distance());
    };
    const detail::SearchSides sides(c, detail::SearchSides::Off::included);
    sides.find_nearest({mesh.x, mesh.y, mesh.z}, 4 * gap, 1 << 20, reach_after);
    EXPECT_TRUE(scenes::brute_force(node_input(mesh), nearer).empty()) << "scene " << k;
  }
}

INSTANTIATE_TEST_SUITE_P(All, SceneFamily, testing::Range(0, scenes::families));

// A larger scene without ties: found pairs as (secondary, main).
Mesh two_sheets(int n) {
  Mesh mesh;
  Dice dice(77);
  for (const double level : {0.0, 0.4}) {
    scenes::add_sheet(mesh, n, false, [&](int i, int j) {
      return std::array{i + dice.uniform(-0.2, 0.2), j + dice.uniform(-0.2, 0.2),
                        level + std::sin(0.1 * i) + dice.uniform(-0.1, 0.1)};
    });
  }
  mesh.all_nodes_secondary();
  mesh.edges_of_segments();
  return mesh;
}

SearchOptions with_gap(double gap) {
  SearchOptions o;
  o.gap = PairGap::constant(gap);
  return o;
}

// A list long enough that the search first tries the order it comes in.
TEST(SearchOrder, ShuffledNodesAreSorted) {
  const Mesh all = two_sheets(100);
  Mesh mesh = all;  // nodes of the second against some segments of the first
  mesh.secondary.erase(mesh.secondary.begin(), mesh.secondary.begin() + 101 * 101);
  std::shuffle(mesh.secondary.begin(), mesh.secondary.end(), std::mt19937(5));
  mesh.segments.clear();
  for (std::size_t i = 0; i < 10000; i += 23) mesh.segments.push_back(all.segments[i]);
  const NodeSegmentInput in = node_input(mesh);
  const SearchOptions o = with_gap(0.6);
  const sweep::NodeSweep w(in, o, 1);
  EXPECT_FALSE(std::is_sorted(w.items.begin(), w.items.end()));
  expect_brute_force(find_node_segment_pairs, in, o, 0);
  EXPECT_GT(find_node_segment_pairs(in, o).pairs.size(), 500U);
}

// Two sheets that overlap at one corner: the rest of both is left out before anything is sorted.
TEST(SearchOrder, DistantPartsOfBothSidesAreLeftOut) {
  constexpr int n = 24, corner = 4;
  Mesh mesh;
  for (const double from : {0.0, double{n - corner}})
    scenes::add_sheet(mesh, n, false, [&](int i, int j) {
      return std::array{from + i, from + j, from == 0 ? 0.0 : 0.3};
    });
  mesh.all_nodes_secondary();
  mesh.edges_of_segments();
  NodeSegmentInput in = node_input(mesh);
  in.secondary = in.secondary.subspan((n + 1) * (n + 1));
  in.segments = in.segments.first(n * n);
  EdgeEdgeInput edges = edge_input(mesh);
  edges.main = edges.main.first(edges.main.size() / 2);
  edges.secondary = edges.secondary.subspan(edges.secondary.size() / 2);
  const SearchOptions o = with_gap(0.6);
  for (const int threads : {1, 3}) {
    const sweep::NodeSweep nodes(in, o, threads);
    EXPECT_LE(nodes.items.size(), 49U);
    EXPECT_LE(nodes.segments.size(), 49U);
    EXPECT_LE(sweep::EdgeSweep(edges, o, threads).mains.size(), 112U);
  }
  expect_brute_force(find_node_segment_pairs, in, o, 0);
  expect_brute_force(find_edge_edge_pairs, edges, o, 0);
  EXPECT_EQ(find_node_segment_pairs(in, o).pairs.size(), 81U);
  for (std::uint32_t node : in.secondary) mesh.z[node] += 1;  // out of reach
  EXPECT_TRUE(find_node_segment_pairs(in, o).pairs.empty());
}

std::vector<CandidatePair> sorted(const sweep::Sink& sink) {
  std::vector<CandidatePair> pairs;
  sink.for_each([&pairs](const CandidatePair& pair) { pairs.push_back(pair); });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

TEST(SearchKernels, EveryInstructionSetFindsTheSamePairs) {
  for (int k = 0; k < 10 * scenes::families; ++k) {
    Dice dice(static_cast<std::uint64_t>(9000 + k));
    double gap = 0;
    const Mesh mesh = scenes::make(k % scenes::families, dice, gap);
    const NodeSegmentInput in = node_input(mesh);
    SearchOptions o = with_gap(gap);
    const sweep::NodeSweep w(in, o, 1);
    const auto expected = scenes::brute_force(in, o);
    for (const auto& kernels : sweep::all_kernels()) {
      sweep::Found found;
      kernels.nodes(w, 0, w.segments.size(), found);
      EXPECT_EQ(sorted(found.pairs), expected) << kernels.name;
    }
    const EdgeEdgeInput edges = edge_input(mesh);
    const sweep::EdgeSweep e(edges, o, 1);
    const auto expected_edges = scenes::brute_force(edges, o);
    for (const auto& kernels : sweep::all_kernels()) {
      sweep::Found found;
      kernels.edges(e, 0, e.mains.size(), found);
      EXPECT_EQ(sorted(found.pairs), expected_edges) << kernels.name;
    }
  }
}

TEST(SearchKernels, EveryInstructionSetFindsTheSameMeetingsOfBoxes) {
  Dice dice(4711);
  double gap = 0;
  const Mesh mesh = scenes::make(0, dice, gap);
  std::vector<Box> boxes;
  for (const auto& edge : mesh.edges) boxes.push_back(sweep::box_of_nodes(mesh.nodes(), edge, gap));
  boxes.push_back({{-Box::infinity, -Box::infinity, -Box::infinity},
                   {Box::infinity, Box::infinity, Box::infinity}});
  const BoxTree tree(
      boxes.size(), [&](std::size_t i) { return boxes[i]; }, 1);
  // The last box is no edge's.
  std::vector<sweep::EdgeNodes> edges(mesh.edges.begin(), mesh.edges.end());
  edges.push_back({sweep::no_node - 1, sweep::no_node - 1});
  std::vector<sweep::CornerBlock> corners(tree.level(0).size());
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k) corners[i / 8].node[k][i % 8] = edges[i][k / 2];
  const auto share = [&](std::size_t i, std::size_t j) {
    const auto &a = edges[i], &b = edges[j];
    return a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
  };
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  Pairs expected, expected_apart;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    for (std::uint32_t j = 0; j < boxes.size(); ++j) {
      const FloatBox a = tree.rounded(boxes[i]), b = tree.rounded(boxes[j]);
      bool meet = true;
      for (std::size_t k = 0; k < 3; ++k) meet &= a.low[k] <= b.high[k] && b.low[k] <= a.high[k];
      EXPECT_TRUE(meet || !boxes[i].overlaps(boxes[j])) << "what overlaps does so when rounded";
      if (meet) expected.emplace_back(i, j);
      if (meet && !share(i, j)) expected_apart.emplace_back(i, j);
    }
  ASSERT_LT(expected_apart.size(), expected.size());
  const auto sorted = [](const std::vector<sweep::Meeting>& meetings) {
    Pairs found;
    for (const sweep::Meeting& m : meetings) found.emplace_back(m.box, m.leaf);
    std::sort(found.begin(), found.end());
    return found;
  };
  for (const auto& kernels : sweep::all_kernels()) {
    std::vector<sweep::Meeting> meetings, apart;
    kernels.meetings(tree, boxes, meetings);
    EXPECT_EQ(sorted(meetings), expected) << kernels.name;
    kernels.meetings_apart(tree, corners, boxes, edges, apart);
    EXPECT_EQ(sorted(apart), expected_apart) << kernels.name;
  }
}

TEST(SearchBoxes, RoundedBoxesOverlapWhereBoxesDo) {
  Dice dice(815);
  for (const int exponent : {-1060, -300, -149, -126, 0, 24, 100, 127, 128, 300, 1020}) {
    std::vector<Box> boxes;
    for (int i = 0; i < 64; ++i) {
      Box b;
      for (std::size_t k = 0; k < 3; ++k) {
        b.low[k] = std::ldexp(dice.uniform(-1, 1), exponent);
        b.high[k] = b.low[k] + std::ldexp(dice.uniform(0, 0.5), exponent);
        // Neighbours that touch.
        if (i % 2 != 0) b.low[k] = boxes.back().high[k], b.high[k] = std::max(b.high[k], b.low[k]);
      }
      boxes.push_back(b);
    }
    for (const double far : {0x1p-200, 1e9, 0x1p130, 0x1p1023})
      boxes.push_back({{far, -far, far}, {far, far, Box::infinity}});
    boxes.push_back(Box::nowhere());
    const BoxTree tree(
        boxes.size(), [&](std::size_t i) { return boxes[i]; }, 1);
    for (const Box& a : boxes)
      for (const Box& b : boxes) {
        const FloatBox p = tree.rounded(a), q = tree.rounded(b);
        bool meet = true;
        for (std::size_t k = 0; k < 3; ++k) meet &= p.low[k] <= q.high[k] && q.low[k] <= p.high[k];
        EXPECT_TRUE(meet || !a.overlaps(b)) << "2^" << exponent;
      }
    const FloatBox none = tree.rounded(Box::nowhere());
    for (std::size_t k = 0; k < 3; ++k) EXPECT_FALSE(none.low[k] <= FloatBox::infinity);
  }
}

TEST(SearchInvariance, PowerOfTwoScaling) {
  const Mesh mesh = two_sheets(20);
  SearchOptions o = with_gap(0.6);
  o.form = Form::robust;
  const auto base = find_node_segment_pairs(node_input(mesh), o).pairs;
  const auto base_edges = find_edge_edge_pairs(edge_input(mesh), o).pairs;
  EXPECT_EQ(base_edges, scenes::brute_force(edge_input(mesh), o));
  for (const int k : {-300, -120, -20, 33, 120, 300}) {
    Mesh scaled = mesh;
    for (auto* axis : {&scaled.x, &scaled.y, &scaled.z})
      for (double& v : *axis) v = std::ldexp(v, k);
    SearchOptions s = o;
    s.gap = PairGap::constant(std::ldexp(0.6, k));
    EXPECT_EQ(find_node_segment_pairs(node_input(scaled), s).pairs, base) << k;
    EXPECT_EQ(find_edge_edge_pairs(edge_input(scaled), s).pairs, base_edges) << k;
  }
}

TEST(SearchLimits, ABoundBelowOneChunkOfPairsHoldsForAnyNumberOfThreads) {
  const Mesh mesh = two_sheets(20);
  const std::size_t pairs = mesh.segments.size() * (mesh.secondary.size() - 4);
  for (const int threads : {1, 2, 4}) {
    SearchOptions o = with_gap(1e3);
    o.threads = threads;
    o.max_pairs = pairs - 1;
    EXPECT_FALSE(find_node_segment_pairs(node_input(mesh), o).complete);
    o.max_pairs = pairs;
    EXPECT_EQ(find_node_segment_pairs(node_input(mesh), o).pairs.size(), pairs);
  }
}

// The places of the tree that hold no box must stay out of an infinite reach.
TEST(SearchLimits, AnInfiniteReachFindsWhatIsThereAndNothingElse) {
  for (const int size : {1, 3, 20}) {
    const Mesh mesh = two_sheets(size);
    SearchOptions o = with_gap(1.0);
    o.margin = std::numeric_limits<double>::infinity();
    expect_brute_force(find_node_segment_pairs, node_input(mesh), o, size);
    expect_brute_force(find_edge_edge_pairs, edge_input(mesh), o, size);
  }
}

TEST(SearchLimits, CoordinatesWithoutBoundsAreNoReadsOutOfBounds) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  for (const double far : {1e154, 1e300, inf, -inf, std::nan("")}) {
    Mesh mesh = two_sheets(60);  // large enough for the order of the mesh to be tried
    for (std::size_t n = 0; n < mesh.x.size(); n += 211) mesh.x[n] = far;
    SearchOptions o = with_gap(0.5);
    for (const Form form : {Form::reference, Form::robust}) {
      o.form = form;
      for (const CandidatePair& p : find_node_segment_pairs(node_input(mesh), o).pairs) {
        ASSERT_LT(p.secondary, mesh.secondary.size());
        ASSERT_LT(p.main, mesh.segments.size());
      }
    }
  }
}

TEST(CandidateMargin, FifthOfTheMeanEdgeInSinglePrecision) {
  Mesh mesh;
  const auto a = mesh.add(0, 0, 0), b = mesh.add(3, 0, 0), c = mesh.add(3, 4, 0),
             d = mesh.add(0, 4, 0);
  mesh.segments = {{a, b, c, d}, {a, b, c, c}};
  // Edges 3 4 3 4 and 3 4 0 5: sum 26 over eight.
  EXPECT_DOUBLE_EQ(candidate_margin(mesh.nodes(), mesh.segments),
                   static_cast<double>(0.2F) * 26.0 / 8.0);
}

TEST(PairGapRule, SharesOfTheTwoSidesCoverThePairGap) {
  Dice dice(5);
  for (int i = 0; i < 1000; ++i) {
    const auto gap = PairGap::from_igap(i % 4, dice.uniform(0, 2), dice.uniform(0, 3));
    const double a = dice.uniform(0, 2), b = dice.uniform(0, 2);
    EXPECT_LE(gap(a, b, 1.0, 1.0), (gap.share(a) + gap.share(b)) * (1 + 1e-15));
  }
}

TEST(SpaceOrder, TheRadixSortIsTheStableSortOfItsBits) {
  Dice dice(8);
  for (const std::size_t n : {100u, 5000u}) {
    for (const int threads : {1, 3}) {
      const auto index_bits = static_cast<unsigned>(std::bit_width(n - 1));
      std::vector<std::uint64_t> keys(n), spare;
      for (std::size_t i = 0; i < n; ++i)
        keys[i] = static_cast<std::uint64_t>(dice.uniform(0, 1 << 17)) << index_bits | i;
      auto expected = keys;
      std::sort(expected.begin(), expected.end());
      order_detail::radix_sort(keys, spare, index_bits, index_bits + 17, threads);
      EXPECT_EQ(keys, expected) << n;
    }
  }
}

TEST(SpaceOrder, IsAPermutationForAnyGradingAndThreads) {
  Dice dice(3);
  std::vector<Point3<double>> p(20000);
  for (auto& q : p) {
    const double scale = std::pow(10.0, dice.uniform(-12, 6));
    q = {scale * dice.uniform(0, 1), scale * dice.uniform(0, 1), 0.0};
  }
  for (std::size_t i = 0; i < 3000; ++i) p[i] = {1, 1, 1};
  const auto order = [&p](int threads) {
    return order_by_place(
        p.size(), [&p](std::uint32_t i) { return Place{p[i]}; }, threads);
  };
  const auto one = order(1);
  EXPECT_EQ(order(2), one);
  auto sorted = one;
  std::sort(sorted.begin(), sorted.end());
  for (std::uint32_t i = 0; i < sorted.size(); ++i) ASSERT_EQ(sorted[i], i);
}

}  // namespace
}  // namespace deck
