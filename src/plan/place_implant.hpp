#pragma once

#include <optional>
#include <string>
#include <vector>

#include "condyle/implant.hpp"

namespace condyle::plan {

/// The axis of a femur's shaft: a point of it, mm, and the unit direction away from the hip.
struct ShaftLine {
  Vec3 point, down;
};

/// Landmarks that place a total hip, in the frame of a joint at zero angles; mm.
struct PlacedBy {
  Vec3 centre;  ///< where the centre of cup and head comes
  Sphere head;  ///< of the femur: it is cut off
  /// Empty: the stem points down the frame's vertical, and the femur moves along it only.
  std::optional<ShaftLine> shaft;
};

/// By how much a femur moves from where the centre of the implant is the origin: the axis of its shaft comes onto that of the stem, and the
/// bone down by the leg's lengthening. Of shafts that are not level.
Vec3 femur_shift(const ShaftLine& shaft, const TotalHip& hip, const NeckCut& cut) noexcept;

/// From a point of a line along its direction to where another line is nearest; both directions unit and not parallel. mm.
double nearest_along(const Vec3& point, const Vec3& direction, const ShaftLine& other) noexcept;

/// From a point in the frame of the joint to the nearest bone of the fixed body: to its meshes that are neither bearing nor soft. mm.
/// Throws UsageError for a body that has none.
double distance_to_bone(const Joint& joint, const Vec3& point);

/// A joint with a total hip, and what was done to its bones.
struct PlacedHip {
  /// A ball joint whose origin is the centre of cup and head; its bones keep their names, those of the implant follow them. Without parts
  /// that have a pose of their own.
  Joint joint;
  NeckCut cut;                        ///< in its frame
  Vec3 femur_shift_mm;                ///< of the femur against the hip bone
  double removed_mm3;                 ///< of the femur
  std::vector<std::string> left_out;  ///< meshes called bearing or soft, such as cartilage
};

/// Puts a total hip into a joint that has none: the femur moves, is cut across where neck and stem meet, and loses what lies on the side of
/// its head; the hip bone stays whole.
///
/// Throws UsageError as check_implant(), for a body of cartilage only, and if the plane does not cut the head off; MeshError for a femur
/// that is not closed. Linear in the meshes.
PlacedHip place_total_hip(const TotalHip& hip, const Joint& joint, const PlacedBy& by);

}  // namespace condyle::plan
