#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "condyle/answer/range.hpp"

/// What is said of a limit beside its numbers.

namespace condyle {

inline bool ends_in_contact(const motion::MotionLimit& limit) noexcept {
  return limit.end.reason == motion::LimitReason::contact ||
         limit.end.reason == motion::LimitReason::contact_at_start;
}

/// The two bedside tests, whose angles nobody has agreed on.
inline bool is_as_defined_here(const motion::Motion& motion) noexcept {
  return motion.name == "fadir" || motion.name == "faber";
}

/// The part of a body that a feature of its mesh is of; null if the body is one mesh.
const BodyPart* part_of(const Body& body, const motion::Feature& feature) noexcept;

/// How far a healthy adult hip is said to turn in the motion of this name; empty if the source has no value. American Academy
/// of Orthopaedic Surgeons, "Joint Motion: Method of Measuring and Recording", Chicago 1965: flexion 120, extension 30,
/// abduction 45, adduction 30, internal and external rotation 45 degrees. Measured on the living, where soft tissue stops
/// most motions before bone does: a bony limit past the range is usual, one well short of it is not. Of other joints no ranges
/// with a source are known here.
std::optional<Angle> normal_hip_range(std::string_view motion) noexcept;
/// The same for a limit; empty of other joints, and if zero angles are not known to be neutral: ranges count from there.
std::optional<Angle> normal_range(const Joint& joint, const motion::MotionLimit& limit);

/// Where bone ended a motion in simulations of other people's hips: means. No spread is given.
struct BoneReference {
  std::string_view motion;
  Angle healthy, cam_without_complaints, patients;
  int people_each;  ///< of each group
  std::string_view source;
};
/// The one study at hand of bone, and not of the living: Audenaert et al., Am J Sports Med 40 (2012) 1329. Its abstract says "on impingement
/// testing", which is 90 degrees of flexion; how far it adducts is not said, and internal rotation grows smaller with adduction: a limit at
/// none that is short is short. None of implants, if zero angles are not known to be neutral, and of a limit that does not say
/// where bone impinges.
std::optional<BoneReference> bone_reference(const Joint& joint, const motion::MotionLimit& limit);
/// Whether bone ends the motion, not its range, and no later than in the mean of hips with a cam. A limit below the healthy mean by less says nothing: half of all
/// healthy hips have one.
bool is_short(const BoneReference& reference, const motion::MotionLimit& limit) noexcept;

/// The source as results and figures name it.
inline constexpr std::string_view normal_hip_range_source = "AAOS 1965";

/// Direction of the limit's contact on the answer's clock, in [0, 12): 12 (0) superior and 3 anterior on either side. None for joints
/// other than hips, without contact, and far from the rim.
std::optional<double> clock_hour(const RangeAnswer& answer, const motion::MotionLimit& limit);

/// Degrees over which a motion went: its range by the number that was given, which 120 degrees in radians are not.
double degrees_turned(Angle turned, const motion::Motion& motion) noexcept;
/// "126–135", "88–>120" where 5 % of the displaced joints reach the end of the motion's range, ">120" where all but 5 % do: a band as it may
/// be quoted.
std::string quoted_band(const motion::LimitBand& band, const motion::Motion& motion);

/// Guarantee of the limit, in one sentence.
std::string guarantee_text(const motion::MotionLimit& limit);
/// The same of a limit with a depth allowed, which is searched for and not exact.
std::string guarantee_text(const motion::DepthLimit& limit);

}  // namespace condyle
