#pragma once

#include <vector>

#include "condyle/mesh.hpp"

namespace condyle::contact {

/// Triangles of a surface with a point inside the other body.
struct Reaching {
  std::vector<Index> places;  ///< in the surface's tree, ascending
  std::vector<char> meets;    ///< of each, whether it meets the other surface: else all of it is inside
};

}  // namespace condyle::contact
