#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "io/mesh/parse.hpp"

namespace condyle::io {

/// Appends the triangles of a polygon round the first of its corners from which all of them turn as the whole polygon does; where
/// some corners are on a line, from which none turns the other way. Fails for a polygon that is not convex from any of its
/// corners, has no area, or uses a vertex that is not there. `number` is what messages call it.
void append_split(TriMesh& mesh, std::span<const std::int64_t> corners, std::size_t number,
                  const Source& source);

}  // namespace condyle::io
