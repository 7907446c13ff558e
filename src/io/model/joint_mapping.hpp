#pragma once

#include <optional>
#include <string>
#include <vector>

#include "condyle/io/model_file.hpp"
#include "condyle/io/recorded_motion.hpp"
#include "io/model/joint_axes.hpp"

namespace condyle::io {

/// A joint of a model in the terms of a joint file.
struct JointMapping {
  JointKind kind;
  Pose X_WF = Pose::Identity();  ///< the joint frame in the parent's body, its centre in metres
  /// Columns of the coordinates; empty for a joint that the model itself must pose.
  std::vector<ColumnOfCoordinate> columns = {};
  std::string why = {};  ///< how the kind follows from the axes, or why the model must pose it
  std::string oblique =
      {};  ///< one line on a hinge whose axis is far from the direction to the right, else empty
  std::string turned = {};  ///< one line on a joint frame that is turned in its body, else empty
  /// "knee_angle_r grows with extension": for each rotational coordinate that turns the joint about one of its axes.
  std::vector<std::string> meanings = {};
};

/// Without an anatomy only a hinge can be mapped: it flexes forwards.
JointMapping mapping_of(const StandingModel& model, const ModelJoint& joint, std::optional<Anatomy> anatomy,
                        Side side);

/// The joint that names of a model's joint and bodies speak of; nothing if they speak of none.
std::optional<Anatomy> anatomy_of(const ModelJoint& joint);

/// Whether names say that the child is the bone nearer to the trunk: angles then have the sense opposite to their names.
bool has_proximal_child(const ModelJoint& joint);

/// The side that a name's ending speaks of: "_r", "_left".
std::optional<Side> side_of(const ModelJoint& joint);

}  // namespace condyle::io
