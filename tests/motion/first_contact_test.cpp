#include "motion/search/first_contact.hpp"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <cstring>
#include <numbers>

#include "motion/turn_scenes.hpp"
#include "support/test_meshes.hpp"

/// First contact where the angle is known in closed form, in several orientations and 10 m away.

namespace condyle {
namespace {

using namespace test;
using std::numbers::pi;

/// Placing a scene 10 m away and about its axis again rounds each coordinate to some 8 * 2^-53 * 2e4 mm =
/// 2e-11 mm; features at least 1 mm from the axis, met at more than 20 degrees, move in angle by less than
/// three times that.
constexpr double placing = 1e-10;

/// The scene as it is, turned, far away, and turned far away.
std::vector<TurnScene> everywhere(const TurnScene& scene) {
  std::mt19937 random(1);
  std::vector<TurnScene> scenes = {scene, moved(Pose(Eigen::Translation3d(1e4, 0, -1e4)), scene)};
  for (int i = 0; i < 6; ++i) scenes.push_back(moved(far_away(random), scene));
  return scenes;
}

void expect_limit(const Limit& limit, double angle) {
  EXPECT_EQ(limit.reason, LimitReason::contact);
  EXPECT_NEAR(limit.angle.radians(), angle, placing);
  EXPECT_LE(limit.shortfall.radians(), 4e-12);
  ASSERT_TRUE(limit.touching);
}

/// A door from the axis to x = 4, 0.5 thick behind y = 0, and a post that points at it with one corner.
TurnScene door_on_post() {
  TriMesh post;
  for (const Vec3& p : {Vec3(2, 2, 1), Vec3(2.2, 3, 0.8), Vec3(2.5, 3, 1.2), Vec3(1.8, 3.2, 1.3)})
    post.vertices.push_back(p);
  post.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  return {box({0, -0.5, 0}, {4, 0, 2}), post};
}

TEST(Door, stops_at_the_post_where_the_arctangent_says) {
  for (const TurnScene& scene : everywhere(door_on_post())) {
    const auto found = limits(scene);
    expect_limit(found.positive, pi / 4);
    EXPECT_EQ(found.positive.touching->features.turning.kind, FeatureKind::face);
    EXPECT_EQ(found.positive.touching->features.resting, (Feature{FeatureKind::vertex, 0}));
    EXPECT_LT((found.positive.touching->resting_point - scene.resting.vertices[0]).norm(), 1e-10);
    // Backwards the rear face y = -0.5 arrives at the corner, 2 sqrt 2 from the axis, from the other side...
    // of the post's farthest corners first: held against brute force, not by hand.
    const auto truth = brute_first_contact(scene, motion::TurnDirection::negative);
    EXPECT_EQ(-found.negative.angle.radians(), truth->size);
  }
}

TEST(Door, and_post_with_exchanged_roles_turn_a_face_on_vertex_into_a_vertex_on_face) {
  for (const TurnScene& scene : everywhere(door_on_post())) {
    const auto found = limits(exchanged(scene));
    expect_limit(found.negative, -pi / 4);
    EXPECT_EQ(found.negative.touching->features.turning, (Feature{FeatureKind::vertex, 0}));
    EXPECT_EQ(found.negative.touching->features.resting.kind, FeatureKind::face);
    EXPECT_LT((found.negative.touching->turning_point - scene.resting.vertices[0]).norm(), 1e-10);
  }
}

TEST(Door, stops_at_the_end_of_a_range_that_ends_before_the_post_and_at_the_post_otherwise) {
  const TurnScene scene = door_on_post();
  const auto before = limits(scene, {Angle::degrees(-10), Angle::degrees(44.9)});
  EXPECT_EQ(before.positive.reason, LimitReason::end_of_range);
  EXPECT_EQ(before.positive.angle, Angle::degrees(44.9));
  EXPECT_EQ(before.negative.reason, LimitReason::end_of_range);
  EXPECT_EQ(before.negative.angle, Angle::degrees(-10));
  EXPECT_FALSE(before.positive.touching);
  const auto after = limits(scene, {Angle(), Angle::degrees(45.1)});
  expect_limit(after.positive, pi / 4);
  EXPECT_EQ(after.negative.reason, LimitReason::end_of_range) << "an empty range is at its end";
}

TEST(Door, already_at_the_post_is_in_contact_at_the_start) {
  TurnScene scene = door_on_post();
  scene.resting = posed(Pose(Eigen::Translation3d(0, -2, 0)), scene.resting);
  const auto found = limits(scene);
  for (const Limit& limit : {found.negative, found.positive}) {
    EXPECT_EQ(limit.reason, LimitReason::contact_at_start);
    EXPECT_EQ(limit.angle.radians(), 0);
    ASSERT_TRUE(limit.touching);
    EXPECT_EQ(limit.touching->resting_point, Vec3(2, 0, 1));
  }
}

TEST(Door, free_by_less_than_any_rounding_of_its_angle_still_turns_away) {
  TurnScene scene = door_on_post();
  const double gap = 0x1p-60;
  scene.resting = posed(Pose(Eigen::Translation3d(0, -2, 0)), scene.resting);
  scene.resting.vertices.y[0] = gap;
  const auto found = limits(scene);
  EXPECT_EQ(found.positive.reason, LimitReason::contact);
  EXPECT_LE(found.positive.angle.radians(), gap);
  EXPECT_LT(found.negative.angle.radians(), -1);
}

/// A bar with a ridge along a spoke at height 0, leading, and a post whose upright ridge faces it `ahead`
/// radians on.
TurnScene crossed_prisms(double ahead) {
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
bool any_vertex_ever_touches(const TurnScene& scene) {
  const auto point = [&](const TriMesh& mesh, Index v) {
    const Vec3 p = scene.axis.to_axis(mesh.vertices[v]);
    return motion::Triple<double>{p.x(), p.y(), p.z()};
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
  return meets(scene.turning, scene.resting) || meets(scene.resting, scene.turning);
}

TEST(CrossedPrisms, meet_ridge_on_ridge_which_no_vertex_ever_sees) {
  for (const double ahead : {0.3, 1.0, 3.0, 5.5}) {
    for (const TurnScene& scene : everywhere(crossed_prisms(ahead))) {
      EXPECT_FALSE(any_vertex_ever_touches(scene));
      const auto found = limits(scene);
      expect_limit(found.positive, ahead);
      EXPECT_EQ(found.positive.touching->features,
                (FeaturePair{{FeatureKind::edge, 0, 3}, {FeatureKind::edge, 0, 3}}));
      expect_limit(limits(exchanged(scene)).negative, -ahead);
    }
  }
}

TEST(CrossedPrisms, touch_at_the_crossing_of_their_ridges) {
  const auto found = limits(crossed_prisms(1.0)).positive;
  EXPECT_LT((found.touching->turning_point - Vec3(3, 0, 0)).norm(), 1e-11);
  EXPECT_LT((found.touching->resting_point - Vec3(3 * std::cos(1.0), 3 * std::sin(1.0), 0)).norm(), 1e-11);
}

TEST(BodyOfRevolution, beside_another_never_touches) {
  const TurnScene scene{torus(3, 1, 64, 16), box({4.5, -1, -1}, {6, 1, 1})};
  for (const TurnScene& s : everywhere(scene)) {
    for (const auto& found : {limits(s), limits(exchanged(s))}) {
      EXPECT_EQ(found.positive.reason, LimitReason::end_of_range);
      EXPECT_EQ(found.positive.angle.radians(), two_pi);
      EXPECT_EQ(found.negative.reason, LimitReason::end_of_range);
      EXPECT_EQ(found.negative.angle.radians(), -two_pi);
    }
  }
}

TEST(BodyOfRevolution, crossing_another_always_touches) {
  const TurnScene scene{torus(3, 1, 64, 16), box({3, -1, -3}, {6, 1, 3})};
  for (const TurnScene& s : everywhere(scene)) {
    EXPECT_EQ(limits(s).positive.reason, LimitReason::contact_at_start);
    EXPECT_TRUE(limits(s).positive.touching);
  }
}

TEST(Inside, the_other_body_is_contact_at_the_start_though_no_surfaces_touch) {
  const TurnScene scene{box({2, 0, 0}, {3, 1, 1}), box({-5, -5, -5}, {5, 5, 5})};
  for (const TurnScene& s : {scene, exchanged(scene)}) {
    const auto found = limits(s);
    EXPECT_EQ(found.positive.reason, LimitReason::contact_at_start);
    EXPECT_FALSE(found.positive.touching);
  }
}

TEST(Inside, one_piece_among_several_counts_and_a_cavity_does_not) {
  const TriMesh room = joined(sphere(Vec3::Zero(), 20, 2), flipped(sphere(Vec3::Zero(), 10, 2)));
  const TriMesh small = box({2, 0, 0}, {3, 1, 1});
  EXPECT_EQ(limits({small, room}).positive.reason, LimitReason::end_of_range);
  const TriMesh in_wall = box({14, 0, 0}, {14.5, 0.5, 0.5});
  EXPECT_EQ(limits({joined(small, in_wall), room}).positive.reason, LimitReason::contact_at_start);
  EXPECT_EQ(limits({room, joined(small, in_wall)}).positive.reason, LimitReason::contact_at_start);
}

TEST(Inside, an_open_mesh_means_nothing) {
  TriMesh open = box({-5, -5, -5}, {5, 5, 5});
  open.triangles.pop_back();
  EXPECT_EQ(limits({box({2, 0, 0}, {3, 1, 1}), open}).positive.reason, LimitReason::end_of_range);
}

TEST(FlatSheets, in_one_plane_across_the_axis_stop_where_a_corner_meets_an_edge) {
  TriMesh sheet, other;
  for (const Vec3& p : {Vec3(1, 0, 2), Vec3(3, 0, 2), Vec3(2, -1, 2)}) sheet.vertices.push_back(p);
  for (const Vec3& p : {Vec3(0, 2, 2), Vec3(1, 4, 2), Vec3(-1, 4, 2)}) other.vertices.push_back(p);
  sheet.triangles = other.triangles = {{0, 2, 1}};
  // The corner (3, 0) meets the edge y = 2 + 2 x where x^2 + y^2 = 9, that is 5 x^2 + 8 x - 5 = 0.
  const double x = (-8 + std::sqrt(164.0)) / 10;
  const auto found = limits({sheet, other}).positive;
  EXPECT_EQ(found.reason, LimitReason::contact);
  EXPECT_NEAR(found.angle.radians(), std::atan2(2 + 2 * x, x), found.shortfall.radians());
}

TEST(EmptyMesh, never_touches) {
  EXPECT_EQ(limits({TriMesh{}, box({0, 0, 0}, {1, 1, 1})}).positive.reason, LimitReason::end_of_range);
  EXPECT_EQ(limits({box({0, 0, 0}, {1, 1, 1}), TriMesh{}}).negative.reason, LimitReason::end_of_range);
}

/// Bytes of everything a limit says that has no padding.
std::vector<double> bytes(const TurnLimits& found) {
  std::vector<double> out;
  for (const Limit& l : {found.negative, found.positive}) {
    out.insert(out.end(), {l.angle.radians(), l.shortfall.radians(), static_cast<double>(l.reason)});
    if (!l.touching) continue;
    for (const Feature& f : {l.touching->features.turning, l.touching->features.resting}) {
      out.insert(out.end(), {static_cast<double>(f.kind), double(f.id), double(f.other_end)});
    }
    for (const Vec3& p : {l.touching->turning_point, l.touching->resting_point})
      out.insert(out.end(), {p.x(), p.y(), p.z()});
  }
  return out;
}

TEST(FirstContact, from_many_poses_on_many_threads_gives_the_bytes_of_one) {
  const motion::FeatureTree resting(torus(30, 8, 48, 24)), turning(sphere({30, 0, 14}, 5, 3));
  const AxisFrame axis(Vec3(1, 2, 3), Vec3(1, 0.2, 0.1));
  const motion::RotationTable table(resting, axis);
  constexpr int poses = 200;
  const auto pose = [](int i) { return Pose(Eigen::AngleAxisd(0.03 * i, Vec3(0.3, 1, 0.2).normalized())); };
  std::vector<std::vector<double>> one(poses), many(poses);
  motion::TurningBody reused(turning);
  for (int i = 0; i < poses; ++i) {
    reused.start_at(axis, pose(i));
    one[i] = bytes(first_contact(table, reused));
  }
  tbb::parallel_for(0, poses, [&](int i) {
    motion::TurningBody fresh(turning);
    fresh.start_at(axis, pose(i));
    many[i] = bytes(first_contact(table, fresh));
  });
  EXPECT_EQ(one, many);
  EXPECT_GT(std::count_if(one.begin(), one.end(), [](const auto& b) { return b.size() > 6; }), poses / 4);
}

}  // namespace
}  // namespace condyle
