// Exact decision whether an edge passes through a triangle. Private to the contact stage.
#pragma once
#include "deck/contact/closest.hpp"

namespace deck::detail {

/// True if p and q lie strictly on either side of the plane of abc and pq meets the closed
/// triangle.
bool passes_through(const Point3<double>& p, const Point3<double>& q, const Point3<double>& a,
                    const Point3<double>& b, const Point3<double>& c);

}  // namespace deck::detail
