#include "condyle/range_of_motion.hpp"
#include "io/sweep/target_table.hpp"
#include "support/test.hpp"

/// Contents that a table of targets may have, and those that are refused.

namespace condyle::test {
namespace {

std::vector<plan::SweepTarget> targets_in(std::string_view text) {
  return io::parse_targets(text, "daily.csv", motion::hip_motions(), JointKind::ball, Anatomy::hip);
}

std::string target_refusal(std::string_view text) {
  return complaint_of<FileError>([&] { targets_in(text); });
}

TEST(TargetTable, HasMotionsByTheirNamesOrByStartAndMovement) {
  const std::vector<plan::SweepTarget> targets = targets_in(
      "# what a day needs\r\n"
      "name,motion,start,movement,reach_deg,range_deg,pelvic_tilt_deg,source\r\n"
      "\r\n"
      "sitting,flexion,,,110,,-15.5,\"Somebody, 2001\"\r\n"
      "  # legs crossed\r\n"
      "tailor,,\"flexion=80, adduction=-20\",external_rotation,45,60,,\r\n"
      "stooping,,,flexion,130,,,\r\n");
  ASSERT_EQ(targets.size(), 3u);
  const motion::Motion flexion = motion::motion_named(motion::hip_motions(), "flexion");
  EXPECT_EQ(targets[0].name, "sitting");
  EXPECT_EQ(targets[0].motion.name, "flexion");
  EXPECT_EQ(targets[0].motion.range, flexion.range);
  EXPECT_EQ(targets[0].reach, Angle::degrees(110));
  EXPECT_EQ(targets[0].pelvic_tilt, Angle::degrees(-15.5));
  EXPECT_EQ(targets[0].source, "Somebody, 2001");
  // A pose of flexion f at an anterior tilt t is that of flexion f + t without.
  EXPECT_NEAR(targets[0].without_tilt().start.flexion.degrees(), -15.5, 1e-12);
  EXPECT_EQ(targets[1].motion.name, "tailor");
  EXPECT_EQ(targets[1].motion.vary, JointAngle::internal_rotation);
  EXPECT_EQ(targets[1].motion.sense, RotationSense::negative);
  EXPECT_EQ(targets[1].motion.start.flexion, Angle::degrees(80));
  EXPECT_EQ(targets[1].motion.start.adduction, Angle::degrees(-20));
  EXPECT_EQ(targets[1].motion.range, Angle::degrees(60));
  EXPECT_EQ(targets[1].pelvic_tilt, Angle());
  EXPECT_EQ(targets[1].source, "");
  // Without a range of its own: 120 degrees, or as far as it must reach.
  EXPECT_EQ(targets[2].motion.range, Angle::degrees(130));
}

TEST(TargetTable, NeedsNoColumnsButNameAndReach) {
  const std::vector<plan::SweepTarget> targets = targets_in("reach_deg,name,motion\n30,sleeping,Extension\n");
  ASSERT_EQ(targets.size(), 1u);
  EXPECT_EQ(targets[0].motion.name, "extension");
  const TemporaryFolder folder;
  const auto path = folder.file("daily.csv", "reach_deg,name,motion\n30,sleeping,extension\n");
  EXPECT_EQ(io::read_targets(path, motion::hip_motions(), JointKind::ball, Anatomy::hip).size(), 1u);
}

TEST(TargetTable, IsRefusedWithFileLineAndColumnInOneLine) {
  const std::string header = "name,motion,reach_deg\n";
  const auto expect = [](const std::string& text, std::string_view saying) {
    EXPECT_EQ(target_refusal(text), "daily.csv: " + std::string(saying)) << text;
  };
  expect("", "has no names of columns");
  expect("# nothing\n\n", "has no names of columns");
  expect(header, "has no target");
  expect("name,motion,reach\na,flexion,20\n",
         "line 1: there is no column 'reach'; there are name, motion, start, movement, reach_deg, range_deg, "
         "pelvic_tilt_deg, weight, source");
  expect("name,name,reach_deg\na,a,20\n", "line 1: column 'name' is there twice");
  expect("name,motion\na,flexion\n", "line 1: there is no column reach_deg");
  expect("\n# note\nmotion,reach_deg\nflexion,20\n", "line 3: there is no column name");
  expect(header + "a,flexion\n", "line 2: has 2 fields, and the header 3");
  expect(header + "a,flexion,20,30\n", "line 2: has 4 fields, and the header 3");
  expect(header + "a,\"flexion,20\n", "line 2: a quote is not closed");
  expect(header + ",flexion,20\n", "line 2: name: is empty");
  expect(header + "a,flexion,20\n\nb,extension,10\na,flexion,30\n", "line 5: name: 'a' is given twice");
  expect(header + "a,,20\n", "line 2: motion: must name a motion, or start and movement say one");
  expect(header + "a,flexion,\n", "line 2: reach_deg: must say how far the motion has to turn");
  expect(header + "a,flexion,far\n", "line 2: reach_deg: 'far' is no number");
  expect(header + "a,flexion,inf\n", "line 2: reach_deg: 'inf' is no number");
  for (const char* reach : {"0", "-5", "180.5"})
    expect(header + "a,flexion," + reach + "\n",
           std::string("line 2: reach_deg: ") + reach + " must be above 0 and up to the motion's range, 180");
  expect("name,motion,movement,reach_deg\na,flexion,flexion,20\n",
         "line 2: movement: the motion that is named has its own");
  expect("name,motion,start,reach_deg\na,flexion,flexion=10,20\n",
         "line 2: start: the motion that is named has its own");
  expect("name,motion,reach_deg,range_deg\na,flexion,20,30\n",
         "line 2: range_deg: the motion that is named has its own");
  expect("name,start,reach_deg\na,flexion=90,20\n",
         "line 2: movement: must say which angle grows from the start: flexion, extension, adduction, "
         "abduction, internal_rotation, external_rotation");
  expect("name,movement,reach_deg\na,wink,20\n",
         "line 2: movement: 'wink' is none; there are flexion, extension, adduction, abduction, "
         "internal_rotation, external_rotation");
  expect("name,motion,reach_deg,pelvic_tilt_deg\na,flexion,20,forwards\n",
         "line 2: pelvic_tilt_deg: 'forwards' is no number");
  expect_begins(target_refusal(header + "a,flexoin,20\n"),
                "daily.csv: line 2: motion: unknown motion \"flexoin\"");
  expect_begins(target_refusal("name,start,movement,reach_deg\na,yaw=3,flexion,20\n"),
                "daily.csv: line 2: start: ");
  for (const auto& text :
       {header + "a,flexoin,20\n", std::string("name,start,movement,reach_deg\na,yaw=3,flexion,20\n")})
    expect_silent(target_refusal(text), "\n");
}

}  // namespace
}  // namespace condyle::test
