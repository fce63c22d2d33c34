// Navigation between definitions and uses of ids, and to include files; symbols and folding.
#include "lsp/view.hpp"

#include <algorithm>
#include <set>

#include "deck/text.hpp"

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

namespace {

/// Ids of nodes and elements.
bool is_item(std::string_view kind) {
  constexpr std::string_view kinds[] = {"node",   "shell",   "sh3n",   "brick",  "tetra4",
                                        "penta6", "tetra10", "bric20", "shel16", "quad",
                                        "tria",   "truss",   "beam",   "spring"};
  return std::find(std::begin(kinds), std::end(kinds), kind) != std::end(kinds);
}

/// All solids share one id space.
bool same_space(std::string_view a, std::string_view b) {
  constexpr std::string_view solids[] = {"brick",   "tetra4", "penta6",
                                         "tetra10", "bric20", "shel16"};
  const auto solid = [&](std::string_view k) {
    return std::find(std::begin(solids), std::end(solids), k) != std::end(solids);
  };
  return a == b || (solid(a) && solid(b));
}

/// Calls f(card, line) for all lines of a block of nodes or elements.
template <class F>
void for_each_item_line(const Deck& deck, const Block& block, F&& f) {
  std::vector<const CardSchema*> cards;
  for (const CardSchema& c : block.schema->cards)
    if (c.in_version(block.version)) cards.push_back(&c);
  if (cards.empty()) return;
  LineCursor cursor(deck.sources, block);
  std::size_t at = 0;
  for (Line line = cursor.next(); line.valid(); line = cursor.next()) {
    if (at == 0 && line.text.empty()) continue;
    if (!f(*cards[at], line, at == 0)) return;
    at = at + 1 == cards.size() ? 0 : at + 1;
  }
}

Span trimmed(const Cell& cell, const Deck& deck) {
  if (cell.text.empty()) return cell.span;
  const char* const begin = deck.sources[cell.span.file].bytes().data();
  return {cell.span.file, static_cast<std::uint32_t>(cell.text.size()),
          static_cast<std::uint64_t>(cell.text.data() - begin)};
}

/// The id in a cell of a decoded block.
std::optional<NamedId> reference_at(const View& view, const Block& block, std::uint64_t offset) {
  for (const Reference& r : references_of(view.deck, block)) {
    if (!r.span.valid() || r.span.file != view.file || offset < r.span.offset ||
        offset > r.span.offset + r.span.length)
      continue;
    return NamedId{std::string(r.kind), r.id, r.span, false};
  }
  return std::nullopt;
}

std::optional<NamedId> item_at(const View& view, const Block& block, const PlacedLine& line,
                               std::uint64_t offset) {
  const Cell* cell = line.cell_at(static_cast<int>(offset - line.line.offset) + 1);
  if (cell == nullptr || cell->integer == 0) return std::nullopt;
  const bool own = &line.card.cells.front() == cell &&
                   block.schema->find_field(cell->field->name) == cell->field;
  const std::string kind = own ? block.schema->kind : cell->field->ref;
  if (kind.empty() || (!own && cell->field->type != FieldType::id)) return std::nullopt;
  return NamedId{kind, std::abs(cell->integer) + view.deck.offset_of(block, kind),
                 trimmed(*cell, view.deck), own};
}

}  // namespace

std::optional<NamedId> id_at(const View& view, std::uint64_t offset) {
  const PlacedLine line = view.line_at(offset);
  if (line.block < 0) return std::nullopt;
  const Block& block = view.deck.blocks[static_cast<std::size_t>(line.block)];
  if (line.what == PlacedLine::What::header) {
    if (const std::string_view kind = header_reference(block); !kind.empty())
      return reference_at(view, block, offset);
    if (block.schema == nullptr || block.schema->kind.empty() || !block.schema->has_id ||
        block.schema->bulk || !block.id.present)
      return std::nullopt;
    return NamedId{block.schema->kind, id_of(view.deck, block), block.id.span, true};
  }
  if (line.what != PlacedLine::What::card) return std::nullopt;
  if (block.schema->bulk) return item_at(view, block, line, offset);
  auto found = reference_at(view, block, offset);
  if (found)
    if (const Cell* cell = line.cell_at(static_cast<int>(found->span.offset - line.line.offset) +
                                        static_cast<int>(found->span.length)))
      found->span = trimmed(*cell, view.deck);
  return found;
}

Span definition_of(const View& view, std::string_view kind, std::int64_t id) {
  const Deck& deck = view.deck;
  if (!is_item(kind)) {
    const Block* block = Definitions(deck).find(kind, id);
    return block == nullptr ? Span{} : block->header_span;
  }
  Span found;
  for (const Block& b : deck.blocks) {
    if (b.schema == nullptr || !b.schema->bulk || b.opaque || !same_space(b.schema->kind, kind))
      continue;
    const std::int64_t written = id - deck.offset_of(b, kind);
    for_each_item_line(deck, b, [&](const CardSchema& card, const Line& line, bool first) {
      if (!first || card.fields.empty()) return true;
      const Field& f = card.fields.front();
      const auto from = static_cast<std::size_t>(f.first - 1);
      if (from >= line.text.size()) return true;
      const auto cell = line.text.substr(from, static_cast<std::size_t>(f.last - f.first + 1));
      if (read_integer(cell).value != written) return true;
      found = line.columns(f.first, f.last);
      return false;
    });
    if (found.valid()) return found;
  }
  return found;
}

namespace {

/// All uses of an id, without the definition.
std::vector<Span> users(const View& view, const NamedId& of) {
  const Deck& deck = view.deck;
  std::vector<Span> out;
  const bool item = is_item(of.kind);
  const Definitions definitions(deck);
  const Block* target = item ? nullptr : definitions.find(of.kind, of.id);
  for (const Block& b : deck.blocks) {
    for (const Reference& r : references_of(deck, b)) {
      if (!r.span.valid()) continue;
      const bool same = item ? same_space(r.kind, of.kind) && r.covers(of.id)
                        : target != nullptr && r.step == 0
                            ? definitions.find(r.kind, r.id) == target
                            : r.kind == of.kind && r.covers(of.id);
      if (same) out.push_back(r.span);
    }
    // Elements refer to nodes.
    if (of.kind != "node" || b.schema == nullptr || !b.schema->bulk || b.opaque ||
        b.schema->kind == "node")
      continue;
    const std::int64_t written = of.id - deck.offset_of(b, "node");
    const std::string digits = std::to_string(written);
    for_each_item_line(deck, b, [&](const CardSchema& card, const Line& line, bool) {
      if (line.text.find(digits) == line.text.npos) return true;
      for (const Cell& cell : decode_line(deck, b, card, line, nullptr).cells)
        if (cell.field->ref == "node" && cell.integer == written)
          out.push_back(trimmed(cell, deck));
      return true;
    });
  }
  return out;
}

Json locations(const View& view, const std::vector<Span>& spans) {
  Json out = Json::array();
  std::set<std::tuple<std::string, std::uint64_t>> seen;
  for (const Span& s : spans)
    if (seen.emplace(view.deck.sources[s.file].path(), s.offset).second)
      out.push_back(view.location(s));
  return out;
}

/// The include directive at an offset.
const IncludeEdge* include_at(const View& view, std::uint64_t offset) {
  for (const IncludeEdge& e : view.deck.includes)
    if (e.parent == view.file && offset >= e.directive.offset &&
        offset <= e.directive.offset + e.directive.length)
      return &e;
  return nullptr;
}

Json begin_of_file() {
  return {{"start", {{"line", 0}, {"character", 0}}}, {"end", {{"line", 0}, {"character", 0}}}};
}

}  // namespace

Answer definition(const View& view, const Json& params) {
  const std::uint64_t offset = view.offset(params.at("position"));
  if (const IncludeEdge* e = include_at(view, offset))
    return {{"uri", view.uri(e->file)}, {"range", begin_of_file()}};
  const auto id = id_at(view, offset);
  if (!id) return nullptr;
  const Span place = definition_of(view, id->kind, id->id);
  return place.valid() ? view.location(place) : Json();
}

Answer references(const View& view, const Json& params) {
  const auto id = id_at(view, view.offset(params.at("position")));
  if (!id) return Json::array();
  std::vector<Span> spans = users(view, *id);
  if (params.contains("context") && params["context"].value("includeDeclaration", false))
    if (const Span place = definition_of(view, id->kind, id->id); place.valid())
      spans.insert(spans.begin(), place);
  return locations(view, spans);
}

Answer document_highlight(const View& view, const Json& params) {
  const std::uint64_t offset = view.offset(params.at("position"));
  Json out = Json::array();
  const auto add = [&](const Span& s, int kind) {
    if (s.file == view.file && s.length > 0)
      out.push_back({{"range", view.range(s)}, {"kind", kind}});
  };
  if (const auto id = id_at(view, offset)) {
    if (const Span place = definition_of(view, id->kind, id->id); place.valid()) add(place, 3);
    for (const Span& s : users(view, *id)) add(s, 2);
    return out;
  }
  // Else the columns of the cell.
  const PlacedLine line = view.line_at(offset);
  if (const Cell* cell = line.cell_at(static_cast<int>(offset - line.line.offset) + 1))
    add(line.line.columns(columns_of(line.card, *cell).first, columns_of(line.card, *cell).last),
        1);
  return out;
}

}  // namespace deck::lsp
