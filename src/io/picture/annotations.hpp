#pragma once

#include <string>

#include "condyle/io/picture.hpp"

/// Text over the bodies: letters of the sides, a scale bar, a line such as the pose.

namespace condyle::io {

/// Letters of a direction in F, the axis that goes most along it first: "S", "AR".
std::string orientation_letters(const Vec3& direction);

/// The largest of 1, 2, 5, 10 ... mm that is no longer than this.
double scale_bar_mm(double longest_mm) noexcept;

/// "flexion 110, adduction 15, internal rotation 35 deg": the coordinates that the joint has, to a tenth.
std::string pose_line(const Joint& joint, const JointAngles& at, const Pose& X_FM);

/// And what that pose is to the limits, as condyle depth says it: "flexion 140 deg, in contact: impinging".
std::string caption_of(const Joint& joint, const JointAngles& at, const Pose& X_FM);

/// Over the first rows of a picture, those of the bodies; without a view no letters.
void draw_annotations(Picture& picture, std::size_t rows_of_scene, const ViewDirection* view,
                      double pixels_per_mm, const std::string& line);

}  // namespace condyle::io
