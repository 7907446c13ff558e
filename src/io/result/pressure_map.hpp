#pragma once

#include <vector>

#include "condyle/io/mesh_file.hpp"
#include "condyle/normal_depth.hpp"

namespace condyle::io {

/// One number per triangle of the surface that casts, 0 where it is not in contact: pressure_mpa, depth_mm, contact_area_mm2.
inline std::vector<MeshArray> pressure_map(const SurfaceContact& surface, std::size_t triangles,
                                           bool with_pressure) {
  std::vector<double> pressure(triangles, 0), depth(triangles, 0), area(triangles, 0);
  for (const FaceContact& face : surface.faces) {
    pressure[face.face] = face.mean_pressure_mpa();
    depth[face.face] = face.mean_depth_mm();
    area[face.face] = face.area_mm2;
  }
  std::vector<MeshArray> arrays;
  if (with_pressure) arrays.push_back({"pressure_mpa", std::move(pressure)});
  arrays.push_back({"depth_mm", std::move(depth)});
  arrays.push_back({"contact_area_mm2", std::move(area)});
  return arrays;
}

}  // namespace condyle::io
