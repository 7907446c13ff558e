#pragma once

#include <cstddef>

#include "condyle/label_surface.hpp"
#include "support/test.hpp"

namespace condyle::test {

/// The faces of a mask's voxels, each as two triangles: the surface of a label map that nothing has smoothed.
inline TriMesh stairs_of(const VoxelMask& mask) {
  using Corner = std::array<std::int64_t, 3>;
  TriMesh mesh;
  std::map<Corner, Index> known;
  const auto vertex = [&](const Corner& c) {
    const auto [at, is_new] = known.emplace(c, static_cast<Index>(mesh.vertices.size()));
    if (is_new)
      mesh.vertices.push_back(mask.image.X_WI *
                              (Vec3(double(c[0]), double(c[1]), double(c[2])) +
                               Vec3(double(mask.first[0]), double(mask.first[1]), double(mask.first[2])) -
                               Vec3::Constant(0.5)));
    return at->second;
  };
  const auto inside = [&](const Corner& v) {
    for (std::size_t a = 0; a < 3; ++a)
      if (v[a] < 0 || v[a] >= mask.size[a]) return false;
    return mask.inside[static_cast<std::size_t>((v[2] * mask.size[1] + v[1]) * mask.size[0] + v[0])] != 0;
  };
  for (std::int64_t k = 0; k < mask.size[2]; ++k)
    for (std::int64_t j = 0; j < mask.size[1]; ++j)
      for (std::int64_t i = 0; i < mask.size[0]; ++i)
        for (std::size_t axis = 0; axis < 3 && inside({i, j, k}); ++axis)
          for (const bool up : {false, true}) {
            Corner beside{i, j, k};
            beside[axis] += up ? 1 : -1;
            if (inside(beside)) continue;
            std::array<Corner, 4> face;
            face.fill({i, j, k});
            const std::size_t u = (axis + 1) % 3, w = (axis + 2) % 3;
            for (Corner& corner : face) corner[axis] += up;
            ++face[1][u], ++face[2][u], ++face[2][w], ++face[3][w];
            const Index a = vertex(face[0]), b = vertex(face[1]), c = vertex(face[2]), d = vertex(face[3]);
            if (up)
              mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
            else
              mesh.triangles.insert(mesh.triangles.end(), {{a, c, b}, {a, d, c}});
          }
  return mesh;
}

}  // namespace condyle::test
