#include "motion/recorded/screw_motion.hpp"
#include "support/test.hpp"

/// Screw motions hold what defines them: both poses, one line, one speed.

namespace condyle::motion {
namespace {

using motion::ScrewMotion;

constexpr double reach_mm = 100;

class RandomPoses {
 public:
  explicit RandomPoses(unsigned seed) : random_(seed) {}

  Vec3 direction() {
    std::normal_distribution<double> normal;
    return Vec3(normal(random_), normal(random_), normal(random_)).normalized();
  }
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Pose pose(double angle, double shift_mm) {
    Pose X = Pose::Identity();
    X.linear() = Eigen::AngleAxisd(angle, direction()).toRotationMatrix();
    X.translation() = shift_mm * direction();
    return X;
  }

 private:
  std::mt19937 random_;
};

TEST(ScrewMotion, GoesFromOnePoseToTheOther) {
  RandomPoses random(1);
  for (int i = 0; i < 1000; ++i) {
    // From rotations that are barely any to nearly half a turn.
    const double angle = std::pow(10, random.between(-12, std::log10(3.1)));
    const Pose from = random.pose(random.between(0, 3), 50), to = random.pose(angle, 3) * from;
    const ScrewMotion motion(from, to, reach_mm);
    EXPECT_TRUE(motion.at(0).isApprox(from, 0));
    EXPECT_LT((motion.at(1).matrix() - to.matrix()).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_NEAR(motion.rotation().radians(), angle, 1e-14);
  }
}

TEST(ScrewMotion, TurnsAboutOneLineAtOneSpeed) {
  RandomPoses random(2);
  for (int i = 0; i < 200; ++i) {
    const Pose from = random.pose(random.between(0, 3), 50),
               to = random.pose(random.between(1e-3, 3), 20) * from;
    const ScrewMotion motion(from, to, reach_mm);
    // One step of a tenth, again and again, is the whole way: all steps are one rigid motion of F.
    const Pose step = motion.at(0.1) * from.inverse();
    Pose X = from;
    for (int k = 1; k <= 10; ++k) {
      X = step * X;
      EXPECT_LT((motion.at(k / 10.0).matrix() - X.matrix()).cwiseAbs().maxCoeff(), 1e-10);
    }
    // A thousandth of the way is an arc longer than its chord by (angle / 1000)^2 / 24 of it.
    const double origin_step = (motion.at(0.501).translation() - motion.at(0.5).translation()).norm();
    EXPECT_NEAR(motion.speed().origin_mm, 1000 * origin_step, 1e-6 * 1000 * origin_step);
    const Vec3 p = reach_mm * random.direction();
    EXPECT_LE((motion.at(0.501) * p - motion.at(0.5) * p).norm() * 1000,
              motion.speed().rotation * reach_mm + motion.speed().origin_mm);
  }
}

TEST(ScrewMotion, WithoutRotationIsAStraightLine) {
  RandomPoses random(3);
  const Pose from = random.pose(1, 50);
  Pose to = from;
  to.translation() += Vec3(3, -4, 12);
  const ScrewMotion motion(from, to, reach_mm);
  EXPECT_EQ(motion.rotation().radians(), 0);
  EXPECT_FALSE(motion.holds_origin());
  EXPECT_LT((motion.at(0.25).translation() - (from.translation() + Vec3(0.75, -1, 3))).norm(), 1e-13);
  EXPECT_NEAR(motion.speed().origin_mm, 13, 1e-10);
}

TEST(ScrewMotion, HoldsItsOriginWhereTranslationsDifferByRoundingOnly) {
  RandomPoses random(4);
  const Pose from = random.pose(1, 50);
  Pose to = random.pose(0.1, 0) * from;
  to.translation() = from.translation();
  EXPECT_TRUE(ScrewMotion(from, to, reach_mm).holds_origin());
  EXPECT_EQ(ScrewMotion(from, to, reach_mm).at(0.3).translation(), from.translation());
  EXPECT_EQ(ScrewMotion(from, to, reach_mm).speed().origin_mm, 0);
  // 4 * 2^-53 * (100 + 50) mm is 6.7e-14 mm.
  to.translation().x() += 2e-14;
  EXPECT_TRUE(ScrewMotion(from, to, reach_mm).holds_origin());
  to.translation().x() += 2e-13;
  EXPECT_FALSE(ScrewMotion(from, to, reach_mm).holds_origin());
  EXPECT_TRUE(ScrewMotion(from, from, reach_mm).is_still());
  EXPECT_FALSE(ScrewMotion(from, to, reach_mm).is_still());
}

}  // namespace
}  // namespace condyle::motion
