#include <cmath>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "condyle/error.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/joint.hpp"
#include "fuzz/one_line.hpp"
#include "fuzz/targets.hpp"
#include "io/joint/grid_text.hpp"
#include "io/result/repair_text.hpp"
#include "io/sweep/target_table.hpp"
#include "support/test_meshes.hpp"

namespace condyle::test {
namespace {

constexpr std::string_view targets_name = "targets.csv";

Joint joint_of(JointKind kind, Anatomy anatomy) {
  static const Mesh fixed = box({-1, -1, -1}, {1, 1, 1}), mobile = box({2, -1, -1}, {3, 1, 1});
  return {.name = "joint",
          .kind = kind,
          .side = Side::right,
          .fixed = {"fixed", fixed},
          .mobile = {"mobile", mobile},
          .anatomy = anatomy};
}

std::string fault_of_pose(std::string_view text, JointKind kind, Anatomy anatomy) {
  const io::PoseDegrees pose = io::parse_pose(text, kind, anatomy);
  for (const JointAngle angle : all_joint_angles) {
    if (!std::isfinite(pose[angle])) return "an angle that is not finite";
  }
  if (!pose.translation_mm.allFinite()) return "a translation that is not finite";
  if (kind != JointKind::free && io::parse_pose(io::to_text(pose, anatomy), kind, anatomy) != pose)
    return "a pose that does not read back";
  return {};
}

std::string fault_of_given(std::string_view text, JointKind kind, Anatomy anatomy) {
  const Pose X = io::given_pose(text, joint_of(kind, anatomy)).X_FM;
  if (!X.matrix().allFinite()) return "a pose that is not finite";
  const double off =
      (X.linear().transpose() * X.linear() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  return off < 1e-12 ? "" : "a pose that is no rotation";
}

std::string fault_of_axis(std::string_view text, JointKind kind, Anatomy anatomy) {
  const motion::GridAxis axis = io::parse_grid_axis(text, anatomy);
  const motion::GridAxis again = io::parse_grid_axis(io::to_text(axis, anatomy), anatomy);
  if (again.coordinate != axis.coordinate || again.first != axis.first || again.last != axis.last)
    return "an axis that does not read back";
  motion::MapGrid grid;
  grid.row = axis;
  grid.column.coordinate =
      axis.coordinate == JointAngle::adduction ? JointAngle::flexion : JointAngle::adduction;
  grid.vary =
      axis.coordinate == JointAngle::internal_rotation ? JointAngle::flexion : JointAngle::internal_rotation;
  if (grid.vary == grid.column.coordinate) grid.vary = JointAngle::adduction;
  motion::check_grid(grid, kind);
  return grid.size() <= motion::most_map_points ? "" : "a map of too many points";
}

/// Axes between spaces.
std::string fault_of_grid(std::string_view text, JointKind kind, Anatomy anatomy) {
  std::istringstream words{std::string(text)};
  const std::vector<std::string> axes{std::istream_iterator<std::string>(words), {}};
  const motion::MapGrid grid = io::parse_grid(axes, "", anatomy);
  motion::check_grid(grid, kind);
  return grid.size() <= motion::most_map_points ? "" : "a map of too many points";
}

std::string fault_of_targets(std::string_view text, JointKind kind, Anatomy anatomy) {
  const auto motions = motion::built_in_motions(kind, anatomy);
  for (const plan::SweepTarget& target : io::parse_targets(text, targets_name, motions, kind, anatomy)) {
    if (!(target.reach > Angle() && target.weight > 0)) return "a target without a reach or a weight";
    if (!std::isfinite(target.reach.radians() + target.pelvic_tilt.radians() + target.weight))
      return "a target that is not finite";
  }
  return {};
}

}  // namespace

std::string fuzz_text(std::string_view bytes) {
  if (bytes.size() < 2) return {};
  const auto first = static_cast<unsigned char>(bytes[0]), second = static_cast<unsigned char>(bytes[1]);
  const auto kind = static_cast<JointKind>(first % 3);
  const Anatomy anatomy = all_anatomies[first / 3 % all_anatomies.size()];
  const std::string_view text = bytes.substr(2);
  try {
    switch (second % 7) {
      case 0:
        return fault_of_pose(text, kind, anatomy);
      case 1:
        return fault_of_given(text, kind, anatomy);
      case 2:
        return fault_of_axis(text, kind, anatomy);
      case 3:
        return io::name_of(io::repair_named(text)) == text ? "" : "a repair of another name";
      case 5:
        return fault_of_grid(text, kind, anatomy);
      case 6:
        return fault_of_targets(text, kind, anatomy);
      default:
        return name_of(io::joint_angle_named(text, anatomy), anatomy) == text ? ""
                                                                              : "an angle of another name";
    }
  } catch (const UsageError& error) {
    return fault_of_message(error.what());
  } catch (const FileError& error) {
    return fault_of_message(error.what(), targets_name);
  }
}

}  // namespace condyle::test
