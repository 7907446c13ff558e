#pragma once

#include "condyle/mesh.hpp"

namespace condyle::kinematics {

/// How far a smooth surface stands out between the triangles that show it, mm, near a point: at an edge where they turn by an angle, an eighth of
/// that times the chord across it, as on an arc. Of the edges within a distance of the point the one that a tenth of them exceed, so that a sharp
/// rim does not decide; 0 without edges. Linear in the mesh.
///
///        .-´ ` - .      sag
///      /----------\     chord h, angle a between chords: sag = h a / 8
double surface_sag_mm(const Mesh& mesh, const Vec3& about, double within_mm);

}  // namespace condyle::kinematics
