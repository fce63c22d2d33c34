// Lines of nodes and elements, found by walking their block again: nothing is stored per item.
// Private to the library.
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "deck/model/model.hpp"

namespace deck::detail {

/// The lines of items of one bulk block; `indices` ascending. Blank lines between items are no
/// items. The block is walked once, up to the last index; an item that is not there gets the
/// header.
std::vector<Span> item_spans(const Deck& deck, const BulkBlock& range,
                             std::span<const std::uint32_t> indices);
/// The same for every item that is there, ascending, none of them kept.
void each_item_span(const Deck& deck, const BulkBlock& range,
                    const std::function<void(std::uint32_t, const Span&)>& take);

/// Model::node_span for many nodes, in any order and with repetitions: every block is walked once.
std::vector<Span> node_spans(const Model& model, std::span<const NodeIndex> nodes);

/// Model::element_span for many elements of one kind, the same way.
std::vector<Span> element_spans(const Model& model, ElementKind kind,
                                std::span<const std::uint32_t> elements);

/// Items that this thread's walks have passed so far: what they cost, for tests.
std::uint64_t items_walked();

}  // namespace deck::detail
