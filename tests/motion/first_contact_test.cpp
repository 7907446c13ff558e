#include "motion/search/first_contact.hpp"

#include "core/parallel.hpp"
#include "motion/rotation_scenes.hpp"
#include "support/test.hpp"

/// First contact where the angle is known in closed form, in several orientations and 10 m away.

namespace condyle::motion {
namespace {

using namespace test;
using std::numbers::pi;

/// Placing a scene 10 m away and about its axis again rounds each coordinate to some 8 * 2^-53 * 2e4 mm =
/// 2e-11 mm; features at least 1 mm from the axis, met at more than 20 degrees, move in angle by less than
/// three times that.
constexpr double placing = 1e-10;

/// The scene as it is, turned, far away, and turned far away.
std::vector<RotationScene> here_and_far_away(const RotationScene& scene) {
  std::mt19937 random(1);
  std::vector<RotationScene> scenes = {scene, moved(Pose(Eigen::Translation3d(1e4, 0, -1e4)), scene)};
  for (int i = 0; i < 6; ++i) scenes.push_back(moved(far_away(random), scene));
  return scenes;
}

void expect_limit(const Limit& limit, double angle) {
  EXPECT_EQ(limit.reason, LimitReason::contact);
  EXPECT_NEAR(limit.turned.radians(), angle, placing);
  EXPECT_LE(limit.error_bound.radians(), 4e-12);
  ASSERT_TRUE(limit.contact);
}

/// A door from the axis to x = 4, 0.5 thick behind y = 0, and a post that points at it with one corner.
RotationScene door_on_post() {
  TriMesh post;
  for (const Vec3& p : {Vec3(2, 2, 1), Vec3(2.2, 3, 0.8), Vec3(2.5, 3, 1.2), Vec3(1.8, 3.2, 1.3)})
    post.vertices.push_back(p);
  post.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  return {box({0, -0.5, 0}, {4, 0, 2}), post};
}

TEST(Door, StopsAtThePostWhereTheArctangentSays) {
  for (const RotationScene& scene : here_and_far_away(door_on_post())) {
    const auto found = limits(scene);
    expect_limit(found.positive, pi / 4);
    EXPECT_EQ(found.positive.contact->mobile_feature.kind, FeatureKind::face);
    EXPECT_EQ(found.positive.contact->fixed_feature, (Feature{FeatureKind::vertex, 0}));
    EXPECT_LT((found.positive.contact->fixed_point - scene.stationary.vertices[0]).norm(), 1e-10);
    // Backwards the rear face y = -0.5 arrives at the corner, 2 sqrt 2 from the axis, from the other side...
    // of the post's farthest corners first: held against brute force, not by hand.
    const auto truth = brute_first_contact(scene, RotationSense::negative);
    EXPECT_EQ(found.negative.turned.radians(), truth->size);
  }
}

TEST(Door, AndPostWithExchangedRolesTurnAFaceOnVertexIntoAVertexOnFace) {
  for (const RotationScene& scene : here_and_far_away(door_on_post())) {
    const auto found = limits(exchanged(scene));
    expect_limit(found.negative, pi / 4);
    EXPECT_EQ(found.negative.contact->mobile_feature, (Feature{FeatureKind::vertex, 0}));
    EXPECT_EQ(found.negative.contact->fixed_feature.kind, FeatureKind::face);
    EXPECT_LT((found.negative.contact->mobile_point - scene.stationary.vertices[0]).norm(), 1e-10);
  }
}

TEST(Door, StopsAtTheEndOfARangeThatEndsBeforeThePostAndAtThePostOtherwise) {
  const RotationScene scene = door_on_post();
  const auto before = limits(scene, {Angle::degrees(-10), Angle::degrees(44.9)});
  EXPECT_EQ(before.positive.reason, LimitReason::end_of_range);
  EXPECT_EQ(before.positive.turned, Angle::degrees(44.9));
  EXPECT_EQ(before.negative.reason, LimitReason::end_of_range);
  EXPECT_EQ(before.negative.turned, Angle::degrees(10));
  EXPECT_FALSE(before.positive.contact);
  const auto after = limits(scene, {Angle(), Angle::degrees(45.1)});
  expect_limit(after.positive, pi / 4);
  EXPECT_EQ(after.negative.reason, LimitReason::end_of_range) << "an empty range is at its end";
}

TEST(Door, AlreadyAtThePostIsInContactAtTheStart) {
  RotationScene scene = door_on_post();
  scene.stationary = posed(Pose(Eigen::Translation3d(0, -2, 0)), scene.stationary);
  const auto found = limits(scene);
  for (const Limit& limit : {found.negative, found.positive}) {
    EXPECT_EQ(limit.reason, LimitReason::contact_at_start);
    EXPECT_EQ(limit.turned.radians(), 0);
    ASSERT_TRUE(limit.contact);
    EXPECT_EQ(limit.contact->fixed_point, Vec3(2, 0, 1));
  }
}

TEST(Door, FreeByLessThanAnyRoundingOfItsAngleStillTurnsAway) {
  RotationScene scene = door_on_post();
  const double gap = 0x1p-60;
  scene.stationary = posed(Pose(Eigen::Translation3d(0, -2, 0)), scene.stationary);
  scene.stationary.vertices.y[0] = gap;
  const auto found = limits(scene);
  EXPECT_EQ(found.positive.reason, LimitReason::contact);
  EXPECT_LE(found.positive.turned.radians(), gap);
  EXPECT_GT(found.negative.turned.radians(), 1);
}

/// A bar with a ridge along a spoke at height 0, leading, and a post whose upright ridge faces it `ahead`
/// radians on.
RotationScene crossed_prisms(double ahead) {
  TriMesh bar, post;
  for (const double x : {1.0, 5.0}) {
    for (const Vec3& p : {Vec3(x, 0, 0), Vec3(x, -1, 1), Vec3(x, -1, -1)}) bar.vertices.push_back(p);
  }
  const Pose turn(Eigen::AngleAxisd(ahead, Vec3::UnitZ()));
  for (const double z : {-5.0, 5.0}) {
    for (const Vec3& p : {Vec3(3, 0, z), Vec3(2.5, 1, z), Vec3(3.5, 1, z)}) post.vertices.push_back(turn * p);
  }
  bar.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
  post.triangles = {{0, 1, 2}, {3, 5, 4}, {0, 4, 1}, {0, 3, 4}, {1, 5, 2}, {1, 4, 5}, {2, 3, 0}, {2, 5, 3}};
  return {bar, post};
}

/// Whether any vertex of either body meets a face of the other at any angle of the turn: all a vertex-only
/// method can see.
bool any_vertex_ever_touches(const RotationScene& scene) {
  const auto point = [&](const TriMesh& mesh, Index v) {
    const Vec3 p = scene.axis.to_axis(mesh.vertices[v]);
    return Triple<double>{p.x(), p.y(), p.z()};
  };
  const auto meets = [&](const TriMesh& a, const TriMesh& b) {
    for (Index v = 0; v < a.vertices.size(); ++v) {
      for (const auto& [p, q, r] : b.triangles) {
        if (motion::vertex_meets_face(point(a, v), {point(b, p), point(b, q), point(b, r)}).count > 0)
          return true;
      }
    }
    return false;
  };
  return meets(scene.rotating, scene.stationary) || meets(scene.stationary, scene.rotating);
}

TEST(CrossedPrisms, MeetRidgeOnRidgeWhichNoVertexEverSees) {
  for (const double ahead : {0.3, 1.0, 3.0, 5.5}) {
    for (const RotationScene& scene : here_and_far_away(crossed_prisms(ahead))) {
      EXPECT_FALSE(any_vertex_ever_touches(scene));
      const auto found = limits(scene);
      expect_limit(found.positive, ahead);
      EXPECT_EQ(found.positive.contact->mobile_feature, (Feature{FeatureKind::edge, 0, 3}));
      EXPECT_EQ(found.positive.contact->fixed_feature, (Feature{FeatureKind::edge, 0, 3}));
      expect_limit(limits(exchanged(scene)).negative, ahead);
    }
  }
}

TEST(CrossedPrisms, TouchAtTheCrossingOfTheirRidges) {
  const auto found = limits(crossed_prisms(1.0)).positive;
  EXPECT_LT((found.contact->mobile_point - Vec3(3, 0, 0)).norm(), 1e-11);
  EXPECT_LT((found.contact->fixed_point - Vec3(3 * std::cos(1.0), 3 * std::sin(1.0), 0)).norm(), 1e-11);
}

TEST(BodyOfRevolution, BesideAnotherNeverTouches) {
  const RotationScene scene{torus(3, 1, 64, 16), box({4.5, -1, -1}, {6, 1, 1})};
  for (const RotationScene& s : here_and_far_away(scene)) {
    for (const auto& found : {limits(s), limits(exchanged(s))}) {
      EXPECT_EQ(found.positive.reason, LimitReason::end_of_range);
      EXPECT_EQ(found.positive.turned.radians(), two_pi);
      EXPECT_EQ(found.negative.reason, LimitReason::end_of_range);
      EXPECT_EQ(found.negative.turned.radians(), two_pi);
    }
  }
}

TEST(BodyOfRevolution, CrossingAnotherAlwaysTouches) {
  const RotationScene scene{torus(3, 1, 64, 16), box({3, -1, -3}, {6, 1, 3})};
  for (const RotationScene& s : here_and_far_away(scene)) {
    EXPECT_EQ(limits(s).positive.reason, LimitReason::contact_at_start);
    EXPECT_TRUE(limits(s).positive.contact);
  }
}

TEST(Inside, TheOtherBodyIsContactAtTheStartThoughNoSurfacesTouch) {
  const RotationScene scene{box({2, 0, 0}, {3, 1, 1}), box({-5, -5, -5}, {5, 5, 5})};
  for (const RotationScene& s : {scene, exchanged(scene)}) {
    const auto found = limits(s);
    EXPECT_EQ(found.positive.reason, LimitReason::contact_at_start);
    EXPECT_FALSE(found.positive.contact);
  }
}

TEST(Inside, OneComponentAmongSeveralCountsAndACavityDoesNot) {
  const TriMesh room = joined(sphere(Vec3::Zero(), 20, 2), flipped(sphere(Vec3::Zero(), 10, 2)));
  const TriMesh small = box({2, 0, 0}, {3, 1, 1});
  EXPECT_EQ(limits({small, room}).positive.reason, LimitReason::end_of_range);
  const TriMesh in_wall = box({14, 0, 0}, {14.5, 0.5, 0.5});
  EXPECT_EQ(limits({joined(small, in_wall), room}).positive.reason, LimitReason::contact_at_start);
  EXPECT_EQ(limits({room, joined(small, in_wall)}).positive.reason, LimitReason::contact_at_start);
}

TEST(Inside, AnOpenMeshMeansNothing) {
  TriMesh open = box({-5, -5, -5}, {5, 5, 5});
  open.triangles.pop_back();
  EXPECT_EQ(limits({box({2, 0, 0}, {3, 1, 1}), open}).positive.reason, LimitReason::end_of_range);
}

TEST(FlatSheets, InOnePlaneAcrossTheAxisStopWhereACornerMeetsAnEdge) {
  TriMesh sheet, other;
  for (const Vec3& p : {Vec3(1, 0, 2), Vec3(3, 0, 2), Vec3(2, -1, 2)}) sheet.vertices.push_back(p);
  for (const Vec3& p : {Vec3(0, 2, 2), Vec3(1, 4, 2), Vec3(-1, 4, 2)}) other.vertices.push_back(p);
  sheet.triangles = other.triangles = {{0, 2, 1}};
  // The corner (3, 0) meets the edge y = 2 + 2 x where x^2 + y^2 = 9, that is 5 x^2 + 8 x - 5 = 0.
  const double x = (-8 + std::sqrt(164.0)) / 10;
  const auto found = limits({sheet, other}).positive;
  EXPECT_EQ(found.reason, LimitReason::contact);
  EXPECT_NEAR(found.turned.radians(), std::atan2(2 + 2 * x, x), found.error_bound.radians());
}

TEST(EmptyMesh, NeverTouches) {
  EXPECT_EQ(limits({TriMesh{}, box({0, 0, 0}, {1, 1, 1})}).positive.reason, LimitReason::end_of_range);
  EXPECT_EQ(limits({box({0, 0, 0}, {1, 1, 1}), TriMesh{}}).negative.reason, LimitReason::end_of_range);
}

/// Bytes of everything a limit says that has no padding.
std::vector<double> bytes(const RotationLimits& found) {
  std::vector<double> out;
  for (const Limit& l : {found.negative, found.positive}) {
    out.insert(out.end(), {l.turned.radians(), l.error_bound.radians(), static_cast<double>(l.reason)});
    if (!l.contact) continue;
    for (const Feature& f : {l.contact->mobile_feature, l.contact->fixed_feature}) {
      out.insert(out.end(), {static_cast<double>(f.kind), double(f.id), double(f.other_end)});
    }
    for (const Vec3& p : {l.contact->mobile_point, l.contact->fixed_point})
      out.insert(out.end(), {p.x(), p.y(), p.z()});
  }
  return out;
}

TEST(FirstContact, FromManyPosesOnManyThreadsGivesTheBytesOfOne) {
  const AxisFrame axis(Vec3(1, 2, 3), Vec3(1, 0.2, 0.1));
  const TriMesh ring = torus(30, 8, 48, 24), ball = sphere({30, 0, 14}, 5, 3);
  const FirstContact first_contact(ring, ball, axis);
  constexpr int poses = 200;
  const auto pose = [](int i) { return Pose(Eigen::AngleAxisd(0.03 * i, Vec3(0.3, 1, 0.2).normalized())); };
  std::vector<std::vector<double>> one(poses), many(poses);
  for (int i = 0; i < poses; ++i) one[i] = bytes(first_contact.limits(pose(i)));
  core::parallel_chunks(poses, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      many[i] = bytes(first_contact.limits(pose(static_cast<int>(i))));
  });
  EXPECT_EQ(one, many);
  EXPECT_GT(std::count_if(one.begin(), one.end(), [](const auto& b) { return b.size() > 6; }), poses / 4);
  // A body that was never posed before.
  const FeatureTree fixed(ring), mobile(ball);
  const RotationTable table(fixed, axis);
  for (int i = 0; i < poses; i += 10) {
    RotatingBody fresh(mobile);
    fresh.start_at(axis, pose(i));
    EXPECT_EQ(bytes(motion::first_contact(table, fresh)), one[i]) << i;
  }
}

TEST(FirstContact, RefusesRangesWithoutTheStartOrOfMoreThanAFullTurn) {
  const FirstContact first_contact(box({0, 0, 0}, {1, 1, 1}), box({5, 0, 0}, {6, 1, 1}),
                                   AxisFrame(Vec3::Zero(), Vec3::UnitZ()));
  for (const auto& [low, high] : {std::pair{1.0, 2.0}, {-2.0, -1.0}, {-361.0, 0.0}, {0.0, 361.0}, {NAN, 0.0}})
    EXPECT_THROW(first_contact.limits(Pose::Identity(), {Angle::degrees(low), Angle::degrees(high)}),
                 UsageError);
}

TEST(FirstContact, RefusesAMeshThatUsesAVertexItDoesNotHave) {
  TriMesh bad = box({0, 0, 0}, {1, 1, 1});
  bad.triangles.back()[1] = 40991;
  EXPECT_THROW(FirstContact(bad, box({5, 0, 0}, {6, 1, 1}), AxisFrame(Vec3::Zero(), Vec3::UnitZ())),
               MeshError);
}

}  // namespace
}  // namespace condyle::motion
