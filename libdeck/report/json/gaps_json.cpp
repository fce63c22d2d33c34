// The document of `deck gaps --json`. Members of a pair are lengths, for edges as for nodes; what
// the solver stores of two edges, the square of the gap and what is left of it, is in "solver".
#include "deck/report/gaps.hpp"
#include "model/shared/item_spans.hpp"
#include "report/gaps_names.hpp"
#include "report/json/ties_json.hpp"
#include "report/shared/schemas.hpp"
#include "report/shared_records.hpp"
#include "verdict/shared/of_interface.hpp"

namespace deck {
namespace {

using Ids2 = std::array<std::int64_t, 2>;
using Ids4 = std::array<std::int64_t, 4>;
using Vector = std::array<double, 3>;

/// A row of the view, and the line of its secondary node.
struct PlacedRow {
  const NamedPenetration* named = nullptr;
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
  std::vector<PlacedRows> rows;  ///< of each contact in the solver's order, ties included
  const PlacedRows none;
};

/// Rows of each contact in the solver's order, penetrations and ties.
std::vector<PlacedRows> rows_of_contacts(const Scene& scene, const SceneView& view) {
  std::vector<PlacedRows> out(scene.contacts.size());
  for (std::size_t c = 0; c < scene.contacts.size(); ++c)
    out[c].resize(scene.contacts[c].penetrations.size());
  for (const auto* list : {&view.penetrations, &view.ties}) {
    const std::vector<Span> spans = detail::node_spans(*scene.model, first_nodes(scene, *list));
    for (std::size_t i = 0; i < list->size(); ++i) {
      const NamedPenetration& p = (*list)[i];
      out[p.contact][p.row] = {&p, spans[i]};
    }
  }
  return out;
}

/// A node, segment or edge of a side, with --all.
struct SideRow {
  std::optional<std::int64_t> node = {};
  std::optional<Ids4> nodes = {};
  std::optional<Ids2> edge = {};
  double stiffness = 0, gap = 0;
  std::optional<double> nodal_stiffness = {};
  std::optional<std::string_view> kind = {};
};
Record<SideRow> record_of(const SideRow*) {
  using Row = SideRow;
  static constexpr Column<Row> columns[] = {
      column("node", [](const Row& r) { return IfAny<std::int64_t>{r.node}; }),
      column("nodes", "Of a segment; triangles repeat the last",
             [](const Row& r) { return IfAny<Ids4>{r.nodes}; }),
      column("edge", [](const Row& r) { return IfAny<Ids2>{r.edge}; }),
      column<&SideRow::stiffness>("stiffness"),
      column<&SideRow::gap>("gap"),
      column("nodal_stiffness", "Istf 2 to 5",
             [](const Row& r) { return IfAny<double>{r.nodal_stiffness}; }),
      column("kind", "TYPE24 and TYPE25: solid, solid-flat, shell, shell-opposite, coat, ...",
             [](const Row& r) { return IfAny<std::string_view>{r.kind}; })};
  return {"side", "A secondary node, main segment or edge (with --all).", columns, true};
}

/// What the solver stores of two edges.
struct SquaredRow {
  double penetration = 0, gap = 0;
};
Record<SquaredRow> record_of(const SquaredRow*) {
  static constexpr Column<SquaredRow> columns[] = {
      column<&SquaredRow::penetration>("penetration", "Gap squared - distance"),
      column<&SquaredRow::gap>("gap", "Gap squared")};
  return {"squared", "What the solver stores of two edges.", columns, true};
}

struct PairRow {
  const GapsDocument& document;
  const Contact& contact;
  const PlacedRow* placed;
  const PenetrationRow* row;
  PairSides sides() const { return {document.scene.model, &contact, row->secondary, row->main}; }
};
Record<PairRow> record_of(const PairRow*) {
  using Row = PairRow;
  static constexpr Column<Row> columns[] = {
      column<&Row::sides, &PairSides::edge>("edge", "Secondary edge"),
      column<&Row::sides, &PairSides::main_edge>("main_edge"),
      column<&Row::sides, &PairSides::node>("node", "Secondary node"),
      column<&Row::sides, &PairSides::segment>("segment",
                                               "Main segment; triangles repeat the last node"),
      column<&PairRow::row, &PenetrationRow::depth>("penetration",
                                                    "Pair gap - distance, of edges as of nodes"),
      column<&PairRow::row, &PenetrationRow::gap>("gap", "The pair gap"),
      column<&PairRow::row, &PenetrationRow::distance>("distance"),
      column("solver",
             [](const Row& r) {
               const double squared = r.row->gap * r.row->gap;
               return if_any(r.sides().edges(), SquaredRow{squared - r.row->distance, squared});
             }),
      column("stored", "TYPE24 and TYPE25: the penetration that the solver keeps",
             [](const Row& r) { return if_any(is_modern(r.contact.type), r.row->p0); }),
      column("normal", "Unit vector from main to secondary; zeros on the surface",
             [](const Row& r) { return Vector(r.row->normal); }),
      column<&PairRow::row, &PenetrationRow::on_surface>("on_surface", "Exactly on the segment"),
      column<&PairRow::row, &PenetrationRow::in_contact>(
          "in_contact",
          "false (--accuracy robust): no nearer than its gap; only the round-off of the solver's "
          "formula makes it a penetration"),
      column<&PairRow::row, &PenetrationRow::action>("action", "What the solver does with it"),
      column("gap0", "Gap left by Inacti 5 or 6",
             [](const Row& r) { return known(r.row->has_gap0, r.row->gap0); }),
      column("p0", [](const Row& r) { return known(r.row->has_gap0, r.row->p0); }),
      column("moved_by", "Inacti 3",
             [](const Row& r) {
               return known(r.row->action == PenetrationAction::node_moved,
                            Vector(r.row->moved_by));
             }),
      column<&PairRow::placed, &PlacedRow::named, &NamedPenetration::at>(
          "at", "Secondary node, or closest point of the edge"),
      column("secondary_element",
             [](const Row& r) {
               const ElementName& e = r.placed->named->secondary_element;
               return known(e.valid(), e);
             }),
      column("main_element",
             [](const Row& r) {
               const ElementName& e = r.placed->named->main_element;
               return known(e.valid(), e);
             }),
      column("source", "The line of the secondary node",
             [](const Row& r) { return place_of(r.document.deck, r.placed->span); })};
  return {"penetration", "A pair that is nearer than its gap.", columns, true};
}

struct ThroughRow {
  const Model& model;
  const Contact &contact, &edges;
  const EdgeThroughSegment* through;
};
Record<ThroughRow> record_of(const ThroughRow*) {
  using Row = ThroughRow;
  static constexpr Column<Row> columns[] = {
      column("edge",
             [](const Row& r) {
               return node_ids(r.model, r.edges.main_edges[r.through->edge].nodes);
             }),
      column("segment",
             [](const Row& r) { return node_ids(r.model, r.contact.main[r.through->main].nodes); }),
      column<&ThroughRow::through, &EdgeThroughSegment::side>(
          "side", "1 to 4: from that corner of the segment to the next"),
      column<&ThroughRow::through, &EdgeThroughSegment::depth>("penetration")};
  return {"edge_through_segment", "An edge through a segment of a solid, beside one of its sides.",
          columns, true};
}

struct CrossingRow {
  const Scene& scene;
  const Crossing& crossing;
  ElementName edge, segment;
};
Record<CrossingRow> record_of(const CrossingRow*) {
  using Row = CrossingRow;
  using Id = std::optional<std::int64_t>;
  static constexpr Column<Row> columns[] = {
      column("edge", [](const Row& r) { return node_ids(*r.scene.model, r.crossing.edge); }),
      column("segment",
             [](const Row& r) {
               const Contact& c = r.scene.contacts[r.crossing.contact];
               return node_ids(*r.scene.model, c.main[r.crossing.main].nodes);
             }),
      column("edge_element", [](const Row& r) { return known(r.edge.valid(), r.edge.id); }),
      column("segment_element",
             [](const Row& r) { return known(r.segment.valid(), r.segment.id); }),
      column("parts", "Of edge and segment", [](const Row& r) {
        return std::array<Id, 2>{known(r.edge.valid(), r.edge.part),
                                 known(r.segment.valid(), r.segment.part)};
      })};
  return {"crossing",
          "An edge of a secondary element that passes through a main segment (with --crossings).",
          columns, true};
}

struct ContactRow {
  const GapsDocument& document;
  std::size_t index;     ///< in Scene::contacts
  const Contact* edges;  ///< TYPE24, TYPE25: the contact of its edges; nullptr: none
  const Contact& contact() const { return document.scene.contacts[index]; }
  const Model& model() const { return *document.scene.model; }
  bool modern() const { return is_modern(contact().type); }
  bool of_nodes() const { return contact().kind == ContactKind::node_segment; }

  Rows<PairRow> pairs(const Contact& c, const PlacedRows& rows) const {
    return rows_of(rows, [&document = document, &c](const PlacedRow& r) {
      return PairRow{document, c, &r, &c.penetrations[r.named->row]};
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
  for (const SecondaryNode& s : c.secondary)
    add({.node = r.model().node_id(s.node),
         .stiffness = s.multiplier,
         .gap = s.gap,
         .nodal_stiffness = known(!r.modern() && c.istf >= 2, s.nodal_stiffness)});
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
  for (std::size_t i = 0; r.edges != nullptr && i < r.edges->main_edges.size(); ++i) {
    SideRow row = r.side(r.edges->main_edges[i]);
    const int kind = r.edges->edge_kinds[i];
    row.kind = kind == 1 ? "solid" : kind == 2 ? "shell" : "solid-flat";
    add(row);
  }
}

Record<ContactRow> record_of(const ContactRow*) {
  using Row = ContactRow;
  static constexpr Column<Row> columns[] = {
      column<&ContactRow::contact, &Contact::kind>("kind"),
      column<&ContactRow::contact, &Contact::role>(
          "role", "primary: all of it but the contacts that TYPE19 adds"),
      column("igap", [](const Row& r) { return r.contact().igap == 0 ? 1000 : r.contact().igap; }),
      column<&ContactRow::contact, &Contact::gapmin>("gapmin"),
      column<&ContactRow::contact, &Contact::gapmax>("gapmax"),
      column<&ContactRow::contact, &Contact::drad>("drad"),
      column("gapmin_origin", "card or derived",
             [](const Row& r) {
               return r.contact().gapmin_origin == GapminOrigin::card ? "card" : "derived";
             }),
      column("gapmin_from", "How Gapmin was derived",
             [](const Row& r) { return to_string(r.contact().gapmin_origin); }),
      column<&ContactRow::contact, &Contact::inacti>("inacti"),
      column<&ContactRow::contact, &Contact::candidates>("candidates",
                                                         "Pairs within gap and margin"),
      column<&ContactRow::contact, &Contact::evaluated>(
          "evaluated",
          "false: too many pairs, or coordinates that are not numbers; whether anything penetrates "
          "is not known"),
      column("obstacle",
             "Why a contact with 0 penetrations is not reported as clean: empty_main, "
             "empty_secondary, no_gap, no_area, no_element or no_stiffness",
             [](const Row& r) {
               const Obstacle o = obstacle_of(r.contact());
               return known(o != Obstacle::none, to_string(o));
             }),
      column<&ContactRow::contact, &Contact::removed_pairs>("removed_pairs",
                                                            "Taken out by Irem_gap 2"),
      column<&ContactRow::contact, &Contact::max_gap>(
          "max_gap", "Largest pair gap that the solver's search expects"),
      column<&ContactRow::contact, &Contact::shortest_side>("shortest_main_side"),
      column("totals", [](const Row& r) { return r.document.view.contacts[r.index]; }),
      column("secondary", "With --all",
             [](const Row& r) {
               return if_any(r.document.all,
                             Rows<SideRow>{[&r](const auto& add) { each_secondary(r, add); }});
             }),
      column("main", "With --all",
             [](const Row& r) {
               return if_any(r.document.all,
                             Rows<SideRow>{[&r](const auto& add) { each_main(r, add); }});
             }),
      column("edges", "With --all: TYPE24 and TYPE25",
             [](const Row& r) {
               return if_any(r.document.all && r.modern(),
                             Rows<SideRow>{[&r](const auto& add) { each_modern_edge(r, add); }});
             }),
      column("penetrations", "Without ties",
             [](const Row& r) {
               const Contact& c = r.contact();
               return r.pairs(c, c.ties() ? r.document.none : r.document.rows[r.index]);
             }),
      column("tied_pairs", "TYPE10: the pairs that it ties; the solver lists them as penetrations",
             [](const Row& r) {
               const Contact& c = r.contact();
               return if_any(c.ties(), r.pairs(c, r.document.rows[r.index]));
             }),
      column("untied_nodes", "TYPE10: nodes that it does not tie",
             [](const Row& r) {
               const Contact& c = r.contact();
               std::vector<std::int64_t> ids;
               if (c.ties())
                 for (const std::uint32_t s : untied_secondary(c))
                   ids.push_back(r.model().node_id(c.secondary[s].node));
               return if_any(c.ties(), ids);
             }),
      column("edges_evaluated",
             "TYPE24 and TYPE25 with Iedge; false: with Igap 2, edges against faces of solids or "
             "points on edges were not evaluated",
             [](const Row& r) {
               return if_any(r.edges != nullptr, r.edges != nullptr && r.edges->evaluated);
             }),
      column("edge_totals", "TYPE25 with Iedge: of edge_penetrations",
             [](const Row& r) {
               return r.edges == nullptr
                          ? IfAny<ContactTotals>{}
                          : IfAny<ContactTotals>{r.document.view.contacts[r.index + 1]};
             }),
      column("edge_penetrations", "TYPE25 with Iedge",
             [](const Row& r) {
               return r.edges == nullptr
                          ? IfAny<Rows<PairRow>>{}
                          : IfAny<Rows<PairRow>>{r.pairs(*r.edges, r.document.rows[r.index + 1])};
             }),
      column("edge_solid_penetrations", "TYPE25 with Iedge of two digits",
             [](const Row& r) {
               return if_any(r.edges != nullptr, Rows<ThroughRow>{[&r](const auto& add) {
                               for (const auto& e : r.edges->edges_through_segments)
                                 add({r.model(), r.contact(), *r.edges, &e});
                             }});
             }),
      column("crossings", "With --crossings", [](const Row& r) {
        return if_any(
            r.document.crossings != nullptr, Rows<CrossingRow>{[&r](const auto& add) {
              const Scene& scene = r.document.scene;
              for (const Crossing& x : *r.document.crossings)
                if (x.contact == r.index)
                  add({scene, x, edge_element(*scene.model, x), segment_element(scene, x)});
            }});
      })};
  return {"contact", "", columns};
}

struct InterfaceRow {
  const GapsDocument& document;
  const InterBase* inter;
  InterfaceVerdict verdict;
};

void each_contact(const InterfaceRow& r, const std::function<void(const ContactRow&)>& add) {
  const std::vector<Contact>& contacts = r.document.scene.contacts;
  for (const ContactRole role : {ContactRole::primary, ContactRole::reversed, ContactRole::edges})
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const Contact& c = contacts[i];
      if (c.inter != r.inter || c.role != role || c.dropped) continue;
      // The edges of a TYPE24 or TYPE25 stand with its nodes.
      if (is_modern(c.type) && role == ContactRole::edges) continue;
      const bool with_edges =
          is_modern(c.type) && i + 1 < contacts.size() && contacts[i + 1].inter == r.inter;
      add({r.document, i, with_edges ? &contacts[i + 1] : nullptr});
    }
}

Record<InterfaceRow> record_of(const InterfaceRow*) {
  using Row = InterfaceRow;
  static constexpr Column<Row> columns[] = {
      column<&InterfaceRow::inter, &InterBase::id>("id"),
      column<&InterfaceRow::inter, &InterBase::type>("type", "7, 10, 11, 19, 24 or 25"),
      column<&InterfaceRow::inter, &InterBase::title>("title"),
      column("source", [](const Row& r) { return place_of(r.document.deck, r.inter->span); }),
      column<&InterfaceRow::verdict, &InterfaceVerdict::level>(
          "level",
          "What the verdict would be if the deck held this interface alone and had no other "
          "errors"),
      column<&InterfaceRow::verdict, &InterfaceVerdict::max_depth>("max_depth", "Of its contacts"),
      column<&InterfaceRow::verdict, &InterfaceVerdict::max_ratio>("max_ratio",
                                                                   "Of its contacts: depth to gap"),
      column("contacts", [](const Row& r) {
        return Rows<ContactRow>{[&r](const auto& add) { each_contact(r, add); }};
      })};
  return {"interface", "", columns};
}

Record<GapsDocument> record_of(const GapsDocument*) {
  using Row = GapsDocument;
  static constexpr Column<Row> columns[] = {
      column("deck",
             [](const Row& r) {
               return DeckRow{r.path, &r.deck, r.scene.model, r.scene.interfaces};
             }),
      column("verdict", [](const Row& r) { return verdict_of(r.deck, r.scene, r.view); }),
      column("summary", "Of all contacts", [](const Row& r) { return r.view.total; }),
      column("gate", "null: no bounds were given",
             [](const Row& r) { return gate_of(r.deck, r.gate); }),
      column("compared", "null: nothing was compared",
             [](const Row& r) { return comparison_of(r.scene, r.view, r.gate); }),
      column("examined", "Interfaces of TYPE2, 7, 10, 11, 19, 24 and 25",
             [](const Row& r) {
               return coverage_of(r.deck, *r.scene.interfaces, r.scene.examined).examined;
             }),
      column("not_examined", "Interfaces of other types, by keyword",
             [](const Row& r) {
               return rows_of(
                   coverage_of(r.deck, *r.scene.interfaces, r.scene.examined).not_examined);
             }),
      column("accuracy", [](const Row& r) { return DecisionsRow{&r.scene}; }),
      column("part_pairs", "Deepest first",
             [](const Row& r) { return rows_of(r.view.part_pairs); }),
      column("interfaces",
             [](const Row& r) {
               return rows_of(r.scene.interfaces->ordered, [&r](const InterBase* inter) {
                 return InterfaceRow{r, inter, verdict_of_interface(r.scene, r.view, *inter)};
               });
             }),
      column("ties", "Every /INTER/TYPE2", [](const Row& r) {
        return rows_of(r.scene.ties, [&r](const Tie& tie) {
          return TieRow{*r.scene.model, &tie, r.all};
        });
      })};
  return {"document", "", columns};
}

constexpr DocumentHead gaps_head{
    "deck/gaps", gaps_version,
    "Written by deck gaps --json; with --all also every secondary node, main segment and edge. "
    "Lengths in working units. null stands for a number that is not finite."};

}  // namespace

Record<PartPair> record_of(const PartPair*) {
  static constexpr Column<PartPair> columns[] = {
      column<&PartPair::secondary>("secondary", "Part id; 0: no part"),
      column<&PartPair::main>("main"),
      column<&PartPair::count, &ItemCounts::pairs>("pairs"),
      column<&PartPair::count, &ItemCounts::nodes>("nodes"),
      column<&PartPair::count, &ItemCounts::edges>("edges"),
      column<&PartPair::on_segment>("on_segment", "Those exactly on a segment"),
      column<&PartPair::max_depth>("max_depth"),
      column<&PartPair::mean_depth>("mean_depth"),
      column<&PartPair::p95_depth>("p95_depth"),
      column<&PartPair::max_ratio>("max_ratio", "Depth to gap")};
  return {"part_pair", "Penetrations between two parts.", columns, true};
}

DocumentSchema gaps_schema() { return document_schema<GapsDocument>(gaps_head); }

std::string gaps_json(std::string_view path, const Deck& deck, const Scene& scene,
                      const SceneView& view, bool all, const std::vector<Crossing>* crossings,
                      const GateReport* gate, const TextDrain& drain) {
  const GapsDocument document{
      path, deck, scene, view, all, crossings, gate, rows_of_contacts(scene, view), {}};
  return write_document(gaps_head, document, drain) + '\n';
}

}  // namespace deck
