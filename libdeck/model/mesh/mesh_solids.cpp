// Time step, mass and stiffness of solids, thick shells and plane elements.
#include <algorithm>
#include <cmath>

#include "model/mesh/mesh_parts.hpp"

namespace deck::detail {
namespace {

using Corners = std::array<Vec, 8>;

constexpr int corner_signs[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                    {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

/// Volume by one central point.
double middle_volume(const Corners& x) {
  const Vec x17 = x[6] - x[0], x28 = x[7] - x[1], x35 = x[4] - x[2], x46 = x[5] - x[3];
  const Vec j1 = x17 + x46 - x28 - x35, j2 = x17 + x28 - x35 - x46, j3 = x17 + x28 + x35 + x46;
  return dot(j1, cross(j2, j3)) / 64.0;
}

/// Four times the area of a plane parallelogram face.
double face(const Vec& a, const Vec& b, const Vec& c, const Vec& d) {
  return 2.0 * norm(cross(c - a, d - b));
}

double over_faces(double volume, const std::array<double, 6>& faces, std::size_t count) {
  double largest = 0.0;
  for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, faces[i]);
  std::size_t small = 0;
  // The solver compares squares.
  for (std::size_t i = 0; i < count; ++i)
    small += faces[i] * faces[i] < 1e-4 * largest * largest ? 1u : 0u;
  return 4.0 * volume / largest * (small >= 3 && count == 6 ? 1000.0 : 1.0);
}

double hexa_length(const Corners& x, double volume) {
  static constexpr int corners[6][4] = {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                        {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  std::array<double, 6> faces{};
  for (std::size_t f = 0; f < 6; ++f) {
    const auto& c = corners[f];
    faces[f] = face(x[static_cast<std::size_t>(c[0])], x[static_cast<std::size_t>(c[1])],
                    x[static_cast<std::size_t>(c[2])], x[static_cast<std::size_t>(c[3])]);
  }
  return over_faces(volume, faces, 6);
}

/// dx/dxi at a point of the cube from -1 to 1, as columns.
std::array<Vec, 3> slopes(const Corners& x, const std::array<double, 3>& at) {
  std::array<Vec, 3> out{};
  for (std::size_t n = 0; n < 8; ++n) {
    const auto& s = corner_signs[n];
    const std::array<double, 3> f{1.0 + s[0] * at[0], 1.0 + s[1] * at[1], 1.0 + s[2] * at[2]};
    out[0] = out[0] + (0.125 * s[0] * f[1] * f[2]) * x[n];
    out[1] = out[1] + (0.125 * s[1] * f[0] * f[2]) * x[n];
    out[2] = out[2] + (0.125 * s[2] * f[0] * f[1]) * x[n];
  }
  return out;
}

struct Gauss {
  std::array<double, 9> at{}, weight{};
  std::size_t count = 0;
};

Gauss gauss(int points) {
  const double a = 1.0 / std::sqrt(3.0);
  switch (points) {
    case 1:
      return {{0.0}, {2.0}, 1};
    case 2:
      return {{-a, a}, {1.0, 1.0}, 2};
    case 3:
      return {{-0.774596669241483, 0.0, 0.774596669241483}, {5.0 / 9, 8.0 / 9, 5.0 / 9}, 3};
    case 4:
      return {{-0.861136311594053, -0.339981043584856, 0.339981043584856, 0.861136311594053},
              {0.347854845137454, 0.652145154862546, 0.652145154862546, 0.347854845137454},
              4};
    case 5:
      return {{-0.906179845938664, -0.538469310105683, 0.0, 0.538469310105683, 0.906179845938664},
              {0.236926885056189, 0.478628670499366, 0.568888888888889, 0.478628670499366,
               0.236926885056189},
              5};
    default:
      return {};
  }
}

struct ManyPoints {
  double length = not_known, volume = 0;
  std::array<double, 8> share{};  ///< volume around each corner, by shape functions
};

ManyPoints many_points(const Corners& x, const std::array<Gauss, 3>& rule) {
  ManyPoints out;
  const std::array<Vec, 3> centre = slopes(x, {0, 0, 0});
  const double s =
      64.0 * std::max({norm(cross(centre[0], centre[1])), norm(cross(centre[1], centre[2])),
                       norm(cross(centre[2], centre[0]))});
  double least = 1e300;
  for (std::size_t i = 0; i < rule[0].count; ++i)
    for (std::size_t j = 0; j < rule[1].count; ++j)
      for (std::size_t k = 0; k < rule[2].count; ++k) {
        const std::array<double, 3> at{rule[0].at[i], rule[1].at[j], rule[2].at[k]};
        const std::array<Vec, 3> d = slopes(x, at);
        const double jacobian = dot(d[0], cross(d[1], d[2]));
        least = std::min(least, jacobian);
        const double part = jacobian * rule[0].weight[i] * rule[1].weight[j] * rule[2].weight[k];
        out.volume += part;
        for (std::size_t n = 0; n < 8; ++n) {
          const auto& sign = corner_signs[n];
          out.share[n] +=
              0.125 * (1 + sign[0] * at[0]) * (1 + sign[1] * at[1]) * (1 + sign[2] * at[2]) * part;
        }
      }
  if (rule[0].count > 0 && rule[1].count > 0 && rule[2].count > 0) out.length = 128.0 * least / s;
  return out;
}

bool thick_shell(const PropertyFigures& p) { return p.type >= 20 && p.type <= 22; }

void hexa(const PartRow& row, const Corners& x, ElementOutcome& out) {
  const PropertyFigures& p = row.property;
  const double middle = middle_volume(x);
  double volume = middle;
  out.share.fill(0.125);
  const Gauss two = gauss(2);
  std::array<Gauss, 3> rule{two, two, two};
  const int law = row.material.law;
  bool many = false;
  if (thick_shell(p)) {
    if (p.isolid == 14) {
      many = true;
      // Layers are between the faces 1234 and 5678.
      rule[2] = gauss(p.inpts % 10 == 2 ? p.inpts / 10 % 10 : -1);
      if (p.icstr != 10) rule[2].count = 0;
      if (p.inpts == 0 || p.inpts == 222 || law == 1) rule[2] = two;
    } else if (p.isolid != 15) {
      out.why = "this formulation of thick shells is not evaluated";
    }
  } else if (p.isolid == 12 || p.isolid == 17) {
    many = true;
  } else if (p.isolid == 18) {
    many = true;
    if (law != 1 && law != 2 && law != 42) rule[0].count = 0;
  } else if (p.isolid == 14) {
    many = true;
    if (law != 1 && p.inpts == 333)
      rule = {gauss(3), gauss(3), gauss(3)};
    else if (law != 1 && p.inpts != 222 && p.inpts != 0)
      rule[0].count = 0;
  } else if (p.isolid != 0 && p.isolid != 1 && p.isolid != 2 && p.isolid != 24) {
    out.why = "this formulation of solids is not evaluated";
  }
  if (many) {
    const ManyPoints points = many_points(x, rule);
    out.length = points.length;
    if (rule[0].count == 0 || rule[2].count == 0) {
      out.why = "these integration points are not evaluated";
      volume = many_points(x, {two, two, two}).volume;  // independent of the number of points
    } else {
      volume = points.volume;
      if (p.isolid == 12 && !thick_shell(p))
        for (std::size_t n = 0; n < 8; ++n) out.share[n] = points.share[n] / volume;
    }
  } else {
    out.length = hexa_length(x, middle);
  }
  out.mass = row.material.density * volume;
  if (out.why != nullptr) out.length = not_known;
  out.dt = bulk_step(row, out.length, std::cbrt(std::abs(middle)));
  out.stiffness = 0.25 * out.mass / (out.dt * out.dt);
}

/// Volume and length of a solid with six nodes, in its local axes.
void penta(const PartRow& row, const Corners& slots, ElementOutcome& out) {
  // Slots are n1 n2 n3 n1 n4 n5 n6 n4.
  std::array<Vec, 6> x{slots[0], slots[1], slots[2], slots[4], slots[5], slots[6]};
  const Vec t = x[1] + x[4] - x[0] - x[3], u = x[2] + x[5] - x[0] - x[3];
  const Vec e3 = unit(cross(t, u)), e1 = unit(norm(u) * t + norm(t) * cross(u, e3)),
            e2 = cross(e3, e1);
  Vec middle{};
  for (const Vec& p : x) middle = middle + (1.0 / 6.0) * p;
  for (Vec& p : x) {
    const Vec d = p - middle;
    p = {dot(d, e1), dot(d, e2), dot(d, e3)};
  }
  const Vec a = x[1] - x[0] + x[4] - x[3], b = x[2] - x[0] + x[5] - x[3],
            c = (1.0 / 3.0) * (x[3] - x[0] + x[4] - x[1] + x[5] - x[2]);
  const double volume = dot(a, cross(b, c)) / 8.0;
  Vec five = x[4], four = x[3];
  std::swap(five.y, four.y);
  const double first = face(x[0], x[1], five, four);
  std::array<double, 6> faces{first,
                              face(x[1], x[4], x[5], x[2]),
                              face(x[0], x[3], x[5], x[2]),
                              face(x[0], x[1], x[2], x[2]),
                              face(x[3], x[4], x[5], x[5]),
                              0};
  out.length = over_faces(volume, faces, 5);
  out.mass = row.material.density * volume;
  out.share = {1.0 / 6, 1.0 / 6, 1.0 / 6, 0, 1.0 / 6, 1.0 / 6, 1.0 / 6, 0};
  if (!thick_shell(row.property) && first >= *std::max_element(faces.begin(), faces.end())) {
    out.why = "the first face of a solid with six nodes governs";
    out.length = not_known;
  }
  out.dt = bulk_step(row, out.length, std::cbrt(std::abs(volume)));
  out.stiffness = 0.25 * out.mass / (out.dt * out.dt);
}

struct Tetra {
  std::array<Vec, 4> corner;
  double volume = 0, largest_face = 0;
  std::array<Vec, 4> gradient{};

  explicit Tetra(const Corners& x) : corner{x[0], x[2], x[5], x[4]} {
    const Vec a = corner[1] - corner[0], b = corner[2] - corner[0], c = corner[3] - corner[0];
    const double six = dot(a, cross(b, c));
    volume = std::abs(six) / 6.0;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec &p = corner[(i + 1) % 4], &q = corner[(i + 2) % 4], &r = corner[(i + 3) % 4];
      const Vec n = cross(q - p, r - p);
      largest_face = std::max(largest_face, 0.5 * norm(n));
      const double height = dot(corner[i] - p, n);
      gradient[i] = (1.0 / height) * n;
    }
  }
};

struct Quadratic {
  double volume = 0;
  std::array<double, 4> point{};  ///< volume of each point
  double corner = 0, middle = 0;
};

/// Four points of a tetrahedron with mid-side nodes.
Quadratic quadratic(const Tetra& t, const std::array<Vec, 6>& middle) {
  static constexpr std::size_t ends[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  std::array<Vec, 10> x{};
  for (std::size_t i = 0; i < 4; ++i) x[i] = t.corner[i];
  for (std::size_t i = 0; i < 6; ++i) x[4 + i] = middle[i];
  std::array<double, 10> u{};
  Quadratic out;
  for (std::size_t p = 0; p < 4; ++p) {
    std::array<double, 4> l{0.1381966, 0.1381966, 0.1381966, 0.1381966};
    l[p] = 0.5854102;
    // Derivatives of the ten functions by the first three barycentric coordinates.
    std::array<std::array<double, 3>, 10> d{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto by = [&](std::size_t c) { return c == k ? 1.0 : c == 3 ? -1.0 : 0.0; };
      for (std::size_t c = 0; c < 4; ++c) d[c][k] = (4.0 * l[c] - 1.0) * by(c);
      for (std::size_t m = 0; m < 6; ++m)
        d[4 + m][k] = 4.0 * (by(ends[m][0]) * l[ends[m][1]] + l[ends[m][0]] * by(ends[m][1]));
    }
    std::array<Vec, 3> j{};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t n = 0; n < 10; ++n) j[k] = j[k] + d[n][k] * x[n];
    const double det = dot(j[0], cross(j[1], j[2]));
    const double v = std::abs(det) / 6.0 * 0.25;
    const std::array<Vec, 3> inverse{(1.0 / det) * cross(j[1], j[2]),
                                     (1.0 / det) * cross(j[2], j[0]),
                                     (1.0 / det) * cross(j[0], j[1])};
    out.volume += v;
    out.point[p] = v;
    for (std::size_t n = 0; n < 10; ++n) {
      const Vec g = d[n][0] * inverse[0] + d[n][1] * inverse[1] + d[n][2] * inverse[2];
      u[n] += dot(g, g) * v;
    }
  }
  for (std::size_t n = 0; n < 4; ++n) out.corner = std::max(out.corner, u[n]);
  for (std::size_t n = 4; n < 10; ++n) out.middle = std::max(out.middle, u[n]);
  return out;
}

/// Itetra10 2: the largest eigenvalue of the corner tetrahedron, from its polynomial.
double condensed_length(const Tetra& t, double ratio) {
  const auto [xx, yy, zz, xy, yz, zx] = products(t.gradient);
  const double a = -(xx + yy + zz);
  const double minors = xx * yy - xy * xy + yy * zz - yz * yz + zz * xx - zx * zx;
  const double p = ratio * minors - a * a / 3.0;
  return 1.0 / std::sqrt(2.0 * std::sqrt(std::max(-p, 0.0) / 3.0) - a / 3.0);
}

void tetra(const PartRow& row, const Corners& x, const std::array<Vec, 6>* middle,
           ElementOutcome& out) {
  const Tetra t(x);
  const double density = row.material.density;
  out.share.fill(0.125);
  if (middle == nullptr) {
    out.mass = density * t.volume;
    out.length = 3.0 * t.volume / t.largest_face;
    out.dt = bulk_step(row, out.length, std::cbrt(t.volume));
    // Each corner has two slots.
    out.stiffness = 0.25 * out.mass / (out.dt * out.dt);
    return;
  }
  const Quadratic q = quadratic(t, *middle);
  out.mass = density * q.volume;
  const double size = std::cbrt(*std::max_element(q.point.begin(), q.point.end()));
  if (row.property.itetra10 == 2 || row.property.itetra10 == 3) {
    out.length = row.property.itetra10 == 2 ? condensed_length(t, row.material.tetra_ratio)
                                            : 3.0 * q.volume / t.largest_face;
    out.dt = bulk_step(row, out.length, size);
    out.stiffness = 0.25 * out.mass / (out.dt * out.dt);
    out.middle_share = 7.0 / 3.0;
    return;
  }
  const double a = 32.0 * q.corner, b = 48.0 * q.middle / 7.0;
  out.length = std::sqrt(2.0 * q.volume / std::max(a, b));
  out.dt = bulk_step(row, out.length, size);
  constexpr double corner = 3.0 / 14.0, all = 4.0 * corner + 6.0;
  out.share.fill(0.5 * corner / all);
  out.middle_share = 1.0 / all;
  double s = 0.0;
  for (const double v : q.point) {
    const double dt = bulk_step(row, out.length, std::cbrt(v));
    s += 0.25 * density * v / (dt * dt);
  }
  out.stiffness = 0.5 * s * q.corner / std::max(q.corner, q.middle);
  out.middle_stiffness = s;
}

}  // namespace

double bulk_step(const PartRow& row, double length, double size) {
  const MaterialFigures& m = row.material;
  if (m.fixed_step > 0.0) return m.fixed_step;
  const PropertyFigures& p = row.property;
  const double c = m.solid_speed;
  const double qb = m.law == 70 && p.viscosity_blank ? 0.0 : p.qb;
  const double q = (qb + p.lambda) * c + p.mu * c * size / length;
  return length / (q + std::sqrt(q * q + c * c));
}

void solid_outcome(const PartRow& row, SolidShape shape, const std::array<Vec, 8>& x,
                   const std::array<Vec, 6>* middle, ElementOutcome& out) {
  switch (shape) {
    case SolidShape::tetra4:
    case SolidShape::tetra10:
      tetra(row, x, middle, out);
      break;
    case SolidShape::penta6: {
      Corners turned = x;  // reversed pentas are kept as written
      if (middle_volume(x) < 0)
        std::swap_ranges(turned.begin(), turned.begin() + 4, turned.begin() + 4);
      penta(row, turned, out);
      break;
    }
    case SolidShape::brick8:
      hexa(row, x, out);
      break;
    case SolidShape::brick20:
    case SolidShape::thick16:
      out.mass = row.material.density * middle_volume(x);
      if (shape == SolidShape::thick16) {
        out.share.fill(1.0 / 32.0);
        out.middle_share = 3.0 / 32.0;
      } else {
        constexpr double corner = 3.0 / 14.0, all = 8.0 * corner + 12.0;
        out.share.fill(corner / all);
        out.middle_share = 1.0 / all;
      }
      out.dt = out.stiffness = out.middle_stiffness = not_known;
      out.why = "solids with 16 and 20 nodes are not evaluated";
      break;
  }
  if (row.rigid) {
    out.dt = no_step;
    out.stiffness = out.middle_stiffness = 0.0;
    out.why = nullptr;
  }
}

void quad_outcome(const PartRow& row, const std::array<Vec, 4>& x, bool axisymmetric,
                  ElementOutcome& out) {
  std::array<Vec, 4> p = x;
  for (Vec& v : p) v.x = 0.0;
  const double area = 0.5 * norm(cross(p[2] - p[0], p[3] - p[1]));
  double longest = 0.0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) longest = std::max(longest, norm(p[j] - p[i]));
  out.length = area / longest;
  out.mass = out.stiffness = not_known;
  if (axisymmetric) {
    double moment = 0.0;  // of the area about the axis, by two triangles
    for (std::size_t i = 1; i < 3; ++i)
      moment += cross(p[i] - p[0], p[i + 1] - p[0]).x * (p[0].y + p[i].y + p[i + 1].y) / 6.0;
    out.mass = row.material.density * std::abs(moment);
    out.share = {0.25, 0.25, 0.25, 0.25};
  }
  if (row.rigid) {
    out.stiffness = 0.0;
    return;
  }
  out.dt = bulk_step(row, out.length, std::sqrt(area));
  out.stiffness = 0.5 * out.mass / (out.dt * out.dt);
}

}  // namespace deck::detail
