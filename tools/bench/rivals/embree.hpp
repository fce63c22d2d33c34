// Embree 3 rival of the pair search: user geometry per scene; per node a point query with its gap
// as radius; bounds widened by the segment's gap and rounded outward to float.
#pragma once

#include <embree3/rtcore.h>

#include <cmath>
#include <limits>

#include "rivals/pair_test.hpp"

namespace bench {

namespace embree_detail {

inline float down(double v) {
  return std::nextafter(std::nextafter(static_cast<float>(v), -INFINITY), -INFINITY);
}
inline float up(double v) {
  return std::nextafter(std::nextafter(static_cast<float>(v), INFINITY), INFINITY);
}

inline void bounds(const RTCBoundsFunctionArguments* args) {
  const auto& scene = *static_cast<const Scene*>(args->geometryUserPtr);
  const Bounds b = segment_bounds(scene, args->primID);
  args->bounds_o->lower_x = down(b.low[0]);
  args->bounds_o->lower_y = down(b.low[1]);
  args->bounds_o->lower_z = down(b.low[2]);
  args->bounds_o->upper_x = up(b.high[0]);
  args->bounds_o->upper_y = up(b.high[1]);
  args->bounds_o->upper_z = up(b.high[2]);
}

struct Query {
  const Scene* scene;
  Answer answer;
  std::uint32_t secondary;
};

inline bool visit(RTCPointQueryFunctionArguments* args) {
  auto& query = *static_cast<Query*>(args->userPtr);
  if (within_gap(*query.scene, query.secondary, args->primID)) {
    query.answer.add(query.secondary, args->primID);
  }
  return false;  // keep the radius
}

}  // namespace embree_detail

inline Answer embree_point_query(const Scene& s) {
  using namespace embree_detail;
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = rtcNewScene(device);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(s.segments.size()));
  rtcSetGeometryUserData(geometry, const_cast<Scene*>(&s));
  rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  Query query{&s, {}, 0};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  for (std::uint32_t i = 0; i < s.secondary.size(); ++i) {
    const std::uint32_t n = s.secondary[i];
    RTCPointQuery q;
    q.x = static_cast<float>(s.x[n]);
    q.y = static_cast<float>(s.y[n]);
    q.z = static_cast<float>(s.z[n]);
    q.time = 0;
    // Rounding moves the point by up to half a unit per coordinate.
    const float largest = std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z)});
    q.radius = up(s.secondary_gap[i]) + 2 * largest * std::numeric_limits<float>::epsilon();
    query.secondary = i;
    rtcPointQuery(scene, &q, &context, visit, &query);
  }
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
  return query.answer;
}

}  // namespace bench
