#include "real_data.hpp"

#include <cstdlib>
#include <string>

#include "condyle/io/recorded_motion.hpp"
#include "io/motion/curve_files.hpp"

namespace bench {

namespace fs = std::filesystem;

fs::path data_folder() {
  const char* named = std::getenv("CONDYLE_DATA");
  return named ? fs::path(named) : fs::path(CONDYLE_SOURCE_DIR).parent_path() / "shared" / "data";
}

std::vector<std::optional<condyle::Pose>> walking_hip(condyle::Side side, std::optional<std::size_t> points) {
  const condyle::io::MotionTable table =
      condyle::io::read_motion_table(data_folder() / "motion_gait2354_walk" / "subject01_walk1_ik.mot");
  const std::string ending = side == condyle::Side::right ? "_r" : "_l";
  std::vector<condyle::io::ColumnOfCoordinate> columns;
  for (const char* angle : {"flexion", "adduction", "rotation"})
    columns.push_back({.coordinate = angle, .column = "hip_" + std::string(angle) + ending});
  const condyle::io::NamedCoordinates recorded = condyle::io::recorded_coordinates(table, columns);
  condyle::io::Curves curves{.at = recorded.times.values,
                             .names = recorded.names,
                             .values = {columns.size(), std::vector<double>{}}};
  for (const auto& frame : recorded.frames)
    for (std::size_t c = 0; c < columns.size(); ++c) curves.values[c].push_back(frame.value()[c]);
  if (points) curves = condyle::io::cycle_of(curves, curves.at.front(), curves.at.back(), *points);

  std::vector<std::optional<condyle::Pose>> poses;
  for (std::size_t i = 0; i < curves.at.size(); ++i) {
    const auto angle = [&](std::size_t c) { return condyle::Angle::degrees(curves.values[c][i]); };
    poses.emplace_back(condyle::pose_at({condyle::Anatomy::hip, side}, {angle(0), angle(1), angle(2)}));
  }
  return poses;
}

}  // namespace bench
