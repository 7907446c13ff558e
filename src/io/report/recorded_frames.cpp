#include "io/report/recorded_frames.hpp"

#include <limits>

#include "condyle/joint_coordinates.hpp"
#include "condyle/range_of_motion.hpp"

namespace condyle::io {

std::vector<double> rows_of(const Pose& X_FM) {
  std::vector<double> rows;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) rows.push_back(X_FM.matrix()(row, column));
  return rows;
}

RecordedFrames recorded_frames(const Joint& joint, const std::vector<std::optional<Pose>>& X_FM) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  RecordedFrames frames;
  for (const std::optional<Pose>& pose : X_FM) {
    if (!pose) {
      frames.coordinates_deg.insert(frames.coordinates_deg.end(), 3, nothing);
      frames.coordinates_mm.insert(frames.coordinates_mm.end(), 3, nothing);
      frames.poses.insert(frames.poses.end(), 16, nothing);
      continue;
    }
    const JointCoordinates at = coordinates_at(joint.coordinates(), *pose, joint.translation_frame);
    for (const JointAngle angle : all_joint_angles)
      frames.coordinates_deg.push_back(angle_of(at.angles, angle).degrees());
    for (int axis = 0; axis < 3; ++axis) frames.coordinates_mm.push_back(at.translation_mm[axis]);
    const std::vector<double> rows = rows_of(*pose);
    frames.poses.insert(frames.poses.end(), rows.begin(), rows.end());
  }
  return frames;
}

}  // namespace condyle::io
