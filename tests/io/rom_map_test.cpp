#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stop_token>

#include "condyle/error.hpp"
#include "condyle/io/map_checkpoint.hpp"
#include "condyle/io/map_result.hpp"
#include "condyle/io/rom_result.hpp"
#include "condyle/io/whole_file.hpp"
#include "rom_scene.hpp"
#include "support/temporary_folder.hpp"

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
  MotionMap map(small_grid());
  fill(map, RangeOfMotion(arm_and_post()));
  return map;
}

/// Computed up to this many points or a few more.
MotionMap interrupted_map(std::size_t points) {
  MotionMap map(small_grid());
  std::stop_source stop;
  fill(map, RangeOfMotion(arm_and_post()),
       {.progress =
            [&](std::size_t done, std::size_t) {
              if (done >= points) stop.request_stop();
            },
        .stop = stop.get_token()});
  return map;
}

/// Everything that is written about a map.
std::string written(const MotionMap& map) {
  const Joint joint = arm_and_post();
  std::string text = map_csv(map) + rom_json({.joint = joint, .limits = {}, .map = &map});
  for (const MapView view : {MapView::positive_limit, MapView::negative_limit, MapView::free_range})
    text += map_plot(plot_of(map, view, joint.name));
  return text;
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
    EXPECT_EQ(lower, -map.points[i]->negative.turned.degrees());
    EXPECT_EQ(upper, map.points[i]->positive.turned.degrees());
  }
  EXPECT_FALSE(std::getline(in, line));
}

TEST(MapSummary, CountsEveryPointOnceAtEitherEnd) {
  const MotionMap map = whole_map();
  const Joint joint = arm_and_post();
  const Json json = Json::parse(rom_json({.joint = joint, .limits = {}, .map = &map}))["map"];
  EXPECT_EQ(json["vary"], "flexion");
  EXPECT_EQ(json["columns"], (Json{{"angle", "adduction"},
                                   {"first_deg", -10.0},
                                   {"last_deg", 10.0},
                                   {"step_deg", 2.5},
                                   {"count", 9}}));
  EXPECT_EQ(json["rows"]["count"], 5);
  EXPECT_EQ(json["points"], 45);
  for (const char* ends : {"negative_ends", "positive_ends"}) {
    int sum = 0;
    for (const auto& [reason, count] : json[ends].items()) sum += count.get<int>();
    EXPECT_EQ(sum, 45) << ends;
  }
  EXPECT_EQ(json["positive_ends"]["contact"], 45);
  EXPECT_EQ(json["free_volume_deg3"].get<double>(), free_volume(map)->plain_deg3);
  EXPECT_EQ(json["row_free_area_deg2"].size(), 5u);
}

TEST(PlotOfMap, ShowsLimitsAsTurnsAndTheFreeRangeAsTheirSum) {
  const MotionMap map = whole_map();
  const MapPlot positive = plot_of(map, MapView::positive_limit, "j"),
                negative = plot_of(map, MapView::negative_limit, "j"),
                free = plot_of(map, MapView::free_range, "j");
  EXPECT_EQ(positive.quantity, "limit of flexion");
  EXPECT_EQ(negative.quantity, "limit of extension");
  EXPECT_EQ(free.quantity, "free range of flexion");
  ASSERT_EQ(free.values.size(), 45u);
  for (std::size_t i = 0; i < 45; ++i) {
    EXPECT_EQ(positive.values[i], map.points[i]->positive.turned.degrees());
    EXPECT_GE(negative.values[i], 0);
    EXPECT_EQ(free.values[i], (map.points[i]->negative.turned + map.points[i]->positive.turned).degrees());
  }
}

class Checkpoint : public ::testing::Test {
 protected:
  const Joint joint = arm_and_post();
  const MapGrid grid = small_grid();
  const MapKey key = map_key(joint, {}, grid);
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "map.checkpoint";

  std::string contents() const { return read_whole_file(path); }
};

TEST_F(Checkpoint, AMapResumedHasTheBytesOfOneMadeInOneGo) {
  for (const std::size_t stop_at : {1u, 20u, 44u}) {
    const MotionMap part = interrupted_map(stop_at);
    ASSERT_GE(part.done(), stop_at);
    ASSERT_FALSE(stop_at < 20 && part.complete());
    write_checkpoint(path, part, key);
    MotionMap map(grid);
    ASSERT_EQ(read_checkpoint(path, key, map), Resumed::points);
    EXPECT_EQ(map.done(), part.done());
    fill(map, RangeOfMotion(joint));
    EXPECT_EQ(written(map), written(whole_map()));
  }
}

TEST_F(Checkpoint, WrittenAgainHasTheSameBytes) {
  write_checkpoint(path, interrupted_map(10), key);
  const std::string before = contents();
  MotionMap map(grid);
  ASSERT_EQ(read_checkpoint(path, key, map), Resumed::points);
  write_checkpoint(path, map, key);
  EXPECT_EQ(contents(), before);
}

TEST_F(Checkpoint, OfAnotherQuestionIsLeftAlone) {
  write_checkpoint(path, interrupted_map(10), key);
  std::vector<MapKey> others;
  const auto other = [&](const Joint& j, const RangeOptions& o, const MapGrid& g) {
    others.push_back(map_key(j, o, g));
  };
  Joint moved = joint, retriangulated = joint, left = joint;
  TriMesh one_moved = joint.mobile.mesh, two_exchanged = joint.fixed.mesh;
  one_moved.vertices.x[3] = std::nextafter(one_moved.vertices.x[3], 0);
  std::swap(two_exchanged.triangles[0], two_exchanged.triangles[1]);
  moved.mobile.mesh = one_moved, retriangulated.fixed.mesh = two_exchanged;
  left.side = Side::left;
  other(moved, {}, grid), other(retriangulated, {}, grid), other(left, {}, grid);
  MapGrid shifted = grid, turned = grid, started = grid, ranged = grid;
  shifted.row.first_deg = -10;
  std::swap(turned.row, turned.column);
  started.start = Angle::degrees(1);
  ranged.range.positive = Angle::degrees(90);
  for (const MapGrid& g : {shifted, turned, started, ranged}) other(joint, {}, g);
  RangeOptions articular, region, rest, accepted;
  articular.articular = ArticularRegion{26};
  region.overlap.leave_out_region = ArticularRegion{26};
  rest.overlap.leave_out_rest_contacts.emplace();
  accepted.overlap.contact_at_rest = ContactAtRest::accept;
  for (const RangeOptions& o : {articular, region, rest, accepted}) other(joint, o, grid);

  std::set<MapKey> different(others.begin(), others.end());
  EXPECT_EQ(different.size(), others.size());
  for (const MapKey k : others) {
    MotionMap map(grid);
    EXPECT_EQ(read_checkpoint(path, k, map), Resumed::other_question);
    EXPECT_EQ(map.done(), 0u);
  }
}

TEST_F(Checkpoint, DoesNotDependOnNames) {
  Joint renamed = joint;
  renamed.name = renamed.fixed.name = "something else";
  EXPECT_EQ(map_key(renamed, {}, grid), key);
}

TEST_F(Checkpoint, IsNothingWhereThereIsNoFile) {
  MotionMap map(grid);
  EXPECT_EQ(read_checkpoint(path, key, map), Resumed::nothing);
}

TEST_F(Checkpoint, CutAnywhereOrWithAnyByteChangedIsRefused) {
  write_checkpoint(path, interrupted_map(2), key);
  const std::string whole = contents();
  const auto expect_refused = [&](const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
    MotionMap map(grid);
    EXPECT_THROW(read_checkpoint(path, key, map), FileError);
    EXPECT_EQ(map.done(), 0u);
  };
  for (std::size_t length = 0; length < whole.size(); length += 7) expect_refused(whole.substr(0, length));
  for (std::size_t i = 0; i < whole.size(); i += 3) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ 0x10);
    expect_refused(changed);
  }
  expect_refused(whole + "x");
}

}  // namespace
}  // namespace condyle::test
