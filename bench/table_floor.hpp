#pragma once

#include <cstddef>

#include "condyle/mesh.hpp"

namespace bench {

/// Reads the corners of every triangle and writes so many bytes to memory of its own, an equal share for each
/// triangle: what making a table of that size costs at least, whatever is computed. Returns something of what
/// was written.
double write_table_floor(const condyle::TriMesh& mesh, std::size_t bytes);

}  // namespace bench
