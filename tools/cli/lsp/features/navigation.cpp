// From an id to what defines it and to what names it; includes as links and as a hierarchy of
// calls.
#include <algorithm>
#include <filesystem>
#include <set>

#include "deck/text/number.hpp"
#include "lsp/view.hpp"

namespace deck::lsp {
namespace {

/// Kinds of ids that stand in lines of nodes and elements.
bool is_item(std::string_view kind) {
  constexpr std::string_view kinds[] = {"node",   "shell",   "sh3n",   "brick",  "tetra4",
                                        "penta6", "tetra10", "bric20", "shel16", "quad",
                                        "tria",   "truss",   "beam",   "spring"};
  return std::find(std::begin(kinds), std::end(kinds), kind) != std::end(kinds);
}

/// All solids share one space of ids.
bool same_space(std::string_view a, std::string_view b) {
  constexpr std::string_view solids[] = {"brick",   "tetra4", "penta6",
                                         "tetra10", "bric20", "shel16"};
  const auto solid = [&](std::string_view k) {
    return std::find(std::begin(solids), std::end(solids), k) != std::end(solids);
  };
  return a == b || (solid(a) && solid(b));
}

/// Calls f(card, line) for every line of a block of nodes or elements.
template <class F>
void each_item_line(const Deck& deck, const Block& block, F&& f) {
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

/// The id of a cell of a block that is decoded as a whole.
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
    each_item_line(deck, b, [&](const CardSchema& card, const Line& line, bool first) {
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

/// Every place that names the id, the definition not included.
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
    // Elements name their nodes.
    if (of.kind != "node" || b.schema == nullptr || !b.schema->bulk || b.opaque ||
        b.schema->kind == "node")
      continue;
    const std::int64_t written = of.id - deck.offset_of(b, "node");
    const std::string digits = std::to_string(written);
    each_item_line(deck, b, [&](const CardSchema& card, const Line& line, bool) {
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

/// The include directive that holds the offset.
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

Answer document_links(const View& view, const Json&) {
  Json out = Json::array();
  for (const IncludeEdge& e : view.deck.includes) {
    if (e.parent != view.file) continue;
    // The path, without the directive.
    const std::string_view line = view.deck.sources.text(e.directive);
    const auto blank = line.find_first_of(" \t'\"");
    const auto name = blank == line.npos ? line.npos : line.find_first_not_of(" \t", blank);
    if (name == line.npos) continue;
    auto end = line.size();
    while (end > name && static_cast<unsigned char>(line[end - 1]) <= ' ') --end;
    out.push_back(
        {{"range", view.range(view.file, e.directive.offset + name, e.directive.offset + end)},
         {"target", view.uri(e.file)},
         {"tooltip", utf8(view.deck.sources[e.file].path())}});
  }
  return out;
}

// ---- call hierarchy: a file calls what it includes -------------------------------------------

namespace {

Json file_item(const View& view, std::uint32_t file) {
  const std::string& path = view.deck.sources[file].path();
  const Json all = view.range(file, 0, view.deck.sources[file].bytes().size());
  return {{"name", utf8(std::filesystem::path(path).filename().string())},
          {"kind", 1},
          {"detail", utf8(std::filesystem::path(path).parent_path().string())},
          {"uri", view.uri(file)},
          {"range", all},
          {"selectionRange", begin_of_file()},
          // Requests about the item name a file that need not be open: this one is.
          {"data", {{"document", view.workspace.uri(view.path)}, {"path", path}}}};
}

/// The file of an item among those of the deck.
std::uint32_t file_of_item(const View& view, const Json& params) {
  return view.syntax->file_of(params.at("item").at("data").at("path").get<std::string>());
}

}  // namespace

Answer prepare_call_hierarchy(const View& view, const Json& params) {
  const IncludeEdge* e = include_at(view, view.offset(params.at("position")));
  return Json::array({file_item(view, e != nullptr ? e->file : view.file)});
}

Answer incoming_calls(const View& view, const Json& params) {
  Json out = Json::array();
  const std::uint32_t file = file_of_item(view, params);
  if (file == Span::no_file) return out;
  const std::string& path = view.deck.sources[file].path();
  std::map<std::string, std::vector<const IncludeEdge*>> by_parent;
  for (const IncludeEdge& e : view.deck.includes)
    if (view.deck.sources[e.file].path() == path)
      by_parent[view.deck.sources[e.parent].path()].push_back(&e);
  for (const auto& [parent, edges] : by_parent) {
    Json ranges = Json::array();
    for (const IncludeEdge* e : edges) ranges.push_back(view.range(e->directive));
    out.push_back({{"from", file_item(view, edges.front()->parent)}, {"fromRanges", ranges}});
  }
  return out;
}

Answer outgoing_calls(const View& view, const Json& params) {
  Json out = Json::array();
  const std::uint32_t file = file_of_item(view, params);
  if (file == Span::no_file) return out;
  for (const IncludeEdge& e : view.deck.includes)
    if (e.parent == file)
      out.push_back({{"to", file_item(view, e.file)},
                     {"fromRanges", Json::array({view.range(e.directive)})}});
  return out;
}

/// {"textDocument", "kind", "id"} -> Location: where an entity of the deck is defined.
Answer locate(const View& view, const Json& params) {
  const std::string kind = params.at("kind").get<std::string>();
  const Span place = definition_of(view, kind, params.at("id").get<std::int64_t>());
  return place.valid() ? view.location(place) : Json();
}

}  // namespace deck::lsp
