// The document of `deck show --json`.
#include <algorithm>

#include "keyword/shared/card_forms.hpp"
#include "keyword/shared/place.hpp"
#include "report/shared/schemas.hpp"
#include "report/shared/show.hpp"
#include "report/shared_records.hpp"

namespace deck {

Record<Entity> record_of(const Entity*) {
  static constexpr Column<Entity> columns[] = {
      column<&Entity::keyword>("keyword"),
      column<&Entity::kind>("kind", "inter, part, node, shell, grnod, surf, set, mat ..."),
      column<&Entity::id>("id"), column<&Entity::title>("title")};
  return {"entity", "", columns, true};
}

namespace {

using detail::CellKind;

struct CellRow {
  std::array<int, 2> columns;
  const Cell* cell;

  std::optional<Scalar> value() const {
    switch (detail::kind_of(*cell)) {
      case CellKind::integer:
        return cell->integer;
      case CellKind::real:
        return cell->real;
      case CellKind::text:
        return std::string(cell->text);
      default:
        return std::nullopt;
    }
  }
};
Record<CellRow> record_of(const CellRow*) {
  static constexpr Column<CellRow> columns[] = {
      column<&CellRow::cell, &Cell::field, &Field::name>("field"),
      column<&CellRow::columns>("columns", "First and last, from 1 on"),
      column<&CellRow::cell, &Cell::text>("text"),
      column<&CellRow::value>("value", "null: blank; a text: a parameter, a name or no number")};
  return {"cell", "", columns, true};
}

struct CardRow {
  const Deck& deck;
  const ShownCard* card;

  std::string name() const {
    if (card->schema != nullptr) return card->schema->name;
    return card->title ? "title" : "";
  }
  /// A cell behind the end of its line has the columns of its field; free format may leave none.
  CellRow cell(const Cell& c) const {
    DecodedCard placed;
    placed.schema = card->schema;
    placed.line = card->line;
    placed.free_format = card->free_format;
    const CellColumns at = columns_of(placed, c);
    return {{at.first, std::max(at.first, at.last)}, &c};
  }
};
Record<CardRow> record_of(const CardRow*) {
  using Row = CardRow;
  static constexpr Column<Row> columns[] = {
      column("line", "From 1 on",
             [](const Row& r) { return r.deck.sources.position(r.card->line.whole()).line; }),
      column("file", [](const Row& r) { return r.deck.sources[r.card->line.file].path(); }),
      column<&Row::name>("card", "What the line is: a card, title, or empty without a schema"),
      column<&Row::card, &ShownCard::line, &Line::text>("text"), column("cells", [](const Row& r) {
        return rows_of(r.card->cells, [&r](const Cell& c) { return r.cell(c); });
      })};
  return {"card", "", columns};
}

struct LinkRow {
  const Link* link;
  std::optional<SourcePlace> place;
};
Record<LinkRow> record_of(const LinkRow*) {
  using Row = LinkRow;
  static constexpr Column<Row> columns[] = {
      column<&Row::link, &Link::field>("field", "The cell, clause or list that names the other"),
      column<&Row::link, &Link::keyword>("keyword", "Empty: there is no such entity"),
      column<&Row::link, &Link::kind>("kind"),
      column("id", [](const Row& r) { return known(r.link->id != 0, r.link->id); }),
      column("last", "Last id of a range",
             [](const Row& r) { return if_any(r.link->last > 0, r.link->last); }),
      column("count", "How many, such as the elements of a part",
             [](const Row& r) { return if_any(r.link->count > 1, r.link->count); }),
      column<&Row::link, &Link::title>("title"),
      column("file",
             [](const Row& r) { return r.place ? std::optional(r.place->file) : std::nullopt; }),
      column("line",
             [](const Row& r) { return r.place ? std::optional(r.place->line) : std::nullopt; })};
  return {"link", "", columns, true};
}

struct ShowDocument {
  const ParamsInput& in;
  const EntityView& view;
  const Deck& deck;

  Rows<LinkRow> links(const std::vector<Link>& list) const {
    return rows_of(list, [this](const Link& l) { return LinkRow{&l, place_of(deck, l.span)}; });
  }
};
Record<ShowDocument> record_of(const ShowDocument*) {
  using Row = ShowDocument;
  static constexpr Column<Row> columns[] = {
      column("deck", [](const Row& r) { return deck_row(r.in.loaded); }),
      column("entity", [](const Row& r) -> const Entity& { return r.view.entity; }),
      column("source", [](const Row& r) { return place_of(r.deck, r.view.entity.span); }),
      column("included_by", "Include directives from the main file down to its file",
             [](const Row& r) {
               return rows_of(r.view.includes, [&r](const Span& s) { return place_of(r.deck, s); });
             }),
      column("cards", "Its data lines",
             [](const Row& r) {
               return rows_of(r.view.cards, [&r](const ShownCard& c) {
                 return CardRow{r.deck, &c};
               });
             }),
      column("parameters", "Of an interface, by the names of the manual",
             [](const Row& r) {
               if (r.view.inter == nullptr) return IfAny<Named<ParameterRow>>{};
               return IfAny<Named<ParameterRow>>{parameters_of(r.in, *r.view.inter)};
             }),
      column("model", "What the model makes of it: counts of members, coordinates ...",
             [](const Row& r) {
               return Named<Scalar>{[&r](const auto& add) {
                 for (const auto& [name, value] : r.view.facts) add(name, value);
               }};
             }),
      column("refers_to", "What it names; the place is that of the target's definition",
             [](const Row& r) { return r.links(r.view.refers_to); }),
      column("used_by", "What names it; the place is that of the cell",
             [](const Row& r) { return r.links(r.view.used_by); }),
      column("contacts", "Contacts that reach it over other entities or as a member of a side",
             [](const Row& r) { return r.links(r.view.interfaces); })};
  return {"document", "", columns};
}

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
