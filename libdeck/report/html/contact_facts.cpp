// What the page says of each contact beside its pairs: options, totals, what a default gap is made
// of.
#include <algorithm>

#include "contact/shared/scene_parts.hpp"
#include "report/gaps_names.hpp"
#include "report/html/parts.hpp"

namespace deck::detail {
namespace {

void write_default_gap(JsonWriter& j, const Contact& c, const PlainSides& plain) {
  const auto side = [&](const ThicknessSamples& t, double shortest) {
    j.begin_array(true).value(t.count).value(t.sum).value(t.smallest).value(t.largest);
    j.value(shortest).end_array();
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

void write_contacts(JsonWriter& j, const HtmlInput& input, const PageContacts& page) {
  const Scene& scene = *input.scene;
  const auto& order = scene.interfaces->ordered;
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
    j.field("interface", static_cast<std::int64_t>(std::find(order.begin(), order.end(), c.inter) -
                                                   order.begin()));
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
      if (!row.in_contact) j.begin_array(true).value(row.secondary).value(row.main).end_array();
    j.end_array();
    j.key("totals").begin_object(true);
    write_totals(j, input.view->contacts[i]);
    j.end_object();
    write_card(j, *c.inter);
    write_default_gap(j, c, plain);
    j.end_object();
  }
  j.end_array();
}

}  // namespace deck::detail
