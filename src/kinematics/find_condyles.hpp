#pragma once

#include "condyle/fit.hpp"

namespace condyle::kinematics {

/// The cylinder that both condyles of a femur share: the flexion axis of a knee (Eckhoff et al., J Bone Joint Surg Am 87,
/// 2005), found where their backs are round about one axis.
///
///      .---.   notch   .---.
///     |  o-|- - - - - -|-o  |   axis     Seen along it both are arcs of one circle, from the underside to the top of
///      `---'           `---'             the back; between them there is nothing of that radius.
struct Condyles {
  CylinderFit fit;            ///< its point is the middle of the axis between the centroids of both parts
  double length_mm = 0;       ///< along the axis, from outer end to outer end
  double common_arc_deg = 0;  ///< of a turn, in which both have surface
  double between = 0;  ///< area of the middle third of that length, over that of the smaller outer third
};

/// Condyles of a bone whose joint surface is near `facing` and whose shaft goes roughly along `towards_shaft` (unit, 30
/// degrees off at most): of cylinders through pairs of vertices the one that both parts have the largest arc of.
/// Deterministic. Throws MeshError, which says what is missing: two parts with 150 degrees of the cylinder in common, more than
/// two radii wide, apart by a notch, that fix the axis within largest_axis_bound and largest_place_bound_mm.
Condyles find_condyles(const TriMesh& femur, const Vec3& facing, const Vec3& towards_shaft);

/// Nearly the same for a small part of the work: of means over cells of 4 mm, and without bounds. On the femora at hand, rough
/// ones too, its axis is within 2 degrees and 1 mm of the one above.
Condyles find_condyles_roughly(const TriMesh& femur, const Vec3& facing, const Vec3& towards_shaft);

}  // namespace condyle::kinematics
