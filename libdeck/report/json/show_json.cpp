// The document of `deck show --json`.
#include <algorithm>

#include "keyword/shared/deck_json_cells.hpp"
#include "keyword/shared/place.hpp"
#include "report/shared/inspection.hpp"
#include "report/shared/params_report.hpp"
#include "report/shared_records.hpp"

namespace deck {

LINE_RECORD(Entity, "entity", "", COLUMN("keyword", "", r.keyword),
            COLUMN("kind", "inter, part, node, shell, grnod, surf, set, mat ...", r.kind),
            COLUMN("id", "", r.id), COLUMN("title", "", r.title));

namespace {

using detail::CellKind;

struct CellRow {
  const ShownCard& card;
  const Cell* cell;

  /// A cell behind the end of its line has the columns of its field; free format may leave none.
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

}  // namespace deck
