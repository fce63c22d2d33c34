// What the picture says about an element that is picked: where it is defined and its own thickness,
// face by face in the order of the mesh. A block of its own, so that the first picture does not
// wait for it.
#include <algorithm>
#include <unordered_map>

#include "model/item_spans.hpp"
#include "report/html/parts.hpp"

namespace deck::detail {
namespace {

struct ElementPlace {
  std::uint32_t file = 0;
  std::uint64_t line = 0;  ///< 0: not known
};

/// Lines of all elements of a family, block by block.
std::vector<ElementPlace> element_places(const Model& model, const Elements& family) {
  std::vector<ElementPlace> out(family.size());
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> of_block;
  for (std::uint32_t e = 0; e < family.size(); ++e) of_block[family.block[e]].push_back(e);
  for (const auto& [block, items] : of_block) {
    const std::vector<Span> spans = item_spans(*model.deck, model.element_blocks[block], items);
    Span last;
    std::uint64_t line = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
      const Span& s = spans[i];
      if (!s.valid()) continue;
      const auto& source = model.deck->sources[s.file];
      if (line == 0 || s.file != last.file || s.offset < last.offset) {
        line = source.position(s.offset).line;
      } else {
        const std::string_view between = source.bytes().substr(last.offset, s.offset - last.offset);
        line += static_cast<std::uint64_t>(std::count(between.begin(), between.end(), '\n'));
      }
      last = s;
      out[items[i]] = {s.file, line};
    }
  }
  return out;
}

double own_thickness(const Elements& family, std::uint32_t element) {
  return element < family.thickness.size() ? family.thickness[element] : 0;
}

}  // namespace

std::string elements_block(const Model& model, const std::vector<MeshPart>& mesh) {
  std::unordered_map<int, std::vector<ElementPlace>> places;
  ByteStream out;
  for (const MeshPart& part : mesh)
    for (const MeshGroup& g : part.groups) {
      const Elements& family = model.family(g.kind);
      const auto found = places.find(static_cast<int>(g.kind));
      const std::vector<ElementPlace>& place =
          found != places.end() ? found->second
                                : places[static_cast<int>(g.kind)] = element_places(model, family);
      Delta file, line;
      for (const MeshFace& f : g.faces) out.s(file(place[f.element].file));
      for (const MeshFace& f : g.faces)
        out.s(line(static_cast<std::int64_t>(place[f.element].line)));
      out.palette(g.faces, [&](const MeshFace& f) { return own_thickness(family, f.element); });
    }
  return std::move(out).text();
}

}  // namespace deck::detail
