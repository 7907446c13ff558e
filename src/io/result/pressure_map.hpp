#pragma once

#include <vector>

#include "condyle/io/mesh_file.hpp"
#include "condyle/joint.hpp"
#include "condyle/normal_depth.hpp"

namespace condyle::io {

/// The number of each triangle's part in the body, from 0: part; nothing if the body is one mesh.
inline std::vector<MeshArray> part_map(const Body& body) {
  if (body.parts.empty()) return {};
  std::vector<std::int32_t> part;
  for (std::size_t i = 0; i < body.parts.size(); ++i)
    part.insert(part.end(), body.parts[i].triangles, static_cast<std::int32_t>(i));
  return {{"part", std::move(part)}};
}

/// One number per triangle of the surface that casts, 0 if it is not in contact: pressure_mpa, depth_mm, contact_area_mm2;
/// and part_map().
inline std::vector<MeshArray> pressure_map(const contact::SurfaceContact& surface, const Body& body,
                                           bool with_pressure) {
  const std::size_t triangles = body.mesh.triangles().size();
  std::vector<double> pressure(triangles, 0), depth(triangles, 0), area(triangles, 0);
  for (const contact::FaceContact& face : surface.faces) {
    pressure[face.face] = face.mean_pressure_mpa();
    depth[face.face] = face.mean_depth_mm();
    area[face.face] = face.area_mm2;
  }
  std::vector<MeshArray> arrays;
  if (with_pressure) arrays.push_back({"pressure_mpa", std::move(pressure)});
  arrays.push_back({"depth_mm", std::move(depth)});
  arrays.push_back({"contact_area_mm2", std::move(area)});
  for (MeshArray& part : part_map(body)) arrays.push_back(std::move(part));
  return arrays;
}

}  // namespace condyle::io
