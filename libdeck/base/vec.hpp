// Three numbers with the arithmetic of vectors: coordinates, differences, forces.
#pragma once
#include <cmath>

namespace deck {

struct Vec {
  double x = 0, y = 0, z = 0;
};
inline Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator*(double f, Vec a) { return {f * a.x, f * a.y, f * a.z}; }
inline double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec cross(Vec a, Vec b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(Vec a) { return std::sqrt(dot(a, a)); }
/// Unit vector; the null vector stays null.
inline Vec unit(Vec a) {
  const double l = norm(a);
  return l > 0.0 ? (1.0 / l) * a : Vec{};
}

}  // namespace deck
