#pragma once

#include "method.hpp"

/// The methods of each source file of this folder. Those of packages are there only where CMake found them.

namespace bench {

/// Condyle's own.
std::vector<MethodKind> condyle_kinds();

/// Flexible Collision Library: hierarchies of boxes, slabs and swept rectangles.
std::vector<MethodKind> fcl_kinds();

/// Embree: rays between vertex and centre.
std::vector<MethodKind> embree_kinds();

}  // namespace bench
