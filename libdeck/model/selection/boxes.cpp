// /BOX: reading and the inside test, with coordinates before /TRANSFORM of node groups.
#include "model/selection/selection_impl.hpp"

#include "base/shared/vec.hpp"
#include "model/model_build.hpp"

namespace deck {

using detail::BoxVolume;
using detail::Definition;

namespace detail {
namespace {

/// Divides by the length without overflow. False: length 0.
bool normalise_vector(Vec& v) {
  const double n = length3(v.x, v.y, v.z);
  if (!(n > 0)) return false;
  v = {v.x / n, v.y / n, v.z / n};
  return true;
}

Vec in_axes(const std::array<Vec, 3>& axes, const Vec& p) {
  return {dot(axes[0], p), dot(axes[1], p), dot(axes[2], p)};
}

/// True if x is between the corners in any order; a flat box contains its plane exactly.
bool between(double x, double from, double to) {
  const double d = to - from;
  const double s = (x - from) * d;
  return d == 0 ? x == from : s >= 0 && s <= d * d;
}

}  // namespace

bool BoxVolume::contains(double x, double y, double z) const {
  const Vec point{x, y, z};
  switch (type) {
    case Type::none: {
      bool in = false;
      for (std::size_t i = 0; i < members.size(); ++i)
        if (members[i]->contains(x, y, z)) in = !subtracted[i];
      return in;
    }
    case Type::rectangle: {
      const Vec local = global ? point : in_axes(axes, point);
      return between(local.x, p.x, q.x) && between(local.y, p.y, q.y) && between(local.z, p.z, q.z);
    }
    case Type::cylinder: {
      const Vec axis = q - p, r = point - p;
      const double along = dot(r, axis), square = dot(axis, axis);
      if (along < 0 || along > square) return false;
      const Vec c = cross(r, axis);
      return dot(c, c) <= 0.25 * diameter * diameter * square;
    }
    case Type::sphere: {
      const Vec r = point - p;
      return dot(r, r) <= 0.25 * diameter * diameter;
    }
  }
  return false;
}

}  // namespace detail

std::array<double, 3> Selections::Impl::box_point(NodeIndex n) const {
  if (const Coordinates* c = model->before_transforms.get()) return {c->x[n], c->y[n], c->z[n]};
  const Nodes& nodes = model->nodes;
  return {nodes.x[n], nodes.y[n], nodes.z[n]};
}

detail::Indices Selections::Impl::nodes_in(const BoxVolume& box) const {
  detail::Indices out;
  for (NodeIndex n = 0; n < model->nodes.size(); ++n) {
    const auto [x, y, z] = box_point(n);
    if (box.contains(x, y, z)) out.push_back(n);
  }
  return out;
}

const BoxVolume* Selections::Impl::box(std::int64_t id, const Block& from, int missing_number) {
  if (definition("box", id) == nullptr) {
    // For node groups missing boxes are not an error.
    const bool goes_on = from.schema != nullptr && from.schema->kind == "grnod";
    report(
        from, RuleId::DK159,
        detail::name_of(from) + " refers to box " + std::to_string(id) + ", which does not exist",
        {.severity = goes_on ? Severity::warning : Severity::error,
         .message = goes_on ? 690 : missing_number,
         .solver = goes_on ? "It ignores the entry, and warns if the group becomes empty."
                           : "it stops with an error"});
    return nullptr;
  }
  return resolved(
      boxes, "box", id, 797,
      [&](const Definition& def, const DecodedBlock& d) {
        BoxVolume b;
        fill_box(b, def, d);
        return b;
      },
      [](const auto&, const Block&) { return BoxVolume(); });
}

std::optional<std::array<Vec, 3>> detail::skew_axes(const Model& model, const Block& skew,
                                                    const std::function<Vec(NodeIndex)>& place) {
  const Deck& deck = *model.deck;
  const DecodedBlock d = decode(deck, skew);
  Vec x, y, z;
  if (skew.schema->keyword == "/SKEW/FIX") {
    y = {d.real("X_Y"), d.real("Y_Y"), d.real("Z_Y")};
    z = {d.real("X_Z"), d.real("Y_Z"), d.real("Z_Z")};
    if (const std::int32_t s = skew.submodel;
        s >= 0 && static_cast<std::size_t>(s) < model.submodel_motions.size()) {
      const AffineMap& motion = model.submodel_motions[static_cast<std::size_t>(s)];
      y = to_vec(motion.turn({y.x, y.y, y.z}));
      z = to_vec(motion.turn({z.x, z.y, z.z}));
    }
    x = cross(y, z);
  } else if (skew.schema->keyword == "/SKEW/MOV") {
    std::array<Vec, 3> p;
    constexpr const char* names[3] = {"N1", "N2", "N3"};
    for (std::size_t i = 0; i < 3; ++i) {
      const NodeIndex n = model.find_node(deck.shifted_id(skew, "node", d.integer(names[i])));
      if (n == no_index) return std::nullopt;
      p[i] = place(n);
    }
    x = p[1] - p[0];
    z = cross(x, p[2] - p[0]);
    y = cross(z, x);
  }
  if (!normalise_vector(x) || !normalise_vector(y)) return std::nullopt;
  return std::array{x, y, cross(x, y)};
}

void Selections::Impl::report_box(const Block& block, std::string what, std::string help,
                                  int number) {
  report(block, RuleId::DK159, detail::name_of(block) + ": " + what,
         {.message = number, .solver = "it stops with an error", .fix = std::move(help)});
}

/// /BOX/BOX: union of boxes, minus others.
void Selections::Impl::collect_boxes(BoxVolume& b, const Block& block, const DecodedBlock& d) {
  const detail::IdList list = id_list(d);
  if (list.positive.empty() && list.negative.empty())
    report_box(block, "the list of boxes is empty", "list boxes or remove it", 801);
  for (const auto* refs : {&list.positive, &list.negative})
    for (const detail::IdRef& ref : *refs)
      if (const BoxVolume* member = box(ref.id, block, 795)) {
        b.members.push_back(member);
        b.subtracted.push_back(refs == &list.negative);
      }
}

void Selections::Impl::fill_box(BoxVolume& b, const Definition& def, const DecodedBlock& d) {
  const Block& block = *def.block;
  if (def.type == "BOX") return collect_boxes(b, block, d);
  const auto fail = [&](std::string what, std::string help, int number) {
    report_box(block, std::move(what), std::move(help), number);
  };
  const AffineMap motion = block.submodel >= 0 && static_cast<std::size_t>(block.submodel) <
                                                      model->submodel_motions.size()
                               ? model->submodel_motions[static_cast<std::size_t>(block.submodel)]
                               : AffineMap{};
  const auto value = [&](const char* name) { return working_value(deck(), d, name); };
  // A point from a node or coordinates.
  const auto point = [&](const char* node_field, const char* x, const char* y, const char* z,
                         bool use_node) -> Vec {
    if (use_node) {
      const std::int64_t id = deck().shifted_id(block, "node", d.integer(node_field));
      if (const NodeIndex n = node(id); n != no_index) return to_vec(box_point(n));
      fail("node " + std::to_string(id) + " does not exist", "correct the node id", 78);
      return {};
    }
    return to_vec(motion.apply({value(x), value(y), value(z)}));
  };
  const auto blank = [&](std::initializer_list<const char*> fields) {
    for (const char* f : fields)
      if (const Cell* cell = d.find(f); cell != nullptr && !cell->blank()) return false;
    return true;
  };
  const bool sphere = def.type == "SPHER";
  const bool nodes = d.integer("node_ID1") > 0 && (sphere || d.integer("node_ID2") > 0);
  b.diameter = value("Diam");
  b.p = point("node_ID1", "X1", "Y1", "Z1", nodes);
  if (!sphere) b.q = point("node_ID2", "X2", "Y2", "Z2", nodes);
  const bool undefined = !nodes && (sphere ? blank({"X1", "Y1", "Z1"}) && b.diameter == 0
                                           : blank({"X1", "Y1", "Z1", "X2", "Y2", "Z2"}));
  if (undefined) fail("its limits are not given", "give coordinates or nodes", 752);
  if (sphere) {
    b.type = BoxVolume::Type::sphere;
  } else if (def.type == "CYLIN") {
    b.type = BoxVolume::Type::cylinder;
  } else {
    b.type = BoxVolume::Type::rectangle;
    const std::int64_t skew = deck().shifted_id(block, "skew", d.integer("skew_ID"));
    if (skew != 0) {
      b.global = false;
      const Definition* const at = definition("skew", skew);
      const auto axes =
          at == nullptr ? std::nullopt : detail::skew_axes(*model, *at->block, [&](NodeIndex n) {
            return to_vec(box_point(n));
          });
      if (axes)
        b.axes = *axes;
      else
        fail("skew " + std::to_string(skew) + " does not exist or has no axes",
             "define the skew or use 0 for the global axes", 748);
    } else if (block.submodel >= 0) {
      // Without a skew a box rotates with its submodel.
      for (std::size_t k = 0; k < 3; ++k) {
        std::array<double, 3> axis{};
        axis[k] = 1;
        const std::array<double, 3> turned = motion.turn(axis);
        b.axes[k] = to_vec(turned);
        b.global = b.global && turned == axis;
      }
    }
    if (!b.global) {
      b.p = detail::in_axes(b.axes, b.p);
      b.q = detail::in_axes(b.axes, b.q);
    }
  }
}

}  // namespace deck
