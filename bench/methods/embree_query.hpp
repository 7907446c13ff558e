#pragma once

#include <algorithm>

#include "embree_rays.hpp"
#include "method.hpp"

/// Embree 3.13, the ray tracer of film and of much engineering software: one ray from each mobile vertex
/// towards the joint centre.
///
///     centre  o - - - - |///// x < - - |        first crossing on the way from the vertex x to the centre:
///                     solid            outside  left through: inside; entered through, or none: outside
///
/// A second ray, away from the centre, is traced for vertices inside alone, and no further than the first one
/// went: it finds the exit if it is the nearer one. Sound for a fixed body without self-intersections; a
/// vertex at the centre itself has no ray and counts as outside. Embree computes in single precision, so the
/// vertices are posed in it.

namespace bench {

/// Where all mobile vertices are in M, in single precision.
struct FloatPoints {
  FloatPoints() = default;
  explicit FloatPoints(condyle::PointsView points) {
    for (std::size_t v = 0; v < points.size(); ++v) {
      x.push_back(static_cast<float>(points.x[v]));
      y.push_back(static_cast<float>(points.y[v]));
      z.push_back(static_cast<float>(points.z[v]));
    }
  }
  std::size_t size() const noexcept { return x.size(); }
  std::vector<float> x, y, z;
};

/// Rays that were traced.
struct RayCount {
  std::int64_t inwards = 0, outwards = 0;
};

/// The two passes over posed points.
template <unsigned Width>
class RayQuery {
 public:
  explicit RayQuery(RTCIntersectContextFlags coherence) {
    rtcInitIntersectContext(&context_);
    context_.flags = coherence;
  }

  void operator()(const EmbreeScene& scene, const RayOrigins& points, std::size_t count,
                  std::vector<InsideVertex>& out) {
    const FlushDenormals flush;
    inside_.resize(std::max(inside_.x.size(), count));
    std::size_t found = 0;
    const bool centre_is_inside = scene.centre_is_inside();
    trace<Width>(scene, context_, points, count, RayTowards::centre, [&](std::size_t i, const FirstHit& hit) {
      const bool is_hit = hit.triangle != condyle::no_index;
      if (is_hit ? !hit.leaves : !centre_is_inside) return;
      inside_.x[found] = points.x[i], inside_.y[found] = points.y[i], inside_.z[found] = points.z[i];
      inside_.reach[found] = is_hit ? hit.fraction : std::numeric_limits<float>::infinity();
      ++found;
      out.push_back({points.vertex[i], hit.triangle});
    });
    trace<Width>(scene, context_, inside_, found, RayTowards::infinity,
                 [&](std::size_t i, const FirstHit& hit) {
                   if (hit.triangle != condyle::no_index) out[i].triangle = hit.triangle;
                   out[i].depth_mm = hit.fraction * inside_.radius(i);
                 });
    count_.inwards += static_cast<std::int64_t>(count), count_.outwards += static_cast<std::int64_t>(found);
  }

  Work work() const { return {{"rays inwards", count_.inwards}, {"rays outwards", count_.outwards}}; }

 private:
  RTCIntersectContext context_;
  RayOrigins inside_;
  RayCount count_;
};

/// The one that passes over what cannot be inside; embree_culled.cpp.
MethodKind embree_culled_kind();

}  // namespace bench
