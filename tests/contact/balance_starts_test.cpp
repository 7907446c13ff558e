#include "condyle/pressure.hpp"
#include "support/cup.hpp"
#include "support/test.hpp"

/// A ball in a closed shell with a rim, hollow downwards: where a balance starts from does not decide what is found, and what is
/// refused is refused for its reason.

namespace condyle::contact {
namespace {

const ElasticLayer cartilage{10, 0.45, 3.0};

ElasticContact ball_in_shell(Casting casting) {
  return {test::socket(Vec3::Zero(), 25, 31, 5),
          posed(test::generic_turn(), test::sphere(Vec3::Zero(), 24.7, 5)),
          {.casting = casting, .fixed = cartilage, .mobile = cartilage}};
}
Load of_force(const Vec3& force_n) {
  return {.on_mobile = {.force_n = force_n}};
}

class BalanceInShell : public testing::TestWithParam<Casting> {};

TEST_P(BalanceInShell, IsFoundFromEveryStartWithinAMillimetre) {
  const ElasticContact contact = ball_in_shell(GetParam());
  for (const Vec3& force : {Vec3(300, 1500, -200), Vec3(0, 2000, 0)}) {
    const BalancedPose found = balance(contact, Pose::Identity(), of_force(force));
    ASSERT_EQ(found.outcome, BalanceOutcome::balanced) << reason_of(found);
    const Vec3 answer = found.X_FM.translation();
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> share;
    for (int i = 0; i < 24; ++i) {
      Vec3 off = Vec3(normal(random), normal(random), normal(random)).normalized() * std::cbrt(share(random));
      if (i < 10)
        off = Vec3(0, -0.1 * (i + 1), 0);  // below the centre, where the rim's faces look along the ball
      const BalancedPose again = balance(contact, test::translated(answer + off), of_force(force));
      ASSERT_EQ(again.outcome, BalanceOutcome::balanced) << off.transpose() << ": " << reason_of(again);
      // 1e-6 N are left of the load, and the contact has more than 100 N per mm.
      EXPECT_LT((again.X_FM.translation() - answer).norm(), 1e-7) << off.transpose();
    }
  }
}

TEST_P(BalanceInShell, RefusesALoadThatIsTooLargeAsThat) {
  if (GetParam() == Casting::fixed) return;  // it goes on beyond its layers, and a note says so
  const ElasticContact contact = ball_in_shell(GetParam());
  for (const double y : {0.0, 0.5, -3.0}) {
    const BalancedPose refused = balance(contact, test::translated({0, y, 0}), of_force({0, 1e5, 0}));
    EXPECT_EQ(refused.outcome, BalanceOutcome::too_large) << reason_of(refused);
    EXPECT_NE(reason_of(refused).find("the load is too large"), std::string::npos);
    EXPECT_FALSE(refused.carries_load());
    EXPECT_LT(refused.residual.force_n.norm(), 1e5);
    const SurfaceContact& cast =
        GetParam() == Casting::fixed ? *refused.contact.fixed : *refused.contact.mobile;
    EXPECT_GT(cast.max_strain, 0.9);
  }
}

TEST_P(BalanceInShell, LeavesNoMoreOfARefusedLoadThanWasApplied) {
  const ElasticContact contact = ball_in_shell(GetParam());
  for (const Vec3& start : {Vec3(0, 0, 0), Vec3(0, 0.5, 0), Vec3(0, 2, 0), Vec3(0.5, 0.8, -0.35)}) {
    const BalancedPose refused = balance(contact, test::translated(start), of_force({0, -1500, 0}));
    EXPECT_EQ(refused.outcome, BalanceOutcome::pulled_apart) << reason_of(refused);
    EXPECT_LE(refused.residual.force_n.norm(), 1500 * (1 + 1e-12));
  }
}

INSTANTIATE_TEST_SUITE_P(Castings, BalanceInShell,
                         testing::Values(Casting::fixed, Casting::mobile, Casting::both), [](const auto& of) {
                           return of.param == Casting::fixed    ? "Fixed"
                                  : of.param == Casting::mobile ? "Mobile"
                                                                : "Both";
                         });

TEST(RefinedForce, IsWhatFinerTrianglesOfTheSameSurfacesGive) {
  // Triangles of 1.5 mm: depths from corner to corner leave out how far facets lie within the ball, always to one side.
  const ElasticContact contact(test::cup(25, 4),
                               posed(test::generic_turn(), test::sphere(Vec3::Zero(), 24.8, 5)),
                               {.casting = Casting::mobile, .fixed = test::layer_of_stiffness(6)});
  const auto quartered = [](const TriMesh& mesh) {
    TriMesh out;  // corners are not shared: each face has its own normal, as its plane has
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
      const Vec3 ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
      for (const auto& corners : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
        const auto first = static_cast<Index>(out.vertices.size());
        for (const Vec3& corner : corners) out.vertices.push_back(corner);
        out.triangles.push_back({first, first + 1, first + 2});
      }
    }
    return out;
  };
  const Pose X_FM = test::translated({0.05, -0.45, 0.1});
  const auto force_of = [&](const TriMesh& ball) {
    return ElasticContact(test::cup(25, 4), ball,
                          {.casting = Casting::mobile, .fixed = test::layer_of_stiffness(6)})
        .at(X_FM)
        .on_mobile.force_n;
  };
  TriMesh ball = posed(test::generic_turn(), test::sphere(Vec3::Zero(), 24.8, 5));
  const Vec3 coarse = contact.at(X_FM).on_mobile.force_n;
  ball = quartered(quartered(quartered(ball)));
  const Vec3 fine = force_of(ball);
  const auto refined = contact.refined_force_n(X_FM);
  ASSERT_TRUE(refined);
  const double left_open = (coarse - fine).norm();
  EXPECT_GT(left_open, 0.005 * fine.norm());
  // Sixteen centres leave a sixteenth of it, rays along the mean normals as much again, and faces at the border some more.
  EXPECT_LT((*refined - fine).norm(), left_open / 4);
  EXPECT_FALSE(ElasticContact(test::cup(25, 4), ball,
                              {.casting = Casting::mobile,
                               .rays = {.rule = FaceRule::face_centre},
                               .fixed = test::layer_of_stiffness(6)})
                   .refined_force_n(X_FM));
}

}  // namespace
}  // namespace condyle::contact
