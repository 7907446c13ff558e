#include "condyle/bearing.hpp"
#include "condyle/hip_measures.hpp"
#include "condyle/sample/hip.hpp"
#include "measure/analytic_hip.hpp"
#include "mesh/cut_mesh.hpp"
#include "support/real_hip.hpp"
#include "support/test.hpp"

/// Parts missing from the meshes are not measured, with a reason; measures that do not depend on them are unchanged.

namespace condyle::measure {
namespace {

using namespace test;

const sample::SampleHip& sample() {
  static const sample::SampleHip hip = sample::sample_hip({}, sample::Scenario::two);
  return hip;
}

/// The triangles whose corners are all kept: open where it is cut.
template <class Keep>
TriMesh kept_of(const TriMesh& mesh, const Keep& keep) {
  TriMesh kept{mesh.vertices, {}};
  for (const Triangle& t : mesh.triangles)
    if (keep(mesh.vertices[t[0]]) && keep(mesh.vertices[t[1]]) && keep(mesh.vertices[t[2]]))
      kept.triangles.push_back(t);
  return kept;
}

void expect_why(const Measure& measure, const std::string& part) {
  EXPECT_FALSE(measure.value) << *measure.value;
  EXPECT_NE(measure.why_none.find(part), std::string::npos) << measure.why_none;
}

TEST(MissingParts, EveryMeasureHasAValueOrAReason) {
  const TriMesh& hip_bone = sample().hip_bone;
  const TriMesh& femur = sample().femur;
  const auto near = [](double radius) { return [=](const Vec3& p) { return p.norm() < radius; }; };
  const auto roof = [](const Vec3& p) { return p.y() > 10; };
  for (const Joint& joint :
       {hip_of(hip_bone, femur), hip_of(hip_bone, kept_of(femur, near(40))),
        hip_of(hip_bone, kept_of(femur, near(28))), hip_of(kept_of(hip_bone, roof), femur),
        hip_of(kept_of(hip_bone, near(45)), femur), hip_of(box({60, 60, 60}, {90, 90, 90}), femur),
        hip_of(hip_bone, box({-20, -20, -20}, {20, 20, 20}))}) {
    const HipMeasures m = measure_hip(joint);
    for (const MeasureDefinition& definition : measure_definitions()) {
      const Measure& measure = definition.of(m);
      EXPECT_NE(measure.value.has_value(), !measure.why_none.empty()) << definition.key;
      if (measure.value) {
        EXPECT_TRUE(std::isfinite(*measure.value)) << definition.key;
      }
    }
  }
}

TEST(MissingParts, WithoutShaftThereIsNoNeckShaftAngleAndTheClockIsTheFrames) {
  const Joint cut =
      hip_of(sample().hip_bone, kept_of(sample().femur, [](const Vec3& p) { return p.y() > -60; }));
  const FemurMeasures m = measure_hip(cut).femur;
  expect_why(m.neck_shaft, "no straight shaft");
  expect_why(m.trochanter_height, "no straight shaft");
  expect_why(m.version, "the mesh ends above the knee");
  ASSERT_TRUE(m.neck);
  EXPECT_EQ(m.neck->clock_from, ClockSource::frame);
  EXPECT_TRUE(m.alpha_1_30.value);
  EXPECT_FALSE(m.torsion_in_frame.note.empty());
}

TEST(MissingParts, AHeadWithoutNeckHasOnlyTheMeasuresOfAHead) {
  const Joint cut =
      hip_of(sample().hip_bone, kept_of(sample().femur, [](const Vec3& p) { return p.norm() < 28; }));
  const HipMeasures m = measure_hip(cut);
  EXPECT_NEAR(*m.femur.head_radius.value, 24, 0.01);
  expect_why(m.femur.neck_shaft, "no");
  expect_why(m.femur.alpha_12, "has no neck");
  EXPECT_TRUE(m.femur.around_neck.empty());
  EXPECT_TRUE(m.acetabulum.inclination.value);
}

/// What the neck's axis and the clock about it decide.
constexpr std::array of_neck{
    &FemurMeasures::torsion_in_frame, &FemurMeasures::alpha_12,      &FemurMeasures::alpha_1_30,
    &FemurMeasures::alpha_3,          &FemurMeasures::alpha_largest, &FemurMeasures::alpha_largest_at_1mm,
    &FemurMeasures::offset_12,        &FemurMeasures::offset_1_30,   &FemurMeasures::offset_3};

TEST(MissingParts, AFemurCutNearItsHeadHasTheMeasuresOfTheWholeNeckOrNone) {
  std::vector<Joint> hips{hip_of(sample().hip_bone, sample().femur)};
  if (const auto real = hip_vhf_right()) hips.push_back(*real);
  for (const Joint& hip : hips) {
    const NeckGeometry neck = *measure_hip(hip).femur.neck;
    const auto cut_at = [&](const Vec3& along, double radii) {
      const std::array plane{mesh::CuttingPlane{neck.head.centre + radii * neck.head.radius * along, along}};
      return measure_hip(
                 hip_of(hip.fixed.mesh, mesh::cut_by_planes(hip.mobile.mesh, "femur", plane).inner.mesh))
          .femur;
    };
    for (const Vec3& along : {Vec3(0, -1, 0), neck.direction}) {
      const FemurMeasures far = cut_at(along, 2);  // the clock is the frame's here too
      for (const double radii : {0.75, 1.2, 1.32, 1.45, 1.55}) {
        const FemurMeasures m = cut_at(along, radii);
        for (const auto measure : of_neck) {
          const Measure& found = m.*measure;
          const bool is_offset = measure == &FemurMeasures::offset_12 ||
                                 measure == &FemurMeasures::offset_1_30 ||
                                 measure == &FemurMeasures::offset_3;
          EXPECT_NEAR(found.value.value_or(0), found.value ? *(far.*measure).value : 0, 0.05) << radii;
          EXPECT_TRUE(found.value || radii < 1.4 || is_offset) << radii << found.why_none;
        }
        if (radii <= 1.2) expect_why(m.alpha_largest, "within 1.4 radii of the head");
      }
    }
  }
}

TEST(MissingParts, WithoutARimThereIsNoOpeningAndWithoutASocketNothingOfIt) {
  const Joint roof =
      hip_of(kept_of(sample().hip_bone, [](const Vec3& p) { return p.y() > 10; }), sample().femur);
  const HipMeasures of_roof = measure_hip(roof);
  expect_why(of_roof.acetabulum.inclination, "of 360 degrees");
  expect_why(of_roof.acetabulum.version_10mm, "of 360 degrees");
  expect_why(of_roof.both.ischiofemoral, "the hip bone ends");
  EXPECT_TRUE(of_roof.acetabulum.centre_edge_lateral.value) << "a section needs no whole rim";
  const Joint cut_short =
      hip_of(kept_of(sample().hip_bone, [](const Vec3& p) { return p.z() < 10; }), sample().femur);
  expect_why(measure_hip(cut_short).acetabulum.centre_edge_lateral, "the mesh ends where the roof goes on");
  const Joint none = hip_of(box({60, 60, 60}, {90, 90, 90}), sample().femur);
  const HipMeasures m = measure_hip(none);
  expect_why(m.acetabulum.coverage, "no socket faces the head");
  expect_why(m.both.joint_space_least, "no socket's sphere");
  EXPECT_TRUE(m.femur.alpha_12.value);
}

// A joint without bone that had to go states its socket, so that nothing fits it anew.
TEST(MissingParts, ASocketThatIsStatedIsOnTheMeshAsOneThatIsFound) {
  std::vector<Joint> hips{hip_of(sample().hip_bone, sample().femur)};
  if (const auto real = hip_vhf_right()) hips.push_back(*real);
  for (Joint& hip : hips) {
    const HipMeasures found = measure_hip(hip);
    const auto bearing = motion::find_bearing_surface(hip).surface;
    ASSERT_TRUE(bearing && bearing->socket);
    hip.fixed.head = bearing->socket;
    const HipMeasures stated = measure_hip(hip);
    ASSERT_TRUE(stated.both.joint_space_least.value) << stated.both.joint_space_least.why_none;
    // The floor of a fossa is left out by deviations from the sphere that is stated, or from one fitted without it.
    EXPECT_NEAR(*stated.both.joint_space_least.value, *found.both.joint_space_least.value, 1e-9);
    EXPECT_NEAR(*stated.both.joint_space_median.value, *found.both.joint_space_median.value, 0.1);
    EXPECT_EQ(stated.acetabulum.inclination.note, found.acetabulum.inclination.note);
    hip.fixed.head->centre += Vec3(80, 0, 0);
    expect_why(measure_hip(hip).both.joint_space_least, "no socket's sphere");
  }
}

TEST(MissingParts, WithoutAHeadNothingIsMeasured) {
  const HipMeasures m = measure_hip(hip_of(sample().hip_bone, box({-20, -20, -20}, {20, 20, 20})));
  for (const MeasureDefinition& definition : measure_definitions())
    expect_why(definition.of(m), "no spherical head");
}

TEST(MissingParts, ASocketThatASagittalPlaneCutsIsMeasuredAsItIsOrNotAtAll) {
  const HipMeasures whole = measure_hip(hip_of(sample().hip_bone, sample().femur));
  for (const double at : {-12.0, -6.0, 0.0, 6.0, 12.0}) {
    const std::array planes{mesh::CuttingPlane{{0, 0, at}, Vec3::UnitZ()}};
    const TriMesh cut = mesh::cut_by_planes(Mesh(sample().hip_bone), "hip bone", planes).inner.mesh;
    const AcetabulumMeasures m = measure_hip(hip_of(cut, sample().femur)).acetabulum;
    // The roof goes on beyond the plane: 28 degrees out of the head's 24 mm and 4 of joint space is 13 mm.
    expect_why(m.centre_edge_lateral, "the mesh ends where the roof goes on");
    if (m.inclination.value) {
      EXPECT_NEAR(*m.inclination.value, *whole.acetabulum.inclination.value, 5) << at;
      EXPECT_NE(m.inclination.note.find("the hip bone ends in the rim"), std::string::npos)
          << m.inclination.note;
    } else {
      EXPECT_NE(m.inclination.why_none.find("the rim is in the mesh over"), std::string::npos)
          << m.inclination.why_none;
    }
  }
}

TEST(MissingParts, OnlyBonesAreMeasured) {
  // A shell around the head that is called bearing, in the femur's own mesh.
  const TriMesh& femur = sample().femur;
  const TriMesh both = joined(femur, sphere(Vec3::Zero(), 26, 4));
  Joint joint = hip_of(sample().hip_bone, both);
  joint.mobile.parts = {
      {"femur", 0, femur.vertices.size(), 0, femur.triangles.size(), PartContact::ends},
      {"cartilage", femur.vertices.size(), both.vertices.size() - femur.vertices.size(),
       femur.triangles.size(), both.triangles.size() - femur.triangles.size(), PartContact::bearing}};
  const HipMeasures m = measure_hip(joint), bare = measure_hip(hip_of(sample().hip_bone, femur));
  EXPECT_NEAR(*m.femur.head_radius.value, 24, 0.01);
  EXPECT_NEAR(*m.femur.alpha_1_30.value, *bare.femur.alpha_1_30.value, 1e-9);
  EXPECT_NEAR(*m.both.joint_space_median.value, *bare.both.joint_space_median.value, 1e-9);
}

TEST(MissingParts, OtherJointsAndWildRequestsAreRefused) {
  Joint joint = hip_of(sample().hip_bone, sample().femur);
  EXPECT_THROW(measure_hip(joint, {.pelvic_tilt = Angle::degrees(61)}), UsageError);
  EXPECT_THROW(measure_hip(joint, {.pelvic_tilt = Angle::degrees(std::nan(""))}), UsageError);
  joint.kind = JointKind::hinge;
  EXPECT_THROW(measure_hip(joint), UsageError);
  joint.kind = JointKind::ball, joint.anatomy = Anatomy::shoulder;
  EXPECT_THROW(measure_hip(joint), UsageError);
}

TEST(MissingParts, CondylesThatAreTwistedOnTheShaftTwistFemoralVersion) {
  FOUND_OR_SKIP(hip, hip_vhf_right());
  const FemurMeasures given = measure_hip(*hip).femur;
  ASSERT_TRUE(given.condyles);
  const Vec3 head = given.neck->head.centre, down = (given.condyles->middle - head).normalized();
  constexpr double twist_deg = 10;
  Points vertices = hip->mobile.mesh.vertices();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const Vec3 p = vertices[v] - head;
    // Down is the axis: on a right femur a positive turn about it brings the medial condyle backwards.
    if (p.dot(down) > 250)
      vertices.set(v, head + Eigen::AngleAxisd(twist_deg * std::numbers::pi / 180, down) * p);
  }
  const Joint twisted = hip_of(hip->fixed.mesh, TriMesh{vertices, hip->mobile.mesh.triangles()});
  const FemurMeasures m = measure_hip(twisted).femur;
  ASSERT_TRUE(m.version.value) << m.version.why_none;
  EXPECT_NEAR(std::abs(*m.version.value - *given.version.value), twist_deg, 0.05);
  EXPECT_NEAR(*m.neck_shaft.value, *given.neck_shaft.value, 1e-9);
}

}  // namespace
}  // namespace condyle::measure
