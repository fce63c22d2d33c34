// What the page says of interfaces and their contacts beside the pairs: effective values with their
// origin, the lines of the cards with the columns that a changed value goes to; options, totals,
// what a default gap is made of.
#include <algorithm>

#include "contact/shared/scene_parts.hpp"
#include "deck/contact/scene.hpp"
#include "deck/keyword/decode.hpp"
#include "report/html/parts.hpp"
#include "report/shared_records.hpp"
#include "verdict/shared/of_interface.hpp"

namespace deck::detail {
namespace {

constexpr std::size_t most_lines = 200;

/// Fields that can be changed in the page, by the names that --what-if takes.
constexpr std::string_view editable[] = {"Gapmin",  "Fscalegap", "Gapmax",
                                         "Fpenmax", "Igap",      "Inacti"};

std::string_view name_on_card(const InterBase& inter, std::string_view field) {
  return field == "Gapmin" ? traits_of(inter).gap : field;
}

void write_card_text(JsonWriter& j, const Deck& deck, const InterBase& inter) {
  const Block& block = *inter.block;
  std::vector<std::uint64_t> offsets;
  j.key("card").begin_object();
  const Position at = deck.sources.position(inter.span);
  j.field("file", deck.sources[inter.span.file].path()).field("line", at.line);
  j.key("lines").begin_array();
  j.value(block.header);
  offsets.push_back(block.header_span.offset);
  LineCursor cursor(deck.sources, block);
  for (Line line = cursor.next_physical(); line.valid() && offsets.size() < most_lines;
       line = cursor.next_physical()) {
    j.value(line.text);
    offsets.push_back(line.offset);
  }
  j.end_array();
  const DecodedBlock decoded = decode(deck, block);
  j.key("cells").begin_array();
  for (const std::string_view field : editable) {
    if (inter.type == InterType2::traits.type) break;  // the page changes nothing of a tie
    const std::string_view name = name_on_card(inter, field);
    for (const DecodedCard& card : decoded.cards) {
      if (card.missing()) continue;
      const auto line = std::find(offsets.begin(), offsets.end(), card.line.offset);
      if (line == offsets.end()) continue;
      for (const Cell& cell : card.cells) {
        if (cell.field == nullptr || cell.field->name != name) continue;
        Cell one = cell;
        one.real = 1;
        const double factor =
            cell.field->type == FieldType::real ? working_value(deck, decoded, one) : 1;
        j.begin_object(true).field("field", field);
        j.field("line", static_cast<std::int64_t>(line - offsets.begin()));
        j.field("first", cell.field->first).field("last", cell.field->last);
        j.field("real", cell.field->type == FieldType::real).field("factor", factor);
        const auto& legal = cell.field->values;
        const bool has_nothing = std::find(legal.begin(), legal.end(), 1000) != legal.end();
        j.field("nothing", has_nothing ? 1000 : 0);
        j.field("parameter", cell.parameter).field("free", card.free_format);
        j.end_object();
      }
    }
  }
  j.end_array().end_object();
}

template <class T>
void write_value(JsonWriter& j, std::string_view name, const Effective<T>& e,
                 const Contact* contact) {
  j.key(name).begin_object(true).key("value");
  if (e.origin != Origin::geometry)
    j.value(e.value);
  else if (contact != nullptr)
    j.value(geometry_value(*contact, name));
  else
    j.null();
  j.field("origin", to_string(e.origin));
  j.key("input");
  e.has_input ? j.value(e.input) : j.null();
  j.end_object();
}

/// Of a contact or a tie.
VerdictLevel level_of(const HtmlInput& input, const InterBase& inter) {
  for (const Tie& tie : input.scene->ties)
    if (tie.inter == &inter) return level_of_tie(tie);
  return verdict_of_interface(*input.scene, *input.view, inter).level;
}

void write_default_gap(JsonWriter& j, const Contact& c, const PlainSides& plain) {
  const auto side = [&](const ThicknessSamples& t, double shortest) {
    write_row(j, t.count, t.sum, t.smallest, t.largest, shortest);
  };
  j.key("default").begin_array();
  if (c.kind == ContactKind::node_segment) {
    side(shell_thickness(c), plain.shortest_side);
  } else {
    side(plain.main_side.thickness, plain.main_side.shortest);
    side(plain.secondary_side.thickness, plain.secondary_side.shortest);
  }
  j.end_array();
}

/// What the card and the defaults say before the rules of the contact's kind apply.
void write_card(JsonWriter& j, const InterBase& inter) {
  const CardSettings card = card_settings(inter);
  double edge_scale_gap = 0;
  visit_interface(inter, [&](const auto& i) {
    if constexpr (requires { i.Edge_scale_gap; }) edge_scale_gap = i.Edge_scale_gap.value;
  });
  j.key("card").begin_object(true);
  j.field("Gapmin", card.gapmin).field("Igap", card.igap).field("Inacti", card.inacti);
  j.field("Fscalegap", card.gap_scale).field("Gapmax", card.gapmax).field("Fpenmax", card.fpenmax);
  j.field("Edge_scale_gap", edge_scale_gap).end_object();
}

}  // namespace

void write_interfaces(JsonWriter& j, const HtmlInput& input) {
  const Deck& deck = *input.deck;
  std::vector<const InterBase*> all = input.scene->interfaces->ordered;
  for (const Tie& tie : input.scene->ties) all.push_back(tie.inter);
  j.key("interfaces").begin_array();
  for (const InterBase* inter : all) {
    j.begin_object();
    j.field("id", inter->id).field("type", inter->type).field("title", inter->title);
    j.field("level", to_string(level_of(input, *inter)));
    write_card_text(j, deck, *inter);
    const Contact* const contact = first_contact(*input.scene, *inter);
    j.key("values").begin_object();
    for_each_field(*inter, [&](std::string_view name, const auto& field) {
      write_value(j, name, field, contact);
    });
    j.end_object().end_object();
  }
  j.end_array();
}

void write_what_if(JsonWriter& j, const std::vector<WhatIf>& all) {
  j.key("what_if").begin_array();
  for (const WhatIf& w : all) {
    j.begin_object(true).field("interface", w.interface_id);
    const auto field = [&](std::string_view name, const auto& value) {
      if (value) j.field(name, *value);
    };
    field("Gapmin", w.Gapmin);
    field("Fscalegap", w.Fscalegap);
    field("Gapmax", w.Gapmax);
    field("Fpenmax", w.Fpenmax);
    field("%mesh_size", w.mesh_size);
    field("Igap", w.Igap);
    field("Inacti", w.Inacti);
    field("Irem_gap", w.Irem_gap);
    j.end_object();
  }
  j.end_array();
}

void write_contacts(JsonWriter& j, const HtmlInput& input, const PageContacts& page) {
  const Scene& scene = *input.scene;
  j.key("contacts").begin_array();
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const Contact& c = scene.contacts[i];
    const PageContact& own = page.contacts[i];
    const PlainSides& plain = own.plain;
    const bool edges = c.kind == ContactKind::edge_edge;
    const auto longest = [&](const std::vector<double>& lengths) {
      return edges || lengths.empty() ? 0.0 : *std::max_element(lengths.begin(), lengths.end());
    };
    j.begin_object();
    j.field("interface", interface_position(scene, c.inter));
    j.field("kind", to_string(c.kind)).field("role", to_string(c.role)).field("type", c.type);
    j.field("ties", c.ties()).field("dropped", c.dropped).field("igap", c.igap);
    j.field("inacti", c.inacti).field("evaluated", c.evaluated);
    j.field("modern", is_modern(c.type)).field("itied", c.itied);
    j.field("fpenmax", c.fpenmax).field("gap_scale", c.gap_scale);
    j.field("gapmin", c.gapmin).field("gapmin_from", to_string(c.gapmin_origin));
    j.field("gapmax", c.gapmax).field("max_gap", c.max_gap);
    j.field("longest_main", longest(plain.main_length));
    j.field("longest_node", longest(plain.secondary_length));
    j.field("secondary", edges ? c.secondary_edges.size() : c.secondary.size());
    j.field("main", edges ? c.main_edges.size() : c.main.size());
    j.field("repaired", c.repaired_segments).field("degenerate", c.degenerate_segments);
    j.field("reoriented", c.reoriented_segments).field("no_carrier", c.no_carrier.size());
    j.field("reach", own.reach).field("fixed", own.fixed).field("complete", own.complete);
    j.key("round_off").begin_array(true);  // pairs that only the solver's round-off makes
    for (const PenetrationRow& row : c.penetrations)
      if (!row.in_contact) write_row(j, row.secondary, row.main);
    j.end_array();
    write_value(j.key("totals"), input.view->contacts[i]);
    write_card(j, *c.inter);
    write_default_gap(j, c, plain);
    j.end_object();
  }
  j.end_array();
}

}  // namespace deck::detail
