// Whole decks: reading, decoding every block, the bulk reader with one and two threads. Spans must
// lie in their files, and the two ways of reading bulk lines must count the same findings.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "deck/keyword/deck.hpp"
#include "deck/keyword/decode.hpp"
#include "model/bulk/bulk.hpp"

namespace {

void require(bool good) {
  if (!good) std::abort();
}

void check(const deck::Deck& deck, const deck::Diagnostics& findings) {
  for (const deck::Diagnostic& d : findings.all()) {
    if (!d.span.valid()) continue;
    require(d.span.file < deck.sources.size());
    require(d.span.offset + d.span.length <= deck.sources[d.span.file].bytes().size());
    deck.sources.where(d.span);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  deck::ReadOptions options;
  options.limits.files = 5;
  std::string text(reinterpret_cast<const char*>(data), size);
  // No visits to the file system: the directive becomes a comment.
  for (std::size_t at = 0; (at = text.find('#', at)) != std::string::npos; ++at)
    if (at + 1 < text.size() && (text[at + 1] | 0x20) == 'i') text[at + 1] = '-';
  auto deck = deck::read_deck_text("fuzz", std::move(text), deck::SchemaSet::built_in(), options);
  if (!deck) return 0;
  check(*deck, deck->diagnostics);
  deck::Diagnostics decoded(10);
  for (const deck::Block& block : deck->blocks) {
    for (const deck::Piece& piece : block.body) require(piece.begin < piece.end);
    const deck::DecodedBlock b = deck::decode(*deck, block, &decoded);
    for (const deck::DecodedCard& card : b.cards)
      for (const deck::Cell& cell : card.cells)
        require(cell.span.length == 0 || cell.span.offset + cell.span.length <=
                                             deck->sources[cell.span.file].bytes().size());
  }
  check(*deck, decoded);
  const auto nodes = deck::detail::node_blocks(*deck);
  const auto elements = deck::detail::element_blocks(*deck);
  deck::Model one, all;
  deck::Diagnostics few(2), many(1 << 20);
  deck::detail::read_nodes(*deck, nodes, one.nodes, one.node_blocks, few, 1);
  deck::detail::read_elements(*deck, elements, one, few, 1);
  deck::detail::orient_solids(one);
  deck::detail::read_nodes(*deck, nodes, all.nodes, all.node_blocks, many, 1);
  deck::detail::read_elements(*deck, elements, all, many, 1);
  require(few.counts() == many.counts());
  check(*deck, many);
  for (const deck::NodeIndex n : one.solid8.nodes)
    require(n == deck::no_index || n < one.nodes.size());
  return 0;
}
