#include "page_motion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/error.hpp"
#include "io/motion/coordinate_motion.hpp"
#include "io/motion/motion_table.hpp"
#include "io/report/recorded_columns.hpp"
#include "io/report/recorded_frames.hpp"
#include "io/result/json.hpp"
#include "page_joint.hpp"

using namespace condyle;

namespace {

using io::Json;

/// So many names of columns fit a line.
constexpr std::size_t most_named = 12;

io::JointMotion motion_of(const Joint& joint, const io::MotionTable& table, std::string_view columns) {
  if (columns.empty()) return io::motion_of_coordinates(joint, table, io::columns_by_name(table, joint));
  const Json said = Json::parse(columns);
  if (said.at("by") != "columns")
    throw FileError(
        fmt::format("{}: [recorded_motion] of the joint file has {}, which condyle report --motion reads and "
                    "a page does not",
                    table.path.string(), said.at("by") == "poses" ? "columns of poses" : "a model"));
  return io::motion_of_coordinates(joint, table, io::columns_of_json(said));
}

std::string columns_there(const io::MotionTable& table) {
  const auto named = std::span(table.columns).first(std::min(most_named, table.columns.size()));
  const std::size_t more = table.columns.size() - named.size();
  return fmt::format("its columns are {}{}", fmt::join(named, ", "),
                     more ? fmt::format(" and {} more", more) : "");
}

/// Null is JSON's word for a gap.
Json numbers_json(const std::vector<double>& numbers) {
  Json list = Json::array();
  for (const double number : numbers) list.push_back(std::isnan(number) ? Json(nullptr) : Json(number));
  return list;
}

Json motion_json(const Joint& joint, const io::JointMotion& motion) {
  const io::RecordedFrames frames = io::recorded_frames(joint, motion.X_FM);
  Json remarks = motion.processing;
  for (const motion::ContactNote& note : motion.notes) remarks.push_back(note.text);
  return {{"axis", motion.times.in_seconds ? "time_s" : "frame"},
          {"times", numbers_json(motion.times.values)},
          {"coordinates_deg", numbers_json(frames.coordinates_deg)},
          {"coordinates_mm", numbers_json(frames.coordinates_mm)},
          {"poses", numbers_json(frames.poses)},
          {"remarks", std::move(remarks)}};
}

}  // namespace

const char* condyle_motion(CondyleJoint* joint, const char* name, const std::uint8_t* bytes, int count,
                           const char* columns) {
  return guarded(static_cast<const char*>(nullptr), [&] {
    const std::string_view contents(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(count));
    const io::MotionTable table = io::motion_table_of(contents, name);
    try {
      joint->description = motion_json(joint->joint, motion_of(joint->joint, table, columns))
                               .dump(-1, ' ', false, Json::error_handler_t::replace);
    } catch (const FileError& error) {
      throw FileError(fmt::format("{}; {}", error.what(), columns_there(table)));
    }
    return joint->description.c_str();
  });
}
