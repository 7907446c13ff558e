#pragma once

#include <optional>
#include <string>

#include "condyle/fit.hpp"

namespace condyle::kinematics {

/// The articular face of a scapula.
struct Glenoid {
  SphereFit fit;
  double area_mm2;
  Vec3 faces;  ///< unit: the mean of its normals by area, roughly to the side
};

/// Anatomy of the joint from a humerus and a scapula, before any frame is known. Axes of the ISB need landmarks that
/// two meshes do not show (acromial angle, inferior angle, root of the spine; epicondyles of the humerus), and are not inferred.
struct ShoulderAnatomy {
  std::optional<SphericalPatch> head;
  std::string why_no_head;
  std::optional<Glenoid> glenoid;
  std::string why_no_glenoid;
  std::optional<Vec3>
      towards_humerus;  ///< unit: from the head to the centroid of the humerus' surface, down a hanging arm
};

/// Takes meshes in mm.
ShoulderAnatomy shoulder_anatomy(const TriMesh& scapula, const TriMesh& humerus);

}  // namespace condyle::kinematics
