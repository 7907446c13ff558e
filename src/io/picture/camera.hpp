#pragma once

#include "io/picture/rasteriser.hpp"
#include "io/picture/surface_values.hpp"

namespace condyle::io {

inline constexpr double smallest_field_mm = 0.1, largest_field_mm = 100'000;

/// Millimetres in the plane of the picture to samples.
struct Camera {
  Vec3 right, up, towards_viewer;
  double samples_per_mm;
  double origin_x, origin_y;  ///< where the joint centre is, in samples

  FlatMesh laid(const TriMesh& mesh) const;
};

/// What is drawn: both bodies in F, and the values of their vertices.
struct Scene {
  JointKind kind;
  const TriMesh &fixed, &mobile;
  const BothValues& values;
};

/// As PictureOptions::field_mm says; columns and rows of samples, without the legend's.
Camera camera_of(const PictureOptions& options, const Scene& scene, double columns, double rows);

}  // namespace condyle::io
