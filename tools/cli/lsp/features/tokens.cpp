// Semantic tokens, symbols and folding: the shape of a deck.
#include <algorithm>
#include <array>

#include "lsp/view.hpp"

namespace deck::lsp {
namespace {

// In the order of the legend.
enum TokenType : int { keyword, title, id, flag, real, text, parameter, comment, directive };
constexpr std::array type_names = {"keyword", "string",    "variable", "enumMember", "number",
                                   "string",  "parameter", "comment",  "macro"};
enum Modifier : int { none = 0, even = 1, ignored = 2, defines = 4 };
constexpr std::array modifier_names = {"even", "deprecated", "definition"};

/// Lines of nodes and elements are many: they are coloured where they are looked at.
constexpr std::uint64_t most_bulk_bytes = 400'000;

class Tokens {
 public:
  explicit Tokens(const View& view)
      : view_(view), lines_(view.syntax->lines(view.file)), text_(view.text()) {}

  /// Places ascend.
  void add(std::uint64_t offset, std::uint64_t length, TokenType type, int modifiers = none) {
    if (length == 0) return;
    while (line_ + 1 < lines_.size() && lines_.start(line_ + 1) <= offset) ++line_;
    const std::uint64_t start = lines_.start(line_);
    const std::uint64_t character =
        units(text_.substr(start, offset - start), view_.client.encoding);
    const std::uint64_t wide = units(text_.substr(offset, length), view_.client.encoding);
    data_.push_back(line_ - last_line_);
    data_.push_back(line_ == last_line_ ? character - last_character_ : character);
    data_.push_back(wide);
    data_.push_back(static_cast<std::uint64_t>(type));
    data_.push_back(static_cast<std::uint64_t>(modifiers));
    last_line_ = line_;
    last_character_ = character;
  }

  void header(const Block& b) {
    const auto begin = b.header_span.offset;
    const auto name = static_cast<std::uint64_t>(b.keyword.size());
    add(begin, std::min<std::uint64_t>(name, b.header_span.length), keyword);
    for (const HeaderId* h : {&b.id, &b.unit_id})
      if (h->present && h->span.offset >= begin + name) {
        add(h->span.offset, h->span.length, id, defines);
      }
  }

  void card(const DecodedCard& c) {
    int column = 0;
    std::uint64_t end = 0;
    for (const Cell& cell : c.cells) {
      const int shade = column++ % 2 == 0 ? none : even;
      if (cell.text.empty()) continue;
      const auto at = static_cast<std::uint64_t>(cell.text.data() - text_.data());
      if (at < end || at >= text_.size()) continue;  // cells do not overlap
      end = at + cell.text.size();
      const Field& f = *cell.field;
      const TokenType type = cell.parameter              ? parameter
                             : f.type == FieldType::id   ? id
                             : f.type == FieldType::real ? real
                             : f.type == FieldType::text ? text
                                                         : flag;
      add(at, cell.text.size(), type, shade | (f.ignored ? ignored : none));
    }
  }

  Json take() { return {{"data", std::move(data_)}}; }

 private:
  const View& view_;
  const LineTable& lines_;
  std::string_view text_;
  std::vector<std::uint64_t> data_;
  std::uint64_t line_ = 0, last_line_ = 0, last_character_ = 0;
};

struct Stretch {
  std::uint64_t begin = 0, end = 0;
  bool holds(std::uint64_t offset) const { return offset >= begin && offset < end; }
};

/// One thing to colour; sorted by place before it is added.
struct Piece {
  std::uint64_t offset = 0, length = 0;
  const Block* header = nullptr;
  DecodedCard card;
  TokenType type = comment;
};

void collect(const View& view, const Block& block, const Stretch& where, bool bulk_too,
             std::vector<Piece>& out) {
  if (block.header_span.file == view.file && where.holds(block.header_span.offset))
    out.push_back({block.header_span.offset, block.header_span.length, &block, {}, keyword});
  bool here = false;
  for (const deck::Piece& p : block.body)
    here = here || (p.file == view.file && p.begin < where.end && p.end > where.begin);
  if (!here || block.schema == nullptr || block.opaque) return;
  const auto inside = [&](const Line& line) {
    return line.valid() && line.file == view.file && where.holds(line.offset);
  };
  const auto add = [&](DecodedCard&& card) {
    const std::uint64_t offset = card.line.offset, length = card.line.text.size();
    out.push_back({offset, length, nullptr, std::move(card), flag});
  };
  if (block.schema->bulk) {
    if (!bulk_too) return;
    std::vector<const CardSchema*> cards;
    for (const CardSchema& c : block.schema->cards)
      if (c.in_version(block.version)) cards.push_back(&c);
    if (cards.empty()) return;
    LineCursor cursor(view.deck.sources, block);
    std::size_t at = 0;
    for (Line line = cursor.next(); line.valid(); line = cursor.next()) {
      if (at == 0 && line.text.empty()) continue;
      if (inside(line)) add(decode_line(view.deck, block, *cards[at], line, nullptr));
      at = at + 1 == cards.size() ? 0 : at + 1;
    }
    return;
  }
  DecodedBlock decoded = decode(view.deck, block);
  if (inside(decoded.title_line))
    out.push_back({decoded.title_line.offset, decoded.title_line.text.size(), nullptr, {}, title});
  for (DecodedCard& card : decoded.cards)
    if (inside(card.line)) add(std::move(card));
}

void comments(const View& view, const Stretch& where, std::vector<Piece>& out) {
  const LineTable& lines = view.syntax->lines(view.file);
  for (std::uint64_t l = lines.line_of(where.begin); l < lines.size(); ++l) {
    if (lines.start(l) >= where.end) return;
    const std::string_view line = lines.line(view.text(), l);
    if (line.empty() || (line[0] != '#' && line[0] != '$')) continue;
    const bool include =
        line.size() >= 8 && (line.starts_with("#include") || line.starts_with("#INCLUDE"));
    out.push_back({lines.start(l), line.size(), nullptr, {}, include ? directive : comment});
  }
}

}  // namespace

Json token_legend() { return {{"tokenTypes", type_names}, {"tokenModifiers", modifier_names}}; }

Answer semantic_tokens(const View& view, const Json& params) {
  Stretch where{0, view.text().size() + 1};
  bool bulk = view.text().size() <= most_bulk_bytes;
  if (const auto range = params.find("range"); range != params.end()) {
    where = {view.offset(range->at("start")), view.offset(range->at("end")) + 1};
    bulk = where.end - where.begin <= most_bulk_bytes;
  }
  std::vector<Piece> pieces;
  for (const Block& block : view.deck.blocks) collect(view, block, where, bulk, pieces);
  comments(view, where, pieces);
  // A file that is included twice has everything twice.
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Piece& a, const Piece& b) { return a.offset < b.offset; });
  Tokens tokens(view);
  std::uint64_t last = 0;
  bool any = false;
  for (const Piece& p : pieces) {
    if (any && p.offset == last) continue;
    any = true;
    last = p.offset;
    if (p.header != nullptr)
      tokens.header(*p.header);
    else if (p.card.schema != nullptr)
      tokens.card(p.card);
    else
      tokens.add(p.offset, p.length, p.type);
  }
  return tokens.take();
}

// ---- symbols and folding -----------------------------------------------------------------------

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
