#pragma once

#include <optional>

#include "measure/found_parts.hpp"

namespace condyle::measure {

/// Why a femur shows no condyles; empty if it does: a search of some tens of milliseconds.
std::string why_no_condyles(const TriMesh& femur, const Sphere& head);

/// The line that touches both condyles from behind, seen along the line from the head's centre to their middle: the centroid, by
/// area, of the last 45 mm of the bone along that line.
///
///         anterior
///       .--.    .--.        What is seen is the convex outline of those 45 mm; the line is its longest edge
///      (    `--'    )       that faces back to within 60 degrees.
///       `--'----`--'
std::optional<CondyleGeometry> condyle_geometry(const TriMesh& femur, const Sphere& head,
                                                const BodyAxes& axes);

/// By how much -neck points forward of the line, seen along the same line; degrees.
double femoral_version_deg(const CondyleGeometry& condyles, const Sphere& head, const Vec3& neck);

/// By how much -neck points forward of medial, seen along `down`; degrees.
double torsion_deg(const Vec3& neck, const Vec3& down, const BodyAxes& axes);

}  // namespace condyle::measure
