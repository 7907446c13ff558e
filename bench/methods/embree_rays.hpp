#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "embree_scene.hpp"

namespace bench {

/// Rays that Embree traces together; 1, 8 or 16. Field i of each is that of ray i.
template <unsigned Width>
struct RayPacket;
template <>
struct RayPacket<1> {
  RTCRayHit rays;
  static void trace(RTCScene scene, RTCIntersectContext& context, const int*, RTCRayHit& rays) {
    rtcIntersect1(scene, &context, &rays);
  }
};
template <>
struct RayPacket<8> {
  RTCRayHit8 rays;
  static void trace(RTCScene scene, RTCIntersectContext& context, const int* valid, RTCRayHit8& rays) {
    rtcIntersect8(valid, scene, &context, &rays);
  }
};
template <>
struct RayPacket<16> {
  RTCRayHit16 rays;
  static void trace(RTCScene scene, RTCIntersectContext& context, const int* valid, RTCRayHit16& rays) {
    rtcIntersect16(valid, scene, &context, &rays);
  }
};

/// Points in the fixed body's frame, with the room to collect them.
struct RayOrigins {
  std::vector<float> x, y, z;
  /// How far a ray goes, in units of the point's distance from the centre.
  std::vector<float> reach;
  std::vector<condyle::Index> vertex;

  void resize(std::size_t count) {
    x.resize(count), y.resize(count), z.resize(count), reach.resize(count), vertex.resize(count);
  }
  float radius(std::size_t i) const noexcept { return std::sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]); }
};

/// Where the ray of a point first meets the surface.
struct FirstHit {
  condyle::Index triangle;  ///< no_index where it meets nothing
  float fraction;           ///< of the point's distance from the centre; the reach where it meets nothing
  bool leaves;
};

enum class RayTowards { centre, infinity };

/// Traces the rays of the first `count` points, `Width` at a time, and calls visit(i, FirstHit) for each.
template <unsigned Width, class Visit>
void trace(const EmbreeScene& scene, RTCIntersectContext& context, const RayOrigins& points,
           std::size_t count, RayTowards towards, const Visit& visit) {
  using Packet = RayPacket<Width>;
  alignas(64) Packet packet;
  alignas(64) std::array<int, Width> valid;
  auto* rays = reinterpret_cast<RTCRayHitN*>(&packet.rays);
  RTCRayN* ray = RTCRayHitN_RayN(rays, Width);
  RTCHitN* hit = RTCRayHitN_HitN(rays, Width);
  const float sign = towards == RayTowards::centre ? -1.0f : 1.0f;
  for (unsigned k = 0; k < Width; ++k) {
    RTCRayN_tnear(ray, Width, k) = 0;
    RTCRayN_time(ray, Width, k) = 0;
    RTCRayN_mask(ray, Width, k) = ~0u;
    RTCRayN_id(ray, Width, k) = k;
    RTCRayN_flags(ray, Width, k) = 0;
  }
  for (std::size_t first = 0; first < count; first += Width) {
    for (unsigned k = 0; k < Width; ++k) {
      const bool is_used = first + k < count;
      const std::size_t i = is_used ? first + k : first;
      valid[k] = is_used ? -1 : 0;
      RTCRayN_org_x(ray, Width, k) = points.x[i];
      RTCRayN_org_y(ray, Width, k) = points.y[i];
      RTCRayN_org_z(ray, Width, k) = points.z[i];
      RTCRayN_dir_x(ray, Width, k) = sign * points.x[i];
      RTCRayN_dir_y(ray, Width, k) = sign * points.y[i];
      RTCRayN_dir_z(ray, Width, k) = sign * points.z[i];
      RTCRayN_tfar(ray, Width, k) = points.reach[i];
      RTCHitN_geomID(hit, Width, k) = RTC_INVALID_GEOMETRY_ID;
    }
    Packet::trace(scene.get(), context, valid.data(), packet.rays);
    for (unsigned k = 0; k < Width && first + k < count; ++k) {
      const bool is_hit = RTCHitN_geomID(hit, Width, k) != RTC_INVALID_GEOMETRY_ID;
      visit(first + k,
            FirstHit{is_hit ? RTCHitN_primID(hit, Width, k) : condyle::no_index, RTCRayN_tfar(ray, Width, k),
                     is_hit && leaves(RTCHitN_Ng_x(hit, Width, k), RTCHitN_Ng_y(hit, Width, k),
                                      RTCHitN_Ng_z(hit, Width, k), RTCRayN_dir_x(ray, Width, k),
                                      RTCRayN_dir_y(ray, Width, k), RTCRayN_dir_z(ray, Width, k))});
    }
  }
}

}  // namespace bench
