// Bulk reader: /NODE, /CNODE and the element blocks straight into the arrays of the model. Private
// to the model stage. Columns come from the schemas; a line that is not clean is read by
// decode_line().
#pragma once
#include <optional>
#include <vector>

#include "deck/model/model.hpp"

namespace deck::detail {

/// The node blocks (/NODE, /CNODE) of a deck in the solver's order.
std::vector<const Block*> node_blocks(const Deck& deck);
/// The element blocks of a deck in the solver's order.
std::vector<const Block*> element_blocks(const Deck& deck);

/// Family and shape an element keyword is stored as; nullopt: no element keyword.
struct ElementFormat {
  ElementKind kind{};
  SolidShape shape = SolidShape::brick8;  ///< solids only; /BRICK may turn out tetra4 or penta6
  int required = 0;                       ///< leading nodes that must exist; later ones may be 0
};
std::optional<ElementFormat> element_format(const Block& block);

/// Node slots per element: shell4 4, shell3 3, solid8 8, quad 4, tria 3, truss 2, beam 3 (the third
/// is the orientation node), spring 6. A slot left blank or 0 on a card is no_index.
int element_width(ElementKind kind);

/// Appends the nodes of `blocks` to `nodes` as they are written: ids with submodel offset,
/// coordinates in working units; then builds nodes.map. `ranges` gets one entry per block (empty
/// ones too). Blank lines are no nodes (DK036). Same result and diagnostics for every number of
/// threads. Duplicate ids are left to the caller (nodes.map.duplicates()).
void read_nodes(const Deck& deck, const std::vector<const Block*>& blocks, Nodes& nodes,
                std::vector<BulkBlock>& ranges, Diagnostics& diagnostics, int threads);

/// Appends the elements of `blocks` (all families, as they are written) to the families of `model`,
/// with the entries of model.element_blocks, and builds the id maps of the families. Needs
/// model.nodes and model.part_of_id; a part that is not there gives no_index without a message (the
/// caller knows all parts and reports once). Unknown nodes: DK101 and no_index. Own thicknesses are
/// in working units; Elements::thickness stays empty if no element of the family has one. Solids
/// are stored as written; orient_solids() is the next step.
void read_elements(const Deck& deck, const std::vector<const Block*>& blocks, Model& model,
                   Diagnostics& diagnostics, int threads);

/// The solver's order of what was read: nodes of a file and elements of a block by id. A block
/// whose rows do not ascend becomes several runs.
void put_nodes_in_order(Nodes& nodes, std::vector<BulkBlock>& ranges);
void put_elements_in_order(Model& model);

/// Turns solids of negative volume (sign of the Jacobian in the centre of the eight stored slots)
/// as the reference solver does: bricks and 20-, 16-node solids exchange nodes 1-4 with 5-8, tetras
/// node 2 with 4 (and their mid-side nodes with them). Pentas and solids with a missing node stay.
/// Returns the number of solids turned.
std::size_t orient_solids(Model& model);

}  // namespace deck::detail
