#include <fmt/format.h>

#include "condyle/io/joint_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "support/joint_text.hpp"
#include "support/test.hpp"

/// Columns of speeds beside those of values become velocities of the mobile body.

namespace condyle {
namespace {

/// A knee with the columns of OpenSim's states.
class RecordedSpeeds : public testing::Test {
 protected:
  static io::LoadedJoint knee_in(const test::TemporaryFolder& folder) {
    io::write_mesh(folder / "body.ply", test::box({-11, -95, -7}, {13, -20, 9}));
    return io::read_joint(folder.file(
        "knee.toml",
        test::joint_text({.kind = "free",
                          .keys = "joint = \"knee\"\n",
                          .fixed = "mesh = \"body.ply\"",
                          .mobile = "mesh = \"body.ply\"",
                          .more =
                              "[recorded_motion]\nflexion = { column = \"bend\", sign = -1, offset = 4 }\n"
                              "adduction = \"tilt\"\ninternal_rotation = \"turn\"\n"
                              "x = { column = \"tx\", unit = \"m\" }\n"})));
  }

  io::MotionTable table(const std::string& columns, const std::string& rows,
                        const std::string& header = "inDegrees=no") const {
    return io::read_motion_table(
        folder_.file("states.sto", header + "\nendheader\n" + columns + "\n" + rows + "\n"));
  }

  test::TemporaryFolder folder_;
  io::LoadedJoint knee_ = knee_in(folder_);
};

const std::string four =
    "time /j/k/bend/value /j/k/bend/speed /j/k/tilt/value /j/k/tilt/speed /j/k/turn/value /j/k/turn/speed "
    "/j/k/tx/value /j/k/tx/speed";

TEST_F(RecordedSpeeds, AreOfTheAxisThatTurns) {
  // Flexion turns about -z, here by -2 rad/s: the column's sense is the other one.
  const auto speeds = io::recorded_speeds(
      knee_, table(four, "0 0.3 2 0 0 0 0 0.01 0.25\n1 0.3 0 0 0 0 0 0.01 0\n2 nan 0 0 0 0 0 0 0"));
  ASSERT_EQ(speeds.size(), 3u);
  EXPECT_LT((speeds[0]->angular_velocity_rad_s - Vec3(0, 0, 2)).norm(), 1e-9);
  EXPECT_LT((speeds[0]->velocity_mm_s - Vec3(250, 0, 0)).norm(), 1e-7);
  EXPECT_EQ(speeds[1]->angular_velocity_rad_s, Vec3(0, 0, 0));
  EXPECT_FALSE(speeds[2].has_value());
}

TEST_F(RecordedSpeeds, AreThoseOfThePosesBeforeAndAfter) {
  const auto q = [](double t) {
    return std::vector<double>{0.9 * std::sin(t), 0.4 * std::sin(2 * t + 1), 0.6 * std::cos(t),
                               0.02 * std::cos(3 * t)};
  };
  const auto speed = [](double t) {
    return std::vector<double>{0.9 * std::cos(t), 0.8 * std::cos(2 * t + 1), -0.6 * std::sin(t),
                               -0.06 * std::sin(3 * t)};
  };
  const double h = 1e-4;
  for (const bool in_degrees : {false, true}) {
    const double unit = in_degrees ? 180 / std::acos(-1.0) : 1;
    std::string rows;
    for (int i = 0; i < 8; ++i)
      for (const double t : {0.5 * i - h, 0.5 * i, 0.5 * i + h}) {
        rows += fmt::format("{}{}", rows.empty() ? "" : "\n", t);
        for (std::size_t k = 0; k < 4; ++k)
          rows += fmt::format(" {} {}", (k < 3 ? unit : 1) * q(t)[k], (k < 3 ? unit : 1) * speed(t)[k]);
      }
    const io::MotionTable states = table(four, rows, in_degrees ? "inDegrees=yes" : "inDegrees=no");
    const auto speeds = io::recorded_speeds(knee_, states);
    const auto X_FM = io::motion_of(knee_, states).X_FM;
    for (std::size_t i = 1; i < X_FM.size(); i += 3) {
      // The third derivatives are below 30 mm/s^3 for one, so that these differences are right to 1e-7.
      const Eigen::Matrix4d slope = (X_FM[i + 1]->matrix() - X_FM[i - 1]->matrix()) / (2 * h);
      const Eigen::Matrix3d spin = slope.topLeftCorner<3, 3>() * X_FM[i]->linear().transpose();
      EXPECT_LT((speeds[i]->velocity_mm_s - Vec3(slope.topRightCorner<3, 1>())).norm(), 1e-6) << i;
      EXPECT_LT((speeds[i]->angular_velocity_rad_s - Vec3(spin(2, 1), spin(0, 2), spin(1, 0))).norm(), 1e-7)
          << i;
    }
  }
}

TEST_F(RecordedSpeeds, AreNoneWhereAColumnThatIsNeededHasNone) {
  const auto of_all =
      io::recorded_speeds(knee_, table("time /j/k/bend/value /j/k/bend/speed /j/k/tilt/value /j/k/turn/value "
                                       "/j/k/turn/speed /j/k/tx/value /j/k/tx/speed",
                                       "0 0.3 2 0 0 0 0 0"));
  ASSERT_EQ(of_all.size(), 1u);
  EXPECT_FALSE(of_all[0].has_value());
  EXPECT_TRUE(
      io::recorded_speeds(
          knee_, table("time /j/k/bend/value /j/k/tilt/value /j/k/turn/value /j/k/tx/value", "0 0.3 0 0 0"))
          .empty());
  // What the joint does not need may be without.
  EXPECT_TRUE(
      io::recorded_speeds(knee_, table(four + " /j/hip/value activation", "0 0.3 2 0 0 0 0 0 0 0 0"))[0]
          .has_value());
}

}  // namespace
}  // namespace condyle
