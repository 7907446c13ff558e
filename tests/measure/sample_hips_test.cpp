#include <iostream>

#include "condyle/hip_measures.hpp"
#include "condyle/sample/hip.hpp"
#include "measure/analytic_hip.hpp"
#include "measure/degree.hpp"
#include "measure/neck_axis.hpp"
#include "measure/sample_shape.hpp"
#include "sample/femur_shape.hpp"
#include "sample/hip_bone_shape.hpp"
#include "support/test.hpp"

/// Sample hips are measured as they were made: as their parameters say where a parameter means the measure, and as their solids are
/// where it means something else.

namespace condyle::measure {
namespace {

using namespace test;

sample::HipParameters drawn(std::mt19937& random) {
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  sample::HipParameters hip;
  hip.lateral_centre_edge_angle = Angle::degrees(between(20, 40));
  hip.acetabular_version = Angle::degrees(between(0, 30));
  hip.acetabular_inclination = Angle::degrees(between(42, 58));
  hip.neck_shaft_angle = Angle::degrees(between(120, 138));
  hip.femoral_anteversion = Angle::degrees(between(0, 30));
  const double alpha = between(55, 80);
  hip.alpha_angle = Angle::degrees(std::max(alpha, sample::native_alpha_angle(hip).degrees()));
  return hip;
}

struct Errors {
  double largest = 0, sum = 0, count = 0;
  void add(double error) { largest = std::max(largest, std::abs(error)), sum += error, ++count; }
};

/// Figures of docs/mathematics/11-measures.md are those of CONDYLE_LONG_TESTS.
void expect_within(double bound, const Errors& errors, const char* what) {
  EXPECT_LE(errors.largest, bound) << what;
  if (std::getenv("CONDYLE_LONG_TESTS"))
    std::cout << what << ": largest " << errors.largest << ", mean " << errors.sum / errors.count << " of "
              << errors.count << "\n";
}

double degrees_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) / degree;
}

// Triangles of 2 mm edges on a bump of 0.55 R sag by 2 * 2 / (8 * 13.2) mm: alpha is that of a tolerance that is off by as much, and
// within a tenth of a degree where it is not flagged.
constexpr double sag_mm = 0.038;

void expect_alpha(const Measure& alpha, double tolerance, double R, const sample::Field& shape,
                  const NeckGeometry& neck, bool is_flagged, Errors& errors) {
  const Vec3 at_1_30 = (neck.clock.twelve + neck.clock.three).normalized();
  const auto of_shape = [&](double at) { return alpha_of_shape(shape, R, neck.direction, at_1_30, at); };
  const double error = *alpha.value - of_shape(tolerance);
  if (!is_flagged) errors.add(error);
  if (std::abs(error) < 0.1) return;
  EXPECT_TRUE(is_flagged) << error;
  EXPECT_GT(*alpha.value, of_shape(tolerance + sag_mm) - 0.1);
  EXPECT_LT(*alpha.value, of_shape(tolerance - sag_mm) + 0.1);
}

/// Neck-shaft angle and torsion of a neck's direction on this femur.
struct NeckAngles {
  double neck_shaft_deg, torsion_deg;
};

NeckAngles angles_of(const Vec3& neck, const sample::FemurAxes& axes) {
  const Vec3 forwards = axes.lateral.cross(axes.distal);
  const double front = -neck.dot(forwards.x() > 0 ? forwards : Vec3(-forwards));
  return {180 - degrees_between(neck, axes.distal), std::atan2(front, neck.dot(axes.lateral)) / degree};
}

TEST(SampleMeasures, HipsAreMeasuredAsTheyWereMade) {
  const int count = std::getenv("CONDYLE_LONG_TESTS") ? 200 : 2;
  std::mt19937 random(1);
  Errors inclination, version, edge, edge_of_solid, edge_by_formula, neck_shaft, torsion, alpha, alpha_at_1mm,
      radius;
  Errors neck_of_solid, neck_shaft_of_solid, torsion_of_solid;
  for (int i = 0; i < count; ++i) {
    const sample::HipParameters made = drawn(random);
    const sample::SampleHip bones = sample::sample_hip(made, sample::Scenario::three);
    const HipMeasures m = measure_hip(hip_of(bones.hip_bone, bones.femur));
    ASSERT_TRUE(m.femur.neck && m.acetabulum.plane);
    const double R = made.head_radius_mm;
    radius.add(*m.femur.head_radius.value - R);
    inclination.add(*m.acetabulum.inclination.value - made.acetabular_inclination.degrees());
    version.add(*m.acetabulum.version.value - made.acetabular_version.degrees());
    neck_shaft.add(*m.femur.neck_shaft.value - made.neck_shaft_angle.degrees());
    torsion.add(*m.femur.torsion_in_frame.value - made.femoral_anteversion.degrees());
    const auto shape = sample::femur_shape(made).field;
    const auto axes = sample::femur_axes(made);
    const Vec3 neck = neck_of_shape(shape, axes.neck, measure::neck_sphere * R);
    const NeckAngles of_solid = angles_of(neck, axes);
    neck_of_solid.add(degrees_between(m.femur.neck->direction, neck));
    neck_shaft_of_solid.add(*m.femur.neck_shaft.value - of_solid.neck_shaft_deg);
    torsion_of_solid.add(*m.femur.torsion_in_frame.value - of_solid.torsion_deg);
    const double lateral_edge = *m.acetabulum.centre_edge_lateral.value;
    edge.add(lateral_edge - made.lateral_centre_edge_angle.degrees());
    edge_of_solid.add(lateral_edge - lateral_edge_of_shape(sample::hip_bone_shape(made).field, R));
    edge_by_formula.add(lateral_edge - lateral_edge_by_formula(made));
    const bool is_doubtful = !m.femur.alpha_1_30.note.empty();
    expect_alpha(m.femur.alpha_1_30, 0.5, R, shape, *m.femur.neck, is_doubtful, alpha);
    // At 1 mm the contour of a low cam leaves as slowly.
    const bool is_low = *m.femur.alpha_1_30.value - *m.femur.alpha_1_30_at_1mm.value > 2.5;
    expect_alpha(m.femur.alpha_1_30_at_1mm, 1, R, shape, *m.femur.neck, is_low, alpha_at_1mm);
    if (m.both.joint_space_median.value) {
      EXPECT_NEAR(*m.both.joint_space_median.value, made.joint_space_mm, 0.05);
    }
  }
  expect_within(0.05, radius, "radius");
  expect_within(0.5, inclination, "inclination");
  expect_within(0.5, version, "version");
  expect_within(0.5, edge_of_solid, "lateral edge of the solid");
  expect_within(0.5, edge_by_formula, "lateral edge by its closed form");
  expect_within(3, edge, "lateral edge by the parameter, which is the middle of a rounded rim");
  expect_within(0.05, neck_of_solid, "neck of the solid");
  expect_within(0.05, neck_shaft_of_solid, "neck-shaft of the solid");
  expect_within(2.1, neck_shaft, "neck-shaft by the parameter, which knows nothing of a cam");
  expect_within(0.05, torsion_of_solid, "torsion of the solid");
  expect_within(2, torsion, "torsion");
  expect_within(0.1, alpha, "alpha, not flagged");
  expect_within(0.1, alpha_at_1mm, "alpha at 1 mm, likewise");
}

/// By how much the solid is off the parameter that it was made with, whoever measures it.
TEST(SampleMeasures, SolidsAreOffTheParametersOfASampleHip) {
  const int count = std::getenv("CONDYLE_LONG_TESTS") ? 200 : 20;
  std::mt19937 random(1);
  Errors formula, neck_shaft, torsion, neck_shaft_without_cam, torsion_without_cam;
  for (int i = 0; i < count; ++i) {
    sample::HipParameters made = drawn(random);
    formula.add(lateral_edge_by_formula(made) -
                lateral_edge_of_shape(sample::hip_bone_shape(made).field, made.head_radius_mm));
    const auto axes = sample::femur_axes(made);
    const auto angles = [&] {
      return angles_of(neck_of_shape(sample::femur_shape(made).field, axes.neck,
                                     measure::neck_sphere * made.head_radius_mm),
                       axes);
    };
    const NeckAngles with = angles();
    made.alpha_angle.reset();
    const NeckAngles without = angles();
    neck_shaft.add(with.neck_shaft_deg - made.neck_shaft_angle.degrees());
    torsion.add(with.torsion_deg - made.femoral_anteversion.degrees());
    neck_shaft_without_cam.add(without.neck_shaft_deg - made.neck_shaft_angle.degrees());
    torsion_without_cam.add(without.torsion_deg - made.femoral_anteversion.degrees());
  }
  expect_within(0.3, formula, "closed form of the lateral edge");
  expect_within(2.1, neck_shaft, "neck-shaft");
  expect_within(1.4, neck_shaft_without_cam, "neck-shaft without cam");
  expect_within(1.7, torsion, "torsion");
  expect_within(0.5, torsion_without_cam, "torsion without cam");
}

}  // namespace
}  // namespace condyle::measure
