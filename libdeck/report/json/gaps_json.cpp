// Documents of deck gaps: pairs, contacts, interfaces and ties of /INTER/TYPE2. Members of a pair
// are lengths, for edges too; "solver" has the squares that the solver stores of two edges: gap and
// remaining gap.

#include "contact/shared/reported.hpp"
#include "deck/report.hpp"
#include "model/shared/item_spans.hpp"
#include "report/shared_records.hpp"
#include "report/terminal/words.hpp"
#include "verdict/shared/of_interface.hpp"

namespace deck {

namespace {

using TieCorners = std::array<std::int64_t, 4>;

struct TiedNodeRow {
  const Model& model;
  const Tie& tie;
  const TiedNode* node;
  bool found() const { return node->segment != no_index; }
  TieCorners corners(std::uint32_t segment) const {
    return segment == no_index ? TieCorners{} : node_ids(model, tie.main[segment]);
  }
  double search() const { return node->search != 0 ? node->search : tie.search_distance; }
};

struct NearestRow {
  TieCorners segment{};
  double distance = 0;
};
LINE_RECORD(NearestRow, "nearest_segment", "", COLUMN("segment", "", r.segment),
            COLUMN("distance", "", r.distance));

LINE_RECORD(
    TiedNodeRow, "tied_node", "A secondary node of a tie.",
    COLUMN("node", "", r.model.nodes.id[r.node->node]), COLUMN("tied", "", r.node->tied),
    COLUMN("segment", "Node ids; triangles repeat the last",
           known(r.found(), r.corners(r.node->segment))),
    COLUMN("s",
           "Place on the segment, -1 to 1 within it; on triangles with Spotflag 27 the weight of "
           "the first corner",
           known(r.found(), r.node->s)),
    COLUMN("t", "", known(r.found(), r.node->t)),
    COLUMN("distance", "", known(r.found(), r.node->distance)),
    COLUMN("search", "How far the solver searches with this segment, or with the nearest one",
           known(r.search() != 0, r.search())),
    COLUMN("message", "Message of the solver that lists the node",
           known(r.node->message != 0, r.node->message)),
    COLUMN("penalty", "Tied by penalty", r.node->penalty),
    COLUMN("why", "A sentence", why_text(r.tie, *r.node)),
    COLUMN("nearest", "Without a segment: the nearest one",
           if_any(!r.found() && r.node->nearest != no_index,
                  NearestRow{r.corners(r.node->nearest), r.node->nearest_distance})));

void each_tied_node(const TieRow& r, const std::function<void(const TiedNodeRow&)>& add) {
  for (const TiedNode& n : r.tie->nodes)
    if (r.all || !n.tied || n.message != 0) add({r.model, *r.tie, &n});
}

}  // namespace

LINE_RECORD(RepeatedTies, "repeated_ties", "", COLUMN("interface", "", r.interface_id),
            COLUMN("nodes", "", r.count));

LINE_RECORD(TieCounts, "tie_counts", "", COLUMN("nodes", "", r.nodes), COLUMN("tied", "", r.tied),
            COLUMN("not_found", "No segment within reach", r.not_found),
            COLUMN("dropped", "A segment was found, and the node dropped", r.dropped),
            COLUMN("elsewhere", "Taken out because something else holds them", r.elsewhere),
            COLUMN("outside", "Tied from beyond the rim of their segment", r.outside));

RECORD(
    TieRow, "tie", "A TYPE2 at start-up.", COLUMN("id", "", r.tie->inter->id),
    COLUMN("type", "2", r.tie->inter->type), COLUMN("title", "", r.tie->inter->title),
    COLUMN("level", "As of an interface", level_of_tie(*r.tie)),
    COLUMN("search_distance", "null: every pair has its own, or there is none",
           known(r.tie->search_distance != 0, r.tie->search_distance)),
    COLUMN("not_evaluated", "Why no segments were searched; null: they were",
           known(!r.tie->not_evaluated.empty(), r.tie->not_evaluated)),
    COLUMN("nodes",
           "With --all every secondary node, else those that are not tied, or tied from beyond a "
           "rim",
           rows_from<each_tied_node>(r)),
    COLUMN("repeated", "Ties that an earlier interface makes already (message 1630)",
           r.tie->repeated),
    COLUMN("main_and_tied",
           "Main nodes in use that are tied themselves: the solver stops (message 556)",
           node_ids(r.model, r.tie->main_and_tied)),
    COLUMN("summary", "", count_ties(*r.tie)));

namespace {

using Ids2 = std::array<std::int64_t, 2>;
using Ids4 = std::array<std::int64_t, 4>;
using Vector = std::array<double, 3>;

/// A row of a contact with its names (none for rows that do not count), and the line of its node.
struct PlacedRow {
  const PenetrationRow* row = nullptr;
  const NamedPenetrations* list = nullptr;
  std::size_t place = 0;
  Span span;
};
using PlacedRows = std::vector<PlacedRow>;

/// The arguments of gaps_json().
struct GapsDocument {
  std::string_view path;
  const Deck& deck;
  const Scene& scene;
  const SceneView& view;
  bool all = false;
  const std::vector<Crossing>* crossings = nullptr;
  const GateReport* gate = nullptr;
  /// By contact in the solver's order, with ties; without edges through segments.
  std::vector<PlacedRows> rows;
  const PlacedRows none = {};
  Coverage coverage = coverage_of(deck, *scene.interfaces, scene.examined);
};

/// Rows by contact in the solver's order: penetrations and ties, then rows that do not count.
std::vector<PlacedRows> rows_of_contacts(const Scene& scene, const SceneView& view) {
  std::vector<PlacedRows> out(scene.contacts.size());
  for (std::size_t c = 0; c < scene.contacts.size(); ++c)
    out[c].resize(scene.contacts[c].penetrations.size());
  for (const auto* list : {&view.penetrations, &view.ties}) {
    const std::vector<Span> spans = detail::node_spans(*scene.model, first_nodes(scene, *list));
    for (std::size_t i = 0; i < list->size(); ++i) {
      const auto& p = list->places[i];
      out[p.contact][p.row] = {&scene.contacts[p.contact].penetrations[p.row], list, i, spans[i]};
    }
  }
  for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
    out[c].resize(out[c].size() - scene.contacts[c].edges_through_segments.size());
    for (const PenetrationRow& row : scene.contacts[c].uncounted)
      out[c].push_back({&row, nullptr, 0, {}});
  }
  return out;
}

/// A node, segment or edge of a side, for --all.
struct SideRow {
  std::optional<std::int64_t> node = {};
  std::optional<Ids4> nodes = {};
  std::optional<Ids2> edge = {};
  double stiffness = 0, gap = 0;
  std::optional<double> nodal_stiffness = {};
  std::optional<std::string_view> kind = {};
};
LINE_RECORD(SideRow, "side", "A secondary node, main segment or edge (with --all).",
            COLUMN("node", "", IfAny<std::int64_t>{r.node}),
            COLUMN("nodes", "Of a segment; triangles repeat the last", IfAny<Ids4>{r.nodes}),
            COLUMN("edge", "", IfAny<Ids2>{r.edge}), COLUMN("stiffness", "", r.stiffness),
            COLUMN("gap", "", r.gap),
            COLUMN("nodal_stiffness", "Istf 2 to 5", IfAny<double>{r.nodal_stiffness}),
            COLUMN("kind", "TYPE24 and TYPE25: solid, solid-flat, shell, shell-opposite, coat, ...",
                   IfAny<std::string_view>{r.kind}));

/// Squares that the solver stores of two edges.
struct SquaredRow {
  double penetration = 0, gap = 0;
};
LINE_RECORD(SquaredRow, "squared", "What the solver stores of two edges.",
            COLUMN("penetration", "Gap squared - distance", r.penetration),
            COLUMN("gap", "Gap squared", r.gap));

SquaredRow squared(const PenetrationRow& row) {
  return {row.gap * row.gap - row.distance, row.gap * row.gap};
}

std::optional<ElementName> if_valid(const ElementName& e) { return known(e.valid(), e); }

struct PairRow {
  const GapsDocument& document;
  const Contact& contact;
  const PlacedRow* placed;
  const PenetrationRow* row = placed->row;
  bool counted = placed->list != nullptr;
  NamedPenetration named = counted ? (*placed->list)[placed->place] : NamedPenetration();
  PairSides sides() const { return {document.scene.model, &contact, row->secondary, row->main}; }
  IfAny<std::string_view> place() const {
    return {contact.points.empty() ? std::nullopt
                                   : std::optional(contact.points[row->secondary].place)};
  }
};
LINE_RECORD(
    PairRow, "penetration", "A pair that is nearer than its gap.",
    COLUMN("edge", "Secondary edge", r.sides().edge()),
    COLUMN("main_edge", "", r.sides().main_edge()),
    COLUMN("place",
           "TYPE24: of the point on the edge, from its first node on: quarter, three-quarters; "
           "inner: within the segment at it",
           r.place()),
    COLUMN("node", "Secondary node", r.sides().node()),
    COLUMN("segment", "Main segment; triangles repeat the last node", r.sides().segment()),
    COLUMN("penetration", "Pair gap - distance, of edges as of nodes", r.row->depth),
    COLUMN("gap", "The pair gap", r.row->gap), COLUMN("distance", "", r.row->distance),
    COLUMN("solver", "", if_any(r.sides().edges() && !r.place().value, squared(*r.row))),
    COLUMN("counted",
           "TYPE25: false: found and kept by the solver, but in none of its numbers, nor in totals",
           if_any(r.contact.type == 25 && r.sides().edges(), r.counted)),
    COLUMN("stored", "TYPE24 and TYPE25: the penetration that the solver keeps",
           if_any(is_type24_or_25(r.contact.type), r.row->p0)),
    COLUMN("normal", "Unit vector from main to secondary; zeros on the surface",
           Vector(r.row->normal)),
    COLUMN("on_surface", "Exactly on the segment", r.row->on_surface),
    COLUMN("in_contact",
           "false (--accuracy robust): no nearer than its gap; only the round-off of the solver's "
           "formula makes it a penetration",
           r.row->in_contact),
    COLUMN("action", "What the solver does with it", r.row->action),
    COLUMN("gap0", "Gap left by Inacti 5 or 6", known(r.row->has_gap0, r.row->gap0)),
    COLUMN("p0", "Stored by Inacti 5 or 6", known(r.row->has_gap0, r.row->p0)),
    COLUMN("moved_by", "Inacti 3",
           known(r.row->action == PenetrationAction::node_moved, Vector(r.row->moved_by))),
    COLUMN("at", "Secondary node, or closest point of the edge; null: not counted",
           known(r.counted, r.named.at)),
    COLUMN("secondary_element", "", if_valid(r.named.secondary_element)),
    COLUMN("main_element", "", if_valid(r.named.main_element)),
    COLUMN("source", "The line of the secondary node", place_of(r.document.deck, r.placed->span)));

struct ThroughRow {
  const Model& model;
  const Contact &contact, &edges;
  const EdgeThroughSegment* through;
};
LINE_RECORD(ThroughRow, "edge_through_segment",
            "An edge through a segment of a solid, beside one of its sides.",
            COLUMN("edge", "", node_ids(r.model, r.edges.main_edges[r.through->edge].nodes)),
            COLUMN("segment", "", node_ids(r.model, r.contact.main[r.through->main].nodes)),
            COLUMN("side", "1 to 4: from that corner of the segment to the next", r.through->side),
            COLUMN("penetration", "", r.through->depth));

struct CrossingRow {
  const Scene& scene;
  const Crossing& crossing;
  ElementName edge, segment;
};
LINE_RECORD(CrossingRow, "crossing",
            "An edge of a secondary element that passes through a main segment (with --crossings).",
            COLUMN("edge", "", node_ids(*r.scene.model, r.crossing.edge)),
            COLUMN("segment", "",
                   node_ids(*r.scene.model,
                            r.scene.contacts[r.crossing.contact].main[r.crossing.main].nodes)),
            COLUMN("edge_element", "", known(r.edge.valid(), r.edge.id)),
            COLUMN("segment_element", "", known(r.segment.valid(), r.segment.id)),
            COLUMN("parts", "Of edge and segment",
                   std::array{known(r.edge.valid(), r.edge.part),
                              known(r.segment.valid(), r.segment.part)}));

struct ContactRow {
  const GapsDocument& document;
  std::size_t index;     ///< in Scene::contacts
  const Contact* edges;  ///< TYPE24, TYPE25: contact of the edges; nullptr: none
  const Contact& contact() const { return document.scene.contacts[index]; }
  const Model& model() const { return *document.scene.model; }
  bool modern() const { return is_type24_or_25(contact().type); }
  bool edges25() const { return edges != nullptr && contact().type == 25; }
  std::size_t next() const { return edges == nullptr ? index : index + 1; }
  bool ties() const { return contact().is_tied_contact(); }
  bool of_nodes() const { return contact().kind == ContactKind::node_segment; }
  std::vector<std::int64_t> untied_nodes() const {
    std::vector<std::int64_t> ids;
    if (ties())
      for (const std::uint32_t s : untied_secondary(contact()))
        ids.push_back(model().node_id(contact().secondary[s].node));
    return ids;
  }

  Rows<PairRow> pairs(const Contact& c, const PlacedRows& rows) const {
    return rows_of(rows, [&document = document, &c](const PlacedRow& r) {
      return PairRow{document, c, &r};
    });
  }
  SideRow side(const ContactEdge& e) const {
    return {.edge = node_ids(model(), e.nodes), .stiffness = e.stiffness, .gap = e.gap};
  }
};

void each_edge(const ContactRow& r, const std::vector<ContactEdge>& edges,
               const std::function<void(const SideRow&)>& add) {
  for (const ContactEdge& e : edges) add(r.side(e));
}

void each_secondary(const ContactRow& r, const std::function<void(const SideRow&)>& add) {
  const Contact& c = r.contact();
  if (!r.of_nodes()) return each_edge(r, c.secondary_edges, add);
  for (std::size_t i = 0; i < c.secondary.size(); ++i) {
    const SecondaryNode& s = c.secondary[i];
    SideRow row{.node = r.model().node_id(s.node), .stiffness = s.multiplier, .gap = s.gap};
    if (!c.nodal_stiffness.empty()) row.nodal_stiffness = c.nodal_stiffness[i];
    add(row);
  }
}

void each_main(const ContactRow& r, const std::function<void(const SideRow&)>& add) {
  const Contact& c = r.contact();
  if (!r.of_nodes()) return each_edge(r, c.main_edges, add);
  for (std::size_t i = 0; i < c.main.size(); ++i) {
    SideRow row{.nodes = node_ids(r.model(), c.main[i].nodes),
                .stiffness = c.main[i].stiffness,
                .gap = c.main[i].gap};
    if (r.modern()) row.kind = to_string(c.segment_kinds[i]);
    add(row);
  }
}

void each_modern_edge(const ContactRow& r, const std::function<void(const SideRow&)>& add) {
  for (std::size_t i = 0; r.edges != nullptr && i < r.edges->edge_kinds.size(); ++i) {
    SideRow row = r.side(r.edges->main_edges[i]);
    const int kind = r.edges->edge_kinds[i];
    row.kind = kind == 1 ? "solid" : kind == 2 ? "shell" : kind == 3 ? "line" : "solid-flat";
    add(row);
  }
}

void each_through(const ContactRow& r, const std::function<void(const ThroughRow&)>& add) {
  for (const EdgeThroughSegment& e : r.edges->edges_through_segments)
    add({r.model(), r.contact(), *r.edges, &e});
}

void each_crossing(const ContactRow& r, const std::function<void(const CrossingRow&)>& add) {
  const Scene& scene = r.document.scene;
  for (const Crossing& x : *r.document.crossings)
    if (x.contact == r.index)
      add({scene, x, edge_element(*scene.model, x), segment_element(scene, x)});
}

std::optional<std::string_view> obstacle_word(const Contact& c) {
  const NotCleanReason o = not_clean_reason(c);
  return o == NotCleanReason::none ? std::nullopt : std::optional<std::string_view>(to_string(o));
}

RECORD(
    ContactRow, "contact", "", COLUMN("kind", "", r.contact().kind),
    COLUMN("role", "primary: all of it but the contacts that TYPE19 adds", r.contact().role),
    COLUMN("igap", "", r.contact().igap == 0 ? 1000 : r.contact().igap),
    COLUMN("gapmin", "", r.contact().gapmin), COLUMN("gapmax", "", r.contact().gapmax),
    COLUMN("drad", "", r.contact().drad),
    COLUMN("gapmin_origin", "card or derived",
           r.contact().gapmin_origin == GapminOrigin::card ? "card" : "derived"),
    COLUMN("gapmin_from", "How Gapmin was derived", to_string(r.contact().gapmin_origin)),
    COLUMN("inacti", "", r.contact().inacti),
    COLUMN("candidates", "Pairs within gap and margin", r.contact().candidates),
    COLUMN(
        "evaluated",
        "false: too many pairs, or coordinates that are not numbers; whether anything penetrates "
        "is not known",
        r.contact().evaluated),
    COLUMN("obstacle",
           "Why a contact with 0 penetrations is not reported as clean: empty_main, "
           "empty_secondary, no_gap, no_area, no_element or no_stiffness",
           obstacle_word(r.contact())),
    COLUMN("removed_pairs", "Taken out by Irem_gap 2", r.contact().removed_pairs),
    COLUMN("max_gap", "Largest pair gap that the solver's search expects", r.contact().max_gap),
    COLUMN("shortest_main_side", "", r.contact().shortest_side),
    COLUMN("totals", "", r.document.view.contacts[r.index]),
    COLUMN("secondary", "With --all", if_any(r.document.all, rows_from<each_secondary>(r))),
    COLUMN("main", "With --all", if_any(r.document.all, rows_from<each_main>(r))),
    COLUMN("edges", "With --all: TYPE24 and TYPE25",
           if_any(r.modern() && r.document.all, rows_from<each_modern_edge>(r))),
    COLUMN("penetrations", "Without ties",
           r.pairs(r.contact(), r.ties() ? r.document.none : r.document.rows[r.index])),
    COLUMN("tied_pairs", "TYPE10: the pairs that it ties; the solver lists them as penetrations",
           if_any(r.ties(), r.pairs(r.contact(), r.document.rows[r.index]))),
    COLUMN("untied_nodes", "TYPE10: nodes that it does not tie",
           if_any(r.ties(), r.untied_nodes())),
    COLUMN("edges_evaluated",
           "TYPE24 and TYPE25 with Iedge; false: too many pairs, or with Igap 2 edges against "
           "faces of solids",
           if_any(r.edges != nullptr, r.edges != nullptr && r.edges->evaluated)),
    COLUMN("edge_totals",
           "TYPE24 and TYPE25 with Iedge: of the three lists that follow; its pairs are what the "
           "solver counts",
           if_any(r.edges != nullptr, r.document.view.contacts[r.next()])),
    COLUMN("edge_penetrations", "TYPE25 with Iedge",
           if_any(r.edges25(),
                  r.pairs(r.document.scene.contacts[r.next()], r.document.rows[r.next()]))),
    COLUMN("edge_solid_penetrations", "TYPE25 with Iedge of two digits",
           if_any(r.edges25(), rows_from<each_through>(r))),
    COLUMN("point_penetrations", "TYPE24 with Iedge",
           if_any(r.edges != nullptr && !r.edges25(),
                  r.pairs(r.document.scene.contacts[r.next()], r.document.rows[r.next()]))),
    COLUMN("crossings", "With --crossings",
           if_any(r.document.crossings != nullptr, rows_from<each_crossing>(r))));

struct InterfaceRow {
  const GapsDocument& document;
  const InterBase* inter;
  InterfaceVerdict verdict = verdict_of_interface(document.scene, document.view, *inter);
};

void each_gap_contact(const InterfaceRow& r, const std::function<void(const ContactRow&)>& add) {
  const std::vector<Contact>& contacts = r.document.scene.contacts;
  for (const ContactRole role : {ContactRole::primary, ContactRole::reversed, ContactRole::edges})
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const Contact& c = contacts[i];
      if (c.inter != r.inter || c.role != role || c.dropped) continue;
      // Edges of a TYPE24 or TYPE25 are listed with its nodes.
      if (is_type24_or_25(c.type) && role == ContactRole::edges) continue;
      const bool with_edges =
          is_type24_or_25(c.type) && i + 1 < contacts.size() && contacts[i + 1].inter == r.inter;
      add({r.document, i, with_edges ? &contacts[i + 1] : nullptr});
    }
}

RECORD(InterfaceRow, "interface", "", COLUMN("id", "", r.inter->id),
       COLUMN("type", "7, 10, 11, 19, 24 or 25", r.inter->type),
       COLUMN("title", "", r.inter->title),
       COLUMN("source", "", place_of(r.document.deck, r.inter->span)),
       COLUMN("level",
              "What the verdict would be if the deck held this interface alone and had no other "
              "errors",
              r.verdict.level),
       COLUMN("max_depth", "Of its contacts", r.verdict.max_depth),
       COLUMN("max_ratio", "Of its contacts: depth to gap", r.verdict.max_ratio),
       COLUMN("contacts", "", rows_from<each_gap_contact>(r)));

RECORD(GapsDocument, "document", "",
       COLUMN("deck", "", DeckRow{r.path, &r.deck, r.scene.model, r.scene.interfaces}),
       COLUMN("verdict", "", verdict_of(r.deck, r.scene, r.view)),
       COLUMN("summary", "Of all contacts", r.view.total),
       COLUMN("gate", "null: no bounds were given", gate_of(r.deck, r.gate)),
       COLUMN("compared", "null: nothing was compared", comparison_of(r.scene, r.view, r.gate)),
       coverage_columns, COLUMN("accuracy", "", DecisionsRow{&r.scene}),
       COLUMN("part_pairs", "Deepest first", rows_of(r.view.part_pairs)),
       COLUMN("interfaces", "", rows<InterfaceRow>(r.scene.interfaces->ordered, r)),
       COLUMN("ties", "Every /INTER/TYPE2", rows<TieRow>(r.scene.ties, *r.scene.model, r.all)));

constexpr DocumentHead gaps_head{
    "deck/gaps", gaps_version,
    "Written by deck gaps --json; with --all also every secondary node, main segment and edge. "
    "Lengths in working units. null stands for a number that is not finite."};

}  // namespace

LINE_RECORD(PartPair, "part_pair", "Penetrations between two parts.",
            COLUMN("secondary", "Part id; 0: no part", r.secondary), COLUMN("main", "", r.main),
            COLUMN("pairs", "", r.count.pairs), COLUMN("nodes", "", r.count.nodes),
            COLUMN("edges", "", r.count.edges),
            COLUMN("on_segment", "Those exactly on a segment", r.on_segment),
            COLUMN("max_depth", "", r.max_depth), COLUMN("mean_depth", "", r.mean_depth),
            COLUMN("p95_depth", "95 % of the pairs are not deeper", r.p95_depth),
            COLUMN("max_ratio", "Depth to gap", r.max_ratio));

DocumentSchema gaps_schema() { return document_schema<GapsDocument>(gaps_head); }

std::string gaps_json(std::string_view path, const Deck& deck, const Scene& scene,
                      const SceneView& view, bool all, const std::vector<Crossing>* crossings,
                      const GateReport* gate, const TextDrain& drain) {
  const GapsDocument document{path, deck,      scene, view,
                              all,  crossings, gate,  rows_of_contacts(scene, view)};
  return write_document(gaps_head, document, drain) + '\n';
}

}  // namespace deck
