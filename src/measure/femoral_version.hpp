#pragma once

#include <optional>

#include "measure/found_parts.hpp"

namespace condyle::measure {

/// Why a femur shows no condyles; empty if it does: a search of some tens of milliseconds.
std::string why_no_condyles(const TriMesh& femur, const Sphere& head);

/// kinematics::condylar_line(), from medial to lateral.
std::optional<CondyleGeometry> condyle_geometry(const TriMesh& femur, const Sphere& head,
                                                const BodyAxes& axes);

/// By how much -neck points forward of the line, seen along the same line; degrees.
double femoral_version_deg(const CondyleGeometry& condyles, const Sphere& head, const Vec3& neck);

/// By how much -neck points forward of medial, seen along `down`; degrees.
double torsion_deg(const Vec3& neck, const Vec3& down, const BodyAxes& axes);

}  // namespace condyle::measure
