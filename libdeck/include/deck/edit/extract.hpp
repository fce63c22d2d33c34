// Extraction: a small deck with some interfaces and what they need — for bug reports.
#pragma once
#include <cstdint>
#include <span>

#include "deck/edit/rewrite.hpp"

namespace deck {

/// One file (Rewrite::new_text) with these interfaces (ids as everywhere in reports, submodel
/// offsets added), the groups, surfaces, sets and boxes they name, every element that touches a
/// node of theirs or that such a selection is made of, and the nodes, parts, properties, materials,
/// frictions, functions, sensors, axes, transformations and switches that go with them. Kept blocks
/// and lines are copied byte for byte, in the order of the deck; ids stay.
///
/// The result is read again: effective values, segments, gaps and stiffness must be those of the
/// whole deck, and of a TYPE2 what it ties; what differs is `approximated` in the loss report.
/// Everything left out is `dropped` there, one entry a keyword.
///
/// Refusals: an id that is no interface whose card is read; a deck that cannot be flattened.
Rewrite extract_contacts(const LoadedDeck& context, std::span<const std::int64_t> interfaces);

}  // namespace deck
