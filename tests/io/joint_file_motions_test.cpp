#include "condyle/io/joint_file.hpp"
#include "condyle/range_of_motion.hpp"
#include "support/joint_text.hpp"
#include "support/test.hpp"

/// [[motion]] tables of joint files.

namespace condyle {
namespace {

class JointFileMotions : public testing::Test {
 protected:
  io::JointFile read(std::string_view motions, std::string_view kind = "ball") const {
    return io::read_joint_file(folder_.file("joint.toml", test::joint_text({.kind = kind, .more = motions})));
  }
  void expect_refused(std::string_view kind, const std::vector<test::Refusal>& all) const {
    for (const auto& [motions, says] : all) {
      const std::string text = test::complaint_of<FileError>([&] { read(motions, kind); });
      test::expect_says(text, says);
      test::expect_says(text, ": line ");
      test::expect_silent(text, "\n");
    }
  }

  const test::TemporaryFolder folder_;
};

TEST_F(JointFileMotions, OfVeryManyNamesAreComparedWithoutTheSquareOfTheirNumber) {
  constexpr int many = 100'000;
  std::string text;
  for (int i = 0; i < many; ++i)
    text += "[[motion]]\nname = \"k" + std::to_string(i) + "\"\nvary = \"flexion\"\nrange = [0, 1]\n";
  const std::vector<motion::Motion> own = read(text).motions;
  ASSERT_EQ(own.size(), static_cast<std::size_t>(many));
  const std::vector<motion::Motion> all = motion::with_own_motions(motion::hip_motions(), own);
  EXPECT_EQ(all.size(), motion::hip_motions().size() + own.size());
  EXPECT_EQ(all.back().name, "k99999");
}

TEST_F(JointFileMotions, AreReadInTheirOrder) {
  const io::JointFile file = read(
      "[[motion]]\nname = \"kick\"\nvary = \"internal_rotation\"\nrange = [-5, 60]\nflexion = 90\nadduction "
      "= 12.5\n"
      "[[motion]]\nname = \"fadir\"\nvary = \"adduction\"\nrange = [10, -30]\n");
  ASSERT_EQ(file.motions.size(), 2u);
  const motion::Motion &kick = file.motions[0], &fadir = file.motions[1];
  EXPECT_EQ(kick.name, "kick");
  EXPECT_EQ(kick.vary, JointAngle::internal_rotation);
  EXPECT_EQ(kick.sense, RotationSense::positive);
  EXPECT_EQ(kick.start, (JointAngles{Angle::degrees(90), Angle::degrees(12.5), Angle::degrees(-5)}));
  EXPECT_EQ(kick.range, Angle::degrees(65));
  EXPECT_EQ(fadir.vary, JointAngle::adduction);
  EXPECT_EQ(fadir.sense, RotationSense::negative);
  EXPECT_EQ(fadir.start, (JointAngles{Angle(), Angle::degrees(10), Angle()}));
  EXPECT_EQ(fadir.range, Angle::degrees(40));
}

TEST_F(JointFileMotions, NeedNotBeThere) {
  EXPECT_TRUE(read("").motions.empty());
}

TEST_F(JointFileMotions, OfAHingeRotateInFlexionOnly) {
  EXPECT_EQ(read("[[motion]]\nname = \"a\"\nvary = \"flexion\"\nrange = [0, 9]\nadduction = 0\n", "hinge")
                .motions.size(),
            1u);
  expect_refused("hinge", {{"[[motion]]\nname = \"a\"\nvary = \"adduction\"\nrange = [0, 9]\n",
                            "motion[0].vary: a hinge"},
                           {"[[motion]]\nname = \"a\"\nvary = \"flexion\"\nrange = [0, 9]\nadduction = 1\n",
                            "motion[0].adduction: a hinge"}});
}

TEST_F(JointFileMotions, ThatMakeNoSenseAreRefusedByLineAndKey) {
  const std::string a = "[[motion]]\nname = \"a\"\n", flexion = a + "vary = \"flexion\"\n",
                    good = flexion + "range = [0, 9]\n";
  expect_refused("ball", {{"[[motion]]\nvary = \"flexion\"\nrange = [0, 9]\n", "motion[0].name: is missing"},
                          {"[[motion]]\nname = \"\"\nvary = \"flexion\"\nrange = [0, 9]\n",
                           "motion[0].name: must not be empty"},
                          {a + "range = [0, 9]\n", "motion[0].vary: is missing"},
                          {a + "vary = \"flexoin\"\nrange = [0, 9]\n", "unknown angle 'flexoin'"},
                          {flexion, "motion[0].range: is missing"},
                          {flexion + "range = 9\n", "list of two numbers"},
                          {flexion + "range = [1, 2, 3]\n", "not of 3"},
                          {flexion + "range = [9, 9]\n", "motion[0].range: is empty"},
                          {flexion + "range = [0, 400]\n", "more than a full turn"},
                          {flexion + "range = [0, inf]\n", "finite"},
                          {good + "flexion = 3\n", "motion[0].flexion: is the angle that varies"},
                          {good + "adduction = \"x\"\n", "motion[0].adduction: must be a number"},
                          {good + "knee = 3\n", "motion[0].knee: unknown key"},
                          {good + good, "motion[1].name: \"a\" is given twice"}});
}

}  // namespace
}  // namespace condyle
