// Symbols and folding: the shape of a deck.
#include "lsp/view.hpp"

namespace deck::lsp {
namespace {

int symbol_kind(const Block& b) {
  constexpr int object = 19, interface = 11, array = 18, structure = 23, function = 12,
                property = 7, klass = 5, enumeration = 10, constant = 14, event = 24;
  if (b.schema == nullptr) return object;
  const std::string& kind = b.schema->kind;
  if (kind == "inter") return interface;
  if (b.schema->bulk) return array;
  if (kind == "mat") return structure;
  if (kind == "funct") return function;
  if (kind == "prop") return property;
  if (kind == "part" || kind == "subset") return klass;
  if (kind.starts_with("gr") || kind == "surf" || kind == "line" || kind == "set")
    return enumeration;
  if (kind == "parameter" || kind == "unit") return constant;
  if (kind == "sensor") return event;
  return object;
}

}  // namespace

Answer document_symbols(const View& view, const Json&) {
  Json out = Json::array();
  for (const Block& b : view.deck.blocks) {
    if (b.header_span.file != view.file) continue;
    const std::string name = utf8(b.header);
    const Json range = view.range(view.file, b.header_span.offset, view.block_end(b));
    if (view.client.hierarchical_symbols)
      out.push_back({{"name", name},
                     {"detail", title_of(view.deck, b)},
                     {"kind", symbol_kind(b)},
                     {"range", range},
                     {"selectionRange", view.range(b.header_span)}});
    else
      out.push_back({{"name", name},
                     {"kind", symbol_kind(b)},
                     {"location", {{"uri", view.uri(view.file)}, {"range", range}}}});
  }
  return out;
}

Answer folding_ranges(const View& view, const Json&) {
  Json out = Json::array();
  const LineTable& lines = view.syntax->lines(view.file);
  const auto fold = [&](std::uint64_t first, std::uint64_t last, const char* kind) {
    if (last <= first) return;
    Json range = {{"startLine", first}, {"endLine", last}};
    if (*kind != '\0') range["kind"] = kind;
    out.push_back(std::move(range));
  };
  std::vector<std::uint64_t> submodels;
  for (const Block& b : view.deck.blocks) {
    if (b.header_span.file != view.file) continue;
    const std::uint64_t first = lines.line_of(b.header_span.offset);
    const std::uint64_t last = lines.line_of(view.block_end(b));
    if (b.header.starts_with("//SUBMODEL")) {
      submodels.push_back(first);
    } else if (b.header.starts_with("//ENDSUB") && !submodels.empty()) {
      fold(submodels.back(), first, "region");
      submodels.pop_back();
    } else {
      fold(first, last, "");
    }
  }
  std::uint64_t run = 0;  // comment lines so far
  for (std::uint64_t l = 0; l <= lines.size(); ++l) {
    const std::string_view line = l < lines.size() ? lines.line(view.text(), l) : "";
    if (!line.empty() && (line[0] == '#' || line[0] == '$')) {
      ++run;
      continue;
    }
    if (run > 2) fold(l - run, l - 1, "comment");
    run = 0;
  }
  return out;
}

}  // namespace deck::lsp
