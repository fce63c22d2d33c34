// The page's JSON as records: deck, interfaces and contacts without pairs (effective values with
// origin, card lines with columns of changed values, options, totals, input of default gaps), ties,
// and an earlier run.
#include <fmt/format.h>

#include <algorithm>

#include "base/shared/words.hpp"
#include "contact/shared/reported.hpp"
#include "contact/shared/scene_steps.hpp"
#include "deck/contacts.hpp"
#include "deck/keyword.hpp"
#include "deck/report.hpp"
#include "report/html/page_steps.hpp"
#include "report/shared/fix.hpp"
#include "report/shared/inspection.hpp"
#include "report/shared_records.hpp"
#include "verdict/shared/of_interface.hpp"

namespace deck {

/// An object with a T for each word of the enumeration.
template <class E, class T>
struct ByWord {
  T (*value)(E);
};
template <class E, class T>
struct Value<ByWord<E, T>> {
  static void write(JsonWriter& json, const ByWord<E, T>& words) {
    json.begin_object();
    for (std::size_t i = 0; i < word_count<E>; ++i) {
      json.key(to_string(static_cast<E>(i)));
      Value<T>::write(json, words.value(static_cast<E>(i)));
    }
    json.end_object();
  }
  static JsonForm form(SchemaDefinitions& d) {
    return {"object", fmt::format(R"("propertyNames": {{ {} }}, "additionalProperties": {{ {} }})",
                                  Value<E>::form(d).members(), Value<T>::form(d).members())};
  }
};

LINE_RECORD(WhatIf, "what_if", "", COLUMN("interface", "Id", r.interface_id),
            COLUMN("Gapmin", "", IfAny<double>{r.Gapmin}),
            COLUMN("Fscalegap", "", IfAny<double>{r.Fscalegap}),
            COLUMN("Gapmax", "", IfAny<double>{r.Gapmax}),
            COLUMN("Fpenmax", "", IfAny<double>{r.Fpenmax}),
            COLUMN("%mesh_size", "", IfAny<double>{r.mesh_size}),
            COLUMN("Igap", "", IfAny<int>{r.Igap}), COLUMN("Inacti", "", IfAny<int>{r.Inacti}),
            COLUMN("Irem_gap", "", IfAny<int>{r.Irem_gap}));

namespace detail {
namespace {

constexpr std::size_t most_lines = 200;  // of a card

struct PagePart {
  const Part* part;
  const Property* property;  ///< nullptr: none
  template <class T>
  IfAny<T> of(T Property::*member) const {
    return property == nullptr ? IfAny<T>{} : IfAny<T>{property->*member};
  }
};
LINE_RECORD(PagePart, "part_meta", "", COLUMN("id", "", r.part->id),
            COLUMN("title", "", r.part->title), COLUMN("prop", "", r.part->prop_id),
            COLUMN("mat", "", r.part->mat_id), COLUMN("prop_type", "", r.of(&Property::type)),
            COLUMN("thickness", "", r.of(&Property::thickness)));

// ---- interfaces -------------------------------------------------------------------------------

/// Fields that the page can change, by their --what-if names.
constexpr std::string_view editable[] = {"Gapmin",  "Fscalegap", "Gapmax",
                                         "Fpenmax", "Igap",      "Inacti"};

struct PageCell {
  std::string_view field;
  std::size_t line = 0;
  const Cell* cell = nullptr;
  double factor = 1;
  bool free = false;
  bool real() const { return cell->field->type == FieldType::real; }
  int nothing() const {
    const auto& legal = cell->field->values;
    return std::find(legal.begin(), legal.end(), 1000) != legal.end() ? 1000 : 0;
  }
};
LINE_RECORD(PageCell, "cell", "A cell that the page can change.", COLUMN("field", "", r.field),
            COLUMN("line", "Position in the lines of the card", r.line),
            COLUMN("first", "Column, from 1 on", r.cell->field->first),
            COLUMN("last", "", r.cell->field->last), COLUMN("real", "", r.real()),
            COLUMN("factor", "Working unit per unit of the card", r.factor),
            COLUMN("nothing", "An integer that says \"no\": 1000 where it is legal, else 0",
                   r.nothing()),
            COLUMN("parameter", "", r.cell->parameter),
            COLUMN("free", "The line has commas", r.free));

struct PageCard {
  const Source* source = nullptr;
  std::size_t line = 0;
  std::vector<std::string_view> lines;
  DecodedBlock decoded;
  std::vector<PageCell> cells;
};
RECORD(PageCard, "card", "", COLUMN("file", "", r.source->path()), COLUMN("line", "", r.line),
       COLUMN("lines", "", rows_of(r.lines)), COLUMN("cells", "", r.cells));

std::string_view name_on_card(const InterBase& inter, std::string_view field) {
  return field == "Gapmin" ? traits_of(inter).gap : field;
}

/// A tie has no cells that the page can change.
std::vector<PageCell> editable_cells(const Deck& deck, const InterBase& inter,
                                     const DecodedBlock& decoded,
                                     const std::vector<std::uint64_t>& offsets) {
  std::vector<PageCell> out;
  if (inter.type == InterType2::traits.type) return out;
  for (const std::string_view field : editable)
    for (const DecodedCard& card : decoded.cards) {
      if (card.missing()) continue;
      const auto line = std::find(offsets.begin(), offsets.end(), card.line.offset);
      if (line == offsets.end()) continue;
      for (const Cell& cell : card.cells) {
        if (cell.field == nullptr || cell.field->name != name_on_card(inter, field)) continue;
        PageCell c{field, static_cast<std::size_t>(line - offsets.begin()), &cell, 1.0,
                   card.free_format};
        Cell one = cell;
        one.real = 1;
        if (c.real()) c.factor = working_value(deck, decoded, one);
        out.push_back(c);
      }
    }
  return out;
}

PageCard card_of(const Deck& deck, const InterBase& inter) {
  const Block& block = *inter.block;
  PageCard out{&deck.sources[inter.span.file],
               deck.sources.position(inter.span).line,
               {block.header},
               decode(deck, block),
               {}};
  std::vector<std::uint64_t> offsets{block.header_span.offset};
  LineCursor cursor(deck.sources, block);
  for (Line line = cursor.next_physical(); line.valid() && offsets.size() < most_lines;
       line = cursor.next_physical()) {
    out.lines.push_back(line.text);
    offsets.push_back(line.offset);
  }
  out.cells = editable_cells(deck, inter, out.decoded, offsets);
  return out;
}

struct PageValue {
  std::optional<Scalar> value;
  const char* origin = "";
  std::optional<Scalar> input;
};
LINE_RECORD(PageValue, "effective_value", "", COLUMN("value", "", r.value),
            COLUMN("origin", "", r.origin), COLUMN("input", "null: none", r.input));

struct PageInterface {
  const HtmlInput& in;
  const InterBase* inter;

  VerdictLevel level() const {
    for (const Tie& tie : in.scene->ties)
      if (tie.inter == inter) return level_of_tie(tie);
    return verdict_of_interface(*in.scene, *in.view, *inter).level;
  }
  Named<PageValue> values() const {
    return {[this](const auto& add) {
      const Contact* const contact = first_contact(*in.scene, *inter);
      for_each_field(*inter, [&](std::string_view name, const auto& e) {
        PageValue v{std::nullopt, to_string(e.origin), std::nullopt};
        if (e.origin != Origin::geometry)
          v.value = e.value;
        else if (contact != nullptr)
          v.value = geometry_value(*contact, name);
        if (e.has_input) v.input = e.input;
        add(name, v);
      });
    }};
  }
};
RECORD(PageInterface, "interface_meta", "", COLUMN("id", "", r.inter->id),
       COLUMN("type", "", r.inter->type), COLUMN("title", "", r.inter->title),
       COLUMN("level", "With the deck's settings", r.level()),
       COLUMN("card", "", card_of(*r.in.deck, *r.inter)), COLUMN("values", "", r.values()));

// ---- contacts ---------------------------------------------------------------------------------

struct PageSettings {
  CardSettings card;
  double edge_scale_gap = 0;
};
LINE_RECORD(PageSettings, "card_values",
            "What the card and the defaults say before the rules of the contact's kind apply.",
            COLUMN("Gapmin", "0: to be derived from the mesh", r.card.gapmin),
            COLUMN("Igap", "", r.card.igap), COLUMN("Inacti", "", r.card.inacti),
            COLUMN("Fscalegap", "", r.card.gap_scale), COLUMN("Gapmax", "", r.card.gapmax),
            COLUMN("Fpenmax", "", r.card.fpenmax), COLUMN("Edge_scale_gap", "", r.edge_scale_gap));

PageSettings settings_of(const InterBase& inter) {
  PageSettings out{card_settings(inter), 0.0};
  visit_interface(inter, [&](const auto& i) {
    if constexpr (requires { i.Edge_scale_gap; }) out.edge_scale_gap = i.Edge_scale_gap.value;
  });
  return out;
}

/// Thicknesses of one side: count, sum, smallest, largest; and its shortest side.
using Samples = std::tuple<std::size_t, double, double, double, double>;

struct PageContactRow {
  const HtmlInput& in;
  std::size_t index;
  const Contact& c;
  const PageContact& own;
  bool edges() const { return c.kind == ContactKind::edge_edge; }
  double longest(const std::vector<double>& lengths) const {
    return edges() || lengths.empty() ? 0.0 : *std::max_element(lengths.begin(), lengths.end());
  }
  std::vector<std::array<std::uint32_t, 2>> round_off() const {
    std::vector<std::array<std::uint32_t, 2>> out;
    for (const PenetrationRow& row : c.penetrations)
      if (!row.in_contact) out.push_back({row.secondary, row.main});
    return out;
  }
  Rows<Samples> default_gap() const {
    return {[this](const auto& add) {
      const auto side = [&](const ThicknessSamples& t, double shortest) {
        add({t.count, t.sum, t.smallest, t.largest, shortest});
      };
      const PlainSides& plain = own.plain;
      if (!edges()) return side(shell_thickness(*in.scene->model, c), plain.shortest_side);
      side(plain.main_side.thickness, plain.main_side.shortest);
      side(plain.secondary_side.thickness, plain.secondary_side.shortest);
    }};
  }
};
RECORD(PageContactRow, "contact_meta", "",
       COLUMN("interface", "Position", interface_position(*r.in.scene, r.c.inter)),
       COLUMN("kind", "", r.c.kind), COLUMN("role", "", r.c.role), COLUMN("type", "", r.c.type),
       COLUMN("ties", "Its pairs are tied: no penetrations", r.c.is_tied_contact()),
       COLUMN("dropped", "", r.c.dropped), COLUMN("igap", "", r.c.igap),
       COLUMN("inacti", "", r.c.inacti),
       COLUMN("evaluated", "false: whether anything penetrates is not known", r.c.evaluated),
       COLUMN("modern", "TYPE24, TYPE25", is_type24_or_25(r.c.type)),
       COLUMN("points", "A secondary edge stands for a point on it", !r.c.points.empty()),
       COLUMN("itied", "", r.c.itied), COLUMN("fpenmax", "", r.c.fpenmax),
       COLUMN("gap_scale", "", r.c.gap_scale), COLUMN("gapmin", "null: unbounded", r.c.gapmin),
       COLUMN("gapmin_from", "", to_string(r.c.gapmin_origin)), COLUMN("gapmax", "", r.c.gapmax),
       COLUMN("max_gap", "null: unbounded", r.c.max_gap),
       COLUMN("longest_main", "", r.longest(r.own.plain.main_length)),
       COLUMN("longest_node", "", r.longest(r.own.plain.secondary_length)),
       COLUMN("secondary", "", r.edges() ? r.c.secondary_edges.size() : r.c.secondary.size()),
       COLUMN("main", "", r.edges() ? r.c.main_edges.size() : r.c.main.size()),
       COLUMN("repaired", "", r.c.repaired_segments),
       COLUMN("degenerate", "", r.c.degenerate_segments),
       COLUMN("reoriented", "", r.c.reoriented_segments),
       COLUMN("no_carrier", "", r.c.no_carrier.size()),
       COLUMN("reach", "All pairs nearer than that are carried", r.own.reach),
       COLUMN("fixed", "Why the page tries no other settings; empty: it does", r.own.fixed),
       COLUMN("complete", "false: of too many penetrations only the deepest", r.own.complete),
       COLUMN("round_off", "Secondary and main of pairs that only the solver's round-off makes",
              r.round_off()),
       COLUMN("totals", "", r.in.view->contacts[r.index]),
       COLUMN("card", "", settings_of(*r.c.inter)),
       COLUMN("default",
              "Thicknesses that a default gap is formed of, of the main side, of edges also of the "
              "secondary: count, sum, smallest, largest (null: there is none), shortest side",
              r.default_gap()));

// ---- ties -------------------------------------------------------------------------------------

struct PageTie {
  std::size_t interface = 0, nodes = 0, tied = 0, lost = 0, beyond_rim = 0;
  double search_distance = 0, farthest = 0;
  std::string text = {}, losses = {};
  bool evaluated = true, stops = false;
};
LINE_RECORD(PageTie, "tie_meta", "A TYPE2 or TYPE10.", COLUMN("interface", "Position", r.interface),
            COLUMN("nodes", "", r.nodes), COLUMN("tied", "", r.tied),
            COLUMN("lost", "Not tied, and nothing else holds them", r.lost),
            COLUMN("beyond_rim", "Tied all the same", r.beyond_rim),
            COLUMN("search_distance", "0: each pair has its own", r.search_distance),
            COLUMN("farthest", "Distance of a node that is tied", r.farthest),
            COLUMN("text", "3 of 412 nodes are not tied", r.text),
            COLUMN("losses", "What becomes of the others", r.losses),
            COLUMN("evaluated", "", r.evaluated), COLUMN("stops", "The solver stops", r.stops));

PageTie page_tie(const Tie& tie, std::size_t interface) {
  const TieCounts n = count_ties(tie);
  PageTie out{interface, n.nodes, n.tied, n.lost(), n.outside, tie.search_distance};
  for (const TiedNode& node : tie.nodes)
    if (node.tied) out.farthest = std::max(out.farthest, node.distance);
  out.text = tie_count_text(tie);
  out.losses = losses_text(tie);
  out.evaluated = tie.not_evaluated.empty();
  out.stops = tie.main_and_tied.size() + (tie.ignore == 0 ? n.not_found : 0) > 0;
  return out;
}

PageTie page_tie(const Contact& c, const ContactTotals& t, std::size_t interface) {
  PageTie out{interface, c.secondary.size(), t.tied.nodes, t.untied, 0, c.gapmin};
  for (const PenetrationRow& row : c.penetrations)
    out.farthest = std::max(out.farthest, row.distance);
  out.text = fmt::format("{} tied", count(out.nodes, "node is", "nodes are"));
  out.losses = "-";
  if (t.untied > 0) {
    out.text = fmt::format("{} of {} {} not tied", t.untied, count(out.nodes, "node", "nodes"),
                           t.untied == 1 ? "is" : "are");
    out.losses = fmt::format("{} without a segment within the gap", t.untied);
  }
  if (!c.evaluated) out.text = "not evaluated";
  out.evaluated = c.evaluated;
  out.stops = t.solver_errors > 0;
  return out;
}

/// In the order of the block of ties: TYPE2 first.
std::vector<PageTie> page_ties(const HtmlInput& in) {
  const Scene& scene = *in.scene;
  std::vector<PageTie> out;
  for (const Tie& tie : scene.ties)
    out.push_back(page_tie(tie, scene.interfaces->ordered.size() + out.size()));
  for (std::size_t i = 0; i < scene.contacts.size(); ++i)
    if (const Contact& c = scene.contacts[i]; c.is_tied_contact())
      out.push_back(page_tie(c, in.view->contacts[i], interface_position(scene, c.inter)));
  return out;
}

// ---- an earlier run ---------------------------------------------------------------------------

/// Trends of the rows of an earlier run, under the present names of penetrations, so that the page
/// finds them by id.
std::vector<PageTrend> trends_in(const HtmlInput& in) {
  if (in.trends != nullptr) return *in.trends;
  std::vector<PageTrend> out;
  const GapsComparison compared = compare_gaps(*in.earlier, *in.scene, *in.view);
  for (const GapsComparison::Row& r : compared.rows) {
    const NamedPenetration& p = in.view->penetrations[r.penetration];
    const Contact& c = in.scene->contacts[p.contact];
    PageTrend t{c.inter->id, to_string(c.role), p.secondary, 0, 0, to_string(r.trend)};
    if (r.earlier != no_index) {
      t.depth = in.earlier->rows[r.earlier].depth;
      t.gap = in.earlier->rows[r.earlier].gap;
    }
    out.push_back(std::move(t));
  }
  for (const std::uint32_t i : compared.solved) {
    const GapBaseline::Row& r = in.earlier->rows[i];
    out.push_back({r.interface_id, r.role, r.secondary, r.depth, r.gap, "solved"});
  }
  return out;
}

struct PageEarlier {
  using Row = std::tuple<std::int64_t, std::string, std::int64_t, std::int64_t, double, double,
                         const char*>;
  const HtmlInput& in;
  std::vector<Row> rows() const {
    std::vector<Row> out;
    for (const PageTrend& t : trends_in(in)) {
      auto [a, b] = t.secondary;
      if (b != 0 && b < a) std::swap(a, b);
      out.emplace_back(t.interface_id, t.role, a, b, t.depth, t.gap, t.trend);
    }
    return out;
  }
};
LINE_RECORD(
    PageEarlier, "earlier", "With --compare: an earlier run.",
    COLUMN("path", "", r.in.earlier->path), COLUMN("deck", "", r.in.earlier->deck_path),
    COLUMN("same_depth", "Share of a depth below which a difference is none", double{same_depth}),
    COLUMN("rows",
           "Interface, role, node and 0 or the nodes of an edge (ascending), depth and gap then, "
           "what became of it: new, worse, better, same or solved",
           r.rows()));

// ---- the whole --------------------------------------------------------------------------------

/// Verb that writes the page.
const char* page_name(const HtmlInput& in) {
  return in.verb != nullptr      ? in.verb
         : in.effects != nullptr ? "cycle"
         : in.parts != nullptr   ? "parts"
                                 : "gaps";
}

/// First id above all node groups and sets, for exported groups.
std::int64_t free_group_id(const Deck& deck) {
  std::int64_t highest = 0;
  for (const Block& b : deck.blocks)
    if (b.header.starts_with("/GRNOD") || b.header.starts_with("/SET"))
      highest = std::max(highest, b.id.value + deck.offset_of(b, "grnod"));
  return highest + 1;
}

using Ways = std::tuple<std::string, std::string>;
Ways ways_to_say(PenetrationAction action) {
  return {action_words(action, 1), action_words(action, 2)};
}

struct PageMeta {
  const HtmlInput& in;
  const PageContacts& page;
  const std::vector<Touch>& touches;
  Coverage coverage = coverage_of(*in.deck, *in.scene->interfaces, in.scene->examined);
  const Model& model() const { return *in.scene->model; }
  std::uint64_t bytes() const {
    std::uint64_t sum = 0;
    for (std::uint32_t f = 0; f < in.deck->sources.size(); ++f)
      sum += in.deck->sources[f].on_disk().size();
    return sum;
  }
  Rows<std::string_view> files() const {
    return {[this](const auto& add) {
      for (std::uint32_t f = 0; f < in.deck->sources.size(); ++f) add(in.deck->sources[f].path());
    }};
  }
  PagePart part(const Part& p) const {
    return {&p, p.prop != no_index ? &model().properties[p.prop] : nullptr};
  }
  /// Contacts in the solver's order, then ties.
  Rows<PageInterface> interfaces() const {
    return {[this](const auto& add) {
      for (const InterBase* inter : in.scene->interfaces->ordered) add({in, inter});
      for (const Tie& tie : in.scene->ties) add({in, tie.inter});
    }};
  }
  Rows<PageContactRow> contacts() const {
    return {[this](const auto& add) {
      for (std::size_t i = 0; i < in.scene->contacts.size(); ++i)
        add({in, i, in.scene->contacts[i], page.contacts[i]});
    }};
  }
  static std::vector<std::int64_t> touch(const Touch& t) {
    std::vector<std::int64_t> out{t.secondary, t.main};
    out.insert(out.end(), t.interfaces.begin(), t.interfaces.end());
    return out;
  }
};
RECORD(PageMeta, "meta", "The block deck-meta. Positions count from 0.",
       COLUMN("page", "The verb that wrote it: gaps, cycle, parts, fix or diff", page_name(r.in)),
       COLUMN("deck", "", DeckRow{r.in.path, r.in.deck, &r.model(), r.in.scene->interfaces}),
       COLUMN("verdict", "", page_verdict(r.in)), COLUMN("summary", "", r.in.view->total),
       coverage_columns, COLUMN("bytes", "Of all files", r.bytes()),
       COLUMN("largest_gap", "Beyond it a gap is unbounded: shown as that word, left out of scales",
              r.in.view->largest_gap),
       COLUMN("files", "", r.files()),
       COLUMN("parts", "", rows_of(r.model().parts, [&r](const Part& p) { return r.part(p); })),
       COLUMN("free_group_id", "", free_group_id(*r.in.deck)),
       COLUMN("actions", "What the solver does, in words: about one pair, about several",
              ByWord<PenetrationAction, Ways>{ways_to_say}),
       COLUMN("what_if", "What the page was written with", rows_of(r.in.what_if)),
       COLUMN("interfaces", "", r.interfaces()), COLUMN("contacts", "", r.contacts()),
       COLUMN("ties", "", page_ties(r.in)),
       COLUMN("touches",
              "Parts with a near pair or a penetration: positions of secondary and main part (-1: "
              "none), then of the interfaces",
              rows_of(r.touches, PageMeta::touch)));

constexpr DocumentHead page_head{
    "deck/gaps-html", 1,
    "JSON blocks of the page that --html writes: the document is deck-meta, the other blocks are "
    "the definitions earlier, tie_lines, crossings, moved, first_cycle, repair and changes. A page "
    "may lack them. Lengths in working units. null stands for a number that is not finite; a "
    "sentence says so where that is usual.",
    false, "JSON in a page of deck"};

}  // namespace

std::string meta_json(const HtmlInput& in, const PageContacts& page,
                      const std::vector<Touch>& touches) {
  return write_document(page_head, PageMeta{in, page, touches});
}

std::string earlier_json(const HtmlInput& in) { return block_json(PageEarlier{in}); }

}  // namespace detail

DocumentSchema page_schema() {
  SchemaDefinitions definitions;
  record_form<detail::PageMeta>(definitions);
  record_form<detail::PageEarlier>(definitions);
  detail::block_forms(definitions);
  repair_form(definitions);
  changes_form(definitions);
  return document_schema(detail::page_head, definitions, "meta");
}

}  // namespace deck
