#include "condyle/impingement_zone.hpp"

#include <algorithm>
#include <cmath>

#include "condyle/error.hpp"
#include "condyle/contact.hpp"

namespace condyle {
namespace {

void take_depths(const std::optional<RadialResults>& radial,
                 const std::optional<TangentialResults>& tangential, BodyZone& zone) {
  if (!radial || !tangential) return;
  const std::size_t count = radial->size();
  for (auto* values : {&zone.radial_depth_mm, &zone.ray_to_normal_deg, &zone.tangential_depth_deg,
                       &zone.tangential_depth_mm})
    values->assign(count, 0.0);
  for (std::size_t v = 0; v < count; ++v) {
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

std::optional<NeckAxis> neck_of(const Joint& joint) {
  const auto region = find_articular_region(joint);
  if (!region) return std::nullopt;
  return find_neck_axis(joint.mobile.mesh, region->radius_mm / articular_radii_of_head);
}

}  // namespace

struct ZoneFinder::Parts {
  Side side;
  Angle past;
  ClockFace socket_clock;
  std::optional<NeckAxis> neck;
  JointContact contact;
};

ZoneFinder::ZoneFinder(const Joint& joint, const ZoneOptions& options) {
  if (!(options.past >= Angle() && options.past <= Angle::degrees(180)))
    throw UsageError("impingement zone: past the limit must be between 0 and 180 degrees");
  parts_ = std::make_unique<Parts>(
      Parts{joint.side, options.past, options.socket_clock ? *options.socket_clock : sagittal_clock(),
            options.neck ? options.neck : neck_of(joint), JointContact(joint.fixed.mesh, joint.mobile.mesh)});
}

ZoneFinder::~ZoneFinder() = default;
ZoneFinder::ZoneFinder(ZoneFinder&&) noexcept = default;
ZoneFinder& ZoneFinder::operator=(ZoneFinder&&) noexcept = default;

const std::optional<NeckAxis>& ZoneFinder::neck() const noexcept {
  return parts_->neck;
}

std::optional<ImpingementZone> ZoneFinder::zone(const MotionLimit& limit) const {
  if (limit.end.reason != LimitReason::contact || !limit.end.contact) return std::nullopt;
  const auto& [side, past, socket_clock, neck, contact] = *parts_;
  ImpingementZone zone{limit, past, {}, {}, {}, {}, {}, {}};
  const Angle onwards = past * sign_of(limit.motion.sense);
  const JointAngles at = turned_by(limit.angles_at_limit(), limit.motion.vary, onwards);
  const Pose X_FM = pose_at(side, at);
  const RadialContact radial = contact.radial(X_FM);
  const bool both_closed = radial.mobile_in_fixed && radial.fixed_in_mobile;
  const TangentialContact tangential =
      both_closed ? contact.tangential(X_FM, axis_of(limit.motion.vary, side, at))
                  : TangentialContact{};
  take_depths(radial.mobile_in_fixed, tangential.mobile_in_fixed, zone.mobile);
  take_depths(radial.fixed_in_mobile, tangential.fixed_in_mobile, zone.fixed);
  std::vector<Index> of_fixed, of_mobile;
  for (const TrianglePair& pair : radial.pairs) {
    of_fixed.push_back(pair.fixed);
    of_mobile.push_back(pair.mobile);
  }
  take_triangles(contact.fixed(), std::move(of_fixed), zone.fixed);
  take_triangles(contact.mobile(), std::move(of_mobile), zone.mobile);

  zone.contact_hour = socket_clock.hour_of(limit.end.contact->fixed_point);
  if (zone.fixed.centroid_mm) zone.zone_hour = socket_clock.hour_of(*zone.fixed.centroid_mm);
  if (!neck) return zone;
  const ClockFace around_neck = neck_clock(*neck);
  zone.contact_neck_angle = around_neck.angle_of(limit.end.contact->mobile_point);
  if (zone.mobile.centroid_mm) zone.zone_neck_angle = around_neck.angle_of(*zone.mobile.centroid_mm);
  return zone;
}

}  // namespace condyle
