// The document of deck parts: parts, totals, steps of elements and nodes, kinematic conditions.
#include "model/shared/kinematics.hpp"
#include "model/shared/mesh.hpp"
#include "report/shared/parts.hpp"
#include "report/shared/schemas.hpp"
#include "report/shared_records.hpp"

namespace deck {

template <>
inline constexpr std::size_t word_count<ConditionType> = condition_types;

Record<LeftOut> record_of(const LeftOut*) {
  static constexpr Column<LeftOut> columns[] = {column<&LeftOut::what>("what"),
                                                column<&LeftOut::why>("why"),
                                                column<&LeftOut::count>("count")};
  return {"left_out", "Figures that are not computed.", columns, true};
}

namespace detail {

Record<PartsView> record_of(const PartsView*) {
  static constexpr Column<PartsView> columns[] = {
      column<&PartsView::unconnected_nodes>("nodes", "Nodes without an element"),
      column<&PartsView::empty_parts>("parts", "Parts without elements"),
      column<&PartsView::unseen_parts>("unseen_parts", "Parts that no contact and no tie sees")};
  return {"unconnected", "", columns, true};
}

}  // namespace detail

namespace {

/// A step that limits something.
std::optional<double> step_of(double dt) { return known(dt < 1e29, dt); }

struct ElementRow {
  ElementKind kind;
  std::int64_t id;
  IfAny<std::optional<double>> dt = {};
  std::string_view word() const { return detail::kind_name(kind); }
};
Record<ElementRow> record_of(const ElementRow*) {
  static constexpr Column<ElementRow> columns[] = {
      column<&ElementRow::word>("kind", "shell4, shell3, solid, quad, tria, truss, beam or spring"),
      column<&ElementRow::id>("id"),
      column<&ElementRow::dt>("dt", "In 'elements'; null: limits nothing, or not computed")};
  return {"element", "", columns, true};
}

/// What a part, or all of them, adds up to.
struct PartSums {
  const Model* model;
  const PartFigures* of;

  bool placed() const { return of->mass > 0.0; }
  std::optional<std::array<double, 3>> centre() const { return known(placed(), of->centre); }
  std::optional<std::array<double, 6>> inertia() const { return known(placed(), of->inertia); }
};

struct PartStepRow {
  PartSums sums;
  std::optional<double> min() const { return step_of(sums.of->dt); }
  std::optional<ElementRow> element() const {
    const ElementRef& e = sums.of->slowest;
    if (e.element == no_index) return std::nullopt;
    return ElementRow{e.kind, sums.model->family(e.kind).id[e.element]};
  }
};
Record<PartStepRow> record_of(const PartStepRow*) {
  static constexpr Column<PartStepRow> columns[] = {
      column<&PartStepRow::min>("min", "null: no element limits the step, or none is computed"),
      column<&PartStepRow::element>("element", "The element that gives it"),
      column<&PartStepRow::sums, &PartSums::of, &PartFigures::not_computed>(
          "not_computed", "Elements without an established step")};
  return {"step", "Smallest time step of elements.", columns, true};
}

Record<PartSums> record_of(const PartSums*) {
  using Row = PartSums;
  static constexpr Column<Row> columns[] = {
      column<&Row::of, &PartFigures::mass>("mass"), column<&Row::centre>("centre"),
      column<&Row::inertia>("inertia"), column("dt", [](const Row& r) { return PartStepRow{r}; })};
  return {"total", "All elements; members as of a part.", columns};
}

struct PartOfDocument {
  const Part* part;
  const detail::PartView* seen;
  PartSums sums;

  Counts elements() const {
    Counts counts;
    for (std::size_t k = 0; k < seen->elements.size(); ++k)
      if (seen->elements[k] > 0)
        counts.emplace_back(detail::kind_name(static_cast<ElementKind>(k)), seen->elements[k]);
    return counts;
  }
  std::optional<std::int64_t> rigid_body() const {
    return known(seen->rigid_body != 0, seen->rigid_body);
  }
};
Record<PartOfDocument> record_of(const PartOfDocument*) {
  using Row = PartOfDocument;
  static constexpr Column<Row> columns[] = {
      column<&Row::part, &Part::id>("id"),
      column<&Row::part, &Part::title>("title"),
      column<&Row::elements>("elements", "By kind"),
      column<&Row::part, &Part::mat_id>("material"),
      column<&Row::part, &Part::prop_id>("property"),
      column<&Row::seen, &detail::PartView::thickness>("thickness"),
      column<&Row::sums, &PartSums::of, &PartFigures::mass>("mass", "null: not computed"),
      column<&Row::sums, &PartSums::centre>("centre", "null: no mass"),
      column<&Row::sums, &PartSums::inertia>(
          "inertia",
          "About the centre: xx yy zz xy yz zx, of masses and rotational inertia of the nodes"),
      column("dt", [](const Row& r) { return PartStepRow{r.sums}; }),
      column<&Row::seen, &detail::PartView::interfaces>(
          "interfaces", "Contacts and ties that have an element of the part"),
      column<&Row::rigid_body>("rigid_body", "The rigid body that has all nodes of the part")};
  return {"part", "", columns};
}

struct RepeatedRow {
  const detail::RepeatedContacts* repeated;
  std::array<std::int64_t, 2> parts() const { return {repeated->part, repeated->other}; }
};
Record<RepeatedRow> record_of(const RepeatedRow*) {
  static constexpr Column<RepeatedRow> columns[] = {
      column<&RepeatedRow::repeated, &detail::RepeatedContacts::interfaces>("interfaces",
                                                                            "Two or more"),
      column<&RepeatedRow::repeated, &detail::RepeatedContacts::pairs>("pairs",
                                                                       "Of parts that all have"),
      column<&RepeatedRow::parts>("parts", "The first of these pairs")};
  return {"repeated_contacts", "Contacts (no ties) that let the same parts touch.", columns, true};
}

struct PartNodeRow {
  std::int64_t node;
  std::optional<double> dt;
  double mass, stiffness;
};
Record<PartNodeRow> record_of(const PartNodeRow*) {
  static constexpr Column<PartNodeRow> columns[] = {
      column<&PartNodeRow::node>("node"), column<&PartNodeRow::dt>("dt"),
      column<&PartNodeRow::mass>("mass"), column<&PartNodeRow::stiffness>("stiffness")};
  return {"node", "", columns, true};
}

struct HeldNode {
  std::int64_t node;
  std::vector<ConditionType> types;
};
Record<HeldNode> record_of(const HeldNode*) {
  static constexpr Column<HeldNode> columns[] = {column<&HeldNode::node>("node"),
                                                 column<&HeldNode::types>("types")};
  return {"held_node", "", columns, true};
}

struct PartsDocument {
  const LoadedDeck& loaded;
  bool all;
  const Model& model;
  const Mesh& mesh;
  const Kinematics& kinematics;
  const detail::PartsView view;

  PartOfDocument part(std::size_t p) const {
    return {&model.parts[p], &view.parts[p], {&model, &mesh.parts[p]}};
  }
  PartNodeRow node(std::size_t n) const {
    return {model.nodes.id[n], step_of(mesh.nodes.dt[n]), mesh.nodes.mass[n],
            mesh.nodes.stiffness[n]};
  }
  HeldNode held_node(NodeIndex n) const {
    HeldNode row{model.node_id(n), {}};
    for (std::size_t t = 0; t < condition_types; ++t)
      if ((kinematics.types[n] >> t & 1) != 0) row.types.push_back(static_cast<ConditionType>(t));
    return row;
  }
};

void each_element(const PartsDocument& r, const std::function<void(const ElementRow&)>& add) {
  for (std::size_t k = 0; k < r.mesh.elements.size(); ++k) {
    const auto kind = static_cast<ElementKind>(k);
    const Elements& family = r.model.family(kind);
    for (std::size_t e = 0; e < family.size(); ++e)
      add({kind, family.id[e], {step_of(r.mesh.elements[k].dt[e])}});
  }
}

Record<PartsDocument> record_of(const PartsDocument*) {
  using Row = PartsDocument;
  static constexpr Column<Row> of_kinematics[] = {
      column("conflicts", "The number of message 312; null: the solver stops before",
             [](const Row& r) { return known(!r.kinematics.stops, r.kinematics.conflicts); }),
      column("nodes", "Nodes with several conditions", [](const Row& r) {
        static const std::vector<NodeIndex> none;
        return rows_of(r.kinematics.stops ? none : r.kinematics.several,
                       [&r](NodeIndex n) { return r.held_node(n); });
      })};
  static constexpr Record<Row> kinematics{"kinematics", "Kinematic conditions.", of_kinematics};
  static constexpr Column<Row> columns[] = {
      column("deck", [](const Row& r) { return deck_row(r.loaded); }),
      column("parts",
             [](const Row& r) {
               return Rows<PartOfDocument>{[&r](const auto& add) {
                 for (std::size_t p = 0; p < r.model.parts.size(); ++p) add(r.part(p));
               }};
             }),
      column("total",
             [](const Row& r) {
               return PartSums{&r.model, &r.mesh.total};
             }),
      column<&Row::view>("unconnected"),
      column("repeated_contacts", "Not more than 1000",
             [](const Row& r) {
               return rows_of(r.view.repeated, [](const auto& c) { return RepeatedRow{&c}; });
             }),
      column("elements", "With --all",
             [](const Row& r) {
               return if_any(r.all,
                             Rows<ElementRow>{[&r](const auto& add) { each_element(r, add); }});
             }),
      column("nodes", "With --all",
             [](const Row& r) {
               return if_any(r.all, Rows<PartNodeRow>{[&r](const auto& add) {
                               for (std::size_t n = 0; n < r.model.nodes.size(); ++n)
                                 add(r.node(n));
                             }});
             }),
      group<kinematics>("kinematics"),
      column("not_computed", [](const Row& r) {
        std::vector<LeftOut> all = r.mesh.left_out;
        all.insert(all.end(), r.kinematics.left_out.begin(), r.kinematics.left_out.end());
        return rows_of(std::move(all));
      })};
  return {"document", "", columns};
}

constexpr DocumentHead parts_head{
    "deck/parts", 1,
    "Written by deck parts --json: parts with the sums of their elements, time steps and kinematic "
    "conditions, in working units."};

}  // namespace

DocumentSchema parts_schema() { return document_schema<PartsDocument>(parts_head); }

std::string parts_json(const LoadedDeck& loaded, bool all) {
  return write_document(parts_head, PartsDocument{loaded, all, loaded.model(), loaded.mesh(),
                                                  loaded.kinematics(), detail::view_parts(loaded)});
}

}  // namespace deck
