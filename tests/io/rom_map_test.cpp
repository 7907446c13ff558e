#include <nlohmann/json.hpp>
#include <sstream>

#include "io/file/whole_file.hpp"
#include "io/result/map_result.hpp"
#include "io/result/rom_files.hpp"
#include "io/result/rom_result.hpp"
#include "rom_scene.hpp"
#include "support/test.hpp"

namespace condyle::test {
namespace {

using Json = nlohmann::json;

motion::MapGrid small_grid() {
  motion::MapGrid grid;
  grid.column = {JointAngle::adduction, -10, 10, 2.5};
  grid.row = {JointAngle::internal_rotation, -20, 20, 10};
  grid.vary = JointAngle::flexion;
  return grid;
}

motion::MotionMap whole_map() {
  return motion::motion_map(small_grid(), motion::RangeOfMotion(arm_and_post()));
}

TEST(MapAxis, EndsEarlyIfItsStepLeadsPastItsLastValue) {
  const auto ends_early = [](double first, double last, double step) {
    return motion::GridAxis{JointAngle::flexion, first, last, step}.ends_early();
  };
  EXPECT_FALSE(ends_early(0, 120, 5));
  EXPECT_FALSE(ends_early(-0.3, 0.6, 0.1));
  EXPECT_FALSE(ends_early(10, 10, 5)) << "one value";
  EXPECT_TRUE(ends_early(0, 119.9, 5));
  EXPECT_TRUE(ends_early(0, 120.1, 5));
}

TEST(MapCsv, HasALinePerPointWithBothLimitsToTheLastBit) {
  const motion::MotionMap map = whole_map();
  std::istringstream in(io::map_csv(map));
  std::string line;
  std::getline(in, line);
  expect_begins(line, "adduction_deg,internal_rotation_deg,flexion_lower_deg,flexion_upper_deg,");
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
  const motion::MotionMap map = whole_map();
  const Joint joint = arm_and_post();
  const Json json = Json::parse(io::rom_json(shown({.joint = joint, .limits = {}, .map = map})))["map"];
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
  EXPECT_EQ(json["free_volume_deg3"].get<double>(), motion::free_volume(map).plain_deg3);
  EXPECT_EQ(json["row_free_area_deg2"].size(), 5u);
}

/// A post in front of the arm and one behind it: with the start beyond the first, what is free lies elsewhere.
motion::MotionMap map_with_islands() {
  Joint joint = arm_and_post();
  joint.fixed.mesh = joined(joint.fixed.mesh, box({-60, -120, -50}, {-40, -80, 50}));
  motion::MapGrid grid = small_grid();
  grid.start = Angle::degrees(30);
  motion::RangeOptions accepting;
  accepting.overlap.reference_contact = motion::ReferenceContact::accept;
  return motion::motion_map(grid, motion::RangeOfMotion(joint, accepting));
}

TEST(MapIntervals, AreThoseOfEveryPointInItsOrder) {
  const motion::MotionMap map = map_with_islands();
  const Joint joint = arm_and_post();
  const Json json =
      Json::parse(io::rom_json(shown({.joint = joint, .limits = {}, .map = map})))["map"]["intervals"];
  ASSERT_EQ(json["offset"].size(), map.points.size() + 1);
  std::size_t k = 0, with_several = 0;
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    EXPECT_EQ(json["offset"][i], k);
    with_several += map.points[i].intervals.size() > 1;
    for (const motion::FreeInterval& free : map.points[i].intervals) {
      EXPECT_EQ(json["low_deg"][k], (map.grid.start + free.low).degrees());
      EXPECT_EQ(json["high_deg"][k], (map.grid.start + free.high).degrees());
      EXPECT_EQ(json["low_reason"][k], name_of(free.at_low.reason));
      EXPECT_EQ(json["high_reason"][k], name_of(free.at_high.reason));
      ++k;
    }
  }
  EXPECT_GT(with_several, 0u);
  EXPECT_EQ(json["offset"].back(), k);
  for (const char* column : {"low_deg", "high_deg", "low_reason", "high_reason"})
    EXPECT_EQ(json[column].size(), k) << column;
}

/// Numbers between the tags of an array of a VTP file of text.
std::vector<double> numbers_of(const std::string& vtp, const std::string& name) {
  const auto at = vtp.find("Name=\"" + name + "\"");
  EXPECT_NE(at, vtp.npos) << name;
  const auto begin = vtp.find('>', at) + 1;
  std::istringstream text(vtp.substr(begin, vtp.find('<', begin) - begin));
  std::vector<double> numbers;
  for (std::string word; text >> word;) numbers.push_back(std::stod(word));
  return numbers;
}

TEST(MapVtp, HasTheEndsOfTheIntervalDrawnAndAllIntervalsAsFieldData) {
  const motion::MotionMap map = map_with_islands();
  const TemporaryFolder folder;
  const Joint joint = arm_and_post();
  io::write_rom(folder / "out", shown({.joint = joint, .limits = {}, .map = map}), io::VtpEncoding::text);
  const std::string vtp = io::read_whole_file(folder / "out/map.vtp");
  const auto lower = numbers_of(vtp, "lower_deg"), upper = numbers_of(vtp, "upper_deg");
  const auto lower_reason = numbers_of(vtp, "lower_reason"), upper_reason = numbers_of(vtp, "upper_reason");
  const auto offset = numbers_of(vtp, "interval_offset");
  const auto low = numbers_of(vtp, "interval_low_deg"), high = numbers_of(vtp, "interval_high_deg");
  const auto low_reason = numbers_of(vtp, "interval_low_reason"),
             high_reason = numbers_of(vtp, "interval_high_reason");
  const auto at_start = numbers_of(vtp, "free_at_start"), count = numbers_of(vtp, "free_intervals");
  const auto code = [](const motion::Limit& end) {
    return end.reason == motion::LimitReason::end_of_range ? 0 : 1;
  };
  ASSERT_EQ(lower.size(), map.points.size());
  ASSERT_EQ(offset.size(), map.points.size() + 1);
  std::size_t k = 0;
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    const motion::FreeAngles& point = map.points[i];
    const motion::FreeInterval* drawn = point.nearest_to_start();
    ASSERT_TRUE(drawn);
    EXPECT_EQ(lower[i], (map.grid.start + drawn->low).degrees());
    EXPECT_EQ(upper[i], (map.grid.start + drawn->high).degrees());
    EXPECT_EQ(lower_reason[i], code(drawn->at_low));
    EXPECT_EQ(upper_reason[i], code(drawn->at_high));
    EXPECT_EQ(at_start[i], point.from_start.free_at_start() ? 1 : 0);
    EXPECT_EQ(count[i], static_cast<double>(point.intervals.size()));
    EXPECT_EQ(offset[i], static_cast<double>(k));
    for (const motion::FreeInterval& free : point.intervals) {
      EXPECT_EQ(low[k], (map.grid.start + free.low).degrees());
      EXPECT_EQ(high[k], (map.grid.start + free.high).degrees());
      EXPECT_EQ(low_reason[k], code(free.at_low));
      EXPECT_EQ(high_reason[k], code(free.at_high));
      ++k;
    }
  }
  EXPECT_EQ(low.size(), k);
}

TEST(MapIntervalsCsv, HasALinePerIntervalWithBothEndsToTheLastBit) {
  const motion::MotionMap map = map_with_islands();
  std::istringstream in(io::map_intervals_csv(map));
  std::string line;
  std::getline(in, line);
  expect_begins(line,
                "adduction_deg,internal_rotation_deg,flexion_low_deg,flexion_high_deg,holds_start,low_"
                "reason,low_contact_kind,");
  for (std::size_t i = 0; i < map.points.size(); ++i)
    for (const motion::FreeInterval& free : map.points[i].intervals) {
      ASSERT_TRUE(std::getline(in, line));
      double x, y, low, high;
      int holds_start;
      ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%d,", &x, &y, &low, &high, &holds_start), 5)
          << line;
      EXPECT_EQ(x, -10 + 2.5 * static_cast<double>(i % 9));
      EXPECT_EQ(y, -20 + 10.0 * static_cast<double>(i / 9));
      EXPECT_EQ(low, (map.grid.start + free.low).degrees());
      EXPECT_EQ(high, (map.grid.start + free.high).degrees());
      EXPECT_EQ(holds_start, free.holds_start() ? 1 : 0);
    }
  EXPECT_FALSE(std::getline(in, line));
}

}  // namespace
}  // namespace condyle::test
