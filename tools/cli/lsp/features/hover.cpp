// Hover and inlay hints: the cell under the cursor, and effective values of a line.
#include <fmt/format.h>

#include <algorithm>

#include "deck/text.hpp"
#include "lint/shared/topics.hpp"
#include "lsp/view.hpp"
#include "report/shared/params_report.hpp"

namespace deck::lsp {
namespace {

/// IBCX, IBCY and IBCZ are one value.
std::string_view value_name(std::string_view field) {
  return field.starts_with("IBC") && field.size() == 4 ? "IBC" : field;
}

struct EffectiveValue {
  bool known = false, on_card = false;
  std::string text, origin, place;
};

/// Effective value of a field of an interface.
EffectiveValue effective(const View& view, const Block& block, std::string_view field) {
  EffectiveValue out;
  const InterBase* inter = view.interface_of(block);
  if (inter == nullptr) return out;
  const LoadedDeck& loaded = *view.semantics()->loaded;
  const ParamsInput params{loaded};
  visit_any_interface(*inter, [&](const auto& typed) {
    typed.for_each([&](std::string_view name, const auto& e) {
      if (name != value_name(field)) return;
      out.known = true;
      out.on_card = e.origin == Origin::card;
      out.text = effective_text(params, *inter, name, e);
      out.origin = to_string(e.origin);
      if (e.origin == Origin::default_block && e.span.valid())
        out.place = fmt::format("line {}", loaded.deck().sources.position(e.span).line);
      if (e.origin != Origin::geometry) return;
      out.origin = "derived from the mesh";
      if (view.open.geometry == nullptr) return;
      if (const auto* g = view.open.geometry->find(inter->id, inter->type))
        for (const auto& [of, value] : g->values)
          if (of == name) out.text = value;
    });
  });
  return out;
}

std::string type_text(const Field& f) {
  switch (f.type) {
    case FieldType::integer:
      return f.values.empty() ? "integer" : "flag";
    case FieldType::real:
      return "real";
    case FieldType::text:
      return "text";
    case FieldType::flag:
      return "one digit, 0 or 1";
    case FieldType::id:
      return "id of " + (f.ref.empty() ? "anything" : f.ref);
  }
  return "";
}

std::string number(double v) {
  std::string text = fmt::format("{:.6g}", v);
  return text;
}

std::string range_text(const Field& f) {
  std::string out;
  if (!f.values.empty()) {
    for (const std::int64_t v : f.values) out += (out.empty() ? "" : ", ") + std::to_string(v);
    return out;
  }
  if (f.min) out += (f.min_open ? "above " : "at least ") + number(*f.min);
  if (f.max)
    out += (out.empty() ? "" : ", ") + std::string(f.max_open ? "below " : "at most ") +
           number(*f.max);
  return out;
}

/// `deck explain` pages with figures as code blocks.
std::string as_markdown(const std::string& page) {
  std::string out;
  bool figure = false;
  for (std::size_t at = 0; at < page.size();) {
    const auto end = std::min(page.find('\n', at), page.size());
    std::string line = page.substr(at, end - at);
    at = end + 1;
    const bool of_figure = line.starts_with("    ");
    if (of_figure != figure && !(figure && line.empty())) {
      out += "```\n";
      figure = of_figure;
    }
    if (!figure && line.starts_with("  ")) line.erase(0, 2);
    out += line + "\n";
  }
  return out + (figure ? "```\n" : "");
}

/// Escapes text for markdown.
std::string plain(std::string_view text) {
  std::string out;
  for (const char c : utf8(text)) {
    if (std::string_view("\\`*_{}[]<>#|~").find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

std::string title_of_id(const View& view, std::string_view kind, std::int64_t id) {
  const Definitions definitions(view.deck);
  const Block* target = definitions.find(kind, id);
  if (target == nullptr) return definition_of(view, kind, id).valid() ? std::string() : "missing";
  return std::string(target->keyword) + " " + title_of(view.deck, *target);
}

}  // namespace

std::string unit_text(const Dimension& d, const UnitSystem* units) {
  std::string out;
  const auto add = [&](const std::string& code, const char* base, int power) {
    if (power == 0) return;
    const bool word = !code.empty() && !(code[0] >= '0' && code[0] <= '9') && code[0] != '.';
    out += (out.empty() ? "" : " ") + (word           ? utf8(code)
                                       : code.empty() ? std::string(base)
                                                      : utf8(code) + " " + base);
    if (power != 1) out += "^" + std::to_string(power);
  };
  const UnitSystem none;
  const UnitSystem& u = units == nullptr ? none : *units;
  add(u.mass_code, "mass", d.mass);
  add(u.length_code, "length", d.length);
  add(u.time_code, "time", d.time);
  add("K", "temperature", d.temperature);
  return out;
}

std::string meaning_of_value(const Field& field, std::int64_t value) {
  std::string_view text = field.doc;
  if (const auto colon = text.find(": "); colon != text.npos) text.remove_prefix(colon + 2);
  const std::string word = std::to_string(value);
  while (!text.empty()) {
    const auto end = std::min(text.find_first_of(",;"), text.size());
    std::string_view part = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    while (!part.empty() && part.front() == ' ') part.remove_prefix(1);
    if (!part.starts_with(word)) continue;
    part.remove_prefix(word.size());
    if (part.starts_with(": ")) part.remove_prefix(1);
    if (!part.starts_with(' ')) continue;
    part.remove_prefix(1);
    return std::string(part);
  }
  return {};
}

std::string title_of(const Deck& deck, const Block& block) {
  if (block.schema == nullptr || !block.schema->has_title || block.opaque) return {};
  LineCursor cursor(deck.sources, block);
  const Line line = cursor.next();
  return line.valid() ? utf8(line.text.substr(0, 100)) : std::string();
}

CellText describe(const View& view, const Block& block, const DecodedCard& card, const Cell& cell) {
  const Field& f = *cell.field;
  const CellColumns at = columns_of(card, cell);
  CellText out;
  out.head = fmt::format(
      "{} · column{} {} · {}", f.name, at.first == at.last ? "" : "s",
      at.first == at.last ? std::to_string(at.first) : fmt::format("{}–{}", at.first, at.last),
      type_text(f));
  if (card.free_format) out.head += " · free format";
  if (f.type == FieldType::real) {
    if (!f.dimension_known) {
      out.head += " · unit not known";
    } else {
      Dimension dimension = f.dimension;
      if (!f.dimension_when.empty()) {
        const DecodedBlock decoded = decode(view.deck, block);
        dimension = dimension_of(f, decoded, &card);
      }
      const std::string unit = unit_text(dimension, view.deck.units_of(block));
      out.head += unit.empty() ? " · no unit" : " · " + unit;
    }
  }
  const EffectiveValue used = effective(view, block, f.name);
  if (used.known) {
    out.value = used.text + (used.on_card ? ", from the card" : ", " + used.origin) +
                (used.place.empty() ? "" : " (" + used.place + ")");
  } else if (!cell.blank() && f.type != FieldType::text) {
    out.value = f.type == FieldType::real ? shortest(cell.real) : std::to_string(cell.integer);
  }
  if (cell.parameter) out.value += fmt::format(" (parameter {})", utf8(cell.text));
  out.doc = f.doc.empty() ? card.schema->doc : f.doc;
  if (!cell.blank() && f.type == FieldType::integer)
    if (const std::string meaning = meaning_of_value(f, cell.integer); !meaning.empty())
      out.rest += fmt::format("{}: {}\n", cell.integer, meaning);
  if (f.type == FieldType::id && cell.integer != 0 && !f.ref.empty()) {
    const std::int64_t id = std::abs(cell.integer) + view.deck.offset_of(block, f.ref);
    if (const std::string title = title_of_id(view, f.ref, id); !title.empty())
      out.rest += fmt::format("{} {}: {}\n", f.ref, id, title);
  }
  if (const std::string range = range_text(f); !range.empty()) out.rest += "Legal: " + range + "\n";
  if (!f.default_text.empty()) out.rest += "0 or blank: " + f.default_text + "\n";
  if (f.ignored) out.rest += "The solver reads it, but it has no effect.\n";
  if (!f.from_manual.empty()) out.rest += "Manual: " + f.from_manual + "\n";
  out.help = field_help(f, view.schemas(), 100);
  return out;
}

namespace {

Json hover_of_cell(const View& view, const PlacedLine& line, const Cell& cell) {
  const Block& block = view.deck.blocks[static_cast<std::size_t>(line.block)];
  const CellText text = describe(view, block, line.card, cell);
  std::string page = "**" + plain(text.head) + "**\n\n" + plain(text.doc) + "\n\n";
  if (!text.value.empty()) page += "Used: `" + text.value + "`\n\n";
  std::size_t at = 0;
  while (at < text.rest.size()) {
    const auto end = std::min(text.rest.find('\n', at), text.rest.size());
    page += "- " + plain(text.rest.substr(at, end - at)) + "\n";
    at = end + 1;
  }
  if (!text.help.empty()) page += "\n---\n" + as_markdown(text.help);
  page += fmt::format("\n{} of {}, columns of version {}", plain(line.card.schema->name),
                      plain(block.schema->keyword), block.version);
  const CellColumns columns = columns_of(line.card, cell);
  const std::uint64_t length = line.line.text.size();
  const auto clipped = [&](int column) {
    return line.line.offset + std::min<std::uint64_t>(static_cast<std::uint64_t>(column), length);
  };
  return {{"contents", markup(view, page)},
          {"range", view.range(view.file, clipped(columns.first - 1), clipped(columns.last))}};
}

Json hover_of_header(const View& view, const PlacedLine& line) {
  const Block& block = view.deck.blocks[static_cast<std::size_t>(line.block)];
  std::string page = "**" + plain(block.header) + "**";
  if (const std::string title = title_of(view.deck, block); !title.empty())
    page += " — " + plain(title);
  page += "\n\n";
  if (block.schema == nullptr) {
    page += "No schema describes this keyword: its lines are not checked.";
  } else {
    page += plain(block.schema->doc) + "\n\n";
    for (const CardSchema& card : block.schema->cards)
      if (card.in_version(block.version)) page += "- " + plain(card.name) + "\n";
    page += fmt::format("\nColumns of version {}", block.version);
    if (const UnitSystem* u = view.deck.units_of(block); u != nullptr && !u->mass_code.empty())
      page += plain(fmt::format(", units {} {} {}", u->mass_code, u->length_code, u->time_code));
  }
  return {{"contents", markup(view, page)}, {"range", view.range(block.header_span)}};
}

}  // namespace

Answer hover(const View& view, const Json& params) {
  const std::uint64_t offset = view.offset(params.at("position"));
  const PlacedLine line = view.line_at(offset);
  if (line.what == PlacedLine::What::header) return hover_of_header(view, line);
  if (line.what == PlacedLine::What::title) {
    const Block& block = view.deck.blocks[static_cast<std::size_t>(line.block)];
    return {{"contents",
             markup(view, "**title** of " + plain(block.header) + " · columns 1–100 · text")},
            {"range", view.range(line.line.whole())}};
  }
  if (line.what != PlacedLine::What::card) return nullptr;
  const Cell* cell = line.cell_at(static_cast<int>(offset - line.line.offset) + 1);
  return cell == nullptr ? Json() : hover_of_cell(view, line, *cell);
}

// ---- inlay hints: at the ends of lines, where they move no column ------------------------------

namespace {

/// Effective values that are not on the line, and titles of referenced entities.
std::string hint_of(const View& view, const Block& block, const DecodedCard& card) {
  std::string out;
  const auto add = [&](const std::string& text) { out += (out.empty() ? "" : " · ") + text; };
  for (const Cell& cell : card.cells) {
    const Field& f = *cell.field;
    if (f.type == FieldType::id && cell.integer != 0 && card.schema->repeat == Repeat::once) {
      const std::string title =
          title_of_id(view, f.ref, std::abs(cell.integer) + view.deck.offset_of(block, f.ref));
      if (!title.empty()) add(f.name + ": " + title);
      continue;
    }
    if (f.ignored || f.type == FieldType::flag) continue;
    const EffectiveValue used = effective(view, block, f.name);
    constexpr std::string_view idle[] = {"", "0", "0.0", "1e+30", "000"};
    if (used.known && !used.on_card &&
        std::find(std::begin(idle), std::end(idle), used.text) == std::end(idle))
      add(fmt::format("{} {} ({})", f.name, used.text, used.origin));
  }
  return out;
}

}  // namespace

Answer inlay_hints(const View& view, const Json& params) {
  const std::uint64_t begin = view.offset(params.at("range").at("start"));
  const std::uint64_t end = view.offset(params.at("range").at("end"));
  Json out = Json::array();
  const auto add = [&](const Line& line, const std::string& text) {
    out.push_back({{"position", view.position(view.file, line.offset + line.text.size())},
                   {"label", utf8(text)},
                   {"paddingLeft", true}});
  };
  for (const Block& block : view.deck.blocks) {
    if (block.schema == nullptr || block.schema->kind != "inter" || block.opaque ||
        block.header_span.file != view.file || block.header_span.offset > end)
      continue;
    for (const DecodedCard& card : decode(view.deck, block).cards) {
      if (card.missing() || card.line.file != view.file || card.line.offset < begin ||
          card.line.offset > end)
        continue;
      if (const std::string text = hint_of(view, block, card); !text.empty()) add(card.line, text);
    }
  }
  // The column under the cursor, if the client sends it.
  if (const auto& cursor = view.open.cursor; cursor && cursor->path == view.path) {
    const LineTable& lines = view.syntax->lines(view.file);
    const std::uint64_t offset = lines.offset(view.text(), cursor->place, view.client.encoding);
    if (offset >= begin && offset <= end) {
      const PlacedLine line = view.line_at(offset);
      if (const Cell* cell = line.cell_at(static_cast<int>(offset - line.line.offset) + 1))
        add(line.line, "▸ " + describe(view, view.deck.blocks[static_cast<std::size_t>(line.block)],
                                       line.card, *cell)
                                  .head);
    }
  }
  return out;
}

}  // namespace deck::lsp
