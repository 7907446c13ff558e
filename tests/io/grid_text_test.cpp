#include "io/joint/grid_text.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

void expect_axis(std::string_view text, JointAngle angle, double first, double last, double step) {
  const motion::GridAxis axis = io::parse_grid_axis(text, Anatomy::hip);
  EXPECT_EQ(axis.coordinate, angle);
  EXPECT_EQ(axis.first, first);
  EXPECT_EQ(axis.last, last);
  EXPECT_EQ(axis.step, step);
}

TEST(GridText, ReadsFirstLastAndStep) {
  expect_axis("flexion=-20:120:1", JointAngle::flexion, -20, 120, 1);
  expect_axis("adduction=-40:30:0.5", JointAngle::adduction, -40, 30, 0.5);
  expect_axis("internal_rotation=0:30", JointAngle::internal_rotation, 0, 30, 1);
  expect_axis("flexion=15", JointAngle::flexion, 15, 15, 1);
}

TEST(GridText, IsReadBackToTheLastBit) {
  const motion::GridAxis axis{JointAngle::adduction, 0.1, 1.0 / 3, 1e-7};
  const motion::GridAxis again = io::parse_grid_axis(io::to_text(axis, Anatomy::hip), Anatomy::hip);
  EXPECT_EQ(again.first, axis.first);
  EXPECT_EQ(again.last, axis.last);
  EXPECT_EQ(again.step, axis.step);
}

TEST(GridText, RefusesWhatIsNotAnAxis) {
  for (const char* text : {"", "flexion", "flexion=", "flexion=a", "flexion=1:", "flexion=1:2:3:4", "=1:2",
                           "flexion=1:2:nan", "flexion=1:inf", "flexion=1 :2", "knee=1:2", "flexion=0x1"})
    EXPECT_THROW(io::parse_grid_axis(text, Anatomy::hip), UsageError) << text;
}

TEST(GridText, AnAngleIsHeldOnceAndOnlyIfItIsOnNoAxis) {
  const auto grid = [](std::vector<std::string> more) {
    more.insert(more.begin(), {"flexion=0:60:30", "x=0:1"});
    return io::parse_grid(more, "z", Anatomy::hip);
  };
  EXPECT_EQ(grid({"adduction=10"}).held.angles.adduction, Angle::degrees(10));
  for (const char* text : {"adduction=20", "flexion=0", "x=1", "internal_rotation=1:2"})
    EXPECT_THROW(grid({"adduction=10", text}), UsageError) << text;
}

}  // namespace
}  // namespace condyle
