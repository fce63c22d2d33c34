// Finds the coordinate cells of moved nodes and rounds new values to the cell.
#include "edit/cells.hpp"

#include <algorithm>

#include "model/shared/item_spans.hpp"
#include "text/shared/edits.hpp"

namespace deck::detail {
namespace {

constexpr std::string_view axis_names[3] = {"X", "Y", "Z"};

Line line_of(const SourceSet& sources, const Span& span) {
  Line line;
  line.text = sources.text(span);
  line.file = span.file;
  line.offset = span.offset;
  return line;
}

}  // namespace

NodeCells::NodeCells(const LoadedDeck& context) : context_(context) {
  std::map<std::string, int> times;
  const SourceSet& sources = context.deck().sources;
  for (std::uint32_t f = 0; f < sources.size(); ++f)
    if (++times[sources[f].path()] > 1) twice_.insert(sources[f].path());
  for (const auto& [a, b] : context.model().merged_nodes) {
    merged_.insert(a);
    merged_.insert(b);
  }
  // /RANDOM adds noise to the written coordinates; transformations may do more than add.
  noise_only_ = context.model().has_random &&
                std::none_of(context.deck().blocks.begin(), context.deck().blocks.end(),
                             [](const Block& b) { return b.keyword.starts_with("/TRANSFORM"); });
}

void NodeCells::find_lines(std::span<const NodeIndex> nodes) {
  std::vector<NodeIndex> unknown;
  for (const NodeIndex n : nodes)
    if (!known_.contains(n)) unknown.push_back(n);
  std::sort(unknown.begin(), unknown.end());
  unknown.erase(std::unique(unknown.begin(), unknown.end()), unknown.end());
  if (unknown.empty()) return;
  const std::vector<Span> spans = node_spans(context_.model(), unknown);
  const NodeBlocks blocks(context_.model());
  for (std::size_t i = 0; i < unknown.size(); ++i)
    known_.emplace(unknown[i], read(unknown[i], *blocks[unknown[i]], spans[i]));
}

NodeCells::Cells NodeCells::read(NodeIndex n, const Block& block, const Span& line) const {
  Cells out;
  const auto blocked = [&](std::string why) {
    out.obstacle = std::move(why);
    return out;
  };
  const Deck& deck = context_.deck();
  if (block.keyword != "/NODE" || merged_.contains(n))
    return blocked("the node is merged with another one (/CNODE)");
  if (block.schema == nullptr || !line.valid() || line == block.header_span)
    return blocked("its line was not found");
  if (twice_.contains(deck.sources[line.file].path()))
    return blocked("its file is included more than once: the copies would move too");
  const UnitSystem* units = deck.units_of(block);
  if (units == nullptr) return blocked("its unit system is not defined");
  out.line = line_of(deck.sources, line);
  const auto card = std::find_if(block.schema->cards.begin(), block.schema->cards.end(),
                                 [&](const CardSchema& c) { return c.in_version(block.version); });
  if (card == block.schema->cards.end()) return blocked("its line was not understood");
  const DecodedCard decoded = decode_line(deck, block, *card, out.line, nullptr);
  const double coordinates[3] = {context_.model().nodes.x[n], context_.model().nodes.y[n],
                                 context_.model().nodes.z[n]};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto cell = std::find_if(decoded.cells.begin(), decoded.cells.end(), [&](const Cell& c) {
      return c.field != nullptr && c.field->name == axis_names[axis];
    });
    if (cell == decoded.cells.end()) return blocked("its line was not understood");
    if (cell->parameter) return blocked("its coordinates are written as a &parameter");
    if (cell->status != NumberStatus::ok && cell->status != NumberStatus::implicit_exponent &&
        cell->status != NumberStatus::blank)
      return blocked("its coordinates are not readable as numbers");
    out.factor = conversion_factor(*units, deck.begin.working, cell->field->dimension);
    // If the line does not give the node's position, something else has changed it.
    out.offset[axis] = coordinates[axis] - cell->real * out.factor;
    if (out.offset[axis] != 0 && !noise_only_)
      return blocked("its place is not the one on its line (/TRANSFORM)");
    out.places[axis] = place_of(block, decoded, *cell);
  }
  return out;
}

std::optional<NodeCells::Printed> NodeCells::print(NodeIndex n, int axis, double value) const {
  const Cells& cells = known_.at(n);
  const CellPlace& place = cells.places[static_cast<std::size_t>(axis)];
  // Keep one column blank: people and scripts separate numbers by blanks.
  const double offset = cells.offset[static_cast<std::size_t>(axis)];
  const auto text = format_real((value - offset) / cells.factor,
                                place.free_format ? widest_number : place.last - place.first);
  if (!text) return std::nullopt;
  return Printed{text->text, read_real(text->text).value * cells.factor + offset};
}

std::vector<TextEdit> NodeCells::edits(
    const std::map<std::pair<NodeIndex, int>, std::string>& texts) const {
  CellWriter out(context_.deck().sources);
  for (const auto& [place, text] : texts) write(out, place.first, place.second, text);
  return out.release_edits();
}

}  // namespace deck::detail
