#include "contact/elastic_parts.hpp"
#include "support/cup.hpp"
#include "support/test.hpp"

/// The derivatives that the balance steps by, against differences of the load.

namespace condyle::contact {
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
LoadChange change_of(const ElasticContact& contact, const Pose& X_FM, Motions motions) {
  ElasticContact::Parts::Answers answers;
  contact.parts().answer(X_FM, answers);
  return contact.parts().change_of(answers, X_FM, motions);
}
/// The load after a small motion about the origin of M, about where that was.
Vector6 load_after(const ElasticContact& contact, const Pose& X_FM, const Vector6& by) {
  Pose X = X_FM;
  X.translation() += by.head<3>();
  if (const double angle = by.tail<3>().norm(); angle > 0)
    X.linear() = Eigen::AngleAxisd(angle, by.tail<3>() / angle) * X.linear();
  ElasticContact::Parts::Answers answers;
  contact.parts().answer(X, answers);
  Vector6 load = contact.parts().load_of(answers, X).wrench;
  load.tail<3>() += by.head<3>().cross(load.head<3>());
  return load;
}
/// By differences. With the fixed body cast, loads stay in place.
LoadChange measured_change(const ElasticContact& contact, const Pose& X_FM, double step_mm, double step_rad) {
  LoadChange change;
  for (int i = 0; i < 6; ++i) {
    const double step = i < 3 ? step_mm : step_rad;
    const Vector6 by = step * Vector6::Unit(i);
    change.col(i) = (load_after(contact, X_FM, by) - load_after(contact, X_FM, -by)) / (2 * step);
  }
  return change;
}
void expect_near(const LoadChange& reported, const LoadChange& measured, double share) {
  for (int i = 0; i < 6; ++i) {
    const Vector6 apart = measured.col(i) - reported.col(i);
    EXPECT_LE(apart.head<3>().norm(), share * reported.col(i).head<3>().norm()) << i;
    EXPECT_LE(apart.tail<3>().norm(), share * reported.col(i).tail<3>().norm()) << i;
  }
}

class LoadChangeOf : public testing::TestWithParam<FaceRule> {};

TEST_P(LoadChangeOf, IsThatOfDifferences) {
  const ElasticContact contact = ball_in_cup(Casting::fixed, GetParam());
  // Steps of a hundred-thousandth of a millimetre: few rays pass from one triangle of the ball to the next, where
  // depth has a kink. A ray runs along the mean of normals, and the normal of the face that it meets gives the place:
  // 0.01 rad over 0.2 mm.
  expect_near(change_of(contact, pose_of_ball(), Motions::all),
              measured_change(contact, pose_of_ball(), 1e-5, 4e-7), 1e-4);
}

TEST_P(LoadChangeOf, WithTranslationsIsAPartOfAll) {
  for (const Casting casting : {Casting::fixed, Casting::mobile, Casting::both}) {
    const ElasticContact contact = ball_in_cup(casting, GetParam());
    const LoadChange all = change_of(contact, pose_of_ball(), Motions::all);
    LoadChange some = change_of(contact, pose_of_ball(), Motions::translations);
    const Eigen::Matrix3d of_force = all.topLeftCorner<3, 3>();
    EXPECT_LE((some.topLeftCorner<3, 3>() - of_force).norm(), 1e-12 * of_force.norm());
    some.topLeftCorner<3, 3>().setZero();
    EXPECT_TRUE(some.isZero(0));
  }
}

TEST_P(LoadChangeOf, IsTheSameWithEitherBodyCastAsMeshesGrowFine) {
  std::array<double, 2> apart;
  for (const int i : {0, 1}) {
    const LoadChange fixed = change_of(ball_in_cup(Casting::fixed, GetParam(), 5 + i), pose_of_ball(),
                                       Motions::all),
                     mobile = change_of(ball_in_cup(Casting::mobile, GetParam(), 5 + i), pose_of_ball(),
                                        Motions::all);
    apart[static_cast<std::size_t>(i)] = (fixed - mobile).norm() / fixed.norm();
  }
  // Triangles sag by 0.01 and 0.003 mm into overlaps of 0.2 mm and less, of two bodies.
  EXPECT_LE(apart[0], 0.2);
  EXPECT_LE(apart[1], 0.4 * apart[0]);
}

TEST(LoadChangeAtARim, IsThatOfDifferences) {
  // A slab is tilted into a sheet: three of its sides cut triangles, and so does the line where the depth is 0. It grows narrower
  // upwards, so that no ray from beside it meets its sides.
  TriMesh slab = test::box({-4.1, 0, -3.3}, {4.3, 3, 3.7});
  for (std::size_t v = 0; v < slab.vertices.size(); ++v)
    if (slab.vertices.y[v] > 1) slab.vertices.x[v] *= 0.8, slab.vertices.z[v] *= 0.8;
  Pose X_FM = Pose::Identity();
  X_FM.linear() =
      (Eigen::AngleAxisd(0.04, Vec3::UnitZ()) * Eigen::AngleAxisd(0.35, Vec3::UnitY())).toRotationMatrix();
  X_FM.translation() = Vec3(0.31, 0.05, -0.17);
  const ElasticContact contact(test::plane(6, 23), slab,
                               {.casting = Casting::fixed, .fixed = test::layer_of_stiffness(6)});
  ASSERT_GT(contact.at(X_FM).fixed->rim_faces, 20u);
  // All is plane, so that central differences err by rounding alone: some 1e-13 of 100 N over 1e-7 rad, 1e-6 N per rad.
  expect_near(change_of(contact, X_FM, Motions::all), measured_change(contact, X_FM, 1e-6, 1e-7), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Rules, LoadChangeOf, testing::Values(FaceRule::face_centre, FaceRule::cut_faces),
                         [](const auto& param) {
                           return param.param == FaceRule::face_centre ? "FaceCentre" : "CutFaces";
                         });

}  // namespace
}  // namespace condyle::contact
