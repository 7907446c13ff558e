#include "condyle/motion_contact.hpp"
#include "support/test.hpp"

namespace condyle::motion {
namespace {

using Frames = std::vector<std::optional<FrameContact>>;

/// A bob swings about a level line, 12 mm over a floor, and slides along it: a motion whose screw is known.
class Swing : public ::testing::Test {
 protected:
  const contact::JointContact joint{test::box({-80, -30, -80}, {90, 0, 70}),
                                    test::box({-2, -3, -1}, {4, 1, 5})};
  const double height = 12;
  const Vec3 direction = Vec3(1, 0, 2).normalized(), point{7, height, -3};

  FrameContact swung(double degrees, double along_mm = 0) const {
    Pose X = Pose::Identity();
    X.linear() = Eigen::AngleAxisd(Angle::degrees(degrees).radians(), direction).toRotationMatrix();
    X.translation() = point + along_mm * direction + X.linear() * Vec3(0, -14, 0);
    return {.X_FM = X, .in_contact = joint.in_contact(X)};
  }
  /// Angle and arc in closed form: a vertex below the line by the radius r leaves the floor where cos = h / r on either side.
  std::pair<double, double> deepest_at(const Pose& X) const {
    double angle = 0, arc = 0;
    for (std::size_t v = 0; v < joint.mobile().vertices().size(); ++v) {
      const Vec3 from = X * joint.mobile().vertices()[v] - point;
      if (from.y() > -height) continue;
      const double x = from.dot(Vec3::UnitY().cross(direction)), r = std::hypot(x, from.y());
      const double depth = std::acos(height / r) - std::abs(std::atan2(x, -from.y()));
      angle = std::max(angle, depth), arc = std::max(arc, r * depth);
    }
    return {angle, arc};
  }
};

TEST_F(Swing, DepthsAreAboutTheLineThatItSwingsAbout) {
  Frames frames;
  for (int i = 0; i < 60; ++i) frames.emplace_back(swung(2.5 * (30 - i), 0.3 * i));
  const auto steps = *screws_along(joint, frames);
  int deep = 0;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const auto& [rotation, axis, depth, depth_mm] = *steps[i];
    EXPECT_NEAR(rotation.degrees(), 2.5, 1e-11);
    // It swings back: the sense is the other one.
    EXPECT_LT((axis->direction + direction).norm(), 1e-12);
    EXPECT_LT((axis->point - point).cross(direction).norm(), 1e-10);
    EXPECT_LT(std::abs((axis->point - frames[i]->X_FM.translation()).dot(direction)), 1e-10);
    const auto [angle, arc] = deepest_at(frames[i]->X_FM);
    EXPECT_NEAR(depth->radians(), angle, 1e-11) << i;
    EXPECT_NEAR(*depth_mm, arc, 1e-10) << i;
    if (angle > 0) ++deep;
  }
  EXPECT_TRUE(deep > 10 && deep < 50) << deep;
}

TEST_F(Swing, NoRotationFreesWhatIsDeepInsideAllTheWayRound) {
  const contact::JointContact buried(test::box({-80, -80, -80}, {80, 80, 80}), joint.mobile());
  Frames frames{swung(0), swung(5)};
  for (auto& frame : frames) frame->in_contact = true;
  const auto steps = *screws_along(buried, frames);
  EXPECT_TRUE(steps[1]->axis);
  EXPECT_FALSE(steps[1]->depth || steps[1]->depth_mm);
}

TEST_F(Swing, SlidesGapsAndHalfTurnsHaveNoAxis) {
  const FrameContact deep = swung(0);
  FrameContact slid = deep;
  slid.X_FM.translation() += Vec3(1, 0, 0);
  const Frames frames{deep, slid, deep, swung(0.9 * slide_below_deg), std::nullopt, deep, deep, swung(180)};
  const auto steps = *screws_along(joint, frames);
  for (const std::size_t none : {0u, 4u, 5u}) EXPECT_FALSE(steps[none]) << none;
  for (const std::size_t slide : {1u, 2u, 3u, 6u}) {
    EXPECT_TRUE(steps[slide]->is_slide()) << slide;
    EXPECT_FALSE(steps[slide]->axis || steps[slide]->depth || steps[slide]->depth_mm) << slide;
  }
  EXPECT_FALSE(steps[7]->is_slide() || steps[7]->axis);
  EXPECT_THROW(screws_along(contact::JointContact(test::plane(5, 2), test::plane(5, 2)), frames), UsageError);
}

}  // namespace
}  // namespace condyle::motion
