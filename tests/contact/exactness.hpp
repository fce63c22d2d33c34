// What the tests of the rules of TYPE24 and TYPE25 share: answers of double held against exact
// ones, the three accuracies held against each other, a tilted sheet, two sheets on a lattice.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "contact/meshes.hpp"

namespace deck::test {

/// Holds the answers of double that are no doubtful ones against exact ones, and counts them.
class Judged {
 public:
  void add(bool quick, bool doubtful, bool exact, const std::string& what) {
    ++all_;
    differ_ += quick != exact ? 1 : 0;
    if (doubtful) return;
    ++sure_;
    EXPECT_EQ(quick, exact) << what;
  }
  /// `share`: of all that are sure, one in so many at least.
  void expect(std::size_t least, std::size_t share) const {
    EXPECT_GT(all_, least);
    EXPECT_GT(differ_, 0u) << "there are hard cases among them";
    EXPECT_GT(sure_, all_ / share) << "the quick way knows something";
  }

 private:
  std::size_t all_ = 0, sure_ = 0, differ_ = 0;
};

/// What is in contact: nodes, or pairs of edges. Of equally near segments any may be named.
inline std::vector<std::pair<std::uint32_t, std::uint32_t>> in_contact(const Contact& c) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> out;
  for (const PenetrationRow& r : c.penetrations)
    if (r.in_contact) out.emplace_back(r.secondary, c.kind == ContactKind::edge_edge ? r.main : 0);
  return out;
}

/// What `robust` makes of a deck. `exact` lists what is in contact of that and nothing else,
/// `reference` what the solver acts on.
inline DecisionReport expect_agreeing(const SmallDeck& d, ContactRole role = ContactRole::primary) {
  const Built robust(d);
  SceneOptions o;
  o.accuracy = Accuracy::exact;
  const Built exact(d, o);
  o.accuracy = Accuracy::reference;
  const Built reference(d, o);
  const Contact& c = robust.contact(1, role);
  EXPECT_EQ(in_contact(exact.contact(1, role)), in_contact(c));
  EXPECT_EQ(exact.contact(1, role).penetrations.size(), in_contact(c).size());
  const auto acted =
      std::count_if(c.penetrations.begin(), c.penetrations.end(),
                    [](const PenetrationRow& r) { return r.action != PenetrationAction::none; });
  EXPECT_EQ(reference.contact(1, role).penetrations.size(), static_cast<std::size_t>(acted));
  return robust.scene.decisions;
}

/// A sheet of one segment, tilted by the normal (2, -2, 1) / 3: distances from it are thirds of
/// numbers that a double holds.
inline SmallDeck tilted_sheet(double side, double thickness) {
  const double x = 7 * side;
  SmallDeck d;
  d.node(1, x, 3, -5).node(2, x + side, 3 + 2 * side, -5 + 2 * side);
  d.node(3, x + 3 * side, 3 + 3 * side, -5).node(4, x + 2 * side, 3 + side, -5 - 2 * side);
  return d.shell_part(1, thickness).shell(1, 1, 1, 2, 3, 4);
}

/// Two sheets of triangles and squares on a lattice: many nodes lie on lines, planes or at the gap.
inline SmallDeck on_a_lattice(unsigned seed) {
  std::mt19937 random(seed);
  SmallDeck d;
  const double step = seed % 2 == 0 ? 1 : 0.1;
  int id = 1;
  for (int sheet = 0; sheet < 2; ++sheet) {
    const auto place = [&](int i, int j) {
      return std::array{step * (2 * i + static_cast<int>(random() % 2)), step * (2 * j + sheet),
                        step * (sheet * 1.0 + static_cast<int>(random() % 3) - 1)};
    };
    add_grid(d, 100 * sheet + 1, 5, 5, place, [&](int, int, const Corners4& n) {
      if (random() % 2 == 0)
        d.shell(sheet + 1, id, n[0], n[1], n[2], n[3]);
      else
        add_two_triangles(d, sheet + 1, id, n);
      id += 2;
    });
  }
  d.shell_part(1, step).shell_part(2, step);
  d.group("/SURF/PART/1", {1}).group("/SURF/PART/2", {2}).group("/SURF/PART/3", {1, 2});
  return d;
}

}  // namespace deck::test
