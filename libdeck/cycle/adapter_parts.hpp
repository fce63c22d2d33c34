// What only some effects want to know about a contact's pairs, each filled into ContactPairs on its
// own. Private to the stage.
#ifndef DECK_CYCLE_ADAPTER_PARTS_HPP_
#define DECK_CYCLE_ADAPTER_PARTS_HPP_

#include "deck/cycle/adapter.hpp"

namespace deck::cycle::detail {

/// Area of each secondary node: its share of the shells around it, 0 where there are none.
void node_areas(const Scene& scene, const Contact& contact, ContactPairs& out);
/// Widths of both edges: the thickness of the shell, or the side of a square with the section of
/// the truss or beam that carries the edge; 0 for edges of nothing else.
void edge_widths(const Contact& contact, ContactPairs& out);

/// /FRICTION by pairs of parts: coefficient, tangential damping, constants of the law, and both
/// directions where there are orthotropic pairs. Those follow the first axis of the segment.
void pair_friction(const Scene& scene, const Contact& contact, Model model, ContactPairs& out);
/// Whether a /FRICTION has pairs with coefficients by direction that are evaluated (Ifric 0).
bool orthotropic(const Friction& friction);

}  // namespace deck::cycle::detail

#endif  // DECK_CYCLE_ADAPTER_PARTS_HPP_
