#pragma once

#include <optional>
#include <string>
#include <vector>

#include "condyle/joint_coordinates.hpp"
#include "kinematics/find_condyles.hpp"
#include "kinematics/shaft_line.hpp"
#include "kinematics/shown_axes.hpp"

namespace condyle::kinematics {

/// The most medial and most lateral vertices of a femur near its condyles, in the order of the condyles' axis.
struct Epicondyles {
  Vec3 first, last;
  double to_axis_deg;  ///< from the line through both to the condyles' axis
};

/// Anatomy of the knee from a femur, before any frame is known, and the reason for each missing part.
///
///        superior
///          |  .-.      seen from the right: the shaft runs in front of the condyles' axis o, and behind the
///        .-|--' |      condyles stand clear of what lies between them, in front they do not.
///       / o|    |
///      (   |   / anterior
///       `-----'
///
/// Z = X x Y points to the right on either side, so that axes need no side; the side is which end of Z is medial.
struct KneeAnatomy {
  std::optional<Condyles> condyles;
  std::string why_no_condyles;
  std::optional<Epicondyles> epicondyles;  ///< with condyles
  std::optional<ShaftLine> shaft;          ///< with condyles
  std::optional<SphericalPatch> head;      ///< of a whole femur
  std::optional<ShownAxes>
      axes;  ///< right along the condyles' axis, superior towards the head, else along the shaft
  std::string why_no_axes;
  std::optional<Side> side;  ///< with axes
  std::string why_no_side;
  std::vector<std::string> evidence;  ///< one line each, for axes and side, with what it needs
};

/// Takes meshes in mm. Less than two seconds for 60,000 triangles.
KneeAnatomy knee_anatomy(const TriMesh& femur, const TriMesh& tibia);

/// The same from the femur by itself, with the condyles found roughly; the mobile body, posed in its frame, only locates them
/// and may be a patella. Some tens of milliseconds: for checks, where directions are known and may be wrong.
KneeAnatomy knee_anatomy_roughly(const TriMesh& femur, const TriMesh& mobile, const Pose& X_FM);

}  // namespace condyle::kinematics
