// `deck show`: one entity as JSON; as text: field names over the columns of the card, effective
// values, references in both directions.
#include <fmt/format.h>

#include <algorithm>

#include "base/shared/shown_text.hpp"
#include "keyword/shared/card_forms.hpp"
#include "keyword/shared/place.hpp"
#include "report/shared/inspection.hpp"
#include "report/shared/params_report.hpp"
#include "report/shared_records.hpp"
#include "report/terminal/words.hpp"
#include "text/shared/columns.hpp"

namespace deck {

LINE_RECORD(Entity, "entity", "", COLUMN("keyword", "", r.keyword),
            COLUMN("kind", "inter, part, node, shell, grnod, surf, set, mat ...", r.kind),
            COLUMN("id", "", r.id), COLUMN("title", "", r.title));

namespace {

using detail::CellKind;

struct CellRow {
  const ShownCard& card;
  const Cell* cell;

  /// A cell behind the end of its line has the columns of its field; free format may have none.
  std::array<int, 2> columns() const {
    DecodedCard placed;
    placed.schema = card.schema;
    placed.line = card.line;
    placed.free_format = card.free_format;
    const CellColumns at = columns_of(placed, *cell);
    return {at.first, std::max(at.first, at.last)};
  }
  std::optional<Scalar> value() const {
    const CellKind kind = detail::kind_of(*cell);
    if (kind == CellKind::integer) return cell->integer;
    if (kind == CellKind::real) return cell->real;
    return known(kind == CellKind::text, Scalar(std::string(cell->text)));
  }
};
LINE_RECORD(CellRow, "cell", "", COLUMN("field", "", r.cell->field->name),
            COLUMN("columns", "First and last, from 1 on", r.columns()),
            COLUMN("text", "", r.cell->text),
            COLUMN("value", "null: blank; a text: a parameter, a name or no number", r.value()));

struct CardRow {
  const Deck& deck;
  const ShownCard* card;

  std::string name() const {
    if (card->schema != nullptr) return card->schema->name;
    return card->title ? "title" : "";
  }
};
RECORD(CardRow, "card", "",
       COLUMN("line", "From 1 on", r.deck.sources.position(r.card->line.whole()).line),
       COLUMN("file", "", r.deck.sources[r.card->line.file].path()),
       COLUMN("card", "What the line is: a card, title, or empty without a schema", r.name()),
       COLUMN("text", "", r.card->line.text),
       COLUMN("cells", "", rows<CellRow>(r.card->cells, *r.card)));

struct LinkRow {
  const Deck& deck;
  const Link* link;
  std::optional<SourcePlace> place = place_of(deck, link->span);
};
LINE_RECORD(LinkRow, "link", "",
            COLUMN("field", "The cell, clause or list that names the other", r.link->field),
            COLUMN("keyword", "Empty: there is no such entity", r.link->keyword),
            COLUMN("kind", "", r.link->kind), COLUMN("id", "", known(r.link->id != 0, r.link->id)),
            COLUMN("last", "Last id of a range", if_any(r.link->last > 0, r.link->last)),
            COLUMN("count", "How many, such as the elements of a part",
                   if_any(r.link->count > 1, r.link->count)),
            COLUMN("title", "", r.link->title),
            COLUMN("file", "", r.place ? std::optional(r.place->file) : std::nullopt),
            COLUMN("line", "", r.place ? std::optional(r.place->line) : std::nullopt));

struct ShowDocument {
  const ParamsInput& in;
  const EntityView& view;
  const Deck& deck;
};
RECORD(ShowDocument, "document", "", COLUMN("deck", "", deck_row(r.in.loaded)),
       COLUMN("entity", "", r.view.entity),
       COLUMN("source", "", place_of(r.deck, r.view.entity.span)),
       COLUMN("included_by", "Include directives from the main file down to its file",
              rows_of(r.view.includes, [&r](const Span& s) { return place_of(r.deck, s); })),
       COLUMN("cards", "Its data lines", rows<CardRow>(r.view.cards, r.deck)),
       COLUMN("parameters", "Of an interface, by the names of the manual",
              r.view.inter == nullptr
                  ? IfAny<Named<ParameterRow>>{}
                  : IfAny<Named<ParameterRow>>{parameters_of(r.in, *r.view.inter)}),
       COLUMN("model", "What the model makes of it: counts of members, coordinates ...",
              Named<Scalar>{[&r](const auto& add) {
                for (const auto& [name, value] : r.view.facts) add(name, value);
              }}),
       COLUMN("refers_to", "What it names; the place is that of the target's definition",
              rows<LinkRow>(r.view.refers_to, r.deck)),
       COLUMN("used_by", "What names it; the place is that of the cell",
              rows<LinkRow>(r.view.used_by, r.deck)),
       COLUMN("contacts", "Contacts that reach it over other entities or as a member of a side",
              rows<LinkRow>(r.view.interfaces, r.deck)));

constexpr DocumentHead show_head{
    "deck/show", 1,
    "Written by deck show --json: one entity of a deck, its card, what the solver uses, what it "
    "refers to and what uses it. Cells have the values of the card; parameters and model are in "
    "working units.",
    false};

}  // namespace

DocumentSchema show_schema() { return document_schema<ShowDocument>(show_head); }

std::string show_json(const ParamsInput& params, const EntityView& view) {
  return write_document(show_head, ShowDocument{params, view, params.loaded.deck()});
}

// ---- for people --------------------------------------------------------------------------------

namespace {

constexpr std::size_t most_card_lines = 30, most_links = 20;

std::string shown_name(const std::string& keyword, const std::string& kind, std::int64_t id) {
  return keyword.empty() ? fmt::format("{} {}", kind, id) : fmt::format("{}/{}", keyword, id);
}

std::string fact_text(const FactValue& value) {
  if (const auto* n = std::get_if<std::int64_t>(&value)) return std::to_string(*n);
  if (const auto* x = std::get_if<double>(&value)) return shortest(*x);
  return std::get<std::string>(value);
}

class ShowText {
 public:
  ShowText(const ParamsInput& in, const EntityView& view, const ShowTextOptions& options)
      : deck_(in.loaded.deck()), in_(in), view_(view), options_(options) {}

  std::string run() {
    head();
    cards();
    facts();
    if (view_.inter != nullptr)
      heading("Effective values",
              params_table(in_, *view_.inter).fitted(options_.width, options_.color, 2));
    links("Refers to", "field", view_.refers_to, true);
    links("Used by", "as", view_.used_by, false);
    links("Reached from contacts", "as", view_.interfaces, false);
    if (view_.used_by.empty() && view_.interfaces.empty() && view_.entity.kind != "inter")
      out_ += "\nNothing uses it.\n";
    return std::move(out_);
  }

 private:
  std::string bold(std::string_view text) const { return toned(text, Tone::bold, options_.color); }
  std::string dim(std::string_view text) const { return toned(text, Tone::dim, options_.color); }
  void heading(const char* title, const std::string& text) {
    out_ += titled(title, text, options_.color);
  }

  void head() {
    const Entity& e = view_.entity;
    out_ += bold(shown_name(e.keyword, e.kind, e.id));
    if (!e.title.empty()) out_ += "  " + terminal_text(e.title);
    out_ += "\n";
    if (e.span.valid()) out_ += "  " + dim(terminal_text(deck_.sources.where(e.span))) + "\n";
    for (const Span& s : view_.includes)
      out_ += "  included by " + dim(terminal_text(deck_.sources.where(s))) + "\n";
    if (e.block == nullptr) return;
    out_ += fmt::format("  columns of version {}", e.block->version);
    if (const UnitSystem* u = deck_.units_of(*e.block); u != nullptr && !u->mass_code.empty())
      out_ += ", units " + units_text(*u);
    if (e.block->submodel >= 0) {
      const Submodel& s = deck_.submodels[static_cast<std::size_t>(e.block->submodel)];
      out_ += fmt::format(", submodel {} {}", s.id, terminal_text(s.title));
    }
    out_ += e.block->opaque ? ", encrypted\n" : "\n";
  }

  // ---- the card -------------------------------------------------------------------------------

  static constexpr std::size_t margin = 8;  ///< line numbers

  void cards() {
    if (view_.cards.empty()) return;
    out_ += "\n";
    const CardSchema* last = nullptr;
    std::size_t shown = 0;
    for (const ShownCard& card : view_.cards) {
      if (!options_.all && shown++ == most_card_lines) {
        out_ += fmt::format("{:>{}}… {} more lines (--all)\n", "", margin,
                            view_.cards.size() - most_card_lines);
        break;
      }
      const std::string number =
          fmt::format("{:>6}  ", deck_.sources.position(card.line.whole()).line);
      if (card.free_format || (card.schema == nullptr && card.cells.empty())) {
        out_ += dim(number) + plain(card.line.text) + "\n";
        if (card.free_format) free_cells(card);
      } else {
        fixed(card, number, card.schema != last || card.schema->repeat != Repeat::ids);
      }
      last = card.schema;
    }
  }

  /// A line as written, continued if longer than the terminal.
  std::string plain(std::string_view text) const {
    std::string shown = terminal_columns(text), out;
    if (options_.width <= margin + 20) return shown;
    const std::size_t room = options_.width - margin;
    while (display_width(shown) > room) {
      std::size_t at = 0;
      for (std::size_t k = 0; k < room; ++k)
        at += std::max<std::size_t>(text_unit_at(shown, at).length, 1);
      out += shown.substr(0, at) + "\n" + std::string(margin, ' ');
      shown.erase(0, at);
    }
    return out + shown;
  }

  void free_cells(const ShownCard& card) {
    std::string line;
    for (const Cell& c : card.cells) {
      const std::string item =
          fmt::format("{} = {}", c.field->name, c.blank() ? "(blank)" : terminal_text(c.text));
      if (options_.width > 0 && margin + line.size() + item.size() + 2 > options_.width) {
        out_ += std::string(margin, ' ') + dim(line) + "\n";
        line.clear();
      }
      append(line, ", ", item);
    }
    if (!line.empty()) out_ += std::string(margin, ' ') + dim(line) + "\n";
  }

  struct Column {
    int last = 0;
    std::string name;
  };

  void fixed(const ShownCard& card, const std::string& number, bool names) {
    std::vector<Column> columns;
    for (const Cell& c : card.cells) {
      const bool list =
          card.schema->repeat == Repeat::ids && c.field == &card.schema->fields.back();
      const int start =
          list ? static_cast<int>(c.span.offset - card.line.offset) + 1 : c.field->first;
      columns.push_back({start + c.field->last - c.field->first, c.field->name});
    }
    // Further cells go to lines of their own.
    const int room =
        options_.width > margin + 20 ? static_cast<int>(options_.width - margin) : 1000;
    for (std::size_t at = 0, begin = 1; at < columns.size() || begin == 1;) {
      const int from = static_cast<int>(begin);
      std::size_t end = at;
      int last = from;
      while (end < columns.size() && (end == at || columns[end].last - from < room))
        last = columns[end++].last;
      if (end == columns.size())
        last = std::max<int>(
            last, std::min<int>(static_cast<int>(card.line.text.size()), from + room - 1));
      if (names) name_lines(std::span(columns).subspan(at, end - at), from);
      out_ += at == 0 ? dim(number) : dim(fmt::format("{:>6}  ", "…"));
      const std::string text = terminal_columns(detail::columns(card.line.text, from, last));
      out_ += text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
      if (end == columns.size()) break;
      at = end;
      begin = static_cast<std::size_t>(last) + 1;
    }
  }

  /// Names end where their columns end; a name without room goes one line up.
  void name_lines(std::span<const Column> columns, int from) {
    std::vector<std::string> lines(1);
    for (const Column& c : columns) {
      const auto end = static_cast<std::size_t>(c.last - from + 1);
      const std::size_t begin = end > c.name.size() ? end - c.name.size() : 0;
      std::size_t row = 0;
      while (row < lines.size() && !lines[row].empty() && lines[row].size() + 1 > begin) ++row;
      if (row == lines.size()) lines.emplace_back();
      lines[row].resize(begin, ' ');
      lines[row] += c.name;
    }
    for (auto it = lines.rbegin(); it != lines.rend(); ++it)
      if (!it->empty())
        out_ += std::string(margin, ' ') + toned(*it, Tone::cyan, options_.color) + "\n";
  }

  // ---- figures and references -----------------------------------------------------------------

  void facts() {
    TextTable table({"figure", "value"});
    for (const auto& [name, value] : view_.facts) table.row({name, fact_text(value)});
    heading("In the model", table.below_heading(options_));
  }

  void links(const char* title, const char* field, const std::vector<Link>& list, bool target) {
    TextTable table({field, "what", "title", target ? "=defined at" : "=place"});
    const std::size_t shown = options_.all ? list.size() : std::min(list.size(), most_links);
    for (const Link& l : std::span(list).first(shown)) {
      std::string what = l.count > 1 || l.id == 0 ? fmt::format("{} {}", l.count, l.keyword)
                                                  : shown_name(l.keyword, l.kind, l.id);
      if (l.last > 0) what = fmt::format("{} {} to {}", l.kind, l.id, l.last);
      const bool missing = target && l.last == 0 && !l.span.valid();
      if (missing) what += " (does not exist)";
      table.row({l.field,
                 {what, missing ? Tone::red : Tone::plain},
                 l.title,
                 {l.span.valid() ? deck_.sources.where(l.span) : std::string(), Tone::dim}});
    }
    heading(title,
            table.below_heading(options_) + more_line(list.size(), shown, " (--all, --json)"));
  }

  const Deck& deck_;
  const ParamsInput& in_;
  const EntityView& view_;
  const ShowTextOptions& options_;
  std::string out_;
};

}  // namespace

std::string show_text(const ParamsInput& params, const EntityView& view,
                      const ShowTextOptions& options) {
  return ShowText(params, view, options).run();
}

}  // namespace deck
