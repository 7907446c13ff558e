#include "condyle/hip_measures.hpp"
#include "condyle/inspect.hpp"
#include "measure/analytic_hip.hpp"
#include "measure/degree.hpp"
#include "measure/neck_axis.hpp"
#include "support/test.hpp"

/// Measures of shapes with closed forms: within 0.01 degrees at facets of one degree.

namespace condyle::measure {
namespace {

using namespace test;

constexpr double within_deg = 0.01;

/// Down, out and a little back.
const Vec3 neck_axis = Vec3(-0.2, -0.62, 0.76).normalized();

TriMesh some_cup() {
  return sharp_cup(opening_of(45, 18), 27.5, 0);
}

struct ConeCase {
  double R, r0, m, at_half, at_one;
};

TEST(KnownMeasures, AlphaOfAConeOnASphereIsThatOfTheToleranceFormulaAtEveryHour) {
  for (const ConeCase& cone : {ConeCase{24, 14, 0, 34.850, 34.056}, ConeCase{24, 12, 0.15, 37.502, 36.870}}) {
    const double R = cone.R, r0 = cone.r0, m = cone.m;
    const auto formula = [&](double tau) {
      return (std::asin(r0 / ((R + tau) * std::sqrt(1 + m * m))) + std::atan(m)) / degree;
    };
    EXPECT_NEAR(formula(0.5), cone.at_half, 0.001);
    EXPECT_NEAR(formula(1), cone.at_one, 0.001);
    const FemurMeasures femur = measure_hip(hip_of(some_cup(), head_with_cone(neck_axis, R, r0, m))).femur;
    ASSERT_TRUE(femur.neck);
    EXPECT_LT((femur.neck->direction - neck_axis).norm(), 1e-6);
    EXPECT_EQ(femur.neck->clock_from, ClockSource::frame);
    EXPECT_NEAR(*femur.head_radius.value, R, 1e-6);
    ASSERT_EQ(femur.around_neck.size(), 144u);
    for (const NeckHour& hour : femur.around_neck) {
      ASSERT_TRUE(hour.alpha_deg) << hour.why_no_alpha;
      EXPECT_NEAR(*hour.alpha_deg, formula(0.5), within_deg) << hour.hour;
      EXPECT_NEAR(*hour.alpha_at_1mm_deg, formula(1), within_deg) << hour.hour;
      EXPECT_FALSE(hour.is_doubtful);
      // The neck is narrowest where it leaves the head; facets around it sag by half a degree's versed sine.
      EXPECT_NEAR(*hour.offset_mm, R - R * std::sin(formula(0) * degree), R * 4e-5);
    }
  }
}

/// A head of 24 mm with a tube for a neck and a ball on it at 50 degrees from the neck, at half past one.
struct BallOnHead {
  static constexpr double R = 24, d = 14, beta = 50, b = 13.2, end = 60;
  double neck_radius;

  double distance(double from_axis, double turn) const {
    const double s = std::sin(from_axis), c = std::cos(from_axis);
    double r = R;
    if (c > 0) r = std::max(r, std::min(s > 0 ? neck_radius / s : end, end / c));
    // |r u - d w| = b, w being the ball's direction: 3 o'clock of a right hip is at -90 degrees about its neck.
    const double cosine =
        c * std::cos(beta * degree) + s * std::sin(beta * degree) * std::cos(turn + 45 * degree);
    const double root = b * b - d * d * (1 - cosine * cosine);
    return root > 0 ? std::max(r, d * cosine + std::sqrt(root)) : r;
  }
  Joint hip() const {
    // The clock of a femur without a shaft: 12 is the frame's superior.
    const Vec3 twelve = (Vec3::UnitY() - neck_axis.y() * neck_axis).normalized();
    return hip_of(some_cup(), star_shaped(neck_axis, twelve, [&](double from_axis, double turn) {
                    return distance(from_axis, turn);
                  }));
  }
  /// Where the ball's circle leaves the head's, on its side towards the head.
  static double alpha_deg(double tau) {
    const double far = R + tau;
    return beta + std::acos((far * far + d * d - b * b) / (2 * d * far)) / degree;
  }
};

constexpr const char* no_shaft = "no shaft: 12 o'clock is the frame's superior";

TEST(KnownMeasures, AlphaOfABallOnAHeadIsWhereTheBallLeavesIt) {
  EXPECT_NEAR(BallOnHead::alpha_deg(0.5), 74.944, 0.001);
  EXPECT_NEAR(BallOnHead::alpha_deg(1), 72.491, 0.001);
  const Joint hip = BallOnHead{14}.hip();
  for (const Joint& joint : {hip, mirrored_hip(hip)}) {
    const FemurMeasures femur = measure_hip(joint).femur;
    ASSERT_TRUE(femur.alpha_1_30.value) << femur.alpha_1_30.why_none;
    EXPECT_NEAR(*femur.alpha_1_30.value, BallOnHead::alpha_deg(0.5), within_deg);
    EXPECT_NEAR(*femur.alpha_1_30_at_1mm.value, BallOnHead::alpha_deg(1), within_deg);
    EXPECT_NEAR(*femur.alpha_largest.value, BallOnHead::alpha_deg(0.5), within_deg);
    EXPECT_NEAR(*femur.alpha_largest_hour.value, 1.5, 1e-9);
    EXPECT_EQ(femur.alpha_1_30.note, no_shaft);
  }
}

TEST(KnownMeasures, ABallBehindAGrooveIsNotedWithTheAlphaOfTheNeck) {
  const FemurMeasures femur = measure_hip(BallOnHead{9}.hip()).femur;
  EXPECT_NEAR(*femur.alpha_1_30.value, std::asin(9 / 24.5) / degree, within_deg);
  EXPECT_EQ(femur.alpha_1_30.note,
            std::string("the contour is outside its circle again up to 74.9; ") + no_shaft);
  EXPECT_EQ(femur.alpha_3.note, no_shaft);
}

struct CupCase {
  double S, inclination, version, h, lateral, anterior, covered;
};

TEST(KnownMeasures, ACupCutByAPlaneHasItsInclinationVersionAndEdges) {
  for (const CupCase& c :
       {CupCase{27.5, 45, 18, 0, 46.437, 72.828, 0.5}, CupCase{27, 50, 10, 3, 46.869, 88.053, 0.556}}) {
    const Vec3 o = opening_of(c.inclination, c.version);
    const auto edge = [&](const Vec3& e) {
      const double out = o.dot(e);
      return (std::atan2(-o.y(), out) + std::asin(c.h / c.S / std::hypot(out, o.y()))) / degree;
    };
    EXPECT_NEAR(edge(Vec3::UnitZ()), c.lateral, 0.001);
    EXPECT_NEAR(edge(Vec3::UnitX()), c.anterior, 0.001);
    const Joint hip = hip_of(sharp_cup(o, c.S, c.h), head_with_cone(neck_axis, 24, 12, 0.15));
    for (const Joint& joint : {c.h > 0 ? hip : mirrored_hip(hip)}) {
      const HipMeasures all = measure_hip(joint);
      const AcetabulumMeasures& m = all.acetabulum;
      ASSERT_TRUE(m.inclination.value) << m.inclination.why_none;
      EXPECT_NEAR(*m.inclination.value, c.inclination, within_deg);
      EXPECT_NEAR(*m.version.value, c.version, within_deg);
      EXPECT_NEAR(*m.inclination_radiographic.value, std::atan2(o.z(), -o.y()) / degree, within_deg);
      EXPECT_NEAR(*m.version_radiographic.value, std::asin(o.x()) / degree, within_deg);
      EXPECT_NEAR(*m.centre_edge_lateral.value, c.lateral, within_deg);
      EXPECT_NEAR(*m.centre_edge_anterior.value, c.anterior, within_deg);
      EXPECT_NEAR(*m.centre_edge_posterior.value, edge(-Vec3::UnitX()), within_deg);
      EXPECT_NEAR(*m.coverage.value, (1 + c.h / c.S) / 2, 1e-4);
      EXPECT_NEAR(*m.coverage.value, c.covered, 1e-3);
      EXPECT_NEAR(*m.rim_radius.value, std::sqrt(c.S * c.S - c.h * c.h), 2e-3);
      EXPECT_NEAR(*m.rim_height.value, c.h, 1e-3);
      for (const Measure* at_height : {&m.version_0mm, &m.version_5mm, &m.version_10mm}) {
        ASSERT_TRUE(at_height->value) << at_height->why_none;
        EXPECT_NEAR(*at_height->value, c.version, within_deg);
      }
      EXPECT_NEAR(*all.both.joint_space_median.value, c.S - 24, 0.002);
      EXPECT_NEAR(*all.both.joint_space_least.value, c.S - 24, 0.002);
    }
  }
}

TEST(KnownMeasures, APelvisThatTiltsForwardsTurnsItsOpeningAndNothingOfTheFemur) {
  const Vec3 o = opening_of(45, 18);
  const Joint hip = hip_of(sharp_cup(o, 27.5, 0), head_with_cone(neck_axis, 24, 12, 0.15));
  const HipMeasures level = measure_hip(hip);
  for (const double tilt : {-10.0, 20.0}) {
    const Vec3 tilted = Eigen::AngleAxisd(-tilt * degree, Vec3::UnitZ()) * o;
    const HipMeasures m = measure_hip(hip, {.pelvic_tilt = Angle::degrees(tilt)});
    EXPECT_NEAR(*m.acetabulum.version.value, std::atan2(tilted.x(), tilted.z()) / degree, within_deg);
    EXPECT_NEAR(*m.acetabulum.inclination.value, std::acos(-tilted.y()) / degree, within_deg);
    EXPECT_NEAR(*m.acetabulum.centre_edge_lateral.value, std::atan2(-tilted.y(), tilted.z()) / degree,
                within_deg);
    EXPECT_EQ(tilt > 0, *m.acetabulum.version.value < *level.acetabulum.version.value)
        << "forward tilt retroverts";
    EXPECT_EQ(m.femur.alpha_3.value, level.femur.alpha_3.value);
    // The same socket in a frame that is turned the other way.
    const Joint turned = hip_of(sharp_cup(tilted, 27.5, 0), hip.mobile.mesh);
    EXPECT_NEAR(*measure_hip(turned).acetabulum.version.value, *m.acetabulum.version.value, within_deg);
  }
}

TEST(KnownMeasures, ANecksVectorAreaIsThatOfTheLoopItCuts) {
  // A prism about the axis gives a loop whose vector area is the prism's own cross-section, whatever the sphere.
  const Sphere head{Vec3::Zero(), 24};
  constexpr int facets = 6;
  const TriMesh femur = revolved(neck_axis, {{-10, 0}, {-10, 12}, {70, 12}, {70, 0}}, facets);
  const auto found = measure::find_neck(femur, head, std::vector<char>(femur.vertices.size()));
  ASSERT_TRUE(found.neck) << found.why_none;
  EXPECT_LT((found.neck->direction - neck_axis).norm(), 1e-12);
  EXPECT_NEAR(found.neck->area_mm2, facets / 2.0 * 144 * std::sin(2 * std::numbers::pi / facets), 1e-9);
}

}  // namespace
}  // namespace condyle::measure
