// The document of `deck show --json`.
#include <algorithm>

#include "keyword/shared/deck_json_cells.hpp"
#include "keyword/shared/place.hpp"
#include "report/shared/json.hpp"
#include "report/shared/show.hpp"

namespace deck {
namespace {

using detail::CellKind;

class ShowJson {
 public:
  ShowJson(const ParamsInput& in, const EntityView& view)
      : deck_(in.loaded.deck()), in_(in), view_(view), json_(out_) {}

  std::string run() {
    const Entity& e = view_.entity;
    json_.begin_object();
    write_json_head(json_, "deck/show", 1);
    write_json_deck(json_, in_.loaded.path(), deck_, &in_.loaded.model(), &in_.loaded.interfaces());
    json_.key("entity").begin_object(true);
    json_.field("keyword", e.keyword).field("kind", e.kind).field("id", e.id);
    json_.field("title", e.title).end_object();
    json_.key("source");
    write_json_place(json_, deck_, e.span);
    json_.key("included_by").begin_array();
    for (const Span& s : view_.includes) write_json_place(json_, deck_, s);
    json_.end_array();
    json_.key("cards").begin_array();
    for (const ShownCard& card : view_.cards) write(card);
    json_.end_array();
    if (view_.inter != nullptr) write_json_parameters(json_, in_, *view_.inter);
    json_.key("model").begin_object();
    for (const auto& [name, value] : view_.facts) {
      json_.key(name);
      std::visit([&](const auto& v) { json_.value(v); }, value);
    }
    json_.end_object();
    write("refers_to", view_.refers_to);
    write("used_by", view_.used_by);
    write("contacts", view_.interfaces);
    json_.end_object();
    return std::move(out_);
  }

 private:
  void write(const ShownCard& card) {
    json_.begin_object();
    json_.field("line", deck_.sources.position(card.line.whole()).line);
    json_.field("file", deck_.sources[card.line.file].path());
    json_.field("card", card.schema != nullptr ? card.schema->name : card.title ? "title" : "");
    json_.field("text", card.line.text);
    json_.key("cells").begin_array();
    DecodedCard placed;
    placed.schema = card.schema;
    placed.line = card.line;
    placed.free_format = card.free_format;
    for (const Cell& c : card.cells) {
      // A cell behind the end of its line has the columns of its field; free format may leave none.
      const CellColumns at = columns_of(placed, c);
      json_.begin_object(true).field("field", c.field->name).key("columns").begin_array();
      json_.value(at.first).value(std::max(at.first, at.last)).end_array();
      json_.field("text", c.text).key("value");
      switch (detail::kind_of(c)) {
        case CellKind::null:
          json_.null();
          break;
        case CellKind::integer:
          json_.value(c.integer);
          break;
        case CellKind::real:
          json_.value(c.real);
          break;
        case CellKind::text:
          json_.value(c.text);
          break;
      }
      json_.end_object();
    }
    json_.end_array().end_object();
  }

  void write(const char* name, const std::vector<Link>& list) {
    json_.key(name).begin_array();
    for (const Link& l : list) {
      json_.begin_object(true).field("field", l.field).field("keyword", l.keyword);
      json_.field("kind", l.kind);
      json_.key("id");
      if (l.id == 0)
        json_.null();
      else
        json_.value(l.id);
      if (l.last > 0) json_.field("last", l.last);
      if (l.count > 1) json_.field("count", l.count);
      json_.field("title", l.title);
      json_.key("file");
      if (l.span.valid())
        json_.value(deck_.sources[l.span.file].path())
            .field("line", deck_.sources.position(l.span).line);
      else
        json_.null().key("line").null();
      json_.end_object();
    }
    json_.end_array();
  }

  const Deck& deck_;
  const ParamsInput& in_;
  const EntityView& view_;
  std::string out_;
  JsonWriter json_;
};

}  // namespace

std::string show_json(const ParamsInput& params, const EntityView& view) {
  return ShowJson(params, view).run();
}

}  // namespace deck
