#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "condyle/io/joint_file.hpp"
#include "io/motion/table_builder.hpp"

namespace condyle::io {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Per column the one of its speed, ".../speed" beside ".../value"; empty where there is none.
std::vector<std::optional<std::size_t>> columns_of_speeds(const MotionTable& table) {
  constexpr std::string_view value = "/value", speed = "/speed";
  std::vector<std::optional<std::size_t>> speeds;
  for (const std::string& name : table.columns) {
    speeds.emplace_back();
    if (!name.ends_with(value)) continue;
    const auto found = std::find(table.columns.begin(), table.columns.end(),
                                 name.substr(0, name.size() - value.size()).append(speed));
    if (found != table.columns.end()) speeds.back() = static_cast<std::size_t>(found - table.columns.begin());
  }
  return speeds;
}

/// Poses of a table a little before and after its frames.
class BesideFrames {
 public:
  BesideFrames(const LoadedJoint& joint, const MotionTable& table)
      : joint_(joint), table_(table), speeds_(columns_of_speeds(table)), steps_s_(table.rows) {
    // Poses are smooth over a thousandth of a radian, and a thousand roundings are far below what they are asked for.
    constexpr double farthest = 1e-3;
    for (std::size_t row = 0; row < table.rows; ++row) {
      double fastest = 0;
      for (const auto& speed : speeds_)
        if (speed) fastest = std::max(fastest, std::abs(table.values[*speed][row]));
      steps_s_[row] = fastest > 0 ? farthest / fastest : 1;
    }
  }

  bool has_speeds() const {
    return std::any_of(speeds_.begin(), speeds_.end(), [](const auto& speed) { return speed.has_value(); });
  }

  /// The poses so many steps later than the frames. A column without a speed is a gap, and so is every pose that needs it.
  std::vector<std::optional<Pose>> poses_after(double steps) const {
    MotionTable moved = table_;
    const std::size_t time = time_column(table_);
    for (std::size_t i = 0; i < moved.columns.size(); ++i) {
      if (i == time) continue;
      for (std::size_t row = 0; row < moved.rows; ++row)
        moved.values[i][row] =
            speeds_[i] ? moved.values[i][row] + steps * steps_s_[row] * table_.values[*speeds_[i]][row]
                       : nothing;
    }
    return motion_of(joint_, moved).X_FM;
  }

  double step_s(std::size_t row) const { return steps_s_[row]; }

 private:
  const LoadedJoint& joint_;
  const MotionTable& table_;
  std::vector<std::optional<std::size_t>> speeds_;
  std::vector<double> steps_s_;
};

}  // namespace

std::vector<std::optional<RelativeMotion>> recorded_speeds(const LoadedJoint& joint,
                                                           const MotionTable& table) {
  const BesideFrames beside(joint, table);
  if (!beside.has_speeds()) return {};
  const std::vector<std::optional<Pose>> X_FM = motion_of(joint, table).X_FM;
  const std::array at = {beside.poses_after(-1), beside.poses_after(-0.5), beside.poses_after(0.5),
                         beside.poses_after(1)};
  std::vector<std::optional<RelativeMotion>> motions(table.rows);
  for (std::size_t row = 0; row < table.rows; ++row) {
    if (!X_FM[row] || std::any_of(at.begin(), at.end(), [&](const auto& poses) { return !poses[row]; }))
      continue;
    // Differences over half the way weigh 4/3 and those over all of it -1/3: what is left is of the fourth power of the step.
    const auto matrix = [&](std::size_t k) -> const Eigen::Matrix4d& { return at[k][row]->matrix(); };
    const Eigen::Matrix4d per_s =
        (8 * (matrix(2) - matrix(1)) - (matrix(3) - matrix(0))) / (6 * beside.step_s(row));
    const Eigen::Matrix3d spin = per_s.topLeftCorner<3, 3>() * X_FM[row]->linear().transpose();
    motions[row] = {per_s.topRightCorner<3, 1>(),
                    Vec3(spin(2, 1) - spin(1, 2), spin(0, 2) - spin(2, 0), spin(1, 0) - spin(0, 1)) / 2};
  }
  return motions;
}

}  // namespace condyle::io
