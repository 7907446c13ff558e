#pragma once

#include <optional>

#include "condyle/fit.hpp"

namespace condyle::kinematics {

/// The far end of a bone along the line from a point to the centroid, by area, of that end.
struct FarEnd {
  Vec3 middle;
  double reach_mm;   ///< along the line
  double height_mm;  ///< of the part that is the end
};

/// That of a femur from its head, 1.9 head radii high: 45 mm where a head has 24. Linear in the bone.
FarEnd far_end(const TriMesh& femur, const Sphere& head);

/// Whether it is farther from the head than the shaft goes: there may be condyles.
bool reaches_knee(const FarEnd& end, const Sphere& head) noexcept;

/// Whether any vertex is: one look at each.
bool may_reach_knee(const TriMesh& femur, const Sphere& head) noexcept;

/// The line that touches both condyles from behind, seen along the line from the head's centre to the middle of the far end.
///
///         anterior
///       .--.    .--.        What is seen is the convex outline of the far end; the line is its longest edge
///      (    `--'    )       that faces back to within 60 degrees.
///       `--'----`--'
struct CondylarLine {
  Vec3 middle;       ///< of the far end
  Vec3 first, last;  ///< where it touches, the last farther along the direction given
  double width_mm;   ///< between these
  double notch_mm;   ///< how far in front of the line vertices lie in its middle fifth; infinite if none does
};

/// Directions are unit. Empty if the bone ends above the knee or nothing faces back over some width. Linear in the femur, and n log n in its far end.
std::optional<CondylarLine> condylar_line(const TriMesh& femur, const Sphere& head, const Vec3& anterior,
                                          const Vec3& along);

/// Whether the line is that of two condyles: as far apart as they are, and a notch between them.
bool touches_condyles(const CondylarLine& line, const Sphere& head) noexcept;

}  // namespace condyle::kinematics
