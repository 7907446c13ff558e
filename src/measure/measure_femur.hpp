#pragma once

#include "measure/found_parts.hpp"

namespace condyle::measure {

/// Measures of the femur about its head, which was found. Linear in the mesh.
FemurMeasures measure_femur(const TriMesh& femur, const SphericalPatch& head, const BoneParts& parts,
                            const BodyAxes& axes);

/// All of them empty for one reason.
FemurMeasures femur_not_measured(const std::string& why);

}  // namespace condyle::measure
