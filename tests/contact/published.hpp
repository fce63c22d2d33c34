// The meshes of the published worked examples, for tests of gaps, stiffness and penetrations.
#pragma once
#include "contact/small_deck.hpp"

namespace deck::test {

/// Two bricks, one of them with its top raised to (22, 2, 2.6) and a shell of 0.15 on top; a
/// tetrahedron; two quads of thickness 1 and 3.
inline SmallDeck published_solids() {
  SmallDeck d;
  const double z[8] = {0, 0, 0, 0, 2, 2, 2, 2};
  const double x[8] = {0, 2, 2, 0, 0, 2, 2, 0}, y[8] = {0, 0, 2, 2, 0, 0, 2, 2};
  for (int i = 0; i < 8; ++i) {
    d.node(1 + i, x[i], y[i], z[i]);
    d.node(11 + i, 20 + x[i], y[i], i == 6 ? 2.6 : z[i]);
  }
  d.node(21, 40, 0, 0).node(22, 43, 0, 0).node(23, 40, 3, 0).node(24, 40, 0, 3);
  d.node(31, 60, 0, 0).node(32, 70, 0, 0).node(33, 70, 10, 0).node(34, 60, 10, 0);
  d.node(35, 80, 0, 0).node(36, 80, 10, 0).node(101, 0.7, 0.6, 9);
  d.shell_part(1, 0.15).solid_part(2).solid_part(3).shell_part(4, 1).shell_part(5, 3);
  d.brick(2, 1, {1, 2, 3, 4, 5, 6, 7, 8}).brick(2, 2, {11, 12, 13, 14, 15, 16, 17, 18});
  d.tetra(3, 3, 21, 22, 23, 24).shell(1, 11, 15, 16, 17, 18);
  d.shell(4, 12, 31, 32, 33, 34).shell(5, 13, 32, 35, 36, 33);
  d.segments("/SURF/SEG/2", {{15, 16, 17, 18}});
  d.group("/SURF/PART/EXT/3", {2}).group("/SURF/PART/5", {4, 5}).group("/SURF/PART/EXT/7", {3});
  d.group("/SURF/PART/EXT/6", {1, 2}).group("/GRNOD/NODE/2", {101});
  return d;
}

/// Two shells that cross (t = 2 and 1.2); a beam, a truss, a brick.
inline SmallDeck published_edges() {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 8, 0).node(4, 0, 8, 0);
  d.node(11, 4, -3, 1.1).node(12, 5, 12, 1.3).node(13, 25, 12, 1.3).node(14, 25, -3, 1.1);
  d.node(21, 2, -2, 0.7).node(22, 2.5, 9, 0.9).node(23, 3, 15, 0.5);
  const double x[8] = {0, 2, 2, 0, 0, 2, 2, 0}, y[8] = {0, 0, 2, 2, 0, 0, 2, 2};
  for (int i = 0; i < 8; ++i) d.node(31 + i, 40 + x[i], y[i], i < 4 ? 0 : 3);
  d.node(41, 41, -1, 3.05).node(42, 41.2, 3, 3.1);
  d.shell_part(1, 2).shell_part(2, 1.2).beam_part(3, 4).truss_part(4, 0.09).solid_part(5);
  d.shell(1, 1, 1, 2, 3, 4).shell(2, 2, 11, 12, 13, 14).bar("BEAM", 3, 3, 21, 22, 23);
  d.bar("TRUSS", 4, 4, 41, 42).brick(5, 5, {31, 32, 33, 34, 35, 36, 37, 38});
  d.group("/SURF/PART/1", {1}).group("/SURF/PART/2", {2}).group("/SURF/PART/EXT/5", {5});
  d.group("/LINE/SURF/1", {1}).group("/LINE/SURF/2", {2}).group("/LINE/SURF/5", {5});
  d.segments("/LINE/SEG/3", {{21, 22}}).segments("/LINE/SEG/4", {{41, 42}});
  return d;
}

/// Eight quads, width 2, bent over; thickness 0.8 (the published example).
inline SmallDeck bent_strip() {
  SmallDeck d;
  const double x[] = {0, 1, 2, 3, 3.6, 3, 2, 1, 0};
  const double z[] = {0, 0, 0, 0, 0.5, 1.1, 1.1, 1.1, 1.1};
  for (int i = 0; i < 9; ++i) d.node(i + 1, x[i], 0, z[i]).node(101 + i, x[i], 2, z[i]);
  d.shell_part(1, 0.8);
  for (int i = 1; i < 9; ++i) d.shell(1, i, i, i + 1, 101 + i, 100 + i);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/SURF/2", {1}).group("/LINE/SURF/1", {1});
  return d;
}

}  // namespace deck::test
