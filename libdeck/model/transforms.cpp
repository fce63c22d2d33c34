// /TRANSFORM: each type is an affine map; submodel transforms act directly after the nodes are
// read, others on node groups after all groups are known. /RANDOM: noise on coordinates.
#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "base/shared/vec.hpp"
#include "deck/model.hpp"
#include "model/model_build.hpp"

namespace deck {

namespace {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;

Vector of(const std::array<double, 3>& v) { return Vector::Map(v.data()); }
Matrix matrix_of(const AffineMap& map) {
  return Eigen::Matrix<double, 3, 3, Eigen::RowMajor>::Map(map.matrix.data());
}
/// Column by column, so that each sum runs from x to z on every processor.
Vector product(const Matrix& m, const Vector& v) {
  return m.col(0) * v[0] + m.col(1) * v[1] + m.col(2) * v[2];
}

std::array<double, 3> plain(const Vector& v) { return {v[0], v[1], v[2]}; }

}  // namespace

std::array<double, 3> AffineMap::turn(const std::array<double, 3>& d) const {
  return plain(product(matrix_of(*this), of(d)));
}

std::array<double, 3> AffineMap::apply(const std::array<double, 3>& p) const {
  return plain(product(matrix_of(*this), of(p)) + of(shift));
}

namespace detail {
namespace {

AffineMap map_of(const Matrix& matrix, const Vector& shift) {
  AffineMap map;
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor>::Map(map.matrix.data()) = matrix;
  map.shift = plain(shift);
  return map;
}

/// Map with the given matrix and fixed point `centre`.
AffineMap about(const Matrix& matrix, const Vector& centre) {
  return map_of(matrix, centre - product(matrix, centre));
}

AffineMap then(const AffineMap& first, const AffineMap& second) {
  const Matrix a = matrix_of(first), b = matrix_of(second);
  Matrix both;
  for (int c = 0; c < 3; ++c) both.col(c) = product(b, a.col(c));
  return map_of(both, product(b, of(first.shift)) + of(second.shift));
}

/// Without overflow.
double length(const Vector& v) { return length3(v[0], v[1], v[2]); }
Vector unit(const Vector& v) { return v / length(v); }
Matrix square(const Vector& n) { return n * n.transpose(); }

/// Rotation by `angle` degrees about the axis through `p` along `direction`.
AffineMap rotation(const Vector& p, const Vector& direction, double angle) {
  const Vector n = unit(direction);
  const double radians = angle * std::numbers::pi / 180;
  const double s = std::sin(radians), c = std::cos(radians);
  Matrix across;  // n x v = across v
  across << 0, -n[2], n[1], n[2], 0, -n[0], -n[1], n[0], 0;
  return about(c * Matrix::Identity() + (1 - c) * square(n) + s * across, p);
}

/// Reflection at the plane through `p` normal to `direction`.
AffineMap reflection(const Vector& p, const Vector& direction) {
  const Vector n = unit(direction);
  return about(Matrix::Identity() - 2 * square(n), p);
}

class TransformReader {
 public:
  TransformReader(BuildContext& c, const Block& block)
      : c_(c), d_(decode(c.deck, block)), type_(type_of(block)) {}

  std::int64_t group() const { return c_.reference(d_, "GR_NODE", "grnod"); }
  std::int64_t submodel() const { return c_.reference(d_, "SUBMODEL", "submodel"); }
  const DecodedBlock& decoded() const { return d_; }

  /// nullopt: the card cannot be evaluated, with a finding.
  std::optional<AffineMap> map() {
    if (type_ == "TRA") return translation();
    if (type_ == "SCA") return scaling();
    if (type_ == "MATRIX") return matrix();
    if (type_ == "ROT" || type_ == "SYM") {
      const auto axis = two_points();
      if (!axis) return std::nullopt;
      if (!(length(axis->second) > 0))
        return fail("its two points coincide", {.message = 0, .fix = "give two different points"});
      return type_ == "ROT" ? rotation(axis->first, axis->second, d_.real("Angle"))
                            : reflection(axis->first, axis->second);
    }
    return not_evaluated(
        "transforms of this type are not evaluated",
        "write it as /TRANSFORM/MATRIX if the contacts of these nodes are to be checked");
  }

 private:
  static std::string_view type_of(const Block& block) {
    const auto fields = header_fields(block);
    return fields.size() > 1 ? fields[1] : std::string_view();
  }

  std::nullopt_t fail(const std::string& what, Overrides overrides) {
    report(c_.findings, finding_about(*d_.block, RuleId::DK110, name_of(*d_.block) + ": " + what,
                                      std::move(overrides)));
    return std::nullopt;
  }
  /// The solver evaluates this, deck does not.
  std::nullopt_t not_evaluated(const std::string& what, std::string help) {
    return fail(what + " here: the nodes keep their coordinates",
                {.severity = Severity::warning,
                 .message = 0,
                 .solver = "it applies the transform",
                 .fix = std::move(help)});
  }

  /// Coordinates of the node in field `name`; nullopt: missing, with a finding.
  std::optional<Vector> node(const char* name) {
    const std::int64_t id = c_.reference(d_, name, "node");
    const NodeIndex n = c_.model.nodes.map.find(id);
    if (n == no_index)
      return fail("node " + std::to_string(id) + " does not exist",
                  {.message = 694, .fix = "correct the node id"});
    const Nodes& nodes = c_.model.nodes;
    return Vector{nodes.x[n], nodes.y[n], nodes.z[n]};
  }

  Vector point(const char* x, const char* y, const char* z) const {
    return {c_.value(d_, x), c_.value(d_, y), c_.value(d_, z)};
  }

  bool has_nodes() const { return d_.integer("node_ID1") > 0 && d_.integer("node_ID2") > 0; }

  /// First point, and the vector to the second.
  std::optional<std::pair<Vector, Vector>> two_points() {
    if (!has_nodes()) {
      const Vector p = point("X1", "Y1", "Z1");
      return std::pair<Vector, Vector>{p, point("X2", "Y2", "Z2") - p};
    }
    const auto p = node("node_ID1");
    const auto q = node("node_ID2");
    if (!p || !q) return std::nullopt;
    return std::pair<Vector, Vector>{*p, *q - *p};
  }

  std::optional<AffineMap> translation() {
    AffineMap map;
    if (has_nodes()) {
      const auto points = two_points();
      if (!points) return std::nullopt;
      map.shift = plain(points->second);
      return map;
    }
    if (d_.integer("skew_ID") != 0)
      return not_evaluated("translations in a skew are not evaluated",
                           "give the translation in global axes");
    map.shift = plain(point("TX", "TY", "TZ"));
    return map;
  }

  std::optional<AffineMap> scaling() {
    Vector centre = Vector::Zero();
    if (d_.integer("node_ID1") > 0) {
      const auto p = node("node_ID1");
      if (!p) return std::nullopt;
      centre = *p;
    }
    const auto factor = [&](const char* name) {
      const double f = d_.real(name);
      return f == 0 ? 1 : f;
    };
    return about(Vector(factor("FX"), factor("FY"), factor("FZ")).asDiagonal(), centre);
  }

  std::optional<AffineMap> matrix() {
    AffineMap map;
    constexpr const char* names[9] = {"M11", "M12", "M13", "M21", "M22",
                                      "M23", "M31", "M32", "M33"};
    for (std::size_t i = 0; i < 9; ++i) map.matrix[i] = d_.real(names[i]);
    map.shift = plain(point("TX", "TY", "TZ"));
    return map;
  }

  BuildContext& c_;
  DecodedBlock d_;
  std::string_view type_;
};

void move_node(Nodes& nodes, NodeIndex n, const AffineMap& map) {
  const std::array<double, 3> p = map.apply({nodes.x[n], nodes.y[n], nodes.z[n]});
  nodes.x[n] = p[0];
  nodes.y[n] = p[1];
  nodes.z[n] = p[2];
}

/// True if `submodel` is `ancestor` or inside of it.
bool inside(const Deck& deck, std::int32_t submodel, std::int32_t ancestor) {
  for (; submodel >= 0; submodel = deck.submodels[static_cast<std::size_t>(submodel)].parent)
    if (submodel == ancestor) return true;
  return false;
}

std::int32_t find_submodel(const Deck& deck, std::int64_t id) {
  for (std::size_t i = 0; i < deck.submodels.size(); ++i)
    if (submodel_id(deck, deck.submodels[i]) == id) return static_cast<std::int32_t>(i);
  return -1;
}

void missing_target(BuildContext& c, const DecodedBlock& d, const std::string& what,
                    std::int64_t id) {
  const std::string that =
      id == 0 ? " names no " + what + " to move"
              : " moves " + what + " " + std::to_string(id) + ", which does not exist";
  report(c.findings, finding_about(*d.block, RuleId::DK110, name_of(*d.block) + that,
                                   {.fix = "correct the id"}));
}

void two_targets(BuildContext& c, const DecodedBlock& d) {
  const Cell* const cell = d.find("SUBMODEL");
  FindingDraft f = finding_about(*d.block, RuleId::DK062,
                                 name_of(*d.block) + " names node group " +
                                     std::to_string(d.integer("GR_NODE")) + " and submodel " +
                                     std::to_string(cell->integer));
  f.span = cell->span;
  report(c.findings, std::move(f));
}

}  // namespace

void apply_submodel_transforms(BuildContext& c) {
  c.model.submodel_motions.assign(c.deck.submodels.size(), {});
  for (const Block& block : c.deck.blocks) {
    if (!header_starts(block, "/TRANSFORM")) continue;
    TransformReader reader(c, block);
    const std::int64_t id = reader.submodel();
    if (id == 0) continue;
    if (reader.group() != 0) two_targets(c, reader.decoded());
    const std::int32_t target = find_submodel(c.deck, id);
    if (target < 0) {
      missing_target(c, reader.decoded(), "submodel", id);
      continue;
    }
    const auto map = reader.map();
    if (!map) continue;
    for (const BulkBlock& range : c.model.node_blocks)
      if (inside(c.deck, range.block->submodel, target))
        for (std::uint32_t n = range.first; n < range.first + range.count; ++n)
          move_node(c.model.nodes, n, *map);
    for (std::size_t s = 0; s < c.deck.submodels.size(); ++s)
      if (inside(c.deck, static_cast<std::int32_t>(s), target))
        c.model.submodel_motions[s] = then(c.model.submodel_motions[s], *map);
  }
}

void apply_group_transforms(BuildContext& c) {
  Model& m = c.model;
  for (const Block& block : c.deck.blocks) {
    if (!header_starts(block, "/TRANSFORM")) continue;
    TransformReader reader(c, block);
    if (reader.submodel() != 0) continue;
    if (!m.before_transforms)
      m.before_transforms =
          std::make_shared<Coordinates>(Coordinates{m.nodes.x, m.nodes.y, m.nodes.z});
    const NodeSet* group = m.selections->node_group(reader.group());
    if (group == nullptr) {
      missing_target(c, reader.decoded(), "node group", reader.group());
      continue;
    }
    const auto map = reader.map();
    if (!map) continue;
    for (const NodeIndex n : group->nodes) move_node(m.nodes, n, *map);
  }
}

/// Random generator, recovered from recorded coordinates: r' = (25173 r + 13849) mod 65536, r = 0
/// at first, one number per coordinate, in the order x y z of each node as read. The coordinate
/// moves by noise * (2 r / 65536 - 1).
void apply_random_noise(BuildContext& context) {
  Model& m = context.model;
  if (!m.has_random) return;
  std::uint32_t state = 0;
  const auto next = [&] {
    state = (25173 * state + 13849) % 65536;
    return m.random_noise * (2 * (state / 65536.0) - 1);
  };
  for (std::size_t n = 0; n < m.nodes.size(); ++n) {
    m.nodes.x[n] += next();
    m.nodes.y[n] += next();
    m.nodes.z[n] += next();
  }
}

}  // namespace detail
}  // namespace deck
