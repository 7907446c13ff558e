#pragma once

#include <string>
#include <vector>

#include "condyle/implant.hpp"

namespace condyle::plan {

/// Meshes as one body, in their order; a single one has no name of its own.
Body joined_body(const std::string& name, const std::vector<ImplantMesh>& parts);

}  // namespace condyle::plan
