#include "condyle/normal_depth.hpp"
#include "condyle/pressure.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/subdivide.hpp"
#include "support/cup.hpp"
#include "support/test.hpp"

/// A ball in a shell that has a rim: rays from the rim's flat face run lengthwise through the ball.

namespace condyle::contact {
namespace {

constexpr double inner = 25, outer = 31, ball_radius = 24.7;
const ElasticLayer shell_cartilage{10, 0.45, 3.0};
const Vec3 moved_by(0.5, 0.8, -0.35);
/// The shell_stiffness of both layers, one on the other, MPa per mm.
const double shell_stiffness = shell_cartilage.confined_modulus_mpa() / 6;
/// How far the ball reaches beyond the hollow.
const double shell_depth = ball_radius + moved_by.norm() - inner;

/// Faces of 0.8 mm; the ball's are as large. What facets of edge e take from depths: e^2 / (8 r), twice.
constexpr double sag = 2 * 0.9 * 0.9 / (8 * ball_radius);

TriMesh shell(int levels) {
  return test::socket(Vec3::Zero(), inner, outer, levels);
}
ElasticContact ball_in_rimmed_shell(Casting casting, FaceRule rule = FaceRule::cut_faces) {
  return {shell(6),
          posed(test::generic_turn(), test::sphere(Vec3::Zero(), ball_radius, 6)),
          {.casting = casting, .rays = {.rule = rule}, .fixed = shell_cartilage, .mobile = shell_cartilage}};
}

TEST(ShellRim, TheShellOfTheseTestsIsClosedAndLooksOutwards) {
  const Mesh mesh = shell(6);
  EXPECT_TRUE(mesh.is_closed());
  const double volume = 2 * std::numbers::pi / 3 * (std::pow(outer, 3) - std::pow(inner, 3));
  EXPECT_NEAR(mesh::enclosed_volume(mesh), volume, 0.001 * volume);
}

class ShellRim : public testing::TestWithParam<Casting> {};

TEST_P(ShellRim, IsNoPartOfTheContact) {
  const auto results = ball_in_rimmed_shell(GetParam()).at(test::translated(moved_by));
  for (const auto* cast : {&results.fixed, &results.mobile}) {
    if (!*cast) continue;
    EXPECT_NEAR((*cast)->totals.max_depth_mm, shell_depth, sag);
    EXPECT_NEAR((*cast)->totals.max_pressure_mpa, shell_stiffness * shell_depth, shell_stiffness * sag);
    EXPECT_FALSE((*cast)->peak_is_oblique);
  }
  // Pressures act through the centre of the sphere that casts, the shell's at -moved_by from the ball's. Sums over facets miss it by some
  // hundredths of what one facet's slope, half its edge over the radius, leaves.
  const Vec3 &force = results.on_mobile.force_n,
             about_shell = results.on_mobile.moment_nmm + moved_by.cross(force);
  const Vec3 off = GetParam() == Casting::mobile  ? results.on_mobile.moment_nmm
                   : GetParam() == Casting::fixed ? about_shell
                                                  : Vec3((results.on_mobile.moment_nmm + about_shell) / 2);
  EXPECT_LT(off.norm(), 0.02 * 0.45 / inner * ball_radius * force.norm());
}

INSTANTIATE_TEST_SUITE_P(Castings, ShellRim, testing::Values(Casting::fixed, Casting::mobile, Casting::both),
                         [](const auto& of) {
                           return of.param == Casting::fixed    ? "Fixed"
                                  : of.param == Casting::mobile ? "Mobile"
                                                                : "Both";
                         });

/// The ball 2.5 mm off the hollow's axis: it reaches over the rim by a crescent, where rays from the rim meet it at a slant.
const Vec3 over_the_rim(2.5, 0.3, 0);
ElasticContact ball_over_rim(FaceRule rule) {
  return {mesh::subdivided(mesh::subdivided(shell(4))),
          test::sphere(Vec3::Zero(), ball_radius, 5),
          {.casting = Casting::both,
           .rays = {.rule = rule},
           .fixed = shell_cartilage,
           .mobile = shell_cartilage}};
}

TEST(ShellRim, IsCountedApart) {
  const auto results = ball_over_rim(FaceRule::cut_faces).at(test::translated(over_the_rim));
  const double radius = std::sqrt(ball_radius * ball_radius - std::pow(over_the_rim.y(), 2));
  double crescent = 0;
  constexpr int parts = 100000;
  for (int i = 0; i < parts; ++i) {
    const double angle = 2 * std::numbers::pi * i / parts;
    const double reach = over_the_rim.x() * std::cos(angle) +
                         std::sqrt(radius * radius - std::pow(over_the_rim.x() * std::sin(angle), 2));
    if (reach > inner) crescent += (reach * reach - inner * inner) / 2 * 2 * std::numbers::pi / parts;
  }
  // Faces at its border, two of 70 mm, are decided by parts, a quarter of 1.5 mm wide: half of that is the most they can all be off.
  EXPECT_NEAR(results.fixed->oblique_area_mm2, crescent, 0.5 * 0.4 * 2 * 70);
  EXPECT_GT(crescent, 100);
  // The shell's facets of 2.5 mm lie within its sphere by 0.03 mm, those of the ball within its own by less.
  EXPECT_NEAR(results.fixed->totals.max_depth_mm, ball_radius + over_the_rim.norm() - inner, 0.06);
  EXPECT_FALSE(results.fixed->peak_is_oblique);
  const auto depths = normal_contact(
      {mesh::subdivided(mesh::subdivided(shell(4))), test::sphere(Vec3::Zero(), ball_radius, 5)},
      test::translated(over_the_rim));
  EXPECT_EQ(depths.fixed->surface.oblique_area_mm2, results.fixed->oblique_area_mm2);
  EXPECT_EQ(depths.fixed->surface.totals.max_depth_mm, results.fixed->totals.max_depth_mm);
}

TEST(ShellRim, FaceCentresCountItAndSaySo) {
  // The published rule knows no angle.
  const auto results = ball_over_rim(FaceRule::face_centre).at(test::translated(over_the_rim));
  EXPECT_GT(results.fixed->totals.max_depth_mm, 2 * (ball_radius + over_the_rim.norm() - inner));
  EXPECT_TRUE(results.fixed->peak_is_oblique);
  EXPECT_GT(results.fixed->oblique_area_mm2, 50);
  EXPECT_FALSE(results.mobile->peak_is_oblique);
}

/// Each corner of a triangle comes first in some.
TriMesh with_corners_in_another_order(TriMesh mesh) {
  std::mt19937_64 random(3);
  for (Triangle& t : mesh.triangles)
    for (auto turns = random() % 3; turns > 0; --turns) t = {t[1], t[2], t[0]};
  return mesh;
}

TEST(CornerOrder, ChangesNoForce) {
  // At the rim faces are cut to quadrilaterals whose shell_depth is no plane.
  const TriMesh hollow = shell(5),
                ball = posed(test::generic_turn(), test::sphere(Vec3::Zero(), ball_radius, 5));
  for (const PressureLaw law : {PressureLaw::linear, PressureLaw::logarithmic}) {
    for (const bool varies : {false, true}) {
      const auto load = [&](const TriMesh& fixed, const TriMesh& mobile) {
        ElasticContactOptions options{.law = law, .fixed = shell_cartilage, .mobile = shell_cartilage};
        if (varies) {
          std::vector<double> thickness;
          for (const double x : mobile.vertices.x) thickness.push_back(2 + 0.05 * x);
          options.mobile->thickness_mm = thickness;
        }
        return ElasticContact(fixed, mobile, options).at(test::translated(moved_by)).on_mobile;
      };
      const Wrench one = load(hollow, ball),
                   other = load(with_corners_in_another_order(hollow), with_corners_in_another_order(ball));
      EXPECT_LT((one.force_n - other.force_n).norm(), 1e-12 * one.force_n.norm());
      EXPECT_LT((one.moment_nmm - other.moment_nmm).norm(), 1e-12 * ball_radius * one.force_n.norm());
    }
  }
}

}  // namespace
}  // namespace condyle::contact
