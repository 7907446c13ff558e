#pragma once

#include <string>
#include <vector>

#include "condyle/answer/depth.hpp"
#include "condyle/io/picture.hpp"
#include "io/picture/surface_values.hpp"

/// What a picture of two meshes shows of their answer. Meshes are in F.

namespace condyle::io {

/// Triangles that meet; and before them a line from the deepest place to its exit, or between the nearest points.
std::vector<PictureMark> touch_marks(const TriMesh& fixed, const TriMesh& mobile, const TouchAnswer& answer,
                                     const Vec3& towards_viewer);

/// No colours; corners of triangles that meet are as inside, which the camera goes by.
BothValues values_of_touch(const TriMesh& fixed, const TriMesh& mobile, const TouchAnswer& answer);

/// "in contact, 1.25 mm deep".
std::string touch_line(const TouchAnswer& answer);

}  // namespace condyle::io
