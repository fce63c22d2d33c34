// Meshes of many elements for decks of tests: grids of any elements, sheets of quads, boxes.
#pragma once
#include <array>

#include "contact/small_deck.hpp"

namespace deck::test {

using Corners4 = std::array<int, 4>;

/// Nodes of a grid at place(i, j), row by row from `first` on, and what cell(i, j, corners) makes
/// of each of its cells.
template <class Place, class Cell>
void add_grid(SmallDeck& d, int first, int columns, int rows, const Place& place,
              const Cell& cell) {
  const auto id = [&](int i, int j) { return first + j * (columns + 1) + i; };
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) {
      const auto p = place(i, j);
      d.node(id(i, j), p[0], p[1], p[2]);
    }
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      cell(i, j, Corners4{id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
}

/// A sheet of quads of a part; its elements are numbered from `element` on.
template <class Place>
void add_sheet(SmallDeck& d, int part, int element, int first, int columns, int rows,
               const Place& place) {
  add_grid(d, first, columns, rows, place,
           [&](int, int, const Corners4& n) { d.shell(part, element++, n[0], n[1], n[2], n[3]); });
}

/// A quad cut into two triangles.
inline void add_two_triangles(SmallDeck& d, int part, int element, const Corners4& n) {
  d.shell3(part, element, n[0], n[1], n[2]).shell3(part, element + 1, n[0], n[2], n[3]);
}

/// A box of bricks with nodes at place(i, j, k), numbered from `first` on, as are its elements.
template <class Place>
void add_box(SmallDeck& d, int part, int first, const std::array<int, 3>& cells,
             const Place& place) {
  const auto id = [&](int i, int j, int k) {
    return first + (k * (cells[1] + 1) + j) * (cells[0] + 1) + i;
  };
  for (int k = 0; k <= cells[2]; ++k)
    for (int j = 0; j <= cells[1]; ++j)
      for (int i = 0; i <= cells[0]; ++i) {
        const auto p = place(i, j, k);
        d.node(id(i, j, k), p[0], p[1], p[2]);
      }
  int element = first;
  for (int k = 0; k < cells[2]; ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i)
        d.brick(
            part, element++,
            {id(i, j, k), id(i + 1, j, k), id(i + 1, j + 1, k), id(i, j + 1, k), id(i, j, k + 1),
             id(i + 1, j, k + 1), id(i + 1, j + 1, k + 1), id(i, j + 1, k + 1)});
}

/// A brick along the axes, its nodes from `first` on: those below, then those above.
inline void add_brick(SmallDeck& d, int part, int element, int first,
                      const std::array<double, 3>& low, const std::array<double, 3>& size) {
  for (int k = 0; k < 8; ++k)
    d.node(first + k, low[0] + (k % 4 == 1 || k % 4 == 2 ? size[0] : 0),
           low[1] + (k % 4 > 1 ? size[1] : 0), low[2] + (k > 3 ? size[2] : 0));
  d.brick(part, element,
          {first, first + 1, first + 2, first + 3, first + 4, first + 5, first + 6, first + 7});
}

}  // namespace deck::test
