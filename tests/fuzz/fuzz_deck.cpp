// Whole decks: reading, decoding every block, the bulk reader with one and two threads. Spans must
// lie in their files, and the two ways of reading bulk lines must count the same findings.
#include "deck/keyword.hpp"
#include "model/bulk/bulk.hpp"
#include "support.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using deck::fuzz::check_spans;
  using deck::fuzz::require;
  deck::ReadOptions options;
  options.limits.files = 5;
  std::string text = deck::fuzz::without_includes(deck::fuzz::text_of(data, size));
  auto deck = deck::read_deck_text("fuzz", std::move(text), deck::SchemaSet::built_in(), options);
  if (!deck) return 0;
  check_spans(*deck, deck->findings);
  deck::Findings decoded(10);
  for (const deck::Block& block : deck->blocks) {
    for (const deck::FilePiece& piece : block.body)
      require(piece.begin < piece.end, "a piece has bytes");
    const deck::DecodedBlock b = deck::decode(*deck, block, &decoded);
    for (const deck::DecodedCard& card : b.cards)
      for (const deck::Cell& cell : card.cells)
        require(cell.span.length == 0 || cell.span.offset + cell.span.length <=
                                             deck->sources[cell.span.file].bytes().size(),
                "a cell lies in its file");
  }
  check_spans(*deck, decoded);
  const auto nodes = deck::detail::node_blocks(*deck);
  const auto elements = deck::detail::element_blocks(*deck);
  deck::Model one, all;
  deck::Findings few(2), many(1 << 20);
  deck::detail::read_nodes(*deck, nodes, one.nodes, one.node_blocks, few, 1);
  deck::detail::read_elements(*deck, elements, one, few, 1);
  deck::detail::orient_solids(one);
  deck::detail::read_nodes(*deck, nodes, all.nodes, all.node_blocks, many, 1);
  deck::detail::read_elements(*deck, elements, all, many, 1);
  require(few.counts() == many.counts(), "findings are counted as they are kept");
  check_spans(*deck, many);
  for (const deck::NodeIndex n : one.solid8.nodes)
    require(n == deck::no_index || n < one.nodes.size(), "a node of a solid exists");
  return 0;
}
