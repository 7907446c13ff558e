#include "condyle/sample/cartilages.hpp"

#include "condyle/contact.hpp"
#include "condyle/pose.hpp"
#include "condyle/pressure.hpp"
#include "core/thread_limit.hpp"
#include "sample/cartilage_shape.hpp"
#include "sample/femur_shape.hpp"
#include "sample/hip_bone_shape.hpp"
#include "sample/projection.hpp"
#include "sample/self_intersection.hpp"
#include "sample/topology.hpp"
#include "support/test.hpp"

namespace condyle::sample {
namespace {

using sample::laid_tolerance;

constexpr std::array<CartilageScenario, 4> scenarios = {CartilageScenario::five, CartilageScenario::six,
                                                        CartilageScenario::seven, CartilageScenario::eight};

/// The cartilages of the default hip, made once per process.
const SampleCartilages& made(CartilageScenario scenario) {
  static std::array<SampleCartilages, 4> all;
  SampleCartilages& one = all[static_cast<std::size_t>(scenario) - 5];
  if (one.femoral.triangles.empty()) one = sample_cartilages({}, {}, scenario);
  return one;
}

void expect_sound_cartilage(const TriMesh& mesh, int genus) {
  test::expect_sound(mesh, genus);
  EXPECT_FALSE(sample::first_self_intersection(mesh));
}

void expect_sound(const SampleCartilages& cartilages) {
  expect_sound_cartilage(cartilages.femoral, 0);
  expect_sound_cartilage(cartilages.acetabular, 1);
}

TEST(SampleCartilages, HaveTheCountsOfThePapersTable2) {
  struct Counts {
    std::size_t femoral_vertices, femoral_triangles, acetabular_vertices, acetabular_triangles;
  };
  constexpr std::array<Counts, 4> table = {{{1414, 2824, 1438, 2876},
                                            {2171, 4338, 2111, 4222},
                                            {3869, 7734, 3935, 7870},
                                            {8649, 17294, 7412, 14824}}};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const SampleCartilages& found = made(scenarios[i]);
    EXPECT_EQ(found.femoral.vertices.size(), table[i].femoral_vertices);
    EXPECT_EQ(found.femoral.triangles.size(), table[i].femoral_triangles);
    EXPECT_EQ(found.acetabular.vertices.size(), table[i].acetabular_vertices);
    EXPECT_EQ(found.acetabular.triangles.size(), table[i].acetabular_triangles);
  }
}

TEST(SampleCartilages, AreAClosedCapAndAClosedRingWoundOutwardsThatDoNotRunIntoThemselves) {
  for (const CartilageScenario scenario : scenarios) expect_sound(made(scenario));
}

TEST(SampleCartilages, OfTheCoarsestScenarioAreSound) {
  expect_sound(made(CartilageScenario::five));
}

TEST(SampleCartilages, TrianglesAreNoSlivers) {
  // As for bones at the ends of their parameters' ranges: the borders turn round within a triangle or two.
  constexpr double least_deg = 15;
  for (const CartilageScenario scenario : scenarios) {
    EXPECT_GT(test::smallest_angles_deg(made(scenario).femoral).front(), least_deg);
    EXPECT_GT(test::smallest_angles_deg(made(scenario).acetabular).front(), least_deg);
  }
}

struct Radii {
  double least = std::numeric_limits<double>::infinity(), most = 0;
};

Radii radii(const TriMesh& mesh) {
  Radii found;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const double radius = mesh.vertices[v].norm();
    found = {std::min(found.least, radius), std::max(found.most, radius)};
  }
  return found;
}

bool is_on_sphere(const Vec3& p, double radius) {
  return std::abs(p.norm() - radius) <= laid_tolerance;
}

/// Triangles with all corners on a sphere about the origin: their area over that of the sphere, and how far
/// they sag into it, R - sqrt(R^2 - r^2) with their circumradius r.
struct Facets {
  double part = 0, sag = 0;
};

Facets facets_on_sphere(const TriMesh& mesh, double radius) {
  Facets found;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
    if (!is_on_sphere(a, radius) || !is_on_sphere(b, radius) || !is_on_sphere(c, radius)) continue;
    const double twice_area = (b - a).cross(c - a).norm();
    found.part += twice_area / (8 * std::numbers::pi * radius * radius);
    const double circumradius = (b - a).norm() * (c - b).norm() * (a - c).norm() / (2 * twice_area);
    found.sag = std::max(found.sag, radius - std::sqrt(radius * radius - circumradius * circumradius));
  }
  return found;
}

TEST(SampleCartilages, ArticularSurfacesAreSpheresTheClearanceApart) {
  const auto spheres = sample::articular_spheres({}, {});
  EXPECT_NEAR(spheres.acetabular - spheres.femoral, CartilageParameters{}.clearance_mm, laid_tolerance);
  for (const CartilageScenario scenario : scenarios) {
    const SampleCartilages& cartilages = made(scenario);
    // Nothing of the femoral cartilage stands out of one sphere, nothing of the acetabular into the other.
    EXPECT_NEAR(radii(cartilages.femoral).most, spheres.femoral, laid_tolerance);
    EXPECT_NEAR(radii(cartilages.acetabular).least, spheres.acetabular, laid_tolerance);
    // A cap that leaves the neck free, seen from its axis up to 68 degrees, is (1 + cos 68) / 2 = 0.69 of its
    // sphere. Lining and labrum are half of theirs, less 0.08 for the fossa. Rounded borders and the
    // triangles that reach into them do not count: up to 5 mm along the cap's margin, 150 mm long, and along
    // the labrum's tip and the fossa, 160 and 100 mm; on these spheres 0.09 and 0.15.
    const Facets femoral = facets_on_sphere(cartilages.femoral, spheres.femoral);
    const Facets acetabular = facets_on_sphere(cartilages.acetabular, spheres.acetabular);
    EXPECT_GT(femoral.part, 0.6);
    EXPECT_LT(femoral.part, 0.69);
    EXPECT_GT(acetabular.part, 0.27);
    EXPECT_LT(acetabular.part, 0.42);
    EXPECT_LT(acetabular.sag, 0.1);
  }
}

/// The gap of every femoral vertex that lies on the articular sphere, by the radial method in the neutral
/// pose; of those alone that see acetabular cartilage.
std::vector<double> articular_gaps(const SampleCartilages& cartilages, double radius) {
  const contact::RadialContact contact =
      contact::JointContact(cartilages.acetabular, cartilages.femoral).radial(Pose::Identity());
  std::vector<double> gaps;
  for (std::size_t v = 0; v < cartilages.femoral.vertices.size(); ++v) {
    const double gap = contact.mobile_in_fixed->radial_gap_mm[v];
    if (std::isfinite(gap) && is_on_sphere(cartilages.femoral.vertices[v], radius)) gaps.push_back(gap);
  }
  std::sort(gaps.begin(), gaps.end());
  return gaps;
}

TEST(SampleCartilages, AreApartByTheClearanceLessTheSag) {
  const auto spheres = sample::articular_spheres({}, {});
  const double clearance = CartilageParameters{}.clearance_mm;
  for (const CartilageScenario scenario : {CartilageScenario::five, CartilageScenario::eight}) {
    const SampleCartilages& cartilages = made(scenario);
    EXPECT_FALSE(
        contact::JointContact(cartilages.acetabular, cartilages.femoral).radial(Pose::Identity()).in_contact);
    const auto gaps = articular_gaps(cartilages, spheres.femoral);
    const double sag = facets_on_sphere(cartilages.acetabular, spheres.acetabular).sag;
    ASSERT_GT(gaps.size(), cartilages.femoral.vertices.size() / 6);
    EXPECT_GE(gaps.front(), clearance - sag - 2 * laid_tolerance);
    // Off the rounded borders, which fewer than half see, facets are chords of the sphere.
    EXPECT_LE(gaps[gaps.size() / 2], clearance + 2 * laid_tolerance);
  }
}

TEST(SampleCartilages, OverlapNoDeeperAtTheirRimsThanTheyWerePushed) {
  // Apart in the neutral pose, they overlap by less than they are moved; a ray 48 degrees off that way, as from a rounded border,
  // goes 1.5 times as far.
  const Vec3 by(-0.02, 0.4, -0.11);
  Pose X_FM = Pose::Identity();
  X_FM.translation() = by;
  const contact::ElasticLayer cartilage{12, 0.42, 1.5};
  for (const CartilageScenario scenario : {CartilageScenario::six, CartilageScenario::seven}) {
    const contact::ElasticContact contact(Mesh(made(scenario).acetabular), Mesh(made(scenario).femoral),
                                          {.fixed = cartilage, .mobile = cartilage});
    const auto results = contact.at(X_FM);
    ASSERT_GT(results.fixed->rim_faces + results.mobile->rim_faces, 0u);
    EXPECT_LT(results.fixed->totals.max_depth_mm, 1.5 * by.norm());
    EXPECT_LT(results.mobile->totals.max_depth_mm, 1.5 * by.norm());
  }
}

TEST(SampleCartilages, OverlapByANegativeClearance) {
  CartilageParameters parameters;
  parameters.clearance_mm = -0.3;
  const auto spheres = sample::articular_spheres({}, parameters);
  const SampleCartilages cartilages = sample_cartilages({}, parameters, CartilageScenario::five);
  expect_sound(cartilages);
  EXPECT_NEAR(radii(cartilages.femoral).most - radii(cartilages.acetabular).least, 0.3, 2 * laid_tolerance);
  const auto gaps = articular_gaps(cartilages, spheres.femoral);
  const double sag = facets_on_sphere(cartilages.acetabular, spheres.acetabular).sag;
  ASSERT_GT(gaps.size(), cartilages.femoral.vertices.size() / 6);
  EXPECT_GE(gaps.front(), -0.3 - sag - 2 * laid_tolerance);
  EXPECT_LE(gaps[gaps.size() / 2], -0.3 + 2 * laid_tolerance);
}

TEST(SampleCartilages, LieOnTheirOwnBonesAndClearOfTheOther) {
  const auto femur = sample::femur_shape({}).field, hip_bone = sample::hip_bone_shape({}).field;
  struct Fit {
    double least = std::numeric_limits<double>::infinity();
    double touching = 0;  // part of the vertices
  };
  const auto fit = [](const Field& bone, const TriMesh& mesh) {
    Fit found;
    const std::size_t count = mesh.vertices.size();
    for (std::size_t v = 0; v < count; ++v) {
      const double value = bone(mesh.vertices[v]).value;
      found.least = std::min(found.least, value);
      if (value < laid_tolerance) found.touching += 1 / static_cast<double>(count);
    }
    return found;
  };
  const auto spheres = sample::articular_spheres({}, {});
  for (const CartilageScenario scenario : scenarios) {
    const auto& [acetabular, femoral] = made(scenario);
    // Inner and outer side have about as many vertices; borders have many too.
    const Fit on_femur = fit(femur, femoral), on_hip_bone = fit(hip_bone, acetabular);
    EXPECT_GT(on_femur.least, -laid_tolerance);
    EXPECT_GT(on_femur.touching, 0.3);
    EXPECT_GT(on_hip_bone.least, -laid_tolerance);
    EXPECT_GT(on_hip_bone.touching, 0.2);
    EXPECT_GE(fit(hip_bone, femoral).least, spheres.socket - spheres.femoral - 2 * laid_tolerance);
    EXPECT_GE(fit(femur, acetabular).least, spheres.acetabular - spheres.head - 2 * laid_tolerance);
  }
}

TEST(SampleCartilages, SameParametersGiveTheSameBytesOnAnyNumberOfThreads) {
  const SampleCartilages& first = made(CartilageScenario::five);
  const core::ThreadLimit one_thread(1);
  const SampleCartilages again = sample_cartilages({}, {}, CartilageScenario::five);
  EXPECT_EQ(again.femoral, first.femoral);
  EXPECT_EQ(again.acetabular, first.acetabular);
}

TEST(SampleCartilages, FitSmallAndLargeHips) {
  HipParameters small, large;
  small.head_radius_mm = 18;
  small.neck_radius_mm = 9;
  small.joint_space_mm = 2.2;
  small.lateral_centre_edge_angle = Angle::degrees(15);
  large.head_radius_mm = 32;
  large.neck_radius_mm = 0.8 * 32;
  large.joint_space_mm = 6;
  large.lateral_centre_edge_angle = Angle::degrees(45);
  expect_sound(sample_cartilages(small, {0.2, 1}, CartilageScenario::five));
  expect_sound(sample_cartilages(large, {-0.5, 3}, CartilageScenario::five));
}

TEST(SampleCartilages, ACamStandsOutThroughThem) {
  HipParameters with_cam;
  with_cam.alpha_angle = Angle::degrees(80);
  const auto without = sample::femoral_cartilage_shape({}, {}).solid.field;
  const auto with = sample::femoral_cartilage_shape(with_cam, {}).solid.field;
  const auto femur = sample::femur_shape(with_cam).field;
  const TriMesh& femoral = made(CartilageScenario::five).femoral;
  double deepest = 0;
  for (std::size_t v = 0; v < femoral.vertices.size(); ++v) {
    const Vec3 p = femoral.vertices[v];
    EXPECT_EQ(with(p).value, without(p).value);
    deepest = std::min(deepest, femur(p).value);
  }
  EXPECT_LT(deepest, -1);
}

TEST(SampleCartilages, AnyEvenCountAndAnyEdgeLengthCanBeAskedFor) {
  const SampleCartilages counted = sample_cartilages({}, {}, CartilageCounts{2000, 2002});
  EXPECT_EQ(counted.acetabular.triangles.size(), 2000u);
  EXPECT_EQ(counted.femoral.triangles.size(), 2002u);
  expect_sound(counted);
  const auto count = sample_cartilages({}, {}, EdgeLength{2}).femoral.triangles.size();
  // Outer and inner side of the cap at the defaults, of equilateral triangles with that edge; more, as edges
  // are shorter at the border.
  const double area = 2 * std::numbers::pi * (24 * 24 + 25.65 * 25.65) * (1 + std::cos(1.18));
  const double equilateral = area / std::sqrt(3.0);
  EXPECT_GT(static_cast<double>(count), equilateral);
  EXPECT_LT(static_cast<double>(count), 2 * equilateral);
}

void expect_refusal(const HipParameters& hip, const CartilageParameters& cartilage,
                    const CartilageResolution& resolution, std::string_view saying) {
  try {
    sample_cartilages(hip, cartilage, resolution);
    ADD_FAILURE() << "accepted: " << saying;
  } catch (const UsageError& error) {
    EXPECT_NE(std::string_view(error.what()).find(saying), std::string_view::npos) << error.what();
  }
}

TEST(SampleCartilages, WhatIsOutOfRangeIsNamed) {
  HipParameters narrow, wide_head;
  narrow.joint_space_mm = 2.4;
  wide_head.head_radius_mm = 40;
  const CartilageScenario any = CartilageScenario::five;
  expect_refusal({}, {-0.51, 1.65}, any, "clearance_mm is -0.51, must be -0.5 to 1");
  expect_refusal({}, {1.01, 1.65}, any, "clearance_mm");
  expect_refusal({}, {std::nan(""), 1.65}, any, "clearance_mm");
  expect_refusal({}, {0.2, 0.99}, any, "femoral_thickness_mm is 0.99, must be 1 to 3");
  expect_refusal({}, {0.2, 3.01}, any, "femoral_thickness_mm");
  expect_refusal(narrow, {0.2, 1.65}, any, "leaves 0.55 mm for the acetabular cartilage, must be at least 1");
  expect_refusal(wide_head, {}, any, "head_radius_mm");
  expect_refusal({}, {}, CartilageCounts{2876, 1998}, "femoral cartilage cannot have 1998 triangles");
  expect_refusal({}, {}, CartilageCounts{2877, 2824}, "acetabular cartilage cannot have 2877 triangles");
  expect_refusal({}, {}, EdgeLength{0.2}, "edge_length_mm");
  expect_refusal({}, {}, EdgeLength{3.1}, "edge_length_mm");
}

TEST(SampleCartilages, OfALeftHipAreTheMirrorImage) {
  const SampleCartilages& right = made(CartilageScenario::five);
  const SampleCartilages left = mirrored(right);
  expect_sound(left);
  for (std::size_t v = 0; v < left.femoral.vertices.size(); ++v) {
    EXPECT_EQ(left.femoral.vertices[v], Vec3(1, 1, -1).cwiseProduct(right.femoral.vertices[v]));
  }
  EXPECT_EQ(mirrored(left).femoral, right.femoral);
  EXPECT_EQ(mirrored(left).acetabular, right.acetabular);
}

}  // namespace
}  // namespace condyle::sample
