#include "condyle/contact.hpp"

#include "contact/brute_pairs.hpp"
#include "core/thread_limit.hpp"
#include "support/random_pose.hpp"
#include "support/test.hpp"

namespace condyle::contact {
namespace {

using test::box;
using test::sphere;

TEST(JointContact, PairsAreThoseOfRationalArithmeticOnBothMapsInEveryPose) {
  const TriMesh fixed = test::socket({0.05, 0.1, 0}, 1.0, 1.3, 1), mobile = test::torus(1.1, 0.15, 7, 5);
  std::size_t found = 0, free_poses = 0;
  for (const auto map : {radial::DirectionMapKind::cube, radial::DirectionMapKind::cartesian}) {
    const JointContact joint(fixed, mobile, {map, 8});
    for (int i = 0; i < 12; ++i) {
      const Pose X = test::rotated(31 * i, {1, 0.3 * i, -0.5}, Vec3(0.02 * i, i % 4 == 0 ? -2.4 : -0.1, 0));
      const auto pairs = joint.pairs(X);
      EXPECT_EQ(pairs, test::brute_pairs(fixed, posed(X, mobile)));
      found += pairs.size();
      free_poses += pairs.empty();
    }
  }
  EXPECT_GT(found, 100u);
  EXPECT_GT(free_poses, 0u);
}

TEST(JointContact, CoplanarFacesThatTouchAreInContact) {
  const TriMesh fixed = box({1, -1, -1}, {3, 1, 1}), mobile = box({-1.5, -0.5, -0.5}, {1, 0.5, 0.5});
  const JointContact joint(fixed, mobile);
  const RadialContact contact = joint.radial(Pose::Identity());
  EXPECT_TRUE(contact.in_contact);
  EXPECT_EQ(contact.pairs, test::brute_pairs(fixed, mobile));
  EXPECT_FALSE(contact.pairs.empty());
  EXPECT_EQ(std::count(contact.mobile_in_fixed->state.begin(), contact.mobile_in_fixed->state.end(),
                       PointState::on_surface),
            4);
  EXPECT_EQ(std::count(contact.mobile_in_fixed->state.begin(), contact.mobile_in_fixed->state.end(),
                       PointState::inside),
            0);
  // One rounding away they are free.
  EXPECT_FALSE(joint.radial(test::rotated(0, {0, 0, 1}, {-0x1p-52, 0, 0})).in_contact);
}

TEST(JointContact, ABodyWhollyInsideTheOtherIsInContact) {
  const TriMesh large = sphere({0.1, 0, 0}, 10, 2), small = sphere({2, 0, 0}, 1, 2);
  const RadialContact inner_mobile = JointContact(large, small).radial(Pose::Identity());
  EXPECT_TRUE(inner_mobile.pairs.empty());
  EXPECT_TRUE(inner_mobile.in_contact);
  const RadialContact inner_fixed = JointContact(small, large).radial(Pose::Identity());
  EXPECT_TRUE(inner_fixed.pairs.empty());
  EXPECT_TRUE(inner_fixed.in_contact);
  EXPECT_EQ(std::count(inner_fixed.fixed_in_mobile->state.begin(), inner_fixed.fixed_in_mobile->state.end(),
                       PointState::inside),
            static_cast<long>(small.vertices.size()));
}

TEST(JointContact, CrossedBarsTouchWithNoVertexInside) {
  const TriMesh fixed = box({-5, 1, -0.5}, {5, 2, 0.5}), mobile = box({-0.5, 1.25, -5}, {0.5, 1.75, 5});
  const RadialContact contact = JointContact(fixed, mobile).radial(Pose::Identity());
  EXPECT_TRUE(contact.in_contact);
  EXPECT_EQ(std::count(contact.mobile_in_fixed->state.begin(), contact.mobile_in_fixed->state.end(),
                       PointState::outside),
            8);
  EXPECT_EQ(std::count(contact.fixed_in_mobile->state.begin(), contact.fixed_in_mobile->state.end(),
                       PointState::outside),
            8);
  EXPECT_EQ(contact.pairs, test::brute_pairs(fixed, mobile));
}

TEST(JointContact, ExchangingTheBodiesExchangesTheAnswers) {
  const TriMesh a = test::socket({0.05, 0.1, 0}, 1.0, 1.3, 2), b = sphere({0, 0.2, 0.1}, 0.95, 2);
  const JointContact ab(a, b), ba(b, a);
  // A turn by 90 degrees about z is exact in both directions: no vertex is rounded.
  Pose X = Pose::Identity();
  X.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const RadialContact forth = ab.radial(X), back = ba.radial(X.inverse());
  EXPECT_EQ(forth.mobile_in_fixed, back.fixed_in_mobile);
  EXPECT_EQ(forth.fixed_in_mobile, back.mobile_in_fixed);
  std::vector<TrianglePair> exchanged;
  for (const auto& [f, m] : back.pairs) exchanged.push_back({m, f});
  std::sort(exchanged.begin(), exchanged.end());
  EXPECT_EQ(forth.pairs, exchanged);
  EXPECT_FALSE(forth.pairs.empty());
}

TEST(JointContact, AnOpenBodyStillHasItsPairs) {
  TriMesh open = sphere({0.1, 0, 0}, 1, 2);
  open.triangles.resize(open.triangles.size() / 2);
  const TriMesh mobile = sphere({0.9, 0.3, 0.1}, 0.5, 2);
  const RadialContact contact = JointContact(open, mobile).radial(Pose::Identity());
  EXPECT_FALSE(contact.mobile_in_fixed);
  EXPECT_TRUE(contact.fixed_in_mobile);
  EXPECT_EQ(contact.pairs, test::brute_pairs(open, mobile));
  EXPECT_FALSE(contact.pairs.empty());
}

TEST(JointContact, AMobileTriangleThroughTheCentreIsTestedAgainstAll) {
  // In this pose a face of the mobile box passes through the fixed centre: it is seen in a whole half of all
  // directions.
  const TriMesh fixed = sphere({3, 0, 0}, 1, 2), mobile = box({-1, -1, -1}, {1, 1, 1});
  const JointContact joint(fixed, mobile);
  const Pose X = test::rotated(0, {0, 0, 1}, {1, 0, 0});
  EXPECT_EQ(joint.pairs(X), test::brute_pairs(fixed, posed(X, mobile)));
  EXPECT_FALSE(joint.pairs(X).empty());
}

TEST(JointContact, OneThreadAndManyGiveTheSamePairs) {
  const JointContact joint(test::socket({0.05, 0.1, 0}, 1.0, 1.3, 4), sphere({0, 0.2, 0.1}, 0.95, 4));
  std::vector<TrianglePair> one, many;
  {
    const core::ThreadLimit single(1);
    one = joint.pairs(test::rotated(20, {1, 1, 0}));
  }
  {
    const core::ThreadLimit eight(8);
    many = joint.pairs(test::rotated(20, {1, 1, 0}));
  }
  EXPECT_EQ(one, many);
  EXPECT_FALSE(one.empty());
}

TEST(JointContact, ACentreOnASurfaceIsRefusedByNameOfTheBody) {
  try {
    JointContact(sphere({5, 0, 0}, 1, 1), box({0, -1, -1}, {2, 1, 1})).radial(Pose::Identity());
    FAIL() << "the centre lies on the mobile body";
  } catch (const MeshError& error) {
    EXPECT_EQ(
        std::string(error.what()).rfind("mobile body: the joint centre lies on the surface, in triangle ", 0),
        0u);
  }
}

}  // namespace
}  // namespace condyle::contact
