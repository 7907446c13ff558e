#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "condyle/angle.hpp"
#include "condyle/first_contact.hpp"
#include "condyle/joint.hpp"
#include "condyle/joint_coordinates.hpp"
#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"
#include "condyle/range_of_motion.hpp"

/// Implants made of their sizes: a total hip and a reverse shoulder, their meshes, and the limits that neck and liner have in closed
/// form. docs/implants.md, docs/mathematics/13-implants.md.

namespace condyle::plan {

// ---- how a cup is oriented -----------------------------------------------------------------------------------------------

struct CupAngles {
  Angle inclination, anteversion;
  CupDefinition definition = CupDefinition::radiographic;

  friend bool operator==(const CupAngles&, const CupAngles&) = default;
};

/// The unit axis out of a cup's opening, in the joint frame at zero angles. Of a right hip, with inclination i and anteversion v:
///
///     radiographic  ( sin v,        -cos i cos v,  sin i cos v)
///     anatomic      ( sin i sin v,  -cos i,        sin i cos v)
///     operative     ( cos i sin v,  -cos i cos v,  sin i      )        a left hip: Z negated
[[nodiscard]] Vec3 cup_axis(const CupAngles& angles, Side side) noexcept;

/// The angles of an axis of any length but zero: the inverse of cup_axis() to rounding, for inclinations of 0 to 90 degrees.
[[nodiscard]] CupAngles cup_angles(const Vec3& axis, CupDefinition definition, Side side) noexcept;

/// The same axis by another definition.
[[nodiscard]] CupAngles by_definition(const CupAngles& angles, CupDefinition definition) noexcept;

/// The unit axis of a stem's neck from the centre of the head towards the stem, in the mobile frame. Of a right hip
/// R_y(-version) (0, -cos(180 - neck_shaft), sin(180 - neck_shaft)).
[[nodiscard]] Vec3 neck_axis(Angle neck_shaft, Angle version, Side side) noexcept;

struct StemAngles {
  Angle neck_shaft, version;
};
/// The angles of an axis of any length but zero: the inverse of neck_axis() to rounding.
[[nodiscard]] StemAngles stem_angles(const Vec3& axis, Side side) noexcept;

// ---- bodies of revolution ------------------------------------------------------------------------------------------------

/// A liner that is a body of revolution about an axis through the centre: spherical inside, and a face from the inner edge of its
/// rim straight to the outer one.
///
///        opening           inner edge: at `radius_mm`, `half_angle` from the pole
///      ___     ___         outer edge: at `outer_radius_mm`, `half_angle - chamfer` from the pole
///     |   \   /   |
///      \   '-'   /
///       '--___--'  pole
struct LinerShape {
  double radius_mm, outer_radius_mm;
  Angle half_angle = Angle::degrees(90);
  Angle chamfer = {};
};

/// A neck that is a body of revolution about an axis through the centre: at z along it as wide as radius_mm + z tan(taper).
struct NeckShape {
  double radius_mm;
  Angle taper = {};
};

/// The angle between the axis out of the liner and the axis of the neck at which both first touch. On the sphere of radius rho
/// about the centre the liner is all directions from delta(rho) on, the neck all up to gamma(rho):
///
///     theta = min over rho of delta(rho) - gamma(rho);     sharp rim, cylinder: 180 - half_angle - asin(neck / liner radius)
///
/// To 1e-12 rad. For a neck that reaches beyond the liner's outer radius. Zero or below if the neck never fits.
[[nodiscard]] Angle contact_half_angle(const LinerShape& liner, const NeckShape& neck) noexcept;

/// Where a motion of a RevolvedPair ends.
struct ClosedLimit {
  Angle turned;  ///< from the motion's start; 0 for contact_at_start
  motion::LimitReason reason;
  Angle of_facets_low, of_facets_high;  ///< between these meshes with the implant's facets end it
};

/// The first root of fixed_axis . R(t) mobile_axis = P + A cos t + B sin t = cos(half_angle) above 0, in the range of the motion.
[[nodiscard]] ClosedLimit closed_limit(const RevolvedPair& pair, CoordinateSystem system,
                                       const motion::Motion& motion) noexcept;

// ---- the implants --------------------------------------------------------------------------------------------------------

/// Facets around liner and neck. 360 keep limits of usual designs within 0.002 degrees, and within 0.01 where the neck comes over
/// the rim at a shallow angle; the error goes with the square.
inline constexpr int default_facets = 360;

/// A total hip. The cup with its liner is fixed; head, neck and stem are mobile. Sizes in mm.
struct TotalHip {
  CupAngles cup = {Angle::degrees(40), Angle::degrees(15)};
  Angle neck_shaft = Angle::degrees(135);
  Angle stem_version = Angle::degrees(15);
  double head_radius_mm = 16;  ///< and of the liner: the head's mesh is smaller by the clearance
  double clearance_mm = 0.5;   ///< so that head and liner never touch
  double neck_radius_mm = 6;   ///< at the centre of the head
  Angle neck_taper = {};       ///< half-angle of a cone that widens away from the head
  /// With these a trapezoid across the neck in place of a circle: twice the neck's radius high, so wide above and below.
  double neck_upper_width_mm = 0, neck_lower_width_mm = 0;
  Angle liner_half_angle = Angle::degrees(90);
  /// By which the outer edge of the liner's face is nearer to the pole than the inner one.
  Angle chamfer = {};
  Angle lip = {};  ///< by which the rim is raised where it is highest
  /// Where on the rim the lip is highest, from its uppermost place backwards.
  Angle lip_towards = Angle::degrees(45);
  Angle lip_width = Angle::degrees(120);  ///< of the rim that is raised
  double cup_radius_mm = 27;              ///< outside
  double offset_mm = 40;                  ///< from the centre of the head to the axis of the stem
  double stem_radius_mm = 7;
  double stem_length_mm = 80;  ///< below where the neck's axis meets the stem's
  double leg_length_mm = 0;    ///< by which the leg becomes longer: moves the bone, not the implant
  int facets = default_facets;

  friend bool operator==(const TotalHip&, const TotalHip&) = default;
};

/// A reverse shoulder: the ball stands on the scapula and is fixed, the cup on the humerus is mobile.
struct ReverseShoulder {
  Angle glenoid_inclination = Angle::degrees(-10);  ///< of the ball's pillar, upwards
  Angle glenoid_version = {};                       ///< the same forwards
  Angle neck_shaft = Angle::degrees(135);
  Angle retroversion = Angle::degrees(20);
  double head_radius_mm = 21;
  double clearance_mm = 0.5;
  double neck_radius_mm = 8;  ///< of the pillar that carries the ball
  Angle neck_taper = {};
  Angle liner_half_angle = Angle::degrees(55);
  Angle chamfer = {};
  double cup_radius_mm = 25;
  double pillar_length_mm = 32;
  double stem_radius_mm = 6;
  double stem_length_mm = 90;
  int facets = default_facets;

  friend bool operator==(const ReverseShoulder&, const ReverseShoulder&) = default;
};

using Implant = std::variant<TotalHip, ReverseShoulder>;

/// As in files: "total_hip", "reverse_shoulder".
[[nodiscard]] std::string_view name_of(const Implant& implant) noexcept;

/// A size of an implant by its name in files; options have hyphens, Python has the unit behind it: "neck_radius",
/// --neck-radius, neck_radius_mm.
struct ImplantParameter {
  std::string_view name, unit, meaning;  ///< unit: "mm" or "deg"
  double low, high;
  double (*value)(const Implant&);
  void (*set)(Implant&, double);
};

/// All sizes of this kind of implant, without facets and definition.
[[nodiscard]] std::span<const ImplantParameter> implant_parameters(const Implant& implant) noexcept;

/// Throws UsageError, one line on the first size that is out of its range, or on what contradicts what: a head larger than its
/// cup, a neck thicker than the head or as wide as the opening, a neck that ends inside the cup.
void check_implant(const Implant& implant);

/// Liner and neck as bodies of revolution; empty where they are none: why_not_revolved() says what is not.
[[nodiscard]] std::optional<RevolvedPair> revolved_pair(const Implant& implant, Side side);
/// Empty if there is a closed form.
[[nodiscard]] std::string why_not_revolved(const Implant& implant);

/// Where the liner and the neck of an implant are in a joint: meshes by the names of implant_meshes().
[[nodiscard]] JointImplant implant_in_joint(const Implant& implant, const Joint& joint);

/// Where the parts of the joint have the axis of its cup; empty if it has none.
[[nodiscard]] std::optional<CupAngles> cup_angles(const Joint& joint, CupDefinition definition);

/// The closed form of a joint with an implant, where its parts have it, or why there is none: a lip, a part that is shifted.
struct ClosedForm {
  std::optional<RevolvedPair> pair = {};
  std::string why_none = {};  ///< empty if there is a pair, and of a joint without an implant
};
[[nodiscard]] ClosedForm closed_form(const Joint& joint);
/// The same at other values of its parts' parameters.
[[nodiscard]] ClosedForm closed_form(const Joint& joint, std::span<const PosedPart> parts);

/// One closed mesh of an implant, by its name as a part of a body.
struct ImplantMesh {
  std::string part;
  TriMesh mesh;
};

/// Meshes of an implant in the joint frame at zero angles: closed, wound outwards, apart from each other by 0.05 mm where they
/// join, so that none is in another.
///
///     total hip         fixed  liner           mobile  head, neck, stem
///     reverse shoulder  fixed  head, pillar    mobile  liner, stem
struct ImplantMeshes {
  std::vector<ImplantMesh> fixed, mobile;
};

/// Throws UsageError as check_implant(). `stem_down` is where the stem points, of a right joint: that of a bone whose shaft leans leans with
/// it, and the angle of the neck stays that from Y. The same bytes for the same sizes.
[[nodiscard]] ImplantMeshes implant_meshes(const Implant& implant, Side side,
                                           const Vec3& stem_down = -Vec3::UnitY());

/// The plane across the neck of a total hip where the bone of the femur is cut: between neck and stem.
struct NeckCut {
  Vec3 normal;  ///< along the neck's axis, away from the head
  double offset_mm;
  Vec3 stem_axis_point;  ///< where the neck's axis meets the stem's
};
[[nodiscard]] NeckCut neck_cut(const TotalHip& hip, Side side);

}  // namespace condyle::plan
