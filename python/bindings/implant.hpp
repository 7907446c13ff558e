#pragma once

#include <map>
#include <string>

#include "condyle/implant.hpp"

namespace condyle::python {

/// Sizes by the names that files have, with their unit in Python: "neck_radius_mm".
void set_sizes(plan::Implant& implant, const std::map<std::string, double>& given);

}  // namespace condyle::python
