#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <numbers>
#include <random>

#include "condyle/hip_measures.hpp"
#include "condyle/sample/hip.hpp"
#include "measure/analytic_hip.hpp"
#include "sample/femur_shape.hpp"

/// Sample hips are measured as they were made.

namespace condyle {
namespace {

using namespace test;

constexpr double degree = std::numbers::pi / 180;

HipParameters drawn(std::mt19937& random) {
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  HipParameters hip;
  hip.lateral_centre_edge_angle = Angle::degrees(between(20, 40));
  hip.acetabular_version = Angle::degrees(between(0, 30));
  hip.acetabular_inclination = Angle::degrees(between(42, 58));
  hip.neck_shaft_angle = Angle::degrees(between(120, 138));
  hip.femoral_anteversion = Angle::degrees(between(0, 30));
  const double alpha = between(55, 80);
  hip.alpha_angle = Angle::degrees(std::max(alpha, sample::native_alpha_angle(hip).degrees()));
  return hip;
}

/// Alpha of the shape that the mesh was made of, in a half-plane of a neck's axis: from the neck, the first angle at which no
/// solid is farther from the centre than the head's radius and the tolerance. Steps of a fiftieth of a degree, and bisection.
double alpha_of_shape(const sample::Field& femur, double R, const Vec3& neck, const Vec3& out,
                      double tolerance) {
  const auto solid_beyond = [&](double angle) {
    const Vec3 towards = std::cos(angle) * neck + std::sin(angle) * out;
    for (double far = R + tolerance; far < 1.6 * R; far += 0.25)
      if (femur(far * towards).value <= 0) return true;
    return false;
  };
  double angle = 15 * degree;
  while (solid_beyond(angle)) angle += 0.02 * degree;
  double low = angle - 0.02 * degree, high = angle;
  for (int i = 0; i < 20; ++i) (solid_beyond((low + high) / 2) ? low : high) = (low + high) / 2;
  return high / degree;
}

struct Errors {
  double largest = 0, sum = 0, count = 0;
  void add(double error) { largest = std::max(largest, std::abs(error)), sum += error, ++count; }
};

std::ostream& operator<<(std::ostream& to, const Errors& errors) {
  return to << "largest " << errors.largest << ", mean " << errors.sum / errors.count;
}

TEST(SampleMeasures, HipsAreMeasuredAsTheyWereMade) {
  const int count = std::getenv("CONDYLE_LONG_TESTS") ? 200 : 6;
  std::mt19937 random(1);
  Errors inclination, version, lateral_edge, neck_shaft, torsion, alpha, alpha_at_1mm, radius;
  for (int i = 0; i < count; ++i) {
    const HipParameters made = drawn(random);
    const SampleHip bones = sample_hip(made, Scenario::three);
    const HipMeasures m = measure_hip(hip_of(bones.hip_bone, bones.femur));
    ASSERT_TRUE(m.femur.neck && m.acetabulum.plane);
    radius.add(*m.femur.head_radius.value - made.head_radius_mm);
    inclination.add(*m.acetabulum.inclination.value - made.acetabular_inclination.degrees());
    version.add(*m.acetabulum.version.value - made.acetabular_version.degrees());
    lateral_edge.add(*m.acetabulum.centre_edge_lateral.value - made.lateral_centre_edge_angle.degrees());
    neck_shaft.add(*m.femur.neck_shaft.value - made.neck_shaft_angle.degrees());
    torsion.add(*m.femur.torsion_in_frame.value - made.femoral_anteversion.degrees());
    const auto shape = sample::femur_shape(made).field;
    const NeckGeometry& neck = *m.femur.neck;
    const Vec3 at_1_30 = (neck.clock.twelve + neck.clock.three).normalized();
    const auto expected = [&](double tolerance) {
      return alpha_of_shape(shape, made.head_radius_mm, neck.direction, at_1_30, tolerance);
    };
    alpha.add(*m.femur.alpha_1_30.value - expected(0.5));
    alpha_at_1mm.add(*m.femur.alpha_1_30_at_1mm.value - expected(1));
    EXPECT_NEAR(*m.both.joint_space_median.value, made.joint_space_mm, 0.05);
  }
  EXPECT_LT(radius.largest, 0.05) << radius;
  EXPECT_LT(inclination.largest, 0.5) << inclination;
  EXPECT_LT(version.largest, 0.5) << version;
  EXPECT_LT(lateral_edge.largest, 2) << lateral_edge;
  EXPECT_LT(neck_shaft.largest, 2) << neck_shaft;
  EXPECT_LT(torsion.largest, 2) << torsion;
  EXPECT_LT(alpha.largest, 0.1) << alpha;
  EXPECT_LT(alpha_at_1mm.largest, 0.1) << alpha_at_1mm;
  std::cout << "radius: " << radius << "\ninclination: " << inclination << "\nversion: " << version
            << "\nlateral edge: " << lateral_edge << "\nneck-shaft: " << neck_shaft
            << "\ntorsion: " << torsion << "\nalpha: " << alpha << "\nalpha at 1 mm: " << alpha_at_1mm
            << "\n";
}

}  // namespace
}  // namespace condyle
