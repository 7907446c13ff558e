#include "condyle/impingement_zone.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "condyle/contact.hpp"
#include "condyle/error.hpp"
#include "motion/rom/contact_roles.hpp"
#include "motion/rom/overlap.hpp"
#include "motion/rom/socket_hour.hpp"

namespace condyle::motion {
namespace {

/// counts(v): whether vertex v may be part of the zone.
template <class Counts>
void take_depths(const std::optional<radial::RadialResults>& radial,
                 const std::optional<tangential::TangentialResults>& tangential, const Counts& counts,
                 BodyZone& zone) {
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

/// One body: the numbers its triangles have in the whole mesh, their roles, and for each vertex the role of the triangle that ends
/// most; soft if no triangle counts.
struct CountedBody {
  std::vector<Index> triangle_in_whole;
  std::vector<ContactRole> triangles, vertices;

  CountedBody(const TriMesh& counted, std::vector<Index> in_whole, const std::vector<ContactRole>& roles)
      : triangle_in_whole(std::move(in_whole)), vertices(counted.vertices.size(), ContactRole::soft) {
    constexpr std::array ends_less{ContactRole::ends, ContactRole::bearing_on_bearing, ContactRole::bearing,
                                   ContactRole::soft};
    const auto rank = [&](ContactRole role) {
      return std::find(ends_less.begin(), ends_less.end(), role) - ends_less.begin();
    };
    for (std::size_t t = 0; t < triangle_in_whole.size(); ++t) {
      triangles.push_back(roles.empty() ? ContactRole::ends : roles[triangle_in_whole[t]]);
      for (const Index v : counted.triangles[t])
        if (rank(triangles.back()) < rank(vertices[v])) vertices[v] = triangles.back();
    }
  }
};

/// The parts of both bodies that can meet in a zone, and which of their contact counts.
struct CountedContact {
  CountedBody fixed, mobile;
  bool leaves_out_bearing;

  bool counts(ContactRole of_fixed, ContactRole of_mobile) const noexcept {
    const ContactKind kind = motion::kind_of(of_fixed, of_mobile);
    return kind != ContactKind::soft && !(kind == ContactKind::bearing && leaves_out_bearing);
  }
  /// Whether a vertex of the mobile body whose ray or arc leaves the fixed one through this triangle is part of a zone.
  bool counts_mobile(std::size_t v, Index exit) const noexcept {
    return counts(exit == no_index ? ContactRole::ends : fixed.triangles[exit], mobile.vertices[v]);
  }
  bool counts_fixed(std::size_t v, Index exit) const noexcept {
    return counts(fixed.vertices[v], exit == no_index ? ContactRole::ends : mobile.triangles[exit]);
  }
};

/// In numbers of the whole mesh.
std::vector<Index> in_whole(std::vector<Index> triangles, const CountedBody& body) {
  for (Index& t : triangles) t = body.triangle_in_whole[t];
  return triangles;
}

}  // namespace

struct ZoneFinder::Parts {
  CoordinateSystem system;
  bool has_socket;
  Angle past;
  ClockFace socket_clock;
  std::optional<BearingSurface> bearing;
  std::optional<NeckAxis> neck;
  Mesh whole_fixed, whole_mobile;
  CountedContact counted;
  contact::JointContact contact;  ///< of what is not soft
};

ZoneFinder::ZoneFinder(const Joint& joint, const ZoneOptions& options) {
  if (!(options.past >= Angle() && options.past <= Angle::degrees(180)))
    throw UsageError("impingement zone: past the limit must be between 0 and 180 degrees");
  const BearingFinding found = find_bearing_surface(joint, options.bearing);
  const std::optional<BearingSurface>& bearing = found.surface;
  std::optional<NeckAxis> neck = options.neck;
  if (!neck && bearing && joint.is_hip()) neck = find_neck_axis(joint.mobile.mesh, bearing->head.radius);
  PartsOfJoint hard = motion::parts_that_count(joint, {}, found, BearingRule::count);
  auto& [fixed, fixed_in_whole] = hard.fixed.front();
  auto& [mobile, mobile_in_whole] = hard.mobile.front();
  CountedContact counted{CountedBody(fixed, std::move(fixed_in_whole), found.roles.fixed),
                         CountedBody(mobile, std::move(mobile_in_whole), found.roles.mobile),
                         options.bearing.rule == BearingRule::leave_out};
  parts_ = std::make_unique<Parts>(Parts{joint.coordinates(), joint.is_hip(), options.past,
                                         options.socket_clock ? *options.socket_clock : sagittal_clock(),
                                         bearing, neck, joint.fixed.mesh, joint.mobile.mesh,
                                         std::move(counted), contact::JointContact(fixed, mobile)});
}

ZoneFinder::~ZoneFinder() = default;
ZoneFinder::ZoneFinder(ZoneFinder&&) noexcept = default;
ZoneFinder& ZoneFinder::operator=(ZoneFinder&&) noexcept = default;

const std::optional<NeckAxis>& ZoneFinder::neck() const noexcept {
  return parts_->neck;
}

std::optional<ImpingementZone> ZoneFinder::zone(const MotionLimit& limit) const {
  if (limit.end.reason != LimitReason::contact || !limit.end.contact) return std::nullopt;
  const auto& [system, has_socket, past, socket_clock, bearing, neck, whole_fixed, whole_mobile,
               counted_contact, contact] = *parts_;
  ImpingementZone zone{limit, past, {}, {}, {}, {}, {}, {}};
  const Angle onwards = past * sign_of(limit.motion.sense);
  const JointAngles at = turned_by(limit.angles_at_limit(), limit.motion.vary, onwards);
  const Pose X_FM = pose_at(system, at);
  const contact::RadialContact radial = contact.radial(X_FM);
  const bool both_closed = radial.mobile_in_fixed && radial.fixed_in_mobile;
  const contact::TangentialContact tangential =
      both_closed ? contact.tangential(X_FM, axis_of(limit.motion.vary, system, at))
                  : contact::TangentialContact{};
  // clang 14 does not let a lambda have a structured binding.
  const CountedContact& counted = counted_contact;
  take_depths(
      radial.mobile_in_fixed, tangential.mobile_in_fixed,
      [&](std::size_t v) {
        return counted.counts_mobile(v, radial.mobile_in_fixed->triangle[v]) &&
               counted.counts_mobile(v, tangential.mobile_in_fixed->triangle[v]);
      },
      zone.mobile);
  take_depths(
      radial.fixed_in_mobile, tangential.fixed_in_mobile,
      [&](std::size_t v) {
        return counted.counts_fixed(v, radial.fixed_in_mobile->triangle[v]) &&
               counted.counts_fixed(v, tangential.fixed_in_mobile->triangle[v]);
      },
      zone.fixed);
  std::vector<Index> of_fixed, of_mobile;
  for (const contact::TrianglePair& pair : radial.pairs) {
    if (!counted.counts(counted.fixed.triangles[pair.fixed], counted.mobile.triangles[pair.mobile])) continue;
    of_fixed.push_back(pair.fixed);
    of_mobile.push_back(pair.mobile);
  }
  take_triangles(whole_fixed, in_whole(std::move(of_fixed), counted.fixed), zone.fixed);
  take_triangles(whole_mobile, in_whole(std::move(of_mobile), counted.mobile), zone.mobile);

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

}  // namespace condyle::motion
