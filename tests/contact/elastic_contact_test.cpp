#include "condyle/pressure.hpp"

#include "support/cup.hpp"
#include "support/test.hpp"

namespace condyle::contact {
namespace {

using test::layer_of_stiffness;
using test::translated;

struct CupAnswer {
  double force, area, peak;
};
CupAnswer cup_answer(const test::BallInCup& known, int levels) {
  const ElasticContact contact(test::cup(known.R, levels),
                               posed(test::generic_turn(), test::sphere(Vec3::Zero(), known.r, levels)),
                               {.casting = Casting::fixed, .fixed = layer_of_stiffness(known.K)});
  const auto results = contact.at(translated({0, -known.d, 0}));
  const ContactTotals& totals = results.fixed->totals;
  // By symmetry nothing acts across the axis, but for facets.
  EXPECT_LT(std::hypot(totals.force_n.x(), totals.force_n.z()), 1e-3 * totals.force_n.norm());
  EXPECT_LT(totals.force_n.y(), 0) << "the cup is pushed down";
  EXPECT_LT((totals.force_n + results.on_mobile.force_n).norm(), 1e-9 * totals.force_n.norm());
  return {-totals.force_n.y(), totals.area_mm2, totals.max_pressure_mpa};
}

/// With edges halved the errors fall by four; from two of them the next order is known.
double extrapolated(double coarse, double fine) {
  return fine + (fine - coarse) / 3;
}

class CupConverges : public testing::TestWithParam<test::BallInCup> {};

TEST_P(CupConverges, ToTheClosedFormWithTheSquareOfTheEdge) {
  const test::BallInCup& known = GetParam();
  // Edges of 0.77, 0.39 and 0.19 mm in the mean; with 0.25 mm the force is within 0.5 %.
  std::array<CupAnswer, 3> of;
  for (int i = 0; i < 3; ++i) of[i] = cup_answer(known, 6 + i);
  EXPECT_NEAR(of[2].force, known.force(), 0.005 * std::pow(0.19 / 0.25, 2) * known.force());
  const auto error = [&](int i) { return std::abs(of[i].force - known.force()); };
  EXPECT_GT(error(0), 3.5 * error(1));
  EXPECT_GT(error(1), 3.5 * error(2));
  EXPECT_NEAR(extrapolated(of[1].force, of[2].force), known.force(), 0.0005 * known.force());
  EXPECT_NEAR(extrapolated(of[1].area, of[2].area), known.area(), 0.0005 * known.area());
  EXPECT_NEAR(extrapolated(of[1].peak, of[2].peak), known.peak(), 0.0005 * known.peak());
}

INSTANTIATE_TEST_SUITE_P(Cases, CupConverges,
                         testing::Values(test::BallInCup{25.85, 25.65, 0.434453, 9.282971},
                                         test::BallInCup{25.85, 25.75, 0.299392, 9.282971},
                                         test::BallInCup{25, 24.8, 0.530583, 6.321839}),
                         [](const auto& param) {
                           return "R" + std::to_string(static_cast<int>(100 * param.param.r));
                         });

TEST(ElasticContact, ASpherePressedIntoAPlaneLayer) {
  // K pi d^2 (3 R - d) / 3: doubling d gives about four times the force.
  const double R = 24, K = 10;
  for (const auto& [d, printed] : {std::pair{0.25, 46.9603}, {0.5, 187.1866}, {1.0, 743.5103}}) {
    const double force = K * std::numbers::pi * d * d * (3 * R - d) / 3;
    EXPECT_NEAR(force, printed, 1e-4);
    std::array<double, 2> found;
    for (const int i : {0, 1}) {
      const ElasticContact contact(test::plane(9, 72 << i), test::sphere(Vec3::Zero(), R, 7 + i),
                                   {.casting = Casting::fixed, .fixed = layer_of_stiffness(K)});
      const auto results = contact.at(translated({0.01, R - d, 0.02}));
      found[i] = results.on_mobile.force_n.y();
      // The stored energy is the work done, which is the integral of the force.
      const double energy = K * std::numbers::pi * d * d * d * (R / 3 - d / 12);
      EXPECT_NEAR(results.energy_nmm, energy, 0.05 * energy);
    }
    EXPECT_NEAR(found[1], force, 0.005 * force) << d;
    EXPECT_LT(std::abs(found[1] - force), std::abs(found[0] - force) / 3.5) << d;
    EXPECT_NEAR(extrapolated(found[0], found[1]), force, 0.0005 * force) << d;
  }
}

TEST(ElasticContact, MomentIsThatOfTheForceAtTheCentreOfPressure) {
  // All of a plane's pressures are parallel: their moment is that of the sum at the centre of pressure.
  const ElasticContact contact(test::plane(9, 40), test::sphere(Vec3::Zero(), 24, 6),
                               {.casting = Casting::fixed, .fixed = layer_of_stiffness(10)});
  const auto results = contact.at(translated({1, 23.3, -2}));
  const ContactTotals& totals = results.fixed->totals;
  EXPECT_LT((totals.moment_nmm - totals.centre_of_pressure->cross(totals.force_n)).norm(),
            1e-9 * totals.moment_nmm.norm());
  EXPECT_LT((*totals.centre_of_pressure - Vec3(1, 0, -2)).norm(), 0.02);
  // About the origin of M, in F.
  const Vec3 arm = *totals.centre_of_pressure - Vec3(1, 23.3, -2);
  EXPECT_LT((results.on_mobile.moment_nmm - arm.cross(results.on_mobile.force_n)).norm(),
            1e-9 * arm.norm() * totals.force_n.norm());
}

TEST(ElasticContact, ExchangingClosedBodiesGivesOppositeForces) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  const TriMesh ball = test::sphere(Vec3::Zero(), 10, 4), ring = test::torus(12, 6, 60, 40);
  const ElasticLayer one{12, 0.42, 2.0}, other{8, 0.45, 1.5};
  const ElasticContact contact(ring, ball, {.law = PressureLaw::linear, .fixed = one, .mobile = other});
  const ElasticContact exchanged(ball, ring, {.law = PressureLaw::linear, .fixed = other, .mobile = one});
  for (int i = 0; i < 20; ++i) {
    Pose X = translated({0.3 * normal(random), 0.3 * normal(random), 7.2 + 0.2 * normal(random)});
    X.linear() = Eigen::AngleAxisd(normal(random), Vec3(normal(random), normal(random), 1).normalized())
                     .toRotationMatrix();
    const Vec3 force = contact.at(X).on_mobile.force_n;
    const Vec3 back = X.linear() * exchanged.at(X.inverse()).on_mobile.force_n;
    ASSERT_GT(force.norm(), 1);
    EXPECT_LT((force + back).norm(), 1e-9 * force.norm());
  }
}

TEST(ElasticContact, MovingBothBodiesMovesTheAnswer) {
  Pose X_WF = translated({30, -20, 10});
  X_WF.linear() = Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const TriMesh cup = test::cup(25, 4), ball = test::sphere(Vec3::Zero(), 24.8, 4);
  const ElasticContactOptions options{.casting = Casting::fixed, .fixed = layer_of_stiffness(6)};
  const Pose X = translated({0.1, -0.4, 0.05});
  const auto here = ElasticContact(cup, ball, options).at(X);
  const auto there = ElasticContact(posed(X_WF, cup), ball, options).at(X_WF * X);
  EXPECT_LT((there.on_mobile.force_n - X_WF.linear() * here.on_mobile.force_n).norm(),
            1e-9 * here.on_mobile.force_n.norm());
  EXPECT_LT((there.on_mobile.moment_nmm - X_WF.linear() * here.on_mobile.moment_nmm).norm(),
            1e-7 * here.on_mobile.force_n.norm());
}

TEST(ElasticContact, CutFacesGiveAStraightBorderExactly) {
  // A box sunk askew into a plane: the depth is linear over the plane, and the part in contact a rectangle.
  const double slope = 0.1;
  const Pose tilt = [&] {
    Pose X = Pose::Identity();
    X.linear() = Eigen::AngleAxisd(std::atan(slope), Vec3::UnitZ()).toRotationMatrix();
    return X;
  }();
  // Its lower face holds the line y = slope x: depth -slope x where x < 0.
  const ElasticContact contact(test::plane(4, 17), test::box({-50, 0, -50}, {50, 30, 50}),
                               {.casting = Casting::fixed, .fixed = layer_of_stiffness(3)});
  const ContactTotals totals = contact.at(tilt).fixed->totals;
  EXPECT_NEAR(totals.area_mm2, 4 * 8, 1e-10);
  EXPECT_NEAR(totals.max_depth_mm, 4 * slope, 1e-12);
  EXPECT_NEAR(totals.mean_depth_mm, 2 * slope, 1e-12);
  EXPECT_NEAR(totals.force_n.y(), -3 * 2 * slope * 32, 1e-9);
  EXPECT_NEAR(totals.centre_of_pressure->x(), -8.0 / 3, 1e-11);
}

TEST(ElasticContact, WhatReachesOverARimIsDecidedByParts) {
  // A flat patch of 6 x 6 mm over a wider plane, 0.5 mm deep: the plane's faces under its rim are decided by 16 parts each.
  const ElasticContact contact(test::plane(6, 40), test::flipped(test::plane(3.05, 1)),
                               {.casting = Casting::fixed, .fixed = layer_of_stiffness(2)});
  const auto results = contact.at(translated({0, -0.5, 0}));
  EXPECT_GT(results.fixed->rim_faces, 0u);
  // The parts are 0.3 / 4 mm wide, along a rim of 24.4 mm; their errors have both signs.
  EXPECT_NEAR(results.fixed->totals.area_mm2, 6.1 * 6.1, 24.4 * 0.3 / 4 / 2);
  EXPECT_NEAR(results.fixed->totals.mean_depth_mm, 0.5, 1e-12);
}

TEST(ElasticContact, ThicknessPerVertexIsReadWhereItIs) {
  // The same thickness everywhere, given as one and as many, on either body.
  const TriMesh cup = test::cup(25, 4), ball = test::sphere(Vec3::Zero(), 24.8, 4);
  const ElasticLayer one{10, 0.45, 3.0};
  const auto many = [&](const TriMesh& mesh) {
    return ElasticLayer{10, 0.45, std::vector<double>(mesh.vertices.size(), 3.0)};
  };
  for (const auto law : {PressureLaw::linear, PressureLaw::logarithmic}) {
    for (const auto rule : {FaceRule::cut_faces, FaceRule::face_centre}) {
      const auto force = [&](const ElasticLayer& fixed, const ElasticLayer& mobile) {
        const ElasticContact contact(cup, ball,
                                     {.casting = Casting::fixed,
                                      .rays = {.rule = rule},
                                      .law = law,
                                      .fixed = fixed,
                                      .mobile = mobile});
        return contact.at(translated({0.1, -0.5, 0})).on_mobile.force_n;
      };
      const Vec3 expected = force(one, one);
      EXPECT_LT((force(many(cup), one) - expected).norm(), 1e-9 * expected.norm());
      EXPECT_LT((force(one, many(ball)) - expected).norm(), 1e-9 * expected.norm());
    }
  }
}

TEST(ElasticContact, ThicknessIsTheDistanceToWhatLiesBehind) {
  // A sphere seen from a larger one: the outer's vertices lie 2 mm above the inner's.
  const auto thickness = thickness_to(test::sphere(Vec3::Zero(), 12, 4), test::sphere(Vec3::Zero(), 10, 4));
  for (const double t : thickness) EXPECT_NEAR(t, 2, 1e-2);
  const auto nothing = thickness_to(test::sphere(Vec3::Zero(), 12, 2), test::sphere({100, 0, 0}, 10, 2));
  for (const double t : nothing) EXPECT_TRUE(std::isnan(t));
}

TEST(ElasticContact, RefusesWhatHasNoMeaning) {
  const TriMesh box = test::box({-1, -1, -1}, {1, 1, 1});
  const auto refused = [&](ElasticContactOptions options, const char* what) {
    try {
      ElasticContact(box, box, options);
      ADD_FAILURE() << what;
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  };
  refused({}, "two rigid bodies");
  refused({.fixed = ElasticLayer{0, 0.4, 1.0}}, "fixed layer: Young's modulus");
  refused({.fixed = ElasticLayer{10, 0.5, 1.0}}, "Poisson's ratio");
  refused({.mobile = ElasticLayer{10, 0.4, -1.0}}, "mobile layer: the thickness");
  refused({.mobile = ElasticLayer{10, 0.4, std::vector<double>(7, 1.0)}}, "7 thicknesses for 8 vertices");
  refused({.mobile = ElasticLayer{10, 0.4, std::vector<double>{1, 1, 1, 0, 1, 1, 1, 1}}}, "vertex 3");
  refused({.rays = {.reach_mm = 0}, .mobile = ElasticLayer{10, 0.4, 1.0}}, "reach");
}

TEST(ElasticContact, LogarithmicLawNamesTheTriangleThatIsTooDeep) {
  const ElasticContact contact(
      test::plane(9, 10), test::sphere(Vec3::Zero(), 24, 4),
      {.casting = Casting::fixed, .law = PressureLaw::logarithmic, .fixed = ElasticLayer{10, 0.45, 1.0}});
  EXPECT_GT(contact.at(translated({0, 23.5, 0})).on_mobile.force_n.y(), 0);
  try {
    contact.at(translated({0, 22.5, 0}));
    FAIL();
  } catch (const MeshError& error) {
    EXPECT_NE(std::string(error.what()).find("triangle "), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("1 mm thick"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace condyle::contact
