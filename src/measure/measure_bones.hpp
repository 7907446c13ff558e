#pragma once

#include "measure/found_parts.hpp"

namespace condyle::measure {

/// Throws UsageError for what measure_hip() refuses.
void check_measures(const Joint& joint, const MeasureOptions& request);

/// Both bodies without their meshes that are called bearing or soft, and without pieces near the head that are not theirs, each a mesh
/// with its findings.
struct BoneMeshes {
  Mesh hip_bone, femur;
  std::vector<std::string> left_out;  ///< what was left out of them, a sentence for each
};
BoneMeshes bones_of(const Joint& joint);

/// Searches of whole surfaces: of these bones, which are those of the joint.
BoneParts find_parts(const Joint& joint, const BoneMeshes& bones);

/// All measures of bones on which these parts were found.
HipMeasures measure_bones(const Bones& bones, const BoneParts& parts, CoordinateSystem system,
                          const MeasureOptions& request);

}  // namespace condyle::measure
