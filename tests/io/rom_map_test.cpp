#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "condyle/io/map_result.hpp"
#include "condyle/io/rom_result.hpp"
#include "rom_scene.hpp"

namespace condyle::test {
namespace {

using Json = nlohmann::json;

MapGrid small_grid() {
  MapGrid grid;
  grid.column = {JointAngle::adduction, -10, 10, 2.5};
  grid.row = {JointAngle::internal_rotation, -20, 20, 10};
  grid.vary = JointAngle::flexion;
  return grid;
}

MotionMap whole_map() {
  return motion_map(small_grid(), RangeOfMotion(arm_and_post()));
}

TEST(MapCsv, HasALinePerPointWithBothLimitsToTheLastBit) {
  const MotionMap map = whole_map();
  std::istringstream in(map_csv(map));
  std::string line;
  std::getline(in, line);
  EXPECT_TRUE(line.starts_with("adduction_deg,internal_rotation_deg,flexion_lower_deg,flexion_upper_deg,"));
  const auto fields = std::count(line.begin(), line.end(), ',');
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    ASSERT_TRUE(std::getline(in, line));
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), fields);
    double x, y, lower, upper;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,", &x, &y, &lower, &upper), 4);
    EXPECT_EQ(x, -10 + 2.5 * static_cast<double>(i % 9));
    EXPECT_EQ(y, -20 + 10.0 * static_cast<double>(i / 9));
    EXPECT_EQ(lower, -map.points[i].from_start.negative.turned.degrees());
    EXPECT_EQ(upper, map.points[i].from_start.positive.turned.degrees());
  }
  EXPECT_FALSE(std::getline(in, line));
}

TEST(MapSummary, CountsEveryPointOnceAtEitherEnd) {
  const MotionMap map = whole_map();
  const Joint joint = arm_and_post();
  const Json json = Json::parse(rom_json({.joint = joint, .limits = {}, .map = &map}))["map"];
  EXPECT_EQ(json["vary"], "flexion");
  EXPECT_EQ(json["vary_opposite"], "extension");
  EXPECT_EQ(json["columns"], (Json{{"angle", "adduction"},
                                   {"opposite", "abduction"},
                                   {"first_deg", -10.0},
                                   {"last_deg", 10.0},
                                   {"step_deg", 2.5},
                                   {"count", 9}}));
  EXPECT_EQ(json["rows"]["opposite"], "external_rotation");
  EXPECT_EQ(json["rows"]["count"], 5);
  EXPECT_EQ(json["points"], 45);
  for (const char* ends : {"negative_ends", "positive_ends"}) {
    int sum = 0;
    for (const auto& [reason, count] : json[ends].items()) sum += count.get<int>();
    EXPECT_EQ(sum, 45) << ends;
  }
  EXPECT_EQ(json["positive_ends"]["contact"], 45);
  EXPECT_EQ(json["free_volume_deg3"].get<double>(), free_volume(map).plain_deg3);
  EXPECT_EQ(json["row_free_area_deg2"].size(), 5u);
}

}  // namespace
}  // namespace condyle::test
