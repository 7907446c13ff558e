#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "io/mesh/parse.hpp"

namespace condyle::io {

/// Appends the triangles of a polygon: those round the first of its corners from which all of them turn as the whole polygon does; where
/// some corners are on a line, those from which none turns the other way; of any other flat polygon those of ear clipping, and of one
/// without area those round its first corner. A twisted polygon, or one that crosses itself, is refused, or by PolygonRule::guess cut as if
/// it were flat, or else round its first corner: the value is then how far its corners are from one plane. Fails for a vertex
/// that is not there. `number` is what messages call it.
std::optional<double> append_split(TriMesh& mesh, std::span<const std::int64_t> corners, std::size_t number,
                                   const Source& source);

}  // namespace condyle::io
