#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "condyle/io/mesh_file.hpp"
#include "support/test_meshes.hpp"

/// A hip of a model whose femur is a square rod that hangs in a duct of four plates: limits of one angle have closed forms.

namespace condyle::test {

/// Metres: half the rod's width and its length below the centre; where the plates stand.
inline constexpr double rod_half = 0.01, rod_length = 0.4, plate_anterior = 0.2, plate_posterior = 0.12,
                        plate_left = 0.1, plate_right = 0.25;

/// Where the lower end of a rod that hangs touches a plate so far from the centre, in degrees.
inline double duct_limit_deg(double plate) {
  const double radius = std::hypot(rod_half, rod_length);
  return (std::asin(plate / radius) - std::atan2(rod_half, rod_length)) * 180 / std::numbers::pi;
}
/// Flexion and extension, adduction and abduction, of a right hip.
inline std::array<double, 2> duct_flexion_deg() {
  return {duct_limit_deg(plate_anterior), duct_limit_deg(plate_posterior)};
}
inline std::array<double, 2> duct_adduction_deg() {
  return {duct_limit_deg(plate_left), duct_limit_deg(plate_right)};
}

/// The model and its two meshes. Its flexion, `flex`, grows with extension; `add` and `rot` are ours. `nearest` is the most that any plate
/// stands away from the centre.
inline void write_duct_model(const std::filesystem::path& path, double nearest = 1) {
  const double thick = 0.02, wide = 0.6;
  const auto at = [&](double plate) { return std::min(plate, nearest); };
  TriMesh duct = box({at(plate_anterior), -wide, -wide}, {at(plate_anterior) + thick, wide, wide});
  duct = joined(duct, box({-at(plate_posterior) - thick, -wide, -wide}, {-at(plate_posterior), wide, wide}));
  for (const double side : {-at(plate_left) - thick, at(plate_right)})
    duct = joined(duct,
                  box({-at(plate_posterior) / 2, -wide, side}, {at(plate_anterior) / 2, -0.2, side + thick}));
  io::write_mesh(path.parent_path() / "duct.ply", duct);
  io::write_mesh(path.parent_path() / "rod.ply",
                 box({-rod_half, -rod_length, -rod_half}, {rod_half, -0.05, rod_half}));
  std::ofstream(path, std::ios::binary) << R"(<?xml version="1.0"?>
<OpenSimDocument Version="40500"><Model name="duct"><BodySet><objects>
<Body name="pelvis"><attached_geometry><Mesh name="p"><mesh_file>duct.ply</mesh_file></Mesh></attached_geometry></Body>
<Body name="femur_r"><attached_geometry><Mesh name="f"><mesh_file>rod.ply</mesh_file></Mesh></attached_geometry></Body>
</objects></BodySet><JointSet><objects><CustomJoint name="hip_r"><socket_parent_frame>/bodyset/pelvis</socket_parent_frame>
<socket_child_frame>/bodyset/femur_r</socket_child_frame><coordinates><Coordinate name="flex"><range>-2 2</range></Coordinate>
<Coordinate name="add"/><Coordinate name="rot"></Coordinate></coordinates><SpatialTransform>
<TransformAxis name="rotation1"><coordinates>flex</coordinates><axis>0 0 -1</axis></TransformAxis>
<TransformAxis name="rotation2"><coordinates>add</coordinates><axis>1 0 0</axis></TransformAxis>
<TransformAxis name="rotation3"><coordinates>rot</coordinates><axis>0 1 0</axis></TransformAxis>
</SpatialTransform></CustomJoint></objects></JointSet></Model></OpenSimDocument>
)";
}

}  // namespace condyle::test
