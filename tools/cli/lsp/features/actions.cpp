// Code actions: fixes, suppressions, setting a cell.
#include <fmt/format.h>

#include <algorithm>

#include "deck/edit.hpp"
#include "deck/model.hpp"
#include "edit/shared/layout.hpp"
#include "lint/shared/fix.hpp"
#include "lsp/view.hpp"

namespace deck::lsp {
namespace {

/// Findings of the current text; nullptr: not yet known.
const Semantics* present(const View& view) {
  const Semantics* s = view.semantics();
  return s != nullptr && s->generation == view.syntax->generation ? s : nullptr;
}

/// Short form of a finding, with which the client links an action.
Json shown(const View& view, const Finding& d) {
  return {{"range", d.span.valid() ? view.range(d.span) : view.range(0, 0, 0)},
          {"code", finding_name(d)},
          {"source", "deck"},
          {"message", utf8(d.message)}};
}

Json action(const View& view, const std::string& title, const char* kind, const Finding* of,
            Json edit, bool preferred) {
  Json out = {{"title", utf8(title)}, {"kind", kind}, {"edit", std::move(edit)}};
  if (of != nullptr) out["diagnostics"] = Json::array({shown(view, *of)});
  if (preferred) out["isPreferred"] = true;
  return out;
}

/// Comment that suppresses a finding in its block.
std::optional<TextEdit> suppression(const View& view, const Finding& d) {
  const std::int64_t b = view.syntax->index.find(d.span.file, d.span.offset);
  if (b < 0) return std::nullopt;
  const Block& block = view.deck.blocks[static_cast<std::size_t>(b)];
  const Source& source = view.deck.sources[block.header_span.file];
  const std::string_view line = source.line_at(block.header_span.offset);
  const auto begin = static_cast<std::uint64_t>(line.data() - source.bytes().data());
  if (begin == 0) return std::nullopt;  // the banner stays the first line
  const bool crlf = source.bytes().substr(0, begin).ends_with("\r\n");
  return TextEdit{{block.header_span.file, 0, begin},
                  fmt::format("# decklint: ignore[{}] reason=(say why){}", finding_name(d),
                              crlf ? "\r\n" : "\n")};
}

std::vector<TextEdit> all_fixes(const View& view, const Semantics& s, bool unsafe) {
  std::vector<const Fix*> wanted;
  for (const Finding& d : s.lint.findings)
    if (d.fix && (d.fix->safe || unsafe) &&
        std::all_of(d.fix->edits.begin(), d.fix->edits.end(),
                    [&](const TextEdit& e) { return e.span.file == view.file; }))
      wanted.push_back(&*d.fix);
  const FixResult fixed = apply_fixes(view.deck.sources, wanted);
  std::vector<TextEdit> edits;
  // apply_fixes returns whole texts; only changed lines are sent.
  for (const FixedFile& f : fixed.files) {
    const std::string_view before = view.deck.sources[f.file].bytes();
    std::size_t head = 0, tail = 0;
    const std::size_t most = std::min(before.size(), f.text.size());
    while (head < most && before[head] == f.text[head]) ++head;
    while (tail < most - head &&
           before[before.size() - 1 - tail] == f.text[f.text.size() - 1 - tail])
      ++tail;
    // Never inside of a character.
    while (head > 0 && head < before.size() &&
           (static_cast<unsigned char>(before[head]) & 0xc0) == 0x80)
      --head;
    while (tail > 0 && (static_cast<unsigned char>(before[before.size() - tail]) & 0xc0) == 0x80)
      --tail;
    edits.push_back({{f.file, static_cast<std::uint32_t>(before.size() - head - tail), head},
                     f.text.substr(head, f.text.size() - head - tail)});
  }
  return edits;
}

bool wants(const Json& params, std::string_view kind) {
  const auto context = params.find("context");
  if (context == params.end() || !context->contains("only")) return true;
  for (const Json& only : (*context)["only"]) {
    const std::string word = only.get<std::string>();
    if (kind == word || kind.starts_with(word + ".")) return true;
  }
  return false;
}

}  // namespace

Answer code_actions(const View& view, const Json& params) {
  Json out = Json::array();
  const std::uint64_t begin = view.offset(params.at("range").at("start"));
  const std::uint64_t end = view.offset(params.at("range").at("end"));
  const Semantics* s = present(view);
  if (s == nullptr) return out;
  const LineTable& lines = view.syntax->lines(view.file);
  const std::uint64_t first = lines.line_of(begin), last = lines.line_of(end);
  if (wants(params, "quickfix"))
    for (const Finding& d : s->lint.findings) {
      const std::uint32_t file = d.span.valid() ? d.span.file : 0;
      if (file != view.file) continue;
      const std::uint64_t line = d.span.valid() ? lines.line_of(d.span.offset) : 0;
      if (line < first || line > last) continue;
      const std::string rule = finding_name(d);
      if (d.fix)
        out.push_back(action(
            view, (d.fix->safe ? "Fix: " : "Unsafe fix: ") + d.fix->title + " (" + rule + ")",
            "quickfix", &d, view.workspace_edit(d.fix->edits), d.fix->safe));
      if (!d.span.valid()) continue;
      if (const auto edit = suppression(view, d))
        out.push_back(action(view, "Suppress " + rule + " here", "quickfix", &d,
                             view.workspace_edit({*edit}), false));
    }
  if (wants(params, "source.fixAll"))
    if (const auto edits = all_fixes(view, *s, false); !edits.empty())
      out.push_back(action(view, "Apply all safe fixes of this file", "source.fixAll", nullptr,
                           view.workspace_edit(edits), false));
  return out;
}

Json fix_all_edit(const View& view, const Json& argument) {
  const Semantics* s = present(view);
  if (s == nullptr) throw Refusal{"the deck is being analysed; try again"};
  return view.workspace_edit(all_fixes(view, *s, argument.value("unsafe", false)));
}

// ---- cells ---------------------------------------------------------------------------

namespace {

const Block* block_at(const View& view, const Json& argument) {
  const std::uint64_t offset = view.offset(argument.at("position"));
  const PlacedLine line = view.line_at(offset);
  return line.block < 0 ? nullptr : &view.deck.blocks[static_cast<std::size_t>(line.block)];
}

}  // namespace

/// {"textDocument", "position": in the block, "field", "value", "round"?}
Json set_field_edit(const View& view, const Json& argument) {
  const Block* block = block_at(view, argument);
  if (block == nullptr) throw Refusal{"the cursor is in no block"};
  std::string value;
  if (const Json& v = argument.at("value"); v.is_string())
    value = v.get<std::string>();
  else if (!v.is_null())
    value = v.dump();
  const auto edit = set_cell(view.deck, *block, argument.at("field").get<std::string>(), value,
                             argument.value("round", 0));
  if (!edit) throw Refusal{edit.error().message};
  return view.workspace_edit({*edit});
}

/// {"textDocument", "position"} -> the card line at this place, for a ruler.
Answer card_at(const View& view, const Json& params) {
  const std::uint64_t offset = view.offset(params.at("position"));
  const PlacedLine line = view.line_at(offset);
  if (line.block < 0) return nullptr;
  const Block& block = view.deck.blocks[static_cast<std::size_t>(line.block)];
  Json out = {
      {"header", utf8(block.header)},
      {"keyword", block.schema != nullptr ? block.schema->keyword : utf8(block.keyword)},
      {"id", id_of(view.deck, block)},
      {"title", title_of(view.deck, block)},
      {"version", block.version},
      {"range",
       view.range(view.file,
                  block.header_span.file == view.file ? block.header_span.offset : line.line.offset,
                  block.header_span.file == view.file ? view.block_end(block)
                                                      : line.line.offset + line.line.text.size())}};
  if (line.what != PlacedLine::What::card) return out;
  out["card"] = line.card.schema->name;
  out["heading"] = card_heading(*line.card.schema, block.version);
  out["freeFormat"] = line.card.free_format;
  out["line"] = view.position(view.file, line.line.offset)["line"];
  Json cells = Json::array();
  const Cell* at = line.cell_at(static_cast<int>(offset - line.line.offset) + 1);
  for (const Cell& cell : line.card.cells) {
    const CellColumns columns = columns_of(line.card, cell);
    const CellText text = describe(view, block, line.card, cell);
    cells.push_back({{"field", cell.field->name},
                     {"columns", {columns.first, columns.last}},
                     {"text", utf8(cell.text)},
                     {"label", utf8(text.head)},
                     {"used", utf8(text.value)},
                     {"doc", utf8(text.doc)}});
    if (&cell == at) out["cell"] = cells.size() - 1;
  }
  out["cells"] = std::move(cells);
  return out;
}

// ---- over every interface ----------------------------------------------------------------------

namespace {

std::string counted(std::uint64_t n, const char* what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

std::string lens_text(const Geometry::Interface& g) {
  if (!g.evaluated) return "not evaluated";
  if (g.pairs == 0) return "no initial penetration";
  std::string who;
  if (g.nodes > 0) who = counted(g.nodes, "node");
  if (g.edges > 0) who += (who.empty() ? "" : " and ") + counted(g.edges, "edge");
  const bool one = g.nodes + g.edges == 1;
  std::string text =
      fmt::format("{} {}, deepest {:.3g}", who, one ? "penetrates" : "penetrate", g.depth);
  if (g.errors > 0) text += fmt::format(" · the solver stops ({})", counted(g.errors, "error"));
  return text;
}

}  // namespace

Answer code_lenses(const View& view, const Json&) {
  Json out = Json::array();
  for (const Block& block : view.deck.blocks) {
    if (block.schema == nullptr || block.schema->kind != "inter" ||
        block.header_span.file != view.file)
      continue;
    const InterBase* inter = view.interface_of(block);
    if (inter == nullptr || traits_of(inter->type) == nullptr) continue;  // ties have no report
    const Geometry::Interface* g =
        view.open.geometry == nullptr ? nullptr : view.open.geometry->find(inter->id, inter->type);
    const Json range = view.range(block.header_span);
    const Json argument = {{"textDocument", {{"uri", view.workspace.uri(view.path)}}},
                           {"interface", inter->id},
                           {"type", inter->type}};
    out.push_back({{"range", range},
                   {"command",
                    {{"title", (g == nullptr ? "contacts not examined yet" : lens_text(*g)) +
                                   " · show report"},
                     {"command", view.client.show_report},
                     {"arguments", Json::array({argument})}}}});
    std::string doing = "what the solver does";
    visit_interface(*inter, [&](const auto& typed) {
      const std::int64_t inacti = typed.Inacti.value == 1000 ? 0 : typed.Inacti.value;
      if (const Field* f = block.schema->find_field("Inacti")) {
        const std::string meaning = meaning_of_value(*f, inacti == 0 ? 1000 : inacti);
        doing =
            fmt::format("Inacti {}{}{}", typed.Inacti.value, meaning.empty() ? "" : ": ", meaning);
      }
    });
    out.push_back(
        {{"range", range},
         {"command",
          {{"title", utf8(doing)},
           {"command", "deck.explain"},
           {"arguments", Json::array({{{"topic", block.schema->keyword + ".Inacti"}}})}}}});
  }
  return out;
}

}  // namespace deck::lsp
