#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "condyle/error.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/range_of_motion.hpp"

/// [[motion]] tables of joint files.

namespace condyle {
namespace {

class JointFileMotions : public testing::Test {
 protected:
  void SetUp() override {
    path_ =
        std::filesystem::path(testing::TempDir()) /
        (std::string("motions_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".toml");
  }
  void TearDown() override { std::filesystem::remove(path_); }

  io::JointFile read(const std::string& motions, const std::string& kind = "ball") const {
    std::ofstream(path_)
        << "condyle = 1\nname = \"hip\"\nkind = \"" << kind
        << "\"\nside = \"right\"\nunits = \"mm\"\n[fixed]\nmesh = \"a.ply\"\n[mobile]\nmesh = \"b.ply\"\n"
           "[frame]\ncentre = [0, 0, 0]\nanterior = [1, 0, 0]\nsuperior = [0, 1, 0]\n"
        << motions;
    return io::read_joint_file(path_);
  }
  void expect_refused(const std::string& motions, const std::string& why,
                      const std::string& kind = "ball") const {
    try {
      read(motions, kind);
      ADD_FAILURE() << "accepted: " << motions;
    } catch (const FileError& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find(why), std::string::npos) << why << " is not in: " << text;
      EXPECT_NE(text.find(": line "), std::string::npos) << text;
      EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    }
  }

  std::filesystem::path path_;
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
  expect_refused("[[motion]]\nname = \"a\"\nvary = \"adduction\"\nrange = [0, 9]\n",
                 "motion[0].vary: a hinge", "hinge");
  expect_refused("[[motion]]\nname = \"a\"\nvary = \"flexion\"\nrange = [0, 9]\nadduction = 1\n",
                 "motion[0].adduction: a hinge", "hinge");
}

TEST_F(JointFileMotions, ThatMakeNoSenseAreRefusedByLineAndKey) {
  const std::string good = "[[motion]]\nname = \"a\"\nvary = \"flexion\"\nrange = [0, 9]\n";
  expect_refused("[[motion]]\nvary = \"flexion\"\nrange = [0, 9]\n", "motion[0].name: is missing");
  expect_refused("[[motion]]\nname = \"\"\nvary = \"flexion\"\nrange = [0, 9]\n",
                 "motion[0].name: must not be empty");
  expect_refused("[[motion]]\nname = \"a\"\nrange = [0, 9]\n", "motion[0].vary: is missing");
  expect_refused("[[motion]]\nname = \"a\"\nvary = \"flexoin\"\nrange = [0, 9]\n", "unknown angle 'flexoin'");
  expect_refused("[[motion]]\nname = \"a\"\nvary = \"flexion\"\n", "motion[0].range: is missing");
  expect_refused("[[motion]]\nname = \"a\"\nvary = \"flexion\"\nrange = 9\n", "list of two numbers");
  expect_refused("[[motion]]\nname = \"a\"\nvary = \"flexion\"\nrange = [1, 2, 3]\n", "not of 3");
  expect_refused("[[motion]]\nname = \"a\"\nvary = \"flexion\"\nrange = [9, 9]\n",
                 "motion[0].range: is empty");
  expect_refused("[[motion]]\nname = \"a\"\nvary = \"flexion\"\nrange = [0, 400]\n", "more than a full turn");
  expect_refused("[[motion]]\nname = \"a\"\nvary = \"flexion\"\nrange = [0, inf]\n", "finite");
  expect_refused(good + "flexion = 3\n", "motion[0].flexion: is the angle that varies");
  expect_refused(good + "adduction = \"x\"\n", "motion[0].adduction: must be a number");
  expect_refused(good + "knee = 3\n", "motion[0].knee: unknown key");
  expect_refused(good + good, "motion[1].name: \"a\" is given twice");
}

}  // namespace
}  // namespace condyle
