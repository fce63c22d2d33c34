// Two shells one above the other, the smallest deck with a contact force.
#pragma once
#include <algorithm>
#include <memory>
#include <string>

#include "contact/small_deck.hpp"
#include "deck/cycle.hpp"

namespace deck::cycle::testing {

/// A scene that forces can be computed of.
inline SceneOptions with_stiffness() {
  SceneOptions o;
  o.nodal_stiffness = true;
  return o;
}

/// Steps of `dt`.
inline CycleOptions with_step(double dt, Model model = Model::robust) {
  CycleOptions o;
  o.dt1 = o.dt12 = dt;
  o.model = model;
  return o;
}

/// A square shell of side 10 in z = 0 (part 1) and one of side 4 above it (part 2), thickness 1.
inline test::SmallDeck plates(double distance) {
  test::SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(11, 1, 5, distance).node(12, 5, 1, distance).node(13, 9, 5, distance);
  d.node(14, 5, 9, distance);
  d.shell_part(1, 1.0).shell_part(2, 1.0);
  d.shell(1, 1, 1, 2, 3, 4).shell(2, 2, 11, 12, 13, 14);
  d.group("/GRNOD/PART/1", {2}).group("/SURF/PART/2", {1});
  return d;
}

/// The same with an interface ("@/INTER/TYPE7/1 Fric=0.3") between them, by default of gap 1.
inline std::unique_ptr<test::Built> plates_in_contact(const std::string& interface,
                                                      double distance) {
  test::SmallDeck d = plates(distance);
  const std::size_t blank = std::min(interface.find(' '), interface.size());
  d.add(interface.substr(0, blank) + " grnd_IDs=1 surf_IDm=2 Gapmin=1" + interface.substr(blank));
  return std::make_unique<test::Built>(d, with_stiffness());
}

}  // namespace deck::cycle::testing
