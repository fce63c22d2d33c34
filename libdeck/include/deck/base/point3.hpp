// Three numbers of any kind with the arithmetic of vectors: coordinates, differences, forces; as
// double, double-double, interval, exact number or a pack of lanes. Sums run from x to z,
// everywhere.
#pragma once

#include <type_traits>

namespace deck {

template <class T>
struct Point3 {
  T x{}, y{}, z{};
};

template <class T>
Point3<T> operator+(const Point3<T>& a, const Point3<T>& b) {
  return {T(a.x + b.x), T(a.y + b.y), T(a.z + b.z)};
}
template <class T>
Point3<T> operator-(const Point3<T>& a, const Point3<T>& b) {
  return {T(a.x - b.x), T(a.y - b.y), T(a.z - b.z)};
}
template <class T>
Point3<T> operator-(const Point3<T>& a) {
  return {T(-a.x), T(-a.y), T(-a.z)};
}
template <class T>
Point3<T> operator*(const std::type_identity_t<T>& f, const Point3<T>& a) {
  return {T(f * a.x), T(f * a.y), T(f * a.z)};
}
template <class T>
T dot(const Point3<T>& a, const Point3<T>& b) {
  return T(a.x * b.x + a.y * b.y + a.z * b.z);
}
template <class T>
Point3<T> cross(const Point3<T>& a, const Point3<T>& b) {
  return {T(a.y * b.z - a.z * b.y), T(a.z * b.x - a.x * b.z), T(a.x * b.y - a.y * b.x)};
}

}  // namespace deck
