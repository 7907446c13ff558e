#pragma once

#include <array>
#include <cstdint>

#include "condyle/mesh.hpp"

namespace condyle::io {

inline constexpr std::array<std::uint8_t, 3> blue = {0, 114, 178}, vermilion = {213, 94, 0};

/// The mark's mesh grows by a ball.
void add_ball(TriMesh& mesh, const Vec3& at, double radius);

}  // namespace condyle::io
