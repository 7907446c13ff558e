#pragma once

#include <cstddef>
#include <string>

#include "sample/field.hpp"
#include "sample/solid_mesh.hpp"

namespace condyle::sample {

/// The solid meshed with exactly so many triangles, sound: of the wanted genus, without self-intersections.
///
/// Coarse triangles may happen to cut across a sharp lip; from another contour they fall differently, so a
/// few are tried. Defects that the parameters cause come up every time: then it raises UsageError with the
/// mesh's name and what is wrong.
TriMesh checked_mesh(const char* name, const Solid& solid, Meshing meshing, std::size_t triangles,
                     int wanted_genus);

/// A point as messages give it.
std::string place(const Vec3& p);

}  // namespace condyle::sample
