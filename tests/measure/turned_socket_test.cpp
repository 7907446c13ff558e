#include "condyle/hip_measures.hpp"
#include "condyle/make_joint.hpp"
#include "measure/analytic_hip.hpp"
#include "measure/degree.hpp"
#include "support/test.hpp"

/// A spherical socket cut from its bone and turned about the head's centre: centre-edge angles and coverage in closed form.

namespace condyle::measure {
namespace {

using namespace test;

/// Opening of a right hip by Murray's radiographic inclination and anteversion.
Vec3 radiographic(double inclination_deg, double anteversion_deg) {
  const double RI = inclination_deg * degree, RA = anteversion_deg * degree;
  return {std::sin(RA), -std::cos(RI) * std::cos(RA), std::sin(RI) * std::cos(RA)};
}

/// Centre-edge angle towards l of a socket of half-angle alpha about -c: docs/parts.md.
double edge_deg(const Vec3& c, double alpha_deg, const Vec3& l) {
  const double up = c.y(), side = c.dot(l);
  return (std::atan2(-side, -up) + std::acos(std::cos(alpha_deg * degree) / std::hypot(up, side))) / degree;
}

struct TurnedSocket {
  double frontal, sagittal, version;
  double lateral, anterior, posterior;
};
struct SocketCase {
  double inclination, anteversion, alpha;
  std::vector<TurnedSocket> turned;
};

/// The part of a thick cup before a plane behind its socket, which cuts its back off; with the parameters of a fragment.
Joint cut_socket(const SocketCase& c, Side side) {
  const Vec3 o = radiographic(c.inclination, c.anteversion);
  constexpr double radius = 27.5, plane = 31;
  Joint hip = hip_of(sharp_cup(o, radius, -radius * std::cos(c.alpha * degree)),
                     head_with_cone(Vec3(-0.2, -0.62, 0.76).normalized(), 24, 12, 0.15));
  const double s = side == Side::right ? 1 : -1;
  if (side == Side::left) hip = mirrored_hip(hip);
  JointDescription description{.name = "hip", .kind = JointKind::ball, .side = side};
  PosedPart fragment{.name = "fragment", .body = BodyRole::fixed};
  for (const ParameterKind kind : {ParameterKind::frontal, ParameterKind::sagittal, ParameterKind::version})
    fragment.parameters.push_back({.name = std::string(name_of(kind)), .kind = kind, .low = -40, .high = 40});
  const Vec3 behind(-o.x(), -o.y(), -s * o.z());
  fragment.cut = {{plane * behind, behind.normalized()}};
  description.parts = {{std::move(fragment)}};
  return make_joint(description, {"hip bone", hip.fixed.mesh}, {"femur", hip.mobile.mesh}).joint;
}

const std::vector<SocketCase> cases = {
    {50,
     15,
     70,
     {{0, 0, 0, 19.262605, 36.810225, 82.068337},
      {10, 0, 0, 29.262605, 44.852679, 83.410600},
      {20, 0, 0, 39.262605, 49.816404, 84.200652},
      {20, 10, 0, 35.906679, 41.925387, 91.499875},
      {20, 0, 10, 40.505935, 42.606417, 92.866803},
      {25, -5, 8, 46.967858, 49.545492, 87.501541}}},
    {45, 20, 75, {{0, 0, 0, 29.012390, 42.500738, 96.973364}, {10, 0, 0, 39.012390, 48.148347, 96.061953}}}};

TEST(TurnedSocket, HasTheCentreEdgeAnglesOfTheClosedForm) {
  constexpr double within_deg = 0.01;  // facets of one degree, as in KnownMeasures
  // A left hip in one case: its turns have the other sign.
  for (const auto& [side, c] : {std::pair(Side::right, cases[0]), std::pair(Side::right, cases[1]),
                                std::pair(Side::left, SocketCase{50, 15, 70, {cases[0].turned.back()}})}) {
    const Joint joint = cut_socket(c, side);
    ASSERT_TRUE(is_cut(joint.fixed));
    const double coverage = *measure_hip(joint).acetabulum.coverage.value;
    for (const TurnedSocket& turned : c.turned) {
      const std::vector<ParameterValue> values = {{"fragment.frontal", turned.frontal},
                                                  {"fragment.sagittal", turned.sagittal},
                                                  {"fragment.version", turned.version}};
      const HipMeasures all = measure_hip(with_parameters(joint, values));
      const AcetabulumMeasures& m = all.acetabulum;
      ASSERT_TRUE(m.centre_edge_lateral.value) << m.centre_edge_lateral.why_none;
      EXPECT_NEAR(*m.centre_edge_lateral.value, turned.lateral, within_deg);
      EXPECT_NEAR(*m.centre_edge_anterior.value, turned.anterior, within_deg);
      EXPECT_NEAR(*m.centre_edge_posterior.value, turned.posterior, within_deg);
      // The cone that a socket covers goes round with it.
      EXPECT_NEAR(*m.coverage.value, coverage, 1e-4);
      EXPECT_TRUE(all.left_out.empty());
    }
    EXPECT_NEAR(coverage, (1 - std::cos(c.alpha * degree)) / 2, 1e-3);
  }
}

TEST(TurnedSocket, ClosedFormsAreThoseOfItsOpening) {
  for (const SocketCase& c : cases) {
    const Vec3 o = radiographic(c.inclination, c.anteversion);
    for (const TurnedSocket& turned : c.turned) {
      const Eigen::Matrix3d Q = (Eigen::AngleAxisd(turned.frontal * degree, Vec3::UnitX()) *
                                 Eigen::AngleAxisd(turned.sagittal * degree, Vec3::UnitZ()) *
                                 Eigen::AngleAxisd(turned.version * degree, Vec3::UnitY()))
                                    .toRotationMatrix();
      EXPECT_NEAR(edge_deg(Q * o, c.alpha, Vec3::UnitZ()), turned.lateral, 1e-6);
      EXPECT_NEAR(edge_deg(Q * o, c.alpha, Vec3::UnitX()), turned.anterior, 1e-6);
      EXPECT_NEAR(edge_deg(Q * o, c.alpha, -Vec3::UnitX()), turned.posterior, 1e-6);
    }
  }
}

TEST(TurnedSocket, WithoutATurnIsMeasuredAsTheBoneThatWasNotCut) {
  const SocketCase& c = cases.front();
  const Joint cut = cut_socket(c, Side::right);
  const Joint whole =
      hip_of(sharp_cup(radiographic(c.inclination, c.anteversion), 27.5, -27.5 * std::cos(c.alpha * degree)),
             cut.mobile.mesh);
  const AcetabulumMeasures a = measure_hip(cut).acetabulum, b = measure_hip(whole).acetabulum;
  for (const auto measure :
       {&AcetabulumMeasures::centre_edge_lateral, &AcetabulumMeasures::centre_edge_anterior,
        &AcetabulumMeasures::centre_edge_posterior, &AcetabulumMeasures::inclination,
        &AcetabulumMeasures::version, &AcetabulumMeasures::coverage, &AcetabulumMeasures::rim_radius}) {
    EXPECT_NEAR(*(a.*measure).value, *(b.*measure).value, 1e-9);
    EXPECT_EQ((a.*measure).note, (b.*measure).note);
  }
}

}  // namespace
}  // namespace condyle::measure
