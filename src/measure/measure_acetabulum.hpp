#pragma once

#include "measure/found_parts.hpp"

namespace condyle::measure {

/// Measures of the socket around a head. Linear in the mesh.
AcetabulumMeasures measure_acetabulum(const TriMesh& hip_bone, const Sphere& head, const BoneParts& parts,
                                      const BodyAxes& axes);

/// All of them empty for one reason.
AcetabulumMeasures acetabulum_not_measured(const std::string& why, const BodyAxes& axes);

}  // namespace condyle::measure
