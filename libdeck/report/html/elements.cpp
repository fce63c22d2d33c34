// What the picture says about an element that is picked: where it is defined and its own thickness,
// face by face in the order of the mesh. A block of its own, so that the first picture does not
// wait for it.
#include <algorithm>
#include <unordered_map>

#include "model/shared/item_spans.hpp"
#include "report/html/parts.hpp"

namespace deck::detail {
namespace {

constexpr std::uint64_t given_back_at_once = std::uint64_t{8} << 20;  // bytes of a file

/// Places of all elements of a family, block by block.
std::vector<ItemPlace> element_places(const Model& model, const Elements& family) {
  std::vector<ItemPlace> out(family.size(), ItemPlace{0, 0});
  std::vector<std::uint8_t> wanted(model.element_blocks.size(), 0);
  for (const std::uint32_t block : family.block)
    if (block < wanted.size()) wanted[block] = 1;
  std::span<const BulkBlock> runs;
  for (std::size_t b = 0; b < wanted.size(); b += runs.size()) {
    runs = runs_of_block(model.element_blocks, b);
    if (wanted[b] == 0) continue;
    each_item_place(*model.deck, runs, [&](std::uint32_t e, ItemPlace at) {
      if (e < out.size() && family.block[e] >= b && family.block[e] < b + runs.size()) out[e] = at;
    });
  }
  return out;
}

double own_thickness(const Elements& family, std::uint32_t element) {
  return element < family.thickness.size() ? family.thickness[element] : 0;
}

}  // namespace

void each_item_place(const Deck& deck, std::span<const BulkBlock> runs,
                     const std::function<void(std::uint32_t, ItemPlace)>& take) {
  Span last;
  std::uint64_t line = 0, given_back = 0;
  each_item_span(deck, runs, [&](std::uint32_t item, const Span& s) {
    const auto& source = deck.sources[s.file];
    if (line == 0 || s.file != last.file || s.offset < last.offset) {
      line = source.position(s.offset).line;
      given_back = s.offset;
    } else {
      const std::string_view between = source.bytes().substr(last.offset, s.offset - last.offset);
      line += static_cast<std::uint64_t>(std::count(between.begin(), between.end(), '\n'));
    }
    last = s;
    if (s.offset - given_back >= given_back_at_once) {
      source.release(given_back, s.offset);
      given_back = s.offset;
    }
    take(item, {s.file, line <= UINT32_MAX ? static_cast<std::uint32_t>(line) : 0});
  });
}

std::string elements_block(const Model& model, const std::vector<MeshPart>& mesh) {
  std::unordered_map<int, std::vector<ItemPlace>> places;
  ByteStream out;
  for (const MeshPart& part : mesh)
    for (const MeshGroup& g : part.groups) {
      const Elements& family = model.family(g.kind);
      const auto found = places.find(static_cast<int>(g.kind));
      const std::vector<ItemPlace>& place =
          found != places.end() ? found->second
                                : places[static_cast<int>(g.kind)] = element_places(model, family);
      Delta file, line;
      for (const std::uint32_t e : g.element) out.s(file(place[e].file));
      for (const std::uint32_t e : g.element) out.s(line(std::int64_t{place[e].line}));
      out.palette(g.element, [&](std::uint32_t e) { return own_thickness(family, e); });
    }
  return std::move(out).text();
}

}  // namespace deck::detail
