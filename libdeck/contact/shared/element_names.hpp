// The element that a node is named after. Private to the library.
#pragma once

#include "contact/shared/node_elements.hpp"
#include "deck/contacts.hpp"

namespace deck {

/// The first family that has an element at the node, its smallest index; none: all 0.
ElementName element_at(const Model& model, Connectivity& connectivity, NodeIndex node);

}  // namespace deck
