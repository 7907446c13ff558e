#include <array>
#include <cmath>

#include "condyle/error.hpp"
#include "condyle/io/recorded_motion.hpp"
#include "fuzz/one_line.hpp"
#include "fuzz/targets.hpp"
#include "support/temporary_folder.hpp"

namespace condyle::test {
namespace {

std::string fault_of(const io::MotionTable& table) {
  if (table.rows == 0 || table.values.size() != table.columns.size() ||
      table.line_of_row.size() != table.rows)
    return "a table of no shape";
  for (const auto& column : table.values) {
    if (column.size() != table.rows) return "a column of another length";
    for (const double value : column) {
      if (std::isinf(value)) return "a value that is infinite";
    }
  }
  const io::FrameTimes times = io::frame_times(table);
  for (std::size_t i = 1; i < times.values.size(); ++i) {
    if (!(times.values[i] > times.values[i - 1])) return "times that do not increase";
  }
  return {};
}

std::string fault_of_poses(const io::MotionTable& table) {
  const io::RecordedPoses poses = io::recorded_poses(table, {.fixed_body = "femur", .mobile_body = "tibia"});
  if (poses.X_FM.size() != table.rows) return "another number of poses";
  for (const auto& X : poses.X_FM) {
    if (!X) continue;
    const double off =
        (X->linear().transpose() * X->linear() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
    if (!(off < 1e-9)) return "a pose that is no rotation";
  }
  return {};
}

std::string fault_of_coordinates(const io::MotionTable& table) {
  const io::NamedCoordinates coordinates =
      io::recorded_coordinates(table, {{.coordinate = "flexion", .column = "knee_flex_r"},
                                       {.coordinate = "x",
                                        .kind = io::CoordinateKind::length,
                                        .column = "tx",
                                        .unit = io::ColumnUnit::metres}});
  for (const auto& frame : coordinates.frames) {
    if (frame && frame->size() != 2) return "a frame of another number of coordinates";
  }
  return {};
}

}  // namespace

std::string fuzz_motion_file(std::string_view bytes) {
  constexpr std::array names = {"x.mot", "x.sto", "x.csv"};
  if (bytes.empty()) return {};
  static const TemporaryFolder folder;
  const auto path = folder.file(names[static_cast<unsigned char>(bytes[0]) % names.size()], bytes.substr(1));
  const auto refused = [&](const auto& read) -> std::string {
    try {
      return read();
    } catch (const FileError& error) {
      return fault_of_message(error.what(), path.string());
    }
  };
  return refused([&]() -> std::string {
    const io::MotionTable table = io::read_motion_table(path);
    std::string fault = fault_of(table);
    if (fault.empty()) fault = refused([&] { return fault_of_poses(table); });
    return fault.empty() ? refused([&] { return fault_of_coordinates(table); }) : fault;
  });
}

}  // namespace condyle::test
