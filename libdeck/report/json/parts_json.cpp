// The document of deck parts: parts, totals, steps of elements and nodes, kinematic conditions.
#include <cmath>

#include "model/shared/kinematics.hpp"
#include "model/shared/mesh.hpp"
#include "report/parts_rows.hpp"
#include "report/shared/json.hpp"
#include "report/shared/parts.hpp"

namespace deck {
namespace {

void step(JsonWriter& json, double dt) {
  if (dt >= 1e29 || std::isnan(dt))
    json.null();
  else
    json.value(dt);
}

void number(JsonWriter& json, double v) {
  if (std::isnan(v))
    json.null();
  else
    json.value(v);
}

void write_figures(JsonWriter& json, const PartFigures& f) {
  json.key("mass");
  number(json, f.mass);
  const bool placed = f.mass > 0.0;
  json.key("centre");
  if (placed) {
    json.begin_array(true);
    for (const double v : f.centre) json.value(v);
    json.end_array();
  } else {
    json.null();
  }
  json.key("inertia");
  if (placed) {
    json.begin_array(true);
    for (const double v : f.inertia) json.value(v);
    json.end_array();
  } else {
    json.null();
  }
}

void write_step(JsonWriter& json, const Model& model, const PartFigures& f) {
  json.key("dt").begin_object(true).key("min");
  step(json, f.dt);
  json.key("element");
  if (f.slowest.element == no_index) {
    json.null();
  } else {
    json.begin_object(true).field("kind", detail::kind_name(f.slowest.kind));
    json.field("id", model.family(f.slowest.kind).id[f.slowest.element]).end_object();
  }
  json.field("not_computed", f.not_computed).end_object();
}

void write_parts(JsonWriter& json, const Model& model, const Mesh& mesh,
                 const detail::PartsView& view) {
  json.key("parts").begin_array();
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const Part& part = model.parts[p];
    const detail::PartView& seen = view.parts[p];
    json.begin_object();
    json.field("id", part.id).field("title", part.title);
    json.key("elements").begin_object(true);
    for (std::size_t k = 0; k < seen.elements.size(); ++k)
      if (seen.elements[k] > 0)
        json.field(detail::kind_name(static_cast<ElementKind>(k)), seen.elements[k]);
    json.end_object();
    json.field("material", part.mat_id).field("property", part.prop_id);
    json.field("thickness", seen.thickness);
    write_figures(json, mesh.parts[p]);
    write_step(json, model, mesh.parts[p]);
    json.key("interfaces").begin_array(true);
    for (const std::int64_t id : seen.interfaces) json.value(id);
    json.end_array();
    json.key("rigid_body");
    if (seen.rigid_body == 0)
      json.null();
    else
      json.value(seen.rigid_body);
    json.end_object();
  }
  json.end_array();
}

void write_all(JsonWriter& json, const Model& model, const Mesh& mesh) {
  json.key("elements").begin_array();
  for (std::size_t k = 0; k < mesh.elements.size(); ++k) {
    const auto kind = static_cast<ElementKind>(k);
    const Elements& family = model.family(kind);
    for (std::size_t e = 0; e < family.size(); ++e) {
      json.begin_object(true).field("kind", detail::kind_name(kind)).field("id", family.id[e]);
      json.key("dt");
      step(json, mesh.elements[k].dt[e]);
      json.end_object();
    }
  }
  json.end_array();
  json.key("nodes").begin_array();
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    json.begin_object(true).field("node", model.nodes.id[n]).key("dt");
    step(json, mesh.nodes.dt[n]);
    json.key("mass");
    number(json, mesh.nodes.mass[n]);
    json.key("stiffness");
    number(json, mesh.nodes.stiffness[n]);
    json.end_object();
  }
  json.end_array();
}

void write_kinematics(JsonWriter& json, const Model& model, const Kinematics& k) {
  json.key("kinematics").begin_object();
  json.key("conflicts");
  if (k.stops)
    json.null();
  else
    json.value(k.conflicts);
  json.key("nodes").begin_array();
  if (!k.stops)
    for (const NodeIndex n : k.several) {
      json.begin_object(true).field("node", model.node_id(n)).key("types").begin_array(true);
      for (std::size_t t = 0; t < condition_types; ++t)
        if ((k.types[n] >> t & 1) != 0) json.value(to_string(static_cast<ConditionType>(t)));
      json.end_array().end_object();
    }
  json.end_array().end_object();
}

}  // namespace

std::string parts_json(const LoadedDeck& loaded, bool all) {
  const Model& model = loaded.model();
  const Mesh& mesh = loaded.mesh();
  const Kinematics& kinematics = loaded.kinematics();
  const detail::PartsView view = detail::view_parts(loaded);
  std::string out;
  JsonWriter json(out);
  json.begin_object();
  write_json_head(json, "deck/parts", 1);
  write_json_deck(json, loaded.path(), loaded.deck(), &model, &loaded.interfaces());
  write_parts(json, model, mesh, view);
  json.key("total").begin_object();
  write_figures(json, mesh.total);
  write_step(json, model, mesh.total);
  json.end_object();
  json.key("unconnected").begin_object(true);
  json.field("nodes", view.unconnected_nodes).key("parts").begin_array(true);
  for (const std::int64_t id : view.empty_parts) json.value(id);
  json.end_array().key("unseen_parts").begin_array(true);
  for (const std::int64_t id : view.unseen_parts) json.value(id);
  json.end_array().end_object();
  json.key("repeated_contacts").begin_array();
  for (const detail::RepeatedContacts& c : view.repeated) {
    json.begin_object(true).key("interfaces").begin_array(true);
    for (const std::int64_t id : c.interfaces) json.value(id);
    json.end_array();
    json.field("pairs", c.pairs).key("parts").begin_array(true);
    json.value(c.part).value(c.other).end_array().end_object();
  }
  json.end_array();
  if (all) write_all(json, model, mesh);
  write_kinematics(json, model, kinematics);
  json.key("not_computed").begin_array();
  for (const auto* list : {&mesh.left_out, &kinematics.left_out})
    for (const LeftOut& l : *list) {
      json.begin_object(true).field("what", l.what).field("why", l.why);
      json.field("count", l.count).end_object();
    }
  json.end_array();
  json.end_object();
  return out;
}

}  // namespace deck
