#pragma once

#include <vector>

#include "condyle/implant.hpp"

namespace condyle::io {

/// Whether a joint has bones beside its implant. Without them a part is the whole body, and names no meshes.
enum class BonesAround { some, none };

/// A cup and a stem that turn against the bones, at the values of a total hip, with what surgery scatters by as standard deviations. A reverse
/// shoulder has none.
std::vector<PosedPart> implant_parts(const plan::Implant& implant, BonesAround bones);

}  // namespace condyle::io
