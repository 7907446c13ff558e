#include "io/motion/functional_frame.hpp"

#include "condyle/error.hpp"
#include "io/motion/column_zero.hpp"
#include "io/motion/model_poses.hpp"

namespace condyle::io {

FunctionalFrame functional_frame(const LoadedJoint& joint, const MotionTable& table) {
  const auto& mapping = joint.report.file.recorded_motion;
  const auto read = [&]() -> RecordedPoses {
    if (mapping) {
      if (const auto* poses = std::get_if<ColumnsOfPoses>(&*mapping)) return recorded_poses(table, *poses);
      if (const auto* poses = std::get_if<PosesOfModel>(&*mapping)) return model_poses(table, *poses);
    }
    throw FileError(
        table.path.string() +
        ": no poses of both bodies: [recorded_motion] with fixed_body and mobile_body names their "
        "columns; coordinates turn about the joint's own centre");
  };
  const RecordedPoses recorded = read();
  const BodyFrames frames = body_frames(joint);
  const Pose X_BM = inverted(frames.X_MB);
  std::vector<Pose> X_FM;
  for (const std::optional<Pose>& X_AB : recorded.X_FM)
    if (X_AB) X_FM.push_back(frames.X_FA * *X_AB * X_BM);
  FunctionalFrame frame{table.path, kinematics::FunctionalCentre{}, recorded.processing};
  for (const motion::ContactNote& note : recorded.notes) frame.processing.push_back(note.text);
  try {
    if (joint.joint.kind == JointKind::ball)
      frame.found = kinematics::functional_centre(X_FM);
    else
      frame.found = kinematics::functional_axis(X_FM);
  } catch (const MeshError& error) {
    throw MeshError(table.path.string() + ": " + error.what());
  }
  return frame;
}

}  // namespace condyle::io
