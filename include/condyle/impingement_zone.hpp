#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "condyle/angle.hpp"
#include "condyle/bearing.hpp"
#include "condyle/fit.hpp"
#include "condyle/joint_coordinates.hpp"
#include "condyle/mesh.hpp"
#include "condyle/range_of_motion.hpp"

/// Impingement zones: which parts of both bones meet at the end of a motion and past it.

namespace condyle::motion {

// Where on the socket's rim, and where around the neck: two clock faces.

/// A clock face in a body's frame, seen with 12 up and 3 anterior whichever side of the body it is on:
///
///             12  twelve (superior)
///              |
///     9 -------+------- 3  three (anterior)
///              |
///              6
struct ClockFace {
  Vec3 twelve, three;  ///< unit, at a right angle

  /// The hour of a direction from the centre, in [0, 12): 0 is 12 o'clock, 1.5 half past one. Along the
  /// face's normal there is no hour: 0.
  [[nodiscard]] double hour_of(const Vec3& direction) const noexcept;
  /// The same as an angle from 12 towards 3, in [0, 360) degrees.
  [[nodiscard]] Angle angle_of(const Vec3& direction) const noexcept;
};

/// The face whose plane has this normal (either sense, any length but zero): 12 is Y of the joint frame and 3
/// is X, each as it falls on the plane, X as far as it is across 12. Throws UsageError if the normal is
/// within a degree of Y, or 12 and X leave no 3.
[[nodiscard]] ClockFace clock_face(const Vec3& normal);

/// The acetabular clock if the opening plane is not given: the sagittal plane, normal Z. Published clock
/// positions refer to the opening plane itself; between the two a position moves by up to half an hour or so,
/// depending on inclination and version.
[[nodiscard]] ClockFace sagittal_clock();

/// The acetabular clock in the plane of the rim: the plane fitted to the rim as the head sees it, 6 o'clock at the
/// acetabular notch, where published clock positions have it. Head and mesh in F. Empty if no rim or no notch is
/// found, or the plane leaves no 3 o'clock.
[[nodiscard]] std::optional<ClockFace> find_rim_clock(const TriMesh& fixed, const Sphere& head);

/// Which of the two a position refers to.
enum class ClockPlane { sagittal, rim };

/// The femoral neck: from the head's centre outwards, in M.
struct NeckAxis {
  Vec3 direction;  ///< unit
};

/// The neck's axis as the mesh has it: the direction of the centroid, by area, of all triangles with their
/// corners between 1.2 and 1.6 head radii from the joint centre. There the femur consists only of the neck;
/// nearer is the head, farther begin the trochanters. Empty if there is nothing in that shell, or it lies
/// around the centre more evenly than any neck does.
[[nodiscard]] std::optional<NeckAxis> find_neck_axis(const TriMesh& mobile, double head_radius_mm);

/// The clock around the neck: its plane is across the neck's axis.
[[nodiscard]] ClockFace neck_clock(const NeckAxis& neck);

struct ZoneOptions {
  BearingOptions bearing = {};                 ///< as the limits were found with
  Angle past = Angle::degrees(5);              ///< how far past the limit the zone is shown, 0 or more
  std::optional<ClockFace> socket_clock = {};  ///< in F; the sagittal one where not given
  std::optional<NeckAxis> neck = {};           ///< in M; find_neck_axis() where not given
};

/// One body's part of a zone, in that body's own frame.
struct BodyZone {
  /// One per vertex, 0 for those not inside the other body; empty if the other body is open and has no
  /// inside. At rim and neck rays graze the wall: there read the tangential depth.
  std::vector<double> radial_depth_mm;
  /// Angle for vertices inside, else 0; beyond 60 the radial depth is no depth. Same length, and empty likewise.
  std::vector<double> ray_to_normal_deg;
  /// The arc about the motion's axis by which the vertex would have to turn back or on, whichever is shorter;
  /// infinite if its whole circle is solid. As many, and empty likewise.
  std::vector<double> tangential_depth_deg, tangential_depth_mm;
  std::vector<Index> triangles;     ///< that meet the other body, ascending
  double area_mm2 = 0;              ///< of these triangles, whole
  std::optional<Vec3> centroid_mm;  ///< by area of these triangles; empty if there are none
};

struct ImpingementZone {
  MotionLimit limit;
  Angle past;  ///< the pose is this far past the limit
  BodyZone fixed, mobile;

  /// On the socket's clock: the contact at the limit, and the centroid of the fixed body's zone past it. Empty but
  /// for a hip, and for what is farther than 1.6 head radii from the joint centre, which is not at the rim.
  std::optional<double> contact_hour, zone_hour;
  /// Around the neck, from superior towards anterior: the same on the mobile body. Empty without a neck.
  std::optional<Angle> contact_neck_angle, zone_neck_angle;
};

/// Finds zones on a joint whose limits are known. At the limit itself the zone is one point, limit.end.contact:
/// there the surfaces meet and nothing is inside; how a zone grows shows past it.
class ZoneFinder {
 public:
  /// Throws UsageError for an angle past the limit that is negative, more than a half turn or not finite.
  explicit ZoneFinder(const Joint& joint, const ZoneOptions& options = {});
  ~ZoneFinder();
  ZoneFinder(ZoneFinder&&) noexcept;
  ZoneFinder& operator=(ZoneFinder&&) noexcept;

  /// Empty for motions that contact did not end. The overlap of bearing contact is no zone unless it counts: neither
  /// the mobile body's bearing surface nor the part of the fixed body inside behind it. Triangles that overlap
  /// options left out are part of zones.
  [[nodiscard]] std::optional<ImpingementZone> zone(const MotionLimit& limit) const;

  /// In M; empty if it was not given and no neck was found.
  [[nodiscard]] const std::optional<NeckAxis>& neck() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace condyle::motion
