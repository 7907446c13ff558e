#include "condyle/contact_measures.hpp"

#include <array>
#include <cassert>

#include "core/parallel.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/surface_distance.hpp"
#include "mesh/surface_to_surface.hpp"

namespace condyle {
namespace {

std::vector<double> distances_to(const mesh::SurfaceDistance& surface, PointsView points) {
  std::vector<double> distances(points.size());
  core::parallel_chunks(points.size(), 256, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) distances[i] = surface(points[i]);
  });
  return distances;
}

struct Corner {
  Vec3 p;
  double gap;
};

/// What patches add up to.
struct Sums {
  mesh::CompensatedSum area, depth;
  Vec3 moment = Vec3::Zero();
  /// Of the triangles' normals n with areas a: sum of a n, and of a n.p with p the triangle's centre.
  Vec3 area_vector = Vec3::Zero();
  mesh::CompensatedSum flux;
  /// Of the border, where the gap is 0: length, and length times middle.
  double border = 0;
  Vec3 border_moment = Vec3::Zero();

  void add(const Corner& a, const Corner& b, const Corner& c) {
    const Vec3 n = (b.p - a.p).cross(c.p - a.p) / 2, middle = (a.p + b.p + c.p) / 3;
    const double size = n.norm();
    area.add(size);
    depth.add(-size * (a.gap + b.gap + c.gap) / 3);
    moment += size * middle;
    area_vector += n;
    flux.add(n.dot(middle));
  }
  void add_border(const Vec3& from, const Vec3& to) {
    const double length = (to - from).norm();
    border += length;
    border_moment += length * (from + to) / 2;
  }
};

/// Where the gap, linear along the edge, is 0.
Corner crossing(const Corner& a, const Corner& b) {
  const double t = a.gap / (a.gap - b.gap);
  return {a.p + t * (b.p - a.p), 0};
}

/// The part of a triangle with gap < 0: nothing, a corner, what a corner leaves, or all.
void add_inside(const std::array<Corner, 3>& triangle, Sums& sums) {
  std::array<Corner, 4> part;
  std::array<Vec3, 2> cut;
  std::size_t corners = 0, cuts = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Corner &here = triangle[k], &next = triangle[(k + 1) % 3];
    if (here.gap < 0) part[corners++] = here;
    if ((here.gap < 0) == (next.gap < 0)) continue;
    part[corners++] = crossing(here, next);
    cut[cuts++] = part[corners - 1].p;
  }
  for (std::size_t k = 2; k < corners; ++k) sums.add(part[0], part[k - 1], part[k]);
  if (cuts == 2) sums.add_border(cut[0], cut[1]);
}

Sums patch_of(const TriMesh& body, std::span<const PointState> states, std::span<const double> distances) {
  const auto gap = [&](Index v) {
    switch (states[v]) {
      case PointState::inside:
        return -distances[v];
      case PointState::on_surface:
        return 0.0;
      case PointState::outside:
        break;
    }
    return distances[v];
  };
  Sums sums;
  for (const Triangle& t : body.triangles) {
    const auto corner = [&](Index v) { return Corner{body.vertices[v], gap(v)}; };
    add_inside({corner(t[0]), corner(t[1]), corner(t[2])}, sums);
  }
  return sums;
}

ContactPatch patch_from(const Sums& sums) {
  ContactPatch patch{sums.area.value(), {}, {}};
  if (patch.area_mm2 > 0) {
    patch.mean_depth_mm = sums.depth.value() / patch.area_mm2;
    patch.centroid = sums.moment / patch.area_mm2;
  }
  return patch;
}

/// By the divergence theorem over both patches, with the middle of their borders as origin: a patch that has no
/// counterpart, under a corner in the middle of a large face, then counts as if a cone from there closed it.
///
///     V = 1/3 sum a n.(p - o) = 1/3 (sum a n.p - o . sum a n)
double volume_of(const Sums& mobile, const Sums& fixed) {
  const double border = mobile.border + fixed.border;
  const Vec3 origin =
      border > 0 ? Vec3((mobile.border_moment + fixed.border_moment) / border) : Vec3(Vec3::Zero());
  return (mobile.flux.value() + fixed.flux.value() - origin.dot(mobile.area_vector + fixed.area_vector)) / 3;
}

}  // namespace

ContactMeasures measure_contact(const JointContact& joint, const Pose& X_FM, const VertexStates& states) {
  const Mesh &fixed = joint.fixed(), &mobile = joint.mobile();
  const mesh::SurfaceDistance to_fixed(fixed), to_mobile(mobile);
  const TriMesh mobile_in_F = posed(X_FM, mobile);
  ContactMeasures out;
  out.distances = {distances_to(to_fixed, mobile_in_F.vertices),
                   distances_to(to_mobile, posed(inverted(X_FM), fixed.vertices()))};
  const mesh::ClosestPoints closest = *mesh::closest_points(to_fixed.tree(), to_mobile.tree(), X_FM);
  out.nearest = {closest.distance_mm, closest.a_point, closest.b_point};

  Sums of_mobile, of_fixed;
  if (states.mobile) {
    of_mobile = patch_of(mobile_in_F, *states.mobile, out.distances.mobile);
    out.mobile = patch_from(of_mobile);
  }
  if (states.fixed) {
    of_fixed = patch_of(fixed, *states.fixed, out.distances.fixed);
    out.fixed = patch_from(of_fixed);
  }
  if (states.mobile && states.fixed) out.volume_mm3 = volume_of(of_mobile, of_fixed);
  const double area = of_mobile.area.value() + of_fixed.area.value();
  if (area > 0) out.centroid = (of_mobile.moment + of_fixed.moment) / area;
  return out;
}

}  // namespace condyle
