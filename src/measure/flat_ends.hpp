#pragma once

#include <vector>

#include "condyle/joint.hpp"

namespace condyle::measure {

/// Planes that a bone was cut by and closed in, which its file does not say: a flat face of some size with all of the bone on one side.
/// No bone has one by nature: what is flat on it is not so to a hundredth of a millimetre. Near linear.
std::vector<ImageCut> flat_ends(const Mesh& bone);

}  // namespace condyle::measure
