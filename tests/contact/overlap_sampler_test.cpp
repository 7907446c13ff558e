#include "contact/overlap_sampler.hpp"

#include "support/test.hpp"

/// Rays of closed targets: those that begin outside are left out if a radial table finds them.

namespace condyle::contact {
namespace {

OverlapSampler::Results found_at(const OverlapSampler& sampler, const Pose& X_CT) {
  OverlapSampler::Results found;
  sampler.sample(X_CT, Quadrature::of_degree_2, {}, found);
  return found;
}

class OfAClosedTarget : public testing::TestWithParam<FaceRule> {};

TEST_P(OfAClosedTarget, RaysFromOutsideAreNotCastAndNothingIsMissed) {
  const TriMesh ball = test::sphere(Vec3::Zero(), 24.8, 4), cup = test::socket(Vec3::Zero(), 25, 27, 4);
  Pose X_CT = Pose::Identity();
  X_CT.linear() = Eigen::AngleAxisd(0.6, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  X_CT.translation() = Vec3(0.2, 0.5, -0.3);
  const NormalDepthOptions options{.rule = GetParam(), .reach_mm = 10};
  const OverlapSampler about_centre(ball, cup, options);

  // With the origin just off the target's surface no table is asked, and every ray is cast.
  const Vec3 off(0, 0, 24.999);
  Pose X_off = X_CT;
  X_off.translation() += X_CT.linear() * off - off;
  const OverlapSampler about_surface(test::shifted_by(ball, -off), test::shifted_by(cup, -off), options);

  const auto some = found_at(about_centre, X_CT), all = found_at(about_surface, X_off);
  EXPECT_LT(some.rays, all.rays - 500);
  ASSERT_EQ(some.samples.size(), all.samples.size());
  ASSERT_GT(some.samples.size(), 100u);
  EXPECT_EQ(some.rim_faces, all.rim_faces);
  // Coordinates of 50 mm round by 4e-15; where a face is cut, by up to some thousand times that: a ratio of small depths.
  for (std::size_t i = 0; i < some.samples.size(); ++i) {
    const auto &a = some.samples[i], &b = all.samples[i];
    EXPECT_EQ(a.face, b.face);
    EXPECT_NEAR(a.depth, b.depth, 1e-12);
    EXPECT_NEAR(a.area, b.area, 1e-10);
    EXPECT_LE((a.point - (b.point + off)).norm(), 1e-10);
    EXPECT_LE((a.gradient - b.gradient).norm(), 1e-9);
  }
}

TEST_P(OfAClosedTarget, ThatIsAHollowEveryRayIsCast) {
  // A ball in a hollow ball, all that surrounds it being solid: what is nearest comes from outside, by winding numbers.
  const OverlapSampler sampler(test::sphere(Vec3::Zero(), 24.8, 4),
                               test::flipped(test::sphere(Vec3::Zero(), 25, 4)), {.rule = GetParam()});
  Pose X_CT = Pose::Identity();
  X_CT.translation() = Vec3(0, 0.5, 0);
  const auto found = found_at(sampler, X_CT);
  EXPECT_GE(found.rays, GetParam() == FaceRule::face_centre ? sampler.casting().triangles().size()
                                                            : sampler.casting().vertices().size());
  EXPECT_GT(found.samples.size(), 0u);
}

INSTANTIATE_TEST_SUITE_P(Rules, OfAClosedTarget, testing::Values(FaceRule::face_centre, FaceRule::cut_faces));

}  // namespace
}  // namespace condyle::contact
