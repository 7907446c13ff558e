#include "io/result/jam_contact.hpp"

#include "support/test.hpp"

namespace condyle {
namespace {

/// A ball that casts, in contact with all its triangles below y = -5: pressed the more the lower they are.
contact::SurfaceContact contact_below(const Mesh& ball) {
  contact::SurfaceContact contact;
  for (std::size_t t = 0; t < ball.triangles().size(); ++t) {
    const Vec3 a = ball.corner(t, 0), b = ball.corner(t, 1), c = ball.corner(t, 2), centre = (a + b + c) / 3;
    if (centre.y() >= -5) continue;
    const double area = (b - a).cross(c - a).norm() / 2, depth = -0.1 * (centre.y() + 5);
    contact.faces.push_back({.face = static_cast<Index>(t),
                             .area_mm2 = area,
                             .max_depth_mm = depth,
                             .overlap_mm3 = area * depth,
                             .overlap_moment = area * depth * centre,
                             .max_pressure_mpa = 2 * depth,
                             .load_n = 2 * area * depth,
                             .load_moment = 2 * area * depth * centre});
  }
  contact.totals = contact::totals_of(contact.faces, ball, contact::FaceRule::face_centre);
  return contact;
}

struct Reported {
  io::JamContact contact;
  std::vector<io::JamCoordinate> coordinates;
};
Reported reported_for(const Mesh& casting, std::vector<std::optional<motion::FrameContact>> frames) {
  const io::LoadedJoint loaded{.joint = {.name = "left hip",
                                         .kind = JointKind::ball,
                                         .side = Side::left,
                                         .fixed = {"socket", Mesh(test::box({-1, -1, -1}, {1, 1, 1}))},
                                         .mobile = {"head", casting}},
                               .report = {}};
  const io::JointMotion motion;
  const io::ContactSurfaces surfaces{loaded.joint.fixed, loaded.joint.mobile};
  io::MotionQuestion question{
      .joint = loaded, .motion = motion, .surfaces = surfaces, .contact = {}, .with_pressure = true};
  question.contact.rays.rule = contact::FaceRule::face_centre;
  MotionAnswer answer;
  answer.frames = std::move(frames);
  return {io::jam_contact(question, answer), io::jam_coordinates(question, answer)};
}

TEST(JamContact, RegionsAreTheHalvesAlongEachAxis) {
  const Mesh ball(test::sphere({1, 0, -2}, 20, 4));
  const io::JamContact contact =
      reported_for(ball, {motion::FrameContact{.X_FM = Pose::Identity(), .surface = contact_below(ball)}})
          .contact;
  EXPECT_EQ(contact.name, "left_hip");
  EXPECT_EQ(contact.casting.mesh, "head");
  EXPECT_EQ(contact.target.mesh, "socket");
  EXPECT_TRUE(contact.target.frames.empty());
  ASSERT_EQ(contact.casting.frames.size(), 1u);
  const io::JamFrame& frame = contact.casting.frames[0];
  const io::JamTotals& total = frame.total;
  ASSERT_EQ(frame.regional.size(), io::jam_regions);
  for (int k = 0; k < 3; ++k) {
    const io::JamTotals &below = frame.regional[2 * k], &above = frame.regional[2 * k + 1];
    EXPECT_NEAR(below.contact_area_m2 + above.contact_area_m2, total.contact_area_m2,
                1e-12 * total.contact_area_m2);
    EXPECT_LE((below.contact_force_n + above.contact_force_n - total.contact_force_n).norm(),
              1e-12 * total.contact_force_n.norm());
    EXPECT_LE((below.contact_moment_nm + above.contact_moment_nm - total.contact_moment_nm).norm(),
              1e-12 * total.contact_force_n.norm());
    EXPECT_EQ(std::max(below.max_proximity_m, above.max_proximity_m), total.max_proximity_m);
    EXPECT_EQ(std::max(below.max_pressure_pa, above.max_pressure_pa), total.max_pressure_pa);
    EXPECT_LT(below.centre_of_proximity_m[k], 0);
    EXPECT_LT(below.centre_of_pressure_m[k], 0);
    if (k == 1) continue;
    EXPECT_GT(above.centre_of_proximity_m[k], 0);
    EXPECT_GT(above.mean_pressure_pa, 0);
  }
  // Nothing is in contact above y = -5.
  const io::JamTotals& above = frame.regional[3];
  EXPECT_EQ(above.contact_area_m2, 0);
  EXPECT_EQ(above.mean_proximity_m, 0);
  EXPECT_TRUE(above.contact_force_n.isZero(0));
  EXPECT_TRUE(above.centre_of_pressure_m.isZero(0));
  EXPECT_EQ(frame.triangle_pressure_pa.size(), ball.triangles().size());
}

TEST(JamContact, ATriangleAtTheOriginIsNotBelowIt) {
  TriMesh one;
  for (const Vec3& v : {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 2, 0)}) one.vertices.push_back(v);
  one.triangles.push_back({0, 1, 2});
  const Mesh mesh(one);
  contact::SurfaceContact contact;
  contact.faces.push_back(
      {.face = 0, .area_mm2 = 3, .max_depth_mm = 1, .overlap_mm3 = 3, .overlap_moment = Vec3::Zero()});
  contact.totals = contact::totals_of(contact.faces, mesh, contact::FaceRule::face_centre);
  const auto frames = reported_for(mesh, {motion::FrameContact{.X_FM = Pose::Identity(), .surface = contact}})
                          .contact.casting.frames;
  for (std::size_t r = 0; r < io::jam_regions; ++r)
    EXPECT_EQ(frames[0].regional[r].contact_area_m2, r % 2 == 0 ? 0 : 3e-6) << r;
}

TEST(JamContact, AGapHasNumbersNowhere) {
  const Mesh ball(test::sphere(Vec3::Zero(), 20, 2));
  const auto frames = reported_for(ball, {std::nullopt}).contact.casting.frames;
  ASSERT_EQ(frames.size(), 1u);
  ASSERT_EQ(frames[0].regional.size(), io::jam_regions);
  for (const io::JamTotals& totals : {frames[0].total, frames[0].regional[0], frames[0].regional[5]}) {
    EXPECT_TRUE(std::isnan(totals.contact_area_m2));
    EXPECT_TRUE(totals.contact_force_n.array().isNaN().all());
    EXPECT_TRUE(totals.centre_of_pressure_m.array().isNaN().all());
  }
  ASSERT_EQ(frames[0].triangle_proximity_m.size(), ball.triangles().size());
  EXPECT_TRUE(std::isnan(frames[0].triangle_proximity_m[0]));
}

TEST(JamContact, CoordinatesHaveTheNamesOfTheJoint) {
  const Mesh ball(test::sphere(Vec3::Zero(), 20, 2));
  const CoordinateSystem hip{Anatomy::hip, Side::left};
  const Pose bent = pose_at(hip, JointAngles{Angle::degrees(30), Angle::degrees(-10), Angle::degrees(5)});
  const auto coordinates = reported_for(ball, {motion::FrameContact{.X_FM = bent}, std::nullopt}).coordinates;
  ASSERT_EQ(coordinates.size(), 3u);
  const std::array<std::pair<const char*, double>, 3> expected = {
      {{"flexion", 30}, {"adduction", -10}, {"internal_rotation", 5}}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(coordinates[i].name, expected[i].first);
    ASSERT_EQ(coordinates[i].values.size(), 2u);
    EXPECT_NEAR(coordinates[i].values[0], expected[i].second, 1e-12);
    EXPECT_TRUE(std::isnan(coordinates[i].values[1]));
  }
}

TEST(JamContact, TranslationsAreInMetres) {
  const io::LoadedJoint knee{.joint = {.name = "knee",
                                       .kind = JointKind::free,
                                       .side = Side::right,
                                       .fixed = {"femur", Mesh(test::box({-1, -1, -1}, {1, 1, 1}))},
                                       .mobile = {"tibia", Mesh(test::box({-1, -3, -1}, {1, -2, 1}))},
                                       .anatomy = Anatomy::knee},
                             .report = {}};
  const io::JointMotion motion;
  const io::ContactSurfaces surfaces{knee.joint.fixed, knee.joint.mobile};
  const io::MotionQuestion question{.joint = knee, .motion = motion, .surfaces = surfaces, .contact = {}};
  Pose X_FM(Eigen::Translation3d(1, -2, 4));
  MotionAnswer answer;
  answer.frames = {motion::FrameContact{.X_FM = X_FM}};
  const auto coordinates = io::jam_coordinates(question, answer);
  ASSERT_EQ(coordinates.size(), 6u);
  const std::array<std::pair<const char*, double>, 3> expected = {{{"x", 1e-3}, {"y", -2e-3}, {"z", 4e-3}}};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(coordinates[3 + i].name, expected[i].first);
    EXPECT_NEAR(coordinates[3 + i].values[0], expected[i].second, 1e-18);
  }
}

}  // namespace
}  // namespace condyle
