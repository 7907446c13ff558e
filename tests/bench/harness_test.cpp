#include "baseline.hpp"
#include "commands.hpp"
#include "growth.hpp"
#include "scenes.hpp"
#include "support/test.hpp"

namespace bench {
namespace {

TEST(Growth, APowerLawIsFoundAgain) {
  std::vector<SizeAndCost> measured;
  for (const double size : {100.0, 400.0, 1600.0, 6400.0})
    measured.push_back({size, 3 * std::pow(size, 0.75)});
  ASSERT_TRUE(fitted_exponent(measured).has_value());
  EXPECT_NEAR(*fitted_exponent(measured), 0.75, 1e-12);
}

TEST(Growth, TwoSizesAreNoGrowth) {
  const std::array<SizeAndCost, 2> two = {{{1, 1}, {2, 2}}};
  EXPECT_FALSE(fitted_exponent(two).has_value());
}

TEST(Baseline, OnlyWhatGotClearlyWorseIsTold) {
  const Ratios before = {{"a", 10}, {"b", 10}, {"c", 10}, {"gone", 5}};
  const Ratios now = {{"a", 9}, {"b", 7}, {"c", 2}, {"new", 1}};
  const std::vector<std::string> lines = worse_than(before, now);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0], "c: 2 times Condyle's time, was 10");
  EXPECT_EQ(lines[1], "b: 7 times Condyle's time, was 10");
}

TEST(Baseline, AWholeCommandThatLostATenthIsTold) {
  const Ratios before{{"command/hip/depth", 0.5}, {"command/hip/rom", 0.25}, {"pairs/hip/fcl", 5}};
  const Ratios now{{"command/hip/depth", 0.44}, {"command/hip/rom", 0.24}, {"pairs/hip/fcl", 4.4}};
  const auto lines = worse_than(before, now);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0], "command/hip/depth: 2.27 times as long as inspect, was 2");
}

TEST(Commands, OfTheSampleAnswerAndAreComparedWithReadingItsMeshes) {
  const auto joints = command_joints(Effort::quick);
  ASSERT_EQ(joints, std::vector<std::string>{"sample_1"});
  Report report;
  const Ratios ratios = ask_commands(joints.front(), Effort::quick, report);
  EXPECT_TRUE(report.disagreements.empty());
  EXPECT_GT(ratios.at("command/sample_1/depth"), 0);
  EXPECT_EQ(ratios.count("command/sample_1/inspect"), 0u) << "it is what the others are compared with";
}

TEST(Baseline, IsReadAsItWasWritten) {
  const condyle::test::TemporaryFolder folder;
  const std::string file = (folder.path() / "baseline.json").string();
  const Ratios ratios = {{"inside/sample_1/a", 1.5}, {"touch/sample_1/b", 250}};
  std::ofstream(file) << baseline_text(ratios);
  EXPECT_EQ(read_baseline(file), ratios);
}

TEST(Baseline, AFileThatIsNoneIsNamed) {
  const condyle::test::TemporaryFolder folder;
  const std::string file = (folder.path() / "baseline.json").string();
  std::ofstream(file) << "[1, 2]";
  try {
    read_baseline(file);
    FAIL() << "read";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(file), std::string::npos);
  }
}

TEST(Scenes, PosesAreTheSameEachTimeAndTakeTurns) {
  const auto once = make_scene("ball_0.1mm_1"), again = make_scene("ball_0.1mm_1");
  ASSERT_TRUE(once && again);
  ASSERT_EQ(once->poses.size(), 128u);
  constexpr PoseKind in_turn[] = {PoseKind::free, PoseKind::grazing, PoseKind::deep};
  for (std::size_t i = 0; i < once->poses.size(); ++i) {
    EXPECT_TRUE(once->poses[i].X_FM.matrix() == again->poses[i].X_FM.matrix());
    EXPECT_EQ(once->poses[i].kind, in_turn[i % 3]);
  }
}

TEST(Scenes, ADeformedBodyMovesByAtMostAQuarterOfAMillimetre) {
  const auto scene = make_scene("ball_1mm_1");
  ASSERT_TRUE(scene);
  const condyle::Points& at_rest = scene->joint.fixed.mesh.vertices();
  double largest = 0;
  for (const int frame : {0, 1, 5}) {
    const condyle::Points moved = deformed(at_rest, frame);
    for (std::size_t i = 0; i < at_rest.size(); ++i)
      largest = std::max(largest, (moved[i] - at_rest[i]).norm());
  }
  EXPECT_LE(largest, 0.25 * (1 + 1e-12));
  EXPECT_GT(largest, 0.2);
}

}  // namespace
}  // namespace bench
