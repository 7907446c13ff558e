#include "condyle/contact.hpp"
#include "condyle/normal_depth.hpp"
#include "condyle/pressure.hpp"
#include "support/cup.hpp"
#include "support/test.hpp"

/// What is computed at a pose is refused at one that is none.

namespace condyle::contact {
namespace {

TEST(Pose, ThatIsNoRotationIsRefusedByAllThatTakesOne) {
  Pose zero = Pose::Identity(), doubled = zero, mirrored = zero;
  zero.matrix().setZero();
  doubled.linear() *= 2;
  mirrored.linear()(0, 0) = -1;
  const Mesh ball(test::sphere(Vec3::Zero(), 10, 3)), other(test::sphere({0, 19, 0}, 10, 3));
  const ElasticContact elastic(ball, other, {.fixed = test::layer_of_stiffness(5)});
  const JointContact joint(ball, other);
  const NormalDepth normal(ball, other);
  const Load load{.on_mobile = {Vec3(0, -1, 0), Vec3::Zero()}};
  for (const Pose& X : {zero, doubled, mirrored}) {
    const std::vector<std::string> refusals = {
        test::complaint_of<UsageError>([&] { elastic.at(X); }),
        test::complaint_of<UsageError>([&] { elastic.forces(X); }),
        test::complaint_of<UsageError>([&] { elastic.refined_force_n(X); }),
        test::complaint_of<UsageError>([&] { elastic.cut_off_by_reach(X); }),
        test::complaint_of<UsageError>([&] { balance(elastic, X, load); }),
        test::complaint_of<UsageError>([&] { normal.at(X); }),
        test::complaint_of<UsageError>([&] { normal.cut_off_by_reach(X); }),
        test::complaint_of<UsageError>([&] { joint.at(X); }),
        test::complaint_of<UsageError>([&] { joint.radial(X); }),
        test::complaint_of<UsageError>([&] { joint.in_contact(X); }),
    };
    for (std::size_t i = 0; i < refusals.size(); ++i)
      EXPECT_TRUE(refusals[i].starts_with("pose: its matrix ")) << i << ": " << refusals[i];
  }
}

/// Poses of single precision are rotations within what they can hold, and of more no place is known to a nanometre.
TEST(Pose, IsARotationWithinAMillionth) {
  const NormalDepth normal(Mesh(test::sphere(Vec3::Zero(), 10, 2)), Mesh(test::sphere({0, 19, 0}, 10, 2)));
  const auto stretched = [](double by) {
    Pose X = Pose::Identity();
    X.linear()(1, 1) += by;
    return X;
  };
  EXPECT_EQ(test::complaint_of<UsageError>([&] { normal.at(stretched(0.49e-6)); }), "accepted");
  EXPECT_NE(test::complaint_of<UsageError>([&] { normal.at(stretched(0.51e-6)); }), "accepted");
}

}  // namespace
}  // namespace condyle::contact
