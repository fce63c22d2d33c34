// `deck parts`: parts, totals, steps of elements and nodes, kinematic conditions as JSON, text and
// CSV.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/shared/words.hpp"
#include "deck/text.hpp"
#include "model/shared/kinematics.hpp"
#include "model/shared/mesh.hpp"
#include "report/shared/parts.hpp"
#include "report/shared_records.hpp"
#include "report/terminal/words.hpp"

namespace deck {

template <>
inline constexpr std::size_t word_count<ConditionType> = condition_types;

LINE_RECORD(LeftOut, "left_out", "Figures that are not computed.", COLUMN("what", "", r.what),
            COLUMN("why", "", r.why), COLUMN("count", "", r.count));

namespace detail {

LINE_RECORD(PartsView, "unconnected", "",
            COLUMN("nodes", "Nodes without an element", r.unconnected_nodes),
            COLUMN("parts", "Parts without elements", r.empty_parts),
            COLUMN("unseen_parts", "Parts that no contact and no tie sees", r.unseen_parts));

LINE_RECORD(RepeatedContacts, "repeated_contacts",
            "Contacts (no ties) that let the same parts touch.",
            COLUMN("interfaces", "Two or more", r.interfaces),
            COLUMN("pairs", "Of parts that all have", r.pairs),
            COLUMN("parts", "The first of these pairs", std::array{r.part, r.other}));

}  // namespace detail

namespace {

/// A step; empty without limit.
std::optional<double> step_of(double dt) { return known(dt < 1e29, dt); }

struct ElementRow {
  ElementKind kind;
  std::int64_t id;
  IfAny<std::optional<double>> dt = {};
};
LINE_RECORD(ElementRow, "element", "",
            COLUMN("kind", "shell4, shell3, solid, quad, tria, truss, beam or spring",
                   detail::kind_name(r.kind)),
            COLUMN("id", "", r.id),
            COLUMN("dt", "In 'elements'; null: limits nothing, or not computed", r.dt));

/// Sums of a part, or of all parts.
struct PartSums {
  const Model* model;
  const PartFigures* of;

  bool placed() const { return of->mass > 0.0; }
  std::optional<std::array<double, 3>> centre() const { return known(placed(), of->centre); }
  std::optional<std::array<double, 6>> inertia() const { return known(placed(), of->inertia); }
};

struct PartStepRow {
  PartSums sums;
};

std::optional<ElementRow> slowest_of(const PartSums& sums) {
  const ElementRef& e = sums.of->slowest;
  if (e.element == no_index) return std::nullopt;
  return ElementRow{e.kind, sums.model->family(e.kind).id[e.element]};
}

LINE_RECORD(PartStepRow, "step", "Smallest time step of elements.",
            COLUMN("min", "null: no element limits the step, or none is computed",
                   step_of(r.sums.of->dt)),
            COLUMN("element", "The element that gives it", slowest_of(r.sums)),
            COLUMN("not_computed", "Elements without an established step",
                   r.sums.of->not_computed));

RECORD(PartSums, "total", "All elements; members as of a part.", COLUMN("mass", "", r.of->mass),
       COLUMN("centre", "", r.centre()), COLUMN("inertia", "", r.inertia()),
       COLUMN("dt", "", PartStepRow{r}));

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
};
RECORD(PartOfDocument, "part", "", COLUMN("id", "", r.part->id), COLUMN("title", "", r.part->title),
       COLUMN("elements", "By kind", r.elements()), COLUMN("material", "", r.part->mat_id),
       COLUMN("property", "", r.part->prop_id), COLUMN("thickness", "", r.seen->thickness),
       COLUMN("mass", "null: not computed", r.sums.of->mass),
       COLUMN("centre", "null: no mass", r.sums.centre()),
       COLUMN("inertia",
              "About the centre: xx yy zz xy yz zx, of masses and rotational inertia of the nodes",
              r.sums.inertia()),
       COLUMN("dt", "", PartStepRow{r.sums}),
       COLUMN("interfaces", "Contacts and ties that have an element of the part",
              r.seen->interfaces),
       COLUMN("rigid_body", "The rigid body that has all nodes of the part",
              known(r.seen->rigid_body != 0, r.seen->rigid_body)));

struct PartNodeRow {
  std::int64_t node;
  std::optional<double> dt;
  double mass, stiffness;
};
LINE_RECORD(PartNodeRow, "node", "", COLUMN("node", "", r.node), COLUMN("dt", "", r.dt),
            COLUMN("mass", "", r.mass), COLUMN("stiffness", "", r.stiffness));

/// The node with the smallest time step; nullopt: none has one.
std::optional<PartNodeRow> slowest_node(const Model& model, const Mesh& mesh) {
  const auto& nodes = mesh.nodes;
  const auto at = std::min_element(nodes.dt.begin(), nodes.dt.end());
  if (at == nodes.dt.end() || !step_of(*at)) return std::nullopt;
  const auto n = static_cast<std::size_t>(at - nodes.dt.begin());
  return PartNodeRow{model.nodes.id[n], *at, nodes.mass[n], nodes.stiffness[n]};
}

struct HeldNode {
  std::int64_t node;
  std::vector<ConditionType> types;
};
LINE_RECORD(HeldNode, "held_node", "", COLUMN("node", "", r.node), COLUMN("types", "", r.types));

struct PartsDocument {
  const LoadedDeck& loaded;
  bool all;
  const Model& model;
  const Mesh& mesh;
  const Kinematics& kinematics;
  const detail::PartsView view;
};

void each_part(const PartsDocument& r, const std::function<void(const PartOfDocument&)>& add) {
  for (std::size_t p = 0; p < r.model.parts.size(); ++p)
    add({&r.model.parts[p], &r.view.parts[p], {&r.model, &r.mesh.parts[p]}});
}

void each_node(const PartsDocument& r, const std::function<void(const PartNodeRow&)>& add) {
  const auto& nodes = r.mesh.nodes;
  for (std::size_t n = 0; n < r.model.nodes.size(); ++n)
    add({r.model.nodes.id[n], step_of(nodes.dt[n]), nodes.mass[n], nodes.stiffness[n]});
}

void each_held_node(const PartsDocument& r, const std::function<void(const HeldNode&)>& add) {
  if (r.kinematics.stops) return;
  for (const NodeIndex n : r.kinematics.several) {
    HeldNode row{r.model.node_id(n), {}};
    for (std::size_t t = 0; t < condition_types; ++t)
      if ((r.kinematics.types[n] >> t & 1) != 0) row.types.push_back(static_cast<ConditionType>(t));
    add(row);
  }
}

void each_left_out(const PartsDocument& r, const std::function<void(const LeftOut&)>& add) {
  for (const auto* list : {&r.mesh.left_out, &r.kinematics.left_out})
    for (const LeftOut& left : *list) add(left);
}

void each_element(const PartsDocument& r, const std::function<void(const ElementRow&)>& add) {
  for (std::size_t k = 0; k < r.mesh.elements.size(); ++k) {
    const auto kind = static_cast<ElementKind>(k);
    const Elements& family = r.model.family(kind);
    for (std::size_t e = 0; e < family.size(); ++e)
      add({kind, family.id[e], {step_of(r.mesh.elements[k].dt[e])}});
  }
}

RECORD(PartsDocument, "document", "", COLUMN("deck", "", deck_row(r.loaded)),
       COLUMN("parts", "", rows_from<each_part>(r)),
       COLUMN("total", "", PartSums{&r.model, &r.mesh.total}),
       COLUMN("slowest_node", "With the smallest time step of all; null: none has one",
              slowest_node(r.model, r.mesh)),
       COLUMN("unconnected", "", r.view),
       COLUMN("repeated_contacts", "Not more than 1000", rows_of(r.view.repeated)),
       COLUMN("elements", "With --all", if_any(r.all, rows_from<each_element>(r))),
       COLUMN("nodes", "With --all", if_any(r.all, rows_from<each_node>(r))),
       OBJECT("kinematics", "Kinematic conditions.",
              COLUMN("conflicts", "The number of message 312; null: the solver stops before",
                     known(!r.kinematics.stops, r.kinematics.conflicts)),
              COLUMN("nodes", "Nodes with several conditions", rows_from<each_held_node>(r))),
       COLUMN("not_computed", "", rows_from<each_left_out>(r)));

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

// ---- for people --------------------------------------------------------------------------------

namespace {

std::string six_digits(double v) { return figure_text(v, 6); }

std::string known_number(double v) { return std::isnan(v) ? "?" : v == 0.0 ? "" : six_digits(v); }
std::string part_step(double dt) { return dt >= 1e29 ? "" : six_digits(dt); }

std::string elements_text(const detail::PartView& v) {
  std::string out;
  for (std::size_t k = 0; k < v.elements.size(); ++k)
    if (v.elements[k] > 0)
      append(out, ", ",
             fmt::format("{} {}", v.elements[k], detail::kind_name(static_cast<ElementKind>(k))));
  return out.empty() ? "none" : out;
}

std::string slowest_element(const Model& model, const PartFigures& f) {
  if (f.slowest.element == no_index) return "";
  return fmt::format("{} {}", detail::kind_name(f.slowest.kind),
                     model.family(f.slowest.kind).id[f.slowest.element]);
}

/// "Contacts 1 and 2 cover the same 3 pairs of parts, for example 4 and 5"
std::string repeated_text(const detail::RepeatedContacts& c) {
  return fmt::format("Contacts {} cover the same {} of parts{}{}\n",
                     c.interfaces.size() == 2
                         ? fmt::format("{} and {}", c.interfaces[0], c.interfaces[1])
                         : first_of(c.interfaces, 8),
                     count(c.pairs, "pair", "pairs"), c.pairs > 1 ? ", for example " : ": ",
                     c.part == c.other ? fmt::format("{} with itself", c.part)
                                       : fmt::format("{} and {}", c.part, c.other));
}

void summary(const LoadedDeck& loaded, const detail::PartsView& view, std::string& out) {
  const Model& model = loaded.model();
  const Mesh& mesh = loaded.mesh();
  const Kinematics& k = loaded.kinematics();
  const bool all =
      !loaded.incomplete() && std::none_of(mesh.parts.begin(), mesh.parts.end(),
                                           [](const PartFigures& p) { return std::isnan(p.mass); });
  out += fmt::format("\nMass of all elements{}: {}\n", all ? "" : " whose mass is known",
                     six_digits(mesh.total.mass));
  if (mesh.total.slowest.element != no_index)
    out += fmt::format("Smallest time step of an element: {} ({})\n", part_step(mesh.total.dt),
                       slowest_element(model, mesh.total));
  if (const auto node = slowest_node(model, mesh))
    out += fmt::format("Smallest time step of a node: {} (node {})\n", part_step(*node->dt),
                       node->node);
  if (view.unconnected_nodes > 0)
    out += count(view.unconnected_nodes, "node belongs", "nodes belong") + " to no element\n";
  if (!view.unseen_parts.empty())
    out += count(view.unseen_parts.size(), "part is", "parts are") +
           " in no contact and no tie: " + first_of(view.unseen_parts, 12) + "\n";
  constexpr std::size_t most_repeated = 5;
  for (std::size_t i = 0; i < std::min(most_repeated, view.repeated.size()); ++i)
    out += repeated_text(view.repeated[i]);
  if (view.repeated.size() > most_repeated)
    out += (view.repeated.size() < detail::most_repeated_contacts ? "" : "At least ") +
           count(view.repeated.size() - most_repeated, "more set", "more sets") +
           " of contacts that cover the same parts (--json lists them)\n";
  if (k.conflicts > 0)
    out += count(k.conflicts, "conflicting condition", "conflicting conditions") +
           " (counted per node and direction) on " + count(k.several.size(), "node", "nodes") +
           " (warning 312)\n";
  for (const auto* left : {&mesh.left_out, &k.left_out})
    for (const LeftOut& l : *left)
      out += fmt::format("Not computed: {} ({}): {}\n", l.what, l.count, l.why);
}

}  // namespace

std::string parts_text(const LoadedDeck& loaded, const PartsTextOptions& options) {
  const Model& model = loaded.model();
  const Mesh& mesh = loaded.mesh();
  const detail::PartsView view = detail::view_parts(loaded);
  TextTable table({">part", "~title", ">step", "=of element", ">mass", ">thickness", "=elements",
                   "interfaces", ">material", ">property", ">rigid body"});
  std::vector<std::size_t> order(model.parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  constexpr std::size_t most = 30;  // with the smallest steps
  const bool few = !options.all && order.size() > most;
  if (few) {
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return mesh.parts[a].dt < mesh.parts[b].dt;
    });
    order.resize(most);
  }
  for (const std::size_t p : order) {
    const Part& part = model.parts[p];
    const detail::PartView& v = view.parts[p];
    const PartFigures& f = mesh.parts[p];
    const bool slowest = f.slowest.element != no_index && f.dt == mesh.total.dt;
    table.row({part.id,
               part.title,
               {part_step(f.dt), slowest ? Tone::yellow : Tone::plain},
               slowest_element(model, f),
               known_number(f.mass),
               known_number(v.thickness),
               elements_text(v),
               first_of(v.interfaces, options.all ? v.interfaces.size() : 8),
               part.mat_id,
               part.prop_id,
               v.rigid_body == 0 ? "" : std::to_string(v.rigid_body)});
  }
  std::vector<std::string> left;
  std::string out = table.fitted(options.width, options.color, 0, 1, few ? &left : nullptr);
  if (few)
    out += fmt::format("… and {} parts more{}{} (--all, --csv)\n", model.parts.size() - most,
                       left.empty() ? "" : "; columns without room: ", fmt::join(left, ", "));
  summary(loaded, view, out);
  return out + "Units: " + units_text(loaded.deck().begin.working) + "\n";
}

std::string parts_csv(const LoadedDeck& loaded) {
  struct PartLine {
    const Part& part;
    const detail::PartView& v;
    const PartFigures& f;
  };
  const Model& model = loaded.model();
  const auto number = [](double x) { return std::isfinite(x) ? shortest(x) : std::string(); };
  const auto limits = [](const PartFigures& f) { return f.slowest.element != no_index; };
  const auto slowest_id = [&](const ElementRef& e) { return model.family(e.kind).id[e.element]; };
  CsvTable<PartLine> table(
      {}, CSV("part", r.part.id), CSV("title", r.part.title), CSV("elements", elements_text(r.v)),
      CSV("material", r.part.mat_id), CSV("property", r.part.prop_id),
      CSV("thickness", number(r.v.thickness)), CSV("mass", number(r.f.mass)),
      CSV("centre_x", number(r.f.centre[0])), CSV("centre_y", number(r.f.centre[1])),
      CSV("centre_z", number(r.f.centre[2])), CSV("inertia_xx", number(r.f.inertia[0])),
      CSV("inertia_yy", number(r.f.inertia[1])), CSV("inertia_zz", number(r.f.inertia[2])),
      CSV("inertia_xy", number(r.f.inertia[3])), CSV("inertia_yz", number(r.f.inertia[4])),
      CSV("inertia_zx", number(r.f.inertia[5])), CSV("dt", r.f.dt >= 1e29 ? "" : shortest(r.f.dt)),
      CSV("dt_kind", limits(r.f) ? detail::kind_name(r.f.slowest.kind) : ""),
      CSV("dt_element", limits(r.f) ? std::to_string(slowest_id(r.f.slowest)) : ""),
      CSV("interfaces", fmt::format("{}", fmt::join(r.v.interfaces, " "))),
      CSV("rigid_body", r.v.rigid_body == 0 ? "" : std::to_string(r.v.rigid_body)));
  const detail::PartsView view = detail::view_parts(loaded);
  for (std::size_t p = 0; p < model.parts.size(); ++p)
    table.add({model.parts[p], view.parts[p], loaded.mesh().parts[p]});
  return table.text();
}

}  // namespace deck
