#include "condyle/impingement_zone.hpp"

#include <algorithm>
#include <cmath>

#include "condyle/contact.hpp"
#include "condyle/error.hpp"
#include "motion/rom/socket_hour.hpp"

namespace condyle {
namespace {

/// counts(v): whether vertex v may be part of the zone.
template <class Counts>
void take_depths(const std::optional<RadialResults>& radial,
                 const std::optional<TangentialResults>& tangential, const Counts& counts, BodyZone& zone) {
  if (!radial || !tangential) return;
  const std::size_t count = radial->size();
  for (auto* values : {&zone.radial_depth_mm, &zone.ray_to_normal_deg, &zone.tangential_depth_deg,
                       &zone.tangential_depth_mm})
    values->assign(count, 0.0);
  for (std::size_t v = 0; v < count; ++v) {
    if (!counts(v)) continue;
    if (radial->state[v] == PointState::inside) {
      zone.radial_depth_mm[v] = -radial->radial_gap_mm[v];
      zone.ray_to_normal_deg[v] = radial->ray_to_normal[v].degrees();
    }
    if (tangential->state[v] == PointState::inside) {
      zone.tangential_depth_deg[v] = (-tangential->angular_gap[v]).degrees();
      zone.tangential_depth_mm[v] = -tangential->arc_gap_mm[v];
    }
  }
}

void take_triangles(const TriMesh& mesh, std::vector<Index> triangles, BodyZone& zone) {
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  zone.triangles = std::move(triangles);
  Vec3 moment = Vec3::Zero();
  for (const Index t : zone.triangles) {
    const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
    const double area = (b - a).cross(c - a).norm() / 2;
    zone.area_mm2 += area;
    moment += area * ((a + b + c) / 3);
  }
  if (zone.area_mm2 > 0) zone.centroid_mm = moment / zone.area_mm2;
}

/// Which triangles and vertices of the mobile body slide and do not count; none where bearing contact counts.
struct BearingParts {
  std::vector<std::uint8_t> triangles, vertices;

  BearingParts(const TriMesh& mobile, const std::optional<BearingSurface>& bearing, BearingRule rule)
      : triangles(mobile.triangles.size()), vertices(mobile.vertices.size()) {
    if (!bearing || rule == BearingRule::count) return;
    triangles = bearing->triangles;
    std::fill(vertices.begin(), vertices.end(), std::uint8_t{1});
    for (std::size_t t = 0; t < triangles.size(); ++t)
      if (!triangles[t])
        for (const Index v : mobile.triangles[t]) vertices[v] = 0;
  }
};

}  // namespace

struct ZoneFinder::Parts {
  CoordinateSystem system;
  bool has_socket;
  Angle past;
  ClockFace socket_clock;
  std::optional<BearingSurface> bearing;
  std::optional<NeckAxis> neck;
  BearingParts bearing_parts;
  JointContact contact;
};

ZoneFinder::ZoneFinder(const Joint& joint, const ZoneOptions& options) {
  if (!(options.past >= Angle() && options.past <= Angle::degrees(180)))
    throw UsageError("impingement zone: past the limit must be between 0 and 180 degrees");
  std::optional<BearingSurface> bearing = find_bearing_surface(joint, options.bearing).surface;
  std::optional<NeckAxis> neck = options.neck;
  if (!neck && bearing && joint.is_hip()) neck = find_neck_axis(joint.mobile.mesh, bearing->head.radius);
  parts_ = std::make_unique<Parts>(
      Parts{joint.coordinates(), joint.is_hip(), options.past,
            options.socket_clock ? *options.socket_clock : sagittal_clock(), bearing, neck,
            BearingParts(joint.mobile.mesh, bearing, options.bearing.rule), JointContact(joint)});
}

ZoneFinder::~ZoneFinder() = default;
ZoneFinder::ZoneFinder(ZoneFinder&&) noexcept = default;
ZoneFinder& ZoneFinder::operator=(ZoneFinder&&) noexcept = default;

const std::optional<NeckAxis>& ZoneFinder::neck() const noexcept {
  return parts_->neck;
}

std::optional<ImpingementZone> ZoneFinder::zone(const MotionLimit& limit) const {
  if (limit.end.reason != LimitReason::contact || !limit.end.contact) return std::nullopt;
  const auto& [system, has_socket, past, socket_clock, bearing, neck, bearing_parts, contact] = *parts_;
  ImpingementZone zone{limit, past, {}, {}, {}, {}, {}, {}};
  const Angle onwards = past * sign_of(limit.motion.sense);
  const JointAngles at = turned_by(limit.angles_at_limit(), limit.motion.vary, onwards);
  const Pose X_FM = pose_at(system, at);
  const RadialContact radial = contact.radial(X_FM);
  const bool both_closed = radial.mobile_in_fixed && radial.fixed_in_mobile;
  const TangentialContact tangential =
      both_closed ? contact.tangential(X_FM, axis_of(limit.motion.vary, system, at)) : TangentialContact{};
  // clang 14 does not let a lambda have a structured binding.
  const BearingParts& slides = bearing_parts;
  const auto leaves_through_bearing = [&](const std::vector<Index>& exits, std::size_t v) {
    return exits[v] != no_index && slides.triangles[exits[v]];
  };
  take_depths(
      radial.mobile_in_fixed, tangential.mobile_in_fixed, [&](std::size_t v) { return !slides.vertices[v]; },
      zone.mobile);
  take_depths(
      radial.fixed_in_mobile, tangential.fixed_in_mobile,
      [&](std::size_t v) {
        return !leaves_through_bearing(radial.fixed_in_mobile->triangle, v) &&
               !leaves_through_bearing(tangential.fixed_in_mobile->triangle, v);
      },
      zone.fixed);
  std::vector<Index> of_fixed, of_mobile;
  for (const TrianglePair& pair : radial.pairs) {
    if (bearing_parts.triangles[pair.mobile]) continue;
    of_fixed.push_back(pair.fixed);
    of_mobile.push_back(pair.mobile);
  }
  take_triangles(contact.fixed(), std::move(of_fixed), zone.fixed);
  take_triangles(contact.mobile(), std::move(of_mobile), zone.mobile);

  if (has_socket)
    zone.contact_hour = motion::socket_hour(socket_clock, bearing, limit.end.contact->fixed_point);
  if (has_socket && zone.fixed.centroid_mm)
    zone.zone_hour = motion::socket_hour(socket_clock, bearing, *zone.fixed.centroid_mm);
  if (!neck) return zone;
  const ClockFace around_neck = neck_clock(*neck);
  zone.contact_neck_angle = around_neck.angle_of(limit.end.contact->mobile_point);
  if (zone.mobile.centroid_mm) zone.zone_neck_angle = around_neck.angle_of(*zone.mobile.centroid_mm);
  return zone;
}

}  // namespace condyle
