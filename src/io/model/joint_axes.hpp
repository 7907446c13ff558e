#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "condyle/io/model_file.hpp"

namespace condyle::io {

/// The axes by which the angles of a model's joint are named: X anterior, Y superior, Z to the right. In OpenSim every body of the
/// standing model has them as its own. A joint's frame F may be turned in its body, for a Pin turns about Z and nothing else.
struct JointAxes {
  Eigen::Matrix3d R_PA = Eigen::Matrix3d::Identity();  ///< in the parent's body P
  Eigen::Matrix3d R_FA =
      Eigen::Matrix3d::Identity();  ///< in F; entries of 0, 1 and -1 if they are F's own, renamed or not
  Eigen::Matrix3d R_PB =
      Eigen::Matrix3d::Identity();  ///< what they are held against: P's own, but for a turned body
  std::string turned = {};          ///< one line if F or the body is turned, else empty
};

/// How the bodies of a model stand with all coordinates at 0. Borrows the model.
class StandingModel {
 public:
  explicit StandingModel(const Model& model);

  /// R_GB; empty if no joints that are read lead from the ground to the body, or more than a body has.
  std::optional<Eigen::Matrix3d> rotation(std::string_view body) const;

  /// Whether more frames of joints stand upright in the ground and lie turned in their bodies than the other way round, as in models
  /// made from images, whose bodies are in the axes of the scanner. Frames on the ground are one or the other by definition.
  bool has_bodies_of_a_scanner() const;

 private:
  struct Above {
    std::string_view parent;
    Eigen::Matrix3d R_PB;
  };

  const Model& model_;
  std::map<std::string_view, Above> above_;  ///< by body, of the first joint that is read
  mutable std::optional<bool> of_a_scanner_;
};

/// F's own axes, each under the name of the body's axis that it is nearest to, if the joint turns about them and none is more than
/// 30 degrees off; else the body's. Bodies in the axes of a scanner lie turned in the standing model, and the ground's axes stand in
/// for theirs.
JointAxes axes_of(const StandingModel& model, const ModelJoint& joint);

/// "X, forwards", "-Z, to the left": the axis of a body nearest to a direction in it.
std::string_view nearest_axis(const Vec3& direction);

}  // namespace condyle::io
