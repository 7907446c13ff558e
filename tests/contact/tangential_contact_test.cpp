#include "condyle/contact.hpp"

#include "support/test.hpp"

namespace condyle::contact {
namespace {

using test::box;

Pose about_z(double degrees) {
  Pose X = Pose::Identity();
  X.linear() = Eigen::AngleAxisd(Angle::degrees(degrees).radians(), Vec3::UnitZ()).toRotationMatrix();
  return X;
}

TEST(TangentialContact, ADoorTurnedIntoAPostMustTurnBackByWhatItIsTooFar) {
  // The leaf of the door lies along x, its face at y = 0.5, and is longer than the way to the post, whose
  // edge that is met first stands at (8, 4).
  const TriMesh post = box({6, 4, -3}, {8, 6, 3}), leaf = box({1, -0.5, -1}, {10, 0.5, 1});
  const JointContact joint(post, leaf);
  const TangentialContact contact = joint.tangential(about_z(26), Vec3::UnitZ());
  EXPECT_TRUE(contact.in_contact);
  // The post is taller than the leaf, the leaf longer than the post is far: only edges and faces meet.
  EXPECT_EQ(summarise(*contact.fixed_in_mobile).vertices_inside, 0u);
  EXPECT_EQ(summarise(*contact.mobile_in_fixed).vertices_inside, 0u);

  // With a post as low as the leaf its edge's ends are inside, by the angle past first touch: the leaf's face
  // y = 0.5 reaches the point (8, 4) of radius r = sqrt(80) when the point is seen at asin(0.5 / r) in the
  // leaf.
  const TriMesh low_post = box({6, 4, -0.5}, {8, 6, 0.5});
  const double radius = std::sqrt(80.0);
  const double first_touch = std::atan2(4, 8) - std::asin(0.5 / radius);
  const TangentialContact low = JointContact(low_post, leaf).tangential(about_z(26), Vec3::UnitZ());
  const TangentialBodySummary post_summary = summarise(*low.fixed_in_mobile);
  EXPECT_EQ(post_summary.vertices_inside, 2u);
  ASSERT_TRUE(post_summary.deepest);
  const double depth = Angle::degrees(26).radians() - first_touch;
  EXPECT_NEAR(post_summary.deepest->depth.radians(), depth, 1e-14);
  EXPECT_NEAR(post_summary.deepest->depth_mm, depth * radius, 1e-13);
  EXPECT_EQ(low.fixed_in_mobile->rotation_sense[post_summary.deepest->vertex], RotationSense::positive);
}

TEST(TangentialContact, StatesAndPairsAreThoseOfTheRadialMethod) {
  const TriMesh fixed = test::socket({0.05, 0.1, 0}, 1.0, 1.3, 2),
                mobile = test::sphere({0.02, 0.15, 0.1}, 0.95, 3);
  const JointContact joint(fixed, mobile);
  for (const double degrees : {0., 13., 90.}) {
    // About z the axis frames permute coordinates: both methods see the same doubles.
    const TangentialContact tangential = joint.tangential(about_z(degrees), Vec3::UnitZ());
    const RadialContact radial = joint.radial(about_z(degrees));
    EXPECT_EQ(tangential.mobile_in_fixed->state, radial.mobile_in_fixed->state);
    EXPECT_EQ(tangential.fixed_in_mobile->state, radial.fixed_in_mobile->state);
    EXPECT_EQ(tangential.pairs, radial.pairs);
    EXPECT_EQ(tangential.in_contact, radial.in_contact);
  }
}

TEST(TangentialContact, VerticesThatNoTurnSetsFreeAreCountedApart) {
  // A pin through a ring about the axis: the pin's vertices at the ring's radius are solid all the way round.
  const TriMesh ring = test::torus(5, 1, 64, 16), pin = box({4.8, -0.1, -0.1}, {5.2, 0.1, 0.1});
  const TangentialBodySummary summary =
      summarise(*JointContact(ring, pin).tangential(Pose::Identity(), Vec3::UnitZ()).mobile_in_fixed);
  EXPECT_EQ(summary.vertices_inside, 8u);
  EXPECT_EQ(summary.without_exit, 8u);
  EXPECT_FALSE(summary.deepest);
}

TEST(TangentialContact, AnOpenBodyHasNoInsideButPairs) {
  TriMesh open = test::sphere({2, 0, 0}, 1, 2);
  open.triangles.pop_back();
  const JointContact joint(open, test::sphere({0.5, 0, 0}, 1, 2));
  const TangentialContact contact = joint.tangential(Pose::Identity(), Vec3::UnitZ());
  EXPECT_FALSE(contact.mobile_in_fixed);
  EXPECT_TRUE(contact.fixed_in_mobile);
  EXPECT_FALSE(contact.pairs.empty());
}

}  // namespace
}  // namespace condyle::contact
