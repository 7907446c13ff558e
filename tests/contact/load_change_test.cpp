#include <gtest/gtest.h>

#include <array>

#include "contact/elastic_parts.hpp"
#include "support/cup.hpp"

/// What the balance steps by, against differences of the load.

namespace condyle {
namespace {

using contact::LoadChange;
using contact::Motions;
using Vector6 = Eigen::Matrix<double, 6, 1>;

const test::BallInCup known{25, 24.8, 0, 6.321839};
/// The ball's centre in M: turns about the origin of M then move the ball.
const Vec3 centre_M(15, -20, 10);

Pose pose_of_ball() {
  Pose X_FM = Pose::Identity();
  X_FM.linear() = Eigen::AngleAxisd(0.3, Vec3(1, -2, 1).normalized()).toRotationMatrix();
  X_FM.translation() = Vec3(0.1, -0.4, 0.05) - X_FM.linear() * centre_M;
  return X_FM;
}
ElasticContact ball_in_cup(Casting casting, FaceRule rule, int levels = 5) {
  Pose X_MB = test::generic_turn();
  X_MB.translation() = centre_M;
  return {test::cup(known.R, levels),
          posed(X_MB, test::sphere(Vec3::Zero(), known.r, levels)),
          {.casting = casting, .rays = {.rule = rule}, .fixed = test::layer_of_stiffness(known.K)}};
}
LoadChange change_of(const ElasticContact& contact, Motions motions) {
  ElasticContact::Parts::Answers answers;
  contact.parts().answer(pose_of_ball(), answers);
  return contact.parts().change_of(answers, pose_of_ball(), motions);
}
/// The load after a small motion about the origin of M, about where that was.
Vector6 load_after(const ElasticContact& contact, const Vector6& by) {
  Pose X = pose_of_ball();
  X.translation() += by.head<3>();
  if (const double angle = by.tail<3>().norm(); angle > 0)
    X.linear() = Eigen::AngleAxisd(angle, by.tail<3>() / angle) * X.linear();
  ElasticContact::Parts::Answers answers;
  contact.parts().answer(X, answers);
  Vector6 load = contact.parts().load_of(answers, X).wrench;
  load.tail<3>() += by.head<3>().cross(load.head<3>());
  return load;
}

class LoadChangeOf : public testing::TestWithParam<FaceRule> {};

TEST_P(LoadChangeOf, IsThatOfDifferences) {
  // With the fixed body cast, loads stay in place.
  const ElasticContact contact = ball_in_cup(Casting::fixed, GetParam());
  const LoadChange told = change_of(contact, Motions::all);
  for (int i = 0; i < 6; ++i) {
    // Steps of a hundred-thousandth of a millimetre: few rays pass from one triangle of the ball to the next, where depth has a
    // kink. A ray runs along the mean of normals, and the place it meets is told by its face's: 0.01 rad over 0.2 mm.
    const double step = i < 3 ? 1e-5 : 4e-7;
    const Vector6 by = step * Vector6::Unit(i);
    const Vector6 measured = (load_after(contact, by) - load_after(contact, -by)) / (2 * step);
    EXPECT_LE((measured - told.col(i)).head<3>().norm(), 1e-4 * told.col(i).head<3>().norm()) << i;
    EXPECT_LE((measured - told.col(i)).tail<3>().norm(), 1e-4 * told.col(i).tail<3>().norm()) << i;
  }
}

TEST_P(LoadChangeOf, WithTranslationsIsAPartOfAll) {
  for (const Casting casting : {Casting::fixed, Casting::mobile, Casting::both}) {
    const ElasticContact contact = ball_in_cup(casting, GetParam());
    const LoadChange all = change_of(contact, Motions::all);
    LoadChange some = change_of(contact, Motions::translations);
    const Eigen::Matrix3d of_force = all.topLeftCorner<3, 3>();
    EXPECT_LE((some.topLeftCorner<3, 3>() - of_force).norm(), 1e-12 * of_force.norm());
    some.topLeftCorner<3, 3>().setZero();
    EXPECT_TRUE(some.isZero(0));
  }
}

TEST_P(LoadChangeOf, IsTheSameWithEitherBodyCastAsMeshesGrowFine) {
  std::array<double, 2> apart;
  for (const int i : {0, 1}) {
    const LoadChange fixed = change_of(ball_in_cup(Casting::fixed, GetParam(), 5 + i), Motions::all),
                     mobile = change_of(ball_in_cup(Casting::mobile, GetParam(), 5 + i), Motions::all);
    apart[static_cast<std::size_t>(i)] = (fixed - mobile).norm() / fixed.norm();
  }
  // Triangles sag by 0.01 and 0.003 mm into overlaps of 0.2 mm and less, of two bodies.
  EXPECT_LE(apart[0], 0.2);
  EXPECT_LE(apart[1], 0.4 * apart[0]);
}

INSTANTIATE_TEST_SUITE_P(Rules, LoadChangeOf, testing::Values(FaceRule::face_centre, FaceRule::cut_faces),
                         [](const auto& param) {
                           return param.param == FaceRule::face_centre ? "FaceCentre" : "CutFaces";
                         });

}  // namespace
}  // namespace condyle
