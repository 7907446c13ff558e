#include "condyle/range_of_motion.hpp"
#include "mesh/enclosed_volume.hpp"
#include "motion/joint_scenes.hpp"
#include "motion/motion_cases.hpp"
#include "support/parametric_shoulder.hpp"
#include "support/test.hpp"

/// A shoulder of parametric parts: what meets the acromion ends a motion, what slides in the glenoid does not.

namespace condyle::motion {
namespace {

using namespace test;

Motion motion(const char* name) {
  return motion_named(built_in_motions(JointKind::ball, Anatomy::shoulder), name);
}

/// How far a flat triangle with such an edge lies inside its sphere.
double largest_sag(const TriMesh& mesh, double radius, double reach) {
  double squared = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      if (mesh.corner(t, k).norm() < reach && mesh.corner(t, (k + 1) % 3).norm() < reach)
        squared = std::max(squared, (mesh.corner(t, k) - mesh.corner(t, (k + 1) % 3)).squaredNorm());
  return squared / (8 * radius);
}

TEST(ShoulderScene, IsOfSoundMeshes) {
  const Joint joint = shoulder({.tubercle = Vec3(0, 10, 35)});
  for (const Body* body : {&joint.fixed, &joint.mobile}) {
    EXPECT_TRUE(body->mesh.is_closed()) << body->name;
    EXPECT_GT(mesh::enclosed_volume(body->mesh), 0) << body->name;
  }
  EXPECT_GT(mesh::enclosed_volume(Mesh(slab_with_dish(26))), 0);
  EXPECT_GT(mesh::enclosed_volume(Mesh(spike({0, 10, 35}))), 0);
}

TEST(ShoulderBearing, IsTheHeadBeforeItsShallowDish) {
  const Joint joint = shoulder({});
  const BearingFinding found = find_bearing_surface(joint);
  ASSERT_TRUE(found.surface) << found.why_none;
  const BearingSurface& surface = *found.surface;
  EXPECT_LT(surface.head.centre.norm(), 1e-9);
  EXPECT_NEAR(surface.head.radius, ParametricShoulder::ball_radius, 1e-9);
  ASSERT_TRUE(surface.socket && surface.rim_gap_mm && surface.beside_gap_mm);
  EXPECT_LT(surface.socket->centre.norm(), 1e-8);
  EXPECT_NEAR(surface.socket->radius, 26, 1e-8);
  EXPECT_NEAR(*surface.rim_gap_mm, 2, 1e-9) << "the dish's border is on its sphere";
  EXPECT_NEAR(*surface.beside_gap_mm, 10, 1e-9) << "the acromion's lower face";
  EXPECT_NEAR(surface.margin_mm, 2 - rim_reserve_mm, 1e-9);
  EXPECT_FALSE(found.narrow_margin);
  // Ten triangles of the shaft reach out of the ball.
  EXPECT_EQ(surface.count(), joint.mobile.mesh.triangles().size() - 10);
}

TEST(ShoulderLimits, AreThoseOfTheAcromionInClosedForm) {
  const ParametricShoulder plain;
  ParametricShoulder with_tubercle;
  with_tubercle.tubercle = Vec3(0, 10, 35);
  for (const bool left : {false, true}) {
    const auto limit_of = [&](const ParametricShoulder& shape) {
      const Joint joint = left ? mirrored(shoulder(shape)) : shoulder(shape);
      return RangeOfMotion(joint).limit(motion("abduction"));
    };
    for (const auto& [limit, expected] :
         {std::pair(limit_of(plain), shaft_limit(plain)),
          std::pair(limit_of(with_tubercle), tubercle_limit(with_tubercle, 10, 35))}) {
      ASSERT_EQ(limit.end.reason, LimitReason::contact);
      EXPECT_EQ(limit.end.kind(), ContactKind::impingement);
      EXPECT_NEAR(limit.end.turned.radians(), expected, angle_tolerance);
      EXPECT_NEAR(limit.end.contact->fixed_point.y(), plain.acromion_y, 1e-9)
          << "on the acromion's lower face";
      EXPECT_FALSE(limit.end.bearing_contact) << "a ball about the centre stays off its dish";
    }
  }
}

TEST(ShoulderLimits, SayOnWhichSideOfTheCentreTheyAre) {
  const Joint joint = shoulder({});
  const auto side_at = [&](const Vec3& point, ContactKind kind = ContactKind::impingement) {
    MotionLimit limit;
    limit.end.reason = LimitReason::contact;
    limit.end.contact = {{}, {}, point, point, kind};
    return contact_side(joint, limit);
  };
  EXPECT_EQ(side_at({3, 34, -10}), ContactSide::superior);
  EXPECT_EQ(side_at({30, 20, -20}), ContactSide::anterior) << "a coracoid process";
  EXPECT_EQ(side_at({5, -30, -20}), ContactSide::inferior);
  EXPECT_EQ(side_at({-30, 29, 0}), ContactSide::posterior);
  EXPECT_EQ(side_at({-30, 31, 0}), ContactSide::superior);
  EXPECT_FALSE(side_at({3, 4, -30})) << "medial of the centre";
  EXPECT_FALSE(side_at({3, 34, -10}, ContactKind::bearing));
  EXPECT_FALSE(side_at(Vec3::Zero()));
  Joint hip = joint;
  hip.anatomy = Anatomy::hip;
  MotionLimit limit;
  limit.end.contact.emplace();
  limit.end.contact->fixed_point = Vec3(0, 30, 0);
  EXPECT_TRUE(contact_side(joint, limit));
  EXPECT_FALSE(contact_side(hip, limit));
}

TEST(ShoulderLimits, InFlexionAndExtensionAreThoseOfTheArmAsItHangs) {
  ParametricShoulder in_front, behind;
  in_front.tubercle = Vec3(35, 10, 0), behind.tubercle = Vec3(-35, 10, 0);
  for (const auto& [shape, name] : {std::pair(in_front, "flexion"), {behind, "extension"}})
    for (const Joint& joint : {shoulder(shape), mirrored(shoulder(shape))}) {
      const MotionLimit limit = RangeOfMotion(joint).limit(motion(name));
      EXPECT_EQ(limit.end.kind(), ContactKind::impingement) << name;
      EXPECT_NEAR(limit.end.turned.radians(), tubercle_limit(shape, 10, 35), angle_tolerance) << name;
    }
}

TEST(ShoulderLimits, AreNoneOfTheGlenoidThatTheHeadSlidesIn) {
  // The ball starts 2 mm lateral of the joint centre, before a dish with a radius of 25 mm. Abduction by e brings its centre to
  // (0, 2 sin e, 2 cos e), and it meets the upper rim, 35 degrees above -Z, where r^2 = R^2 + 2^2 - 2 R 2 cos(145 - e): at 87.
  ParametricShoulder shape;
  shape.head_offset = Vec3(0, 0, 2), shape.dish_radius = 25, shape.ball_levels = 5;
  const Joint joint = shoulder(shape);
  const MotionLimit limit = RangeOfMotion(joint).limit(motion("abduction"));
  EXPECT_EQ(limit.end.kind(), ContactKind::impingement);
  EXPECT_NEAR(limit.end.turned.radians(), shaft_limit(shape), angle_tolerance);
  ASSERT_TRUE(limit.end.bearing_contact);
  const double sag_of_ball = largest_sag(sphere(Vec3::Zero(), 24, 5), 24, 30),
               sag_of_dish = largest_sag(slab_with_dish(25), 25, 25 + 1e-9);
  const auto met_at = [](double r, double R) {
    return std::numbers::pi - ParametricShoulder::dish_half_angle - std::acos((R * R + 4 - r * r) / (4 * R));
  };
  EXPECT_LT(sag_of_ball + sag_of_dish, 0.05);
  EXPECT_GE(limit.end.bearing_contact->turned.radians(), met_at(24, 25 - sag_of_dish));
  EXPECT_LE(limit.end.bearing_contact->turned.radians(), met_at(24 - sag_of_ball, 25));
  EXPECT_EQ(limit.end.bearing_contact->contact->kind, ContactKind::bearing);

  const MotionLimit counted =
      RangeOfMotion(joint, {.bearing = {.rule = BearingRule::count}}).limit(motion("abduction"));
  EXPECT_EQ(counted.end.turned, limit.end.bearing_contact->turned);
  EXPECT_EQ(counted.end.kind(), ContactKind::bearing);
}

TEST(ShoulderBearing, EndsBeforeTheAcromion) {
  ParametricShoulder low;
  low.acromion_y = 25.2;
  const BearingFinding near = find_bearing_surface(shoulder(low));
  ASSERT_TRUE(near.surface);
  EXPECT_NEAR(near.surface->margin_mm, 1.2 - rim_reserve_mm, 1e-9);
  ASSERT_TRUE(near.narrow_margin);
  EXPECT_EQ(near.narrow_margin->by, MarginLimit::beside_socket);
  EXPECT_NEAR(near.narrow_margin->gap_mm, 1.2, 1e-9);
  low.acromion_y = 24.3;
  EXPECT_EQ(
      find_bearing_surface(shoulder(low)).why_none,
      "scapula leaves the head only 0.30 mm beside its socket: no margin to distinguish bearing surfaces by");
}

TEST(ShoulderBearing, IsNoneOfAHeadThatRisesToTheAcromion) {
  // The ball's top rises by 2 sin e to the acromion 1.5 mm above it. Bearing contact would be passed over.
  ParametricShoulder high;
  high.head_offset = Vec3(0, 0, 2), high.acromion_y = 25.5, high.ball_levels = 5;
  const Joint joint = shoulder(high);
  const RangeOfMotion range(joint);
  EXPECT_FALSE(range.bearing().surface);
  const MotionLimit limit = range.limit(motion("abduction"));
  EXPECT_EQ(limit.end.kind(), ContactKind::unknown);
  const double sag = largest_sag(sphere(Vec3::Zero(), 24, 5), 24, 30);
  EXPECT_GE(limit.end.turned.radians(), std::asin(1.5 / 2));
  EXPECT_LE(limit.end.turned.radians(), std::asin((1.5 + sag) / 2));
}

TEST(ShoulderBearing, IsFoundBelowAnAcromionOfAnyFineness) {
  // Coarse or fine, and 4 mm from the head as the dish is 2: the nearer one that fills more of the view is the socket.
  ParametricShoulder shape;
  shape.acromion_y = 28;
  Joint joint = shoulder(shape);
  TriMesh plate = box({-15, 28, -10}, {15, 34, 30});
  for (int level = 0; level < 4; ++level) {
    TriMesh finer{plate.vertices, {}};
    for (const auto& [a, b, c] : plate.triangles) {
      // Corners that are not shared: nothing here asks whether it is closed.
      const auto middle = [&](Index i, Index j) {
        finer.vertices.push_back((plate.vertices[i] + plate.vertices[j]) / 2);
        return static_cast<Index>(finer.vertices.size() - 1);
      };
      const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.triangles.insert(finer.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    plate = finer;
    joint.fixed.mesh = joined(slab_with_dish(26), plate);
    const auto surface = find_bearing_surface(joint).surface;
    ASSERT_TRUE(surface && surface->socket && surface->rim_gap_mm && surface->beside_gap_mm);
    EXPECT_NEAR(surface->socket->radius, 26, 1e-8);
    EXPECT_NEAR(*surface->rim_gap_mm, 2, 1e-9);
    EXPECT_NEAR(*surface->beside_gap_mm, 4, 1e-9);
  }
}

}  // namespace
}  // namespace condyle::motion
