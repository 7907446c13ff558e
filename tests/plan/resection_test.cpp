#include "condyle/resection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "condyle/error.hpp"
#include "measure/analytic_hip.hpp"
#include "mesh/self_crossings.hpp"

/// Bone that must go, against closed forms: docs/mathematics/12-resection.md, "Known answers".

namespace condyle::test {
namespace {

constexpr double degree = std::numbers::pi / 180;
const Vec3 down = -Vec3::UnitY();

/// A cylinder of radius a from the origin along an axis.
TriMesh neck(double a, double length = 60, int facets = 120) {
  std::vector<ProfilePoint> profile{{0, 0}, {0, a}};
  for (double along = 1; along <= length; along += 1) profile.push_back({along, a});
  profile.push_back({length, 0});
  return revolved(down, profile, facets);
}

/// A half ball of radius `outer` with a hemispherical hole of radius R, its face through the origin.
TriMesh socket(double R, double outer) {
  std::vector<ProfilePoint> profile;
  for (int i = 0; i <= 90; i += 10) profile.push_back({-outer * std::cos(i * degree), outer * std::sin(i * degree)});
  for (int i = 90; i >= 0; --i) profile.push_back({-R * std::cos(i * degree), R * std::sin(i * degree)});
  profile.front().beside = profile.back().beside = 0;
  return revolved(down, profile, 360);
}

/// Far enough for an endless wall.
constexpr double endless = 80;

ResectionRequest flexion_to(double degrees, double edge_mm = 0.5) {
  ResectionRequest request;
  request.targets = {{motion_named(hip_motions(), "flexion"), Angle::degrees(degrees)}};
  request.edge_mm = edge_mm;
  return request;
}

struct NeckCase {
  double R, a, outer, limit, target, volume, area, depth;
  double volume_within;  ///< share
};

void expect_sound(const CutBone& cut) {
  EXPECT_TRUE(cut.body.mesh.is_closed());
  EXPECT_EQ(mesh::self_crossings_of(cut.body.mesh).pairs, 0);
  for (std::size_t t = 0; t < cut.before.triangles.size(); ++t) {
    const auto normal = [&](const TriMesh& m) {
      return Vec3((m.corner(t, 1) - m.corner(t, 0)).cross(m.corner(t, 2) - m.corner(t, 0)));
    };
    EXPECT_GT(normal(cut.before).dot(normal(cut.body.mesh)), 0) << t;
  }
}

TEST(Resection, ANeckInAnEndlessSocketLosesWhatTheClosedFormSays) {
  for (const NeckCase& each : {NeckCase{16, 6, endless, 67.975687, 70, 1.234676, 5.949339, 0.527678, 0.05},
                               {25, 15, endless, 53.130102, 65, 356.680106, 215.932501, 4.434543, 0.01}}) {
    const Joint joint = hip_of(socket(each.R, each.outer), neck(each.a));
    const Resection cut = resect(joint, flexion_to(each.target));
    ASSERT_TRUE(cut.mobile);
    EXPECT_NEAR(cut.targets[0].before.end.turned.degrees(), each.limit, 0.02);
    EXPECT_GE(cut.targets[0].after.end.turned.degrees(), each.target);
    EXPECT_LT(cut.targets[0].after.end.turned.degrees(), each.target + 0.2);
    EXPECT_NEAR(cut.mobile->volume_mm3 / each.volume, 1, each.volume_within);
    EXPECT_NEAR(cut.mobile->least_volume_mm3 / each.volume, 1, each.volume_within);
    EXPECT_NEAR(cut.mobile->deepest_mm, each.depth, 0.01);
    expect_sound(*cut.mobile);
    std::printf("%g: volume %.4f of %.4f least %.4f area %.3f of %.3f depth %.4f of %.4f after %.4f\n", each.R, cut.mobile->volume_mm3, each.volume, cut.mobile->least_volume_mm3, cut.mobile->area_mm2, each.area, cut.mobile->deepest_mm, each.depth, cut.targets[0].after.end.turned.degrees());
  }
}

TEST(Resection, HalfTheEdgeIsAQuarterOfTheError) {
  const Joint joint = hip_of(socket(25, endless), neck(15));
  const double exact = 356.680106;
  for (double e : {1.0, 0.5}) {
    const Resection r = resect(joint, flexion_to(65, e));
    std::printf("%g %.4f %.4f depth %.4f\n", e, r.mobile->volume_mm3 - exact, r.mobile->least_volume_mm3 - exact, r.mobile->deepest_mm);
  }
}

}  // namespace
}  // namespace condyle::test
