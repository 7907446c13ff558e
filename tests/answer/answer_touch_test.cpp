#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "condyle/answer.hpp"
#include "condyle/error.hpp"
#include "contact/body_pair.hpp"
#include "contact/deepest_place.hpp"
#include "core/rotation_about.hpp"
#include "core/trigonometry.hpp"
#include "mesh/subdivide.hpp"
#include "mesh/surface_distance.hpp"
#include "mesh/winding_number.hpp"
#include "motion/search/translation_contacts.hpp"
#include "support/real_hip.hpp"
#include "support/test_meshes.hpp"

/// Two meshes without a joint: depth, volume and ways out against closed forms, sampling and the question asked again.

namespace condyle::test {
namespace {

Pose at(const Vec3& translation) {
  Pose X = Pose::Identity();
  X.translation() = translation;
  return X;
}

Pose random_pose(std::mt19937& random, double reach) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> angle(-3, 3), place(-reach, reach);
  Pose X = at({place(random), place(random), place(random)});
  X.linear() =
      core::rotation_about(Vec3(normal(random), normal(random), normal(random)).normalized(), angle(random));
  return X;
}

const std::vector<Vec3> axes = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

TouchAnswer touch(const TriMesh& fixed, const TriMesh& mobile, const Pose& X_FM = Pose::Identity()) {
  return answer_touch(fixed, mobile, {.X_FM = X_FM, .along = axes});
}

TriMesh scaled(TriMesh mesh, double by) {
  for (auto* row : {&mesh.vertices.x, &mesh.vertices.y, &mesh.vertices.z})
    for (double& value : *row) value *= by;
  return mesh;
}

/// The body is free just beyond the distance and in contact just before it.
void expect_frees(const contact::JointContact& bodies, const Pose& X_FM, const FreeTranslation& free) {
  constexpr double margin_mm = 1e-9;
  Pose beyond = X_FM, before = X_FM;
  beyond.translation() += free.along * (free.distance_mm + margin_mm);
  before.translation() += free.along * (free.distance_mm - free.error_bound_mm - margin_mm);
  EXPECT_FALSE(bodies.in_contact(beyond)) << free.along.transpose();
  EXPECT_TRUE(bodies.in_contact(before)) << free.along.transpose();
}

TEST(Touch, OfABoxSunkIntoABoxDoesNotChangeWithTheirTriangles) {
  TriMesh fixed = box({-10, -10, -10}, {10, 10, 10}), mobile = box({-3, -2, 8.75}, {3, 4, 14});
  const std::vector<double> distances = {13, 13, 12, 14, 1.25, 24};
  for (const std::size_t triangles : {12u, 48u, 192u, 768u}) {
    ASSERT_EQ(fixed.triangles.size(), triangles);
    const TouchAnswer answer = touch(fixed, mobile);
    ASSERT_TRUE(answer.in_contact && answer.deepest && answer.overlap && !answer.nearest);
    EXPECT_FALSE(answer.inside);
    EXPECT_NEAR(answer.deepest->depth_mm, 1.25, 1e-12);
    EXPECT_LT(answer.deepest->error_mm, 1e-10);
    EXPECT_NEAR((answer.deepest->exit - answer.deepest->place).norm(), 1.25, 1e-12);
    EXPECT_NEAR(std::abs(answer.deepest->normal.z()), 1, 1e-12);
    EXPECT_NEAR(*answer.overlap->volume_mm3, 45, 1e-9);
    EXPECT_LT(answer.overlap->volume_error_mm3, 1e-8);
    EXPECT_NEAR(*answer.overlap->fixed_area_mm2, 36, 1e-9);
    EXPECT_NEAR(*answer.overlap->mobile_area_mm2, 66, 1e-9);
    ASSERT_EQ(answer.free.size(), axes.size());
    for (std::size_t k = 0; k < axes.size(); ++k) {
      EXPECT_NEAR(answer.free[k].distance_mm, distances[k], 1e-9);
      expect_frees({fixed, mobile}, Pose::Identity(), answer.free[k]);
    }
    fixed = mesh::subdivided(fixed), mobile = mesh::subdivided(mobile);
  }
}

TEST(Touch, FindsADeepestPlaceFarFromEveryVertex) {
  // A bar through a bar: no vertex of either is inside the other, and of the mobile one's surface the middle of two faces is deepest.
  TriMesh fixed = box({-10, -3, -3}, {10, 3, 3}), mobile = box({-1, -2, -10}, {1, 2, 10});
  for (int level = 0; level < 3; ++level) {
    const TouchAnswer answer = touch(fixed, mobile);
    ASSERT_TRUE(answer.deepest);
    EXPECT_EQ(answer.deepest->of, BodyRole::mobile);
    EXPECT_NEAR(answer.deepest->depth_mm, 3, 1e-10);
    EXPECT_LT(answer.deepest->error_mm, 1e-9);
    EXPECT_NEAR((answer.deepest->place - Vec3(answer.deepest->place.x() > 0 ? 1 : -1, 0, 0)).norm(), 0, 1e-8);
    EXPECT_NEAR(*answer.overlap->volume_mm3, 2 * 4 * 6, 1e-9);
    fixed = mesh::subdivided(fixed), mobile = mesh::subdivided(mobile);
  }
}

/// The largest distance to the target of points of a surface inside of it: of all points of a grid on each triangle.
double sampled_depth(const Mesh& target, const TriMesh& surface, const Pose& X, int n) {
  const mesh::SurfaceDistance distance{TriMesh(target)};
  const mesh::WindingNumber winding(target);
  double deepest = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) {
        const Vec3 own =
            (i * surface.corner(t, 0) + j * surface.corner(t, 1) + (n - i - j) * surface.corner(t, 2)) / n;
        const Vec3 p = posed(X, own);
        if (winding.at(p).state == PointState::inside) deepest = std::max(deepest, distance(p));
      }
  return deepest;
}

TEST(Touch, DepthIsThatOfTheDeepestOfManyPoints) {
  std::mt19937 random(63);
  const std::vector<TriMesh> shapes = {box({-3, -4, -5}, {3, 4, 5}), torus(4, 1.5, 10, 7),
                                       sphere({0, 0, 0}, 4, 1)};
  constexpr int n = 12;
  int in_contact = 0;
  for (int k = 0; k < 40; ++k) {
    const TriMesh &fixed = shapes[random() % 3], &mobile = shapes[random() % 3];
    const Pose X_FM = random_pose(random, 4);
    const contact::JointContact bodies(fixed, mobile);
    const contact::BodyPair& pair = contact::body_pair_of(bodies);
    const auto [found, bound] = contact::deepest_place(pair.fixed_tree(), pair.mobile_tree(), X_FM);
    const double sampled = sampled_depth(fixed, mobile, X_FM, n);
    EXPECT_EQ(found.has_value(), sampled > 0) << k;
    if (!found) continue;
    ++in_contact;
    EXPECT_LT(bound - found->depth_mm, 1e-9) << k;
    EXPECT_GE(found->depth_mm, sampled - 1e-12) << k;
    // No point of a triangle is farther from the grid than two thirds of a cell's longest side, 10.3 / n.
    EXPECT_LE(found->depth_mm, sampled + 10.3 / n * 2 / 3) << k;
    EXPECT_NEAR(mesh::SurfaceDistance(fixed)(found->place), found->depth_mm, 1e-12) << k;
    EXPECT_EQ(mesh::WindingNumber(fixed).at(found->place).state, PointState::inside) << k;
  }
  EXPECT_GT(in_contact, 20);
}

/// A triangle that meets nothing is inside if a corner is.
TEST(Touch, TrianglesThatReachInsideAreThoseOfBruteForce) {
  std::mt19937 random(64);
  const std::vector<TriMesh> shapes = {
      box({-3, -4, -5}, {3, 4, 5}), torus(4, 1.5, 10, 7), sphere({0, 0, 0}, 4, 2),
      joined(joined(sphere({0, 0, 0}, 1, 1), sphere({9, 0, 0}, 3, 1)), box({-2, -9, -2}, {2, -6, 2}))};
  std::size_t inside = 0, meeting = 0;
  for (int k = 0; k < 60; ++k) {
    const TriMesh &fixed = shapes[random() % 4], &mobile = shapes[random() % 4];
    const Pose X_FM = random_pose(random, 5);
    const contact::JointContact bodies(fixed, mobile);
    const contact::BodyPair& pair = contact::body_pair_of(bodies);
    const auto pairs = pair.pairs(X_FM);
    for (const BodyRole role : {BodyRole::fixed, BodyRole::mobile}) {
      const bool is_fixed = role == BodyRole::fixed;
      const Mesh& own = is_fixed ? bodies.fixed() : bodies.mobile();
      const mesh::WindingNumber other(is_fixed ? Mesh(posed(X_FM, mobile)) : bodies.fixed());
      std::vector<char> expected(own.triangles().size());
      for (const contact::TrianglePair& each : pairs)
        expected[is_fixed ? each.fixed : each.mobile] = true, ++meeting;
      for (std::size_t t = 0; t < expected.size(); ++t) {
        const Vec3& p = own.vertices()[own.triangles()[t][0]];
        if (expected[t] || other.at(is_fixed ? p : posed(X_FM, p)).winding <= 0) continue;
        expected[t] = true, ++inside;
      }
      const std::vector<char> reaching = pair.reaching(role, own, X_FM, pairs);
      EXPECT_EQ(reaching, expected) << k;

      const auto& [target, surface, X_TS] =
          is_fixed ? std::tuple(&pair.mobile_tree(), &pair.fixed_tree(), inverted(X_FM))
                   : std::tuple(&pair.fixed_tree(), &pair.mobile_tree(), X_FM);
      const auto all = contact::deepest_place(*target, *surface, X_TS);
      const auto some = contact::deepest_place(*target, *surface, X_TS, reaching);
      ASSERT_EQ(all.deepest.has_value(), some.deepest.has_value()) << k;
      if (all.deepest) {
        EXPECT_NEAR(all.deepest->depth_mm, some.deepest->depth_mm, 1e-11) << k;
      }
    }
  }
  EXPECT_GT(inside, 500);
  EXPECT_GT(meeting, 1000);
}

TEST(Touch, OfTwoBallsIsTheirClosedFormsWithinWhatFacetsSag) {
  constexpr double a = 10, b = 7, apart = 15;
  const TriMesh fixed = sphere({0, 0, 0}, a, 5), mobile = sphere({0, 0, 0}, b, 5);
  const Pose X_FM = at({apart, 0, 0});
  const TouchAnswer answer = touch(fixed, mobile, X_FM);
  // Edges of an octahedron split five times are at most pi / 2 / 2^5 * 2^(1/2) of the radius: facets sag by edge^2 / (8 r).
  const double edge = 3.1416 / 64 * 1.4143, sag = edge * edge / 8 * (a + b);
  const double depth = a + b - apart;
  ASSERT_TRUE(answer.deepest);
  EXPECT_LE(answer.deepest->depth_mm, depth + 1e-12);
  EXPECT_GE(answer.deepest->depth_mm, depth - sag);
  // The lens between them: pi h^2 (d^2 + 2 d (a + b) - 3 (a - b)^2) / (12 d), and its surface times the sag at most less.
  const double pi = 4 * core::arctangent(1, 1);
  const double lens =
      pi * depth * depth * (apart * apart + 2 * apart * (a + b) - 3 * (a - b) * (a - b)) / (12 * apart);
  EXPECT_LE(*answer.overlap->volume_mm3, lens);
  EXPECT_GE(*answer.overlap->volume_mm3,
            lens - sag * (*answer.overlap->fixed_area_mm2 + *answer.overlap->mobile_area_mm2));
  EXPECT_NEAR(answer.free[0].distance_mm, depth, 1e-12);  // vertices on the axis meet
  EXPECT_NEAR(answer.free[1].distance_mm, a + b + apart, 1e-12);
  const contact::JointContact bodies(fixed, mobile);
  for (const FreeTranslation& free : answer.free) expect_frees(bodies, X_FM, free);

  const TouchAnswer free = touch(fixed, mobile, at({a + b + 2, 0, 0}));
  EXPECT_FALSE(free.in_contact || free.deepest || free.overlap || free.inside);
  EXPECT_NEAR(free.nearest->distance_mm, 2, 1e-12);
  for (const FreeTranslation& each : free.free) EXPECT_EQ(each.distance_mm, 0);
}

TEST(Touch, OfABodyWhollyInsideSaysSo) {
  const TriMesh outer = box({-10, -10, -10}, {10, 10, 10}), inner = box({-1, -1, -1}, {1, 2, 1});
  const TouchAnswer answer = touch(outer, inner);
  EXPECT_TRUE(answer.in_contact);
  EXPECT_TRUE(answer.pairs.empty());
  EXPECT_EQ(answer.inside, BodyRole::mobile);
  EXPECT_NEAR(answer.nearest->distance_mm, 8, 1e-12);
  EXPECT_NEAR(answer.deepest->depth_mm, 9, 1e-10);
  EXPECT_NEAR(*answer.overlap->volume_mm3, 12, 1e-10);
  EXPECT_NEAR(answer.free[2].distance_mm, 11, 1e-12);
  EXPECT_NEAR(answer.free[3].distance_mm, 12, 1e-12);
  EXPECT_EQ(touch(inner, outer).inside, BodyRole::fixed);
  // Everywhere about as deep: the search may end at its effort, with a place and a bound all the same.
  const TouchAnswer ball = touch(sphere({0, 0, 0}, 4, 4), sphere({0, 0, 0}, 3, 4));
  ASSERT_TRUE(ball.deepest);
  EXPECT_NEAR(ball.deepest->depth_mm, 1, 0.02);
  EXPECT_LE(*ball.depth_bound_mm, 1.01);
  // In a hollow nothing is inside: the wall is what is solid.
  const TriMesh hollow = joined(outer, flipped(box({-9, -9, -9}, {9, 9, 9})));
  const TouchAnswer within = touch(hollow, inner);
  EXPECT_FALSE(within.in_contact || within.inside || within.deepest);
  EXPECT_NEAR(within.nearest->distance_mm, 7, 1e-12);
  // Only one of two pieces is inside.
  const TouchAnswer one = touch(outer, joined(inner, box({20, 0, 0}, {21, 1, 1})));
  EXPECT_TRUE(one.in_contact && one.deepest && !one.inside);
}

TEST(Touch, OfBodiesThatOnlyTouchIsContactWithoutDepth) {
  const TriMesh cube = box({-1, -1, -1}, {1, 1, 1});
  for (const Vec3& beside : {Vec3(2, 0, 0), Vec3(2, 0.5, 0.25), Vec3(2, 2, 0), Vec3(2, 2, 2)}) {
    const TouchAnswer answer = touch(cube, cube, at(beside));
    EXPECT_TRUE(answer.in_contact && !answer.pairs.empty());
    EXPECT_FALSE(answer.deepest || answer.inside || answer.nearest);
    EXPECT_LT(*answer.depth_bound_mm, 1e-11);
    EXPECT_LE(std::abs(*answer.overlap->volume_mm3), answer.overlap->volume_error_mm3);
    EXPECT_EQ(answer.overlap->mobile_area_mm2, 0);
    EXPECT_NEAR(answer.free[0].distance_mm, 0, 1e-14);
    EXPECT_NEAR(answer.free[1].distance_mm, 4, 1e-14);
    expect_frees({cube, cube}, at(beside), answer.free[1]);
    EXPECT_FALSE(touch(cube, cube, at(beside + Vec3(0x1p-51, 0, 0))).in_contact);
  }
  // Along a direction whose frame rounds: away at once, or through all of the other body.
  const Vec3 oblique(1, 0.3, 0.7);
  const TouchAnswer along = answer_touch(cube, cube, {.X_FM = at({2, 0, 0}), .along = {oblique, -oblique}});
  EXPECT_NEAR(along.free[0].distance_mm, 0, 1e-14);
  EXPECT_NEAR(along.free[1].distance_mm, 2 * oblique.norm() / 0.7, 1e-13);
  // A vertex in a plane.
  TriMesh tip;
  for (const Vec3& p : {Vec3(1, 0.2, 0.1), Vec3(3, 0, 0), Vec3(3, 1, 0), Vec3(3, 0, 1)})
    tip.vertices.push_back(p);
  tip.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  const TouchAnswer vertex = touch(cube, tip);
  EXPECT_TRUE(vertex.in_contact && !vertex.deepest);
  EXPECT_LE(std::abs(*vertex.overlap->volume_mm3), vertex.overlap->volume_error_mm3);
}

TEST(Touch, OfCoincidentBoxesIsAllOfThem) {
  const TriMesh cube = box({-1, -1, -1}, {1, 1, 1});
  for (const TriMesh& other : {cube, mesh::subdivided(cube)}) {
    const TouchAnswer answer = touch(cube, other);
    EXPECT_TRUE(answer.in_contact);
    EXPECT_FALSE(answer.deepest);  // no point of a surface is inside the other body
    EXPECT_LT(*answer.depth_bound_mm, 1e-11);
    EXPECT_NEAR(*answer.overlap->volume_mm3, 8, 1e-12);
    for (const FreeTranslation& free : answer.free) EXPECT_NEAR(free.distance_mm, 2, 1e-14);
  }
}

TEST(Touch, ScalesWithTheMeshes) {
  const TriMesh fixed = box({-10, -10, -10}, {10, 10, 10}), mobile = box({-3, -2, 8.75}, {3, 4, 14});
  for (const double by : {1e-6, 1e6}) {
    const TouchAnswer answer = touch(scaled(fixed, by), scaled(mobile, by));
    ASSERT_TRUE(answer.deepest);
    EXPECT_NEAR(answer.deepest->depth_mm, 1.25 * by, 1e-12 * by);
    EXPECT_NEAR(*answer.overlap->volume_mm3, 45 * by * by * by, 1e-9 * by * by * by);
    EXPECT_NEAR(answer.free[4].distance_mm, 1.25 * by, 1e-12 * by);
  }
  // Far from the origin coordinates have fewer digits, and the bounds say so.
  const Vec3 far(1e6, -2e6, 3e6);
  const TouchAnswer answer = touch(posed(at(far), fixed), posed(at(far), mobile));
  EXPECT_NEAR(answer.deepest->depth_mm, 1.25, 1e-8);
  EXPECT_NEAR(*answer.overlap->volume_mm3, 45, answer.overlap->volume_error_mm3);
  EXPECT_NEAR(answer.free[4].distance_mm, 1.25, 1e-8);
}

TEST(Touch, OfSurfacesWithoutAnInsideAnswersForTheSurfaces) {
  const TriMesh solid = box({-2, -2, -2}, {2, 2, 2}), sheet = plane(1, 2);
  const TouchAnswer open = touch(solid, posed(at({0, 0, 1.5}), sheet));
  EXPECT_TRUE(
      open.in_contact);  // the sheet reaches through the box's top? it lies within: pieces of it are inside
  ASSERT_EQ(open.notes.size(), 1u);
  EXPECT_EQ(open.notes[0].code, JointNoteCode::open_mesh);
  ASSERT_TRUE(open.deepest);  // of the sheet, whose lower edge is deepest in the solid, 1.5 below its top
  EXPECT_EQ(open.deepest->of, BodyRole::mobile);
  EXPECT_NEAR(open.deepest->depth_mm, 1.5, 1e-10);
  EXPECT_FALSE(open.overlap->volume_mm3 || open.overlap->fixed_area_mm2);
  EXPECT_TRUE(open.overlap->mobile_area_mm2);

  const TouchAnswer inverted = touch(flipped(solid), box({1, -1, -1}, {4, 1, 1}));
  EXPECT_TRUE(inverted.in_contact);
  EXPECT_EQ(inverted.notes[0].code, JointNoteCode::inverted_mesh);
  EXPECT_FALSE(inverted.overlap->volume_mm3);
  ASSERT_TRUE(inverted.deepest);  // of the inverted body's surface in the other
  EXPECT_NEAR(inverted.deepest->depth_mm, 1, 1e-10);

  // Only a piece is inside out, which no other holds.
  const TouchAnswer partly =
      touch(joined(solid, flipped(box({5, -1, -1}, {8, 1, 1}))), box({6, 0, 0}, {7, 0.5, 0.5}));
  EXPECT_FALSE(partly.in_contact);
  ASSERT_EQ(partly.notes.size(), 1u);
  EXPECT_EQ(partly.notes[0].code, JointNoteCode::inverted_mesh);
  EXPECT_NE(partly.notes[0].text.find("that of triangle 12"), std::string::npos) << partly.notes[0].text;
  EXPECT_TRUE(touch(joined(solid, flipped(box({-1, -1, -1}, {1, 1, 1}))), solid).notes.empty());

  const TouchAnswer crossed = touch(joined(solid, posed(at({1, 0, 0}), solid)), box({1, -1, -1}, {5, 1, 1}));
  EXPECT_GT(crossed.overlap->fixed_covered_again_mm3, 1);
}

TEST(Touch, RefusesWhatIsNoPoseDirectionOrMesh) {
  const TriMesh cube = box({-1, -1, -1}, {1, 1, 1});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Pose mirror = Pose::Identity(), scale = Pose::Identity(), broken = Pose::Identity();
  mirror.linear()(0, 0) = -1, scale.linear() *= 2, broken.translation().x() = nan;
  for (const Pose& bad : {mirror, scale, broken}) {
    EXPECT_THROW(answer_touch(cube, cube, {.X_FM = bad}), UsageError);
    EXPECT_THROW(answer_turn(cube, cube, {.X_FM = bad}), UsageError);
    EXPECT_THROW(answer_slide(cube, cube, {.X_FM = bad}), UsageError);
  }
  for (const Vec3& bad : {Vec3(0, 0, 0), Vec3(nan, 0, 1)}) {
    EXPECT_THROW(answer_touch(cube, cube, {.along = {bad}}), UsageError);
    EXPECT_THROW(answer_turn(cube, cube, {.axis = bad}), UsageError);
    EXPECT_THROW(answer_slide(cube, cube, {.along = bad}), UsageError);
  }
  EXPECT_THROW(answer_touch(cube, TriMesh(), {}), MeshError);
  EXPECT_THROW(answer_turn(TriMesh(), cube, {}), MeshError);
  EXPECT_THROW(answer_slide(cube, TriMesh(), {}), MeshError);
  // Nothing but triangles without area, which meet nothing, would be apart from what it goes through.
  TriMesh needle;
  for (const double x : {-3.0, 3.0, 0.0}) needle.vertices.push_back({x, 0.25, 0.5});
  needle.triangles = {{0, 1, 2}};
  EXPECT_THROW(answer_touch(cube, needle, {}), MeshError);
  EXPECT_THROW(answer_turn(needle, cube, {}), MeshError);
  EXPECT_THROW(answer_slide(cube, needle, {}), MeshError);
}

// ---- turn and slide

TEST(Turn, OfARodInADuctIsItsClosedForm) {
  // A rod of half length 10 and half thickness 1 between plates 5 from the axis: its corner reaches them where
  // 10 sin t + cos t = 5.
  const TriMesh duct = joined(box({-20, 5, -2}, {20, 6, 2}), box({-20, -6, -2}, {20, -5, 2}));
  const TriMesh rod = box({-10, -1, -1}, {10, 1, 1});
  const double expected =
      (std::asin(5 / std::sqrt(101)) - core::arctangent(1, 10)) * 180 / (4 * core::arctangent(1, 1));
  const TurnAnswer answer = answer_turn(duct, rod, {.axis = {0, 0, 2}});
  EXPECT_TRUE(answer.free.from_start.free_at_start());
  EXPECT_NEAR(answer.free.from_start.positive.turned.degrees(), expected, 1e-9);
  EXPECT_NEAR(answer.free.from_start.negative.turned.degrees(), expected, 1e-9);
  ASSERT_EQ(answer.free.intervals.size(), 2u);
  EXPECT_NEAR(answer.free.intervals[0].low.degrees(), -expected, 1e-9);
  EXPECT_NEAR(answer.free.intervals[1].low.degrees(), 180 - expected, 1e-9);
  EXPECT_NEAR(answer.free.intervals[1].high.degrees(), 180 + expected, 1e-9);
  // The same about an axis and in a frame turned anyhow.
  std::mt19937 random(7);
  const Pose X = random_pose(random, 30), Y = random_pose(random, 30);
  const TurnAnswer moved =
      answer_turn(posed(X, duct), posed(inverted(Y), rod),
                  {.axis = X.linear() * Vec3(0, 0, 3), .centre = posed(X, Vec3(0, 0, 5)), .X_FM = X * Y});
  ASSERT_EQ(moved.free.intervals.size(), 2u);
  EXPECT_NEAR(moved.free.intervals[1].high.degrees(), 180 + expected, 1e-9);
  // Started in contact, it has the same free intervals.
  Pose start = Pose::Identity();
  start.linear() = core::rotation_about(Vec3::UnitZ(), 1.5);
  const TurnAnswer within = answer_turn(duct, rod, {.X_FM = start});
  EXPECT_FALSE(within.free.from_start.free_at_start());
  ASSERT_EQ(within.free.intervals.size(), 2u);
  EXPECT_NEAR((within.free.intervals[0].high - within.free.intervals[0].low).degrees(), 2 * expected, 1e-9);
  // Nothing to meet.
  const TurnAnswer free = answer_turn(box({50, 0, 0}, {51, 1, 1}), rod, {});
  EXPECT_EQ(free.free.from_start.positive.reason, motion::LimitReason::end_of_range);
  ASSERT_EQ(free.free.intervals.size(), 1u);
  // Wholly inside a ball about the centre: never free.
  const TurnAnswer inside = answer_turn(sphere({0, 0, 0}, 20, 2), rod, {});
  EXPECT_TRUE(!inside.free.from_start.free_at_start() && inside.free.intervals.empty());
}

TEST(Turn, IntervalsAreThoseOfSampling) {
  std::mt19937 random(11);
  const TriMesh gear =
      joined(joined(box({6, -1, -1}, {9, 1, 1}), box({-9, -2, -1}, {-7, 0, 1})), box({-1, 5, -1}, {1, 8, 1}));
  for (int k = 0; k < 10; ++k) {
    const Pose X_FM = random_pose(random, 2);
    const TriMesh arm = box({-8, -0.5, -0.5}, {2, 0.5, 0.5});
    const contact::JointContact bodies(gear, arm);
    const TurnAnswer answer = answer_turn(gear, arm, {.X_FM = X_FM});
    for (int degree = 0; degree < 360; degree += 3) {
      Pose X = Pose::Identity();
      X.linear() = core::rotation_about(Vec3::UnitZ(), degree * 4 * core::arctangent(1, 1) / 180);
      bool is_free = false;
      for (const motion::FreeInterval& each : answer.free.intervals)
        for (const int turns : {-360, 0})
          is_free |= each.low.degrees() <= degree + turns && degree + turns <= each.high.degrees();
      EXPECT_EQ(bodies.in_contact(X * X_FM), !is_free) << k << " at " << degree;
    }
  }
}

TEST(Slide, OfARodInADuctIsItsClosedForm) {
  const TriMesh duct = joined(box({-20, 5, -2}, {20, 6, 2}), box({-20, -6, -2}, {20, -5, 2}));
  TriMesh rod = box({-10, -1, -1}, {10, 1, 1});
  for (int level = 0; level < 2; ++level) {
    const SlideAnswer answer = answer_slide(duct, rod, {.along = {0, 3, 0}});
    EXPECT_TRUE(answer.free.free_at_start);
    EXPECT_NEAR(*answer.free.positive.at_mm, 4, 1e-14);
    EXPECT_LE(*answer.free.positive.at_mm, 4);
    EXPECT_GE(*answer.free.positive.at_mm + answer.free.positive.error_bound_mm, 4);
    EXPECT_NEAR(*answer.free.negative.at_mm, -4, 1e-14);
    ASSERT_EQ(answer.free.intervals.size(), 3u);
    EXPECT_FALSE(answer.free.intervals[0].low.at_mm);
    EXPECT_NEAR(*answer.free.intervals[0].high.at_mm, -7, 1e-12);
    EXPECT_NEAR(*answer.free.intervals[2].low.at_mm, 7, 1e-12);
    EXPECT_NEAR(answer.free.positive.contact->fixed_point.y(), 5, 1e-12);
    EXPECT_NEAR(answer.free.positive.contact->mobile_point.y(), 1, 1e-12);
    const SlideAnswer oblique = answer_slide(duct, rod, {.along = {0.6, 0.8, 0}});
    EXPECT_NEAR(*oblique.free.positive.at_mm, 5, 1e-12);
    EXPECT_LT(oblique.free.positive.error_bound_mm, 1e-12);
    EXPECT_NEAR(*oblique.free.intervals[2].low.at_mm, 8.75, 1e-12);
    // Nothing is met along the duct, whose walls it would touch exactly.
    EXPECT_FALSE(answer_slide(duct, rod, {.along = {1, 0, 0}}).free.positive.at_mm);
    const SlideAnswer grazing = answer_slide(duct, rod, {.along = {1, 0, 0}, .X_FM = at({0, 4, 0})});
    EXPECT_FALSE(grazing.free.free_at_start);
    ASSERT_EQ(grazing.free.intervals.size(), 2u);
    EXPECT_NEAR(*grazing.free.intervals[1].low.at_mm, 30, 1e-12);
    EXPECT_EQ(
        answer_slide(duct, rod, {.along = {1, 0, 0}, .X_FM = at({0, 4 - 0x1p-50, 0})}).free.intervals.size(),
        1u);
    rod = mesh::subdivided(rod);
  }
}

TEST(Slide, AlongAFaceEndsWhereItsEdgesDo) {
  // A wedge whose top is a triangle, its slant on y = x, and a box whose top is level with it. Turned, top and slide are parallel to
  // rounding only, and the tops are seen as slivers: the box's corner at y = 1 meets the slant at x = 1, and its back leaves the wedge
  // at x = 10.
  TriMesh wedge;
  for (const double z : {0.0, 5.0})
    for (const Vec3& p : {Vec3(0, 0, z), Vec3(10, 0, z), Vec3(10, 10, z)}) wedge.vertices.push_back(p);
  wedge.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
  std::mt19937 random(29);
  for (const double top : {5.0, 6.0})
    for (int k = 0; k < 200; ++k) {
      const TriMesh block = box({-21, 1, top - 2}, {-19, 2, top});
      const Pose X = random_pose(random, 0);
      const motion::FreeSlides free =
          answer_slide(posed(X, wedge), posed(X, block), {.along = X.linear().col(0)}).free;
      ASSERT_EQ(free.intervals.size(), 2u) << k;
      EXPECT_NEAR(*free.positive.at_mm, 20, 1e-12) << k;
      EXPECT_NEAR(*free.intervals[1].low.at_mm, 31, 1e-12) << k;
      EXPECT_LT(free.positive.error_bound_mm, 1e-12) << k;
      EXPECT_LT(free.intervals[1].low.error_bound_mm, 1e-12) << k;
    }
}

TEST(Touch, BeginsSlidesAndTurnsInContact) {
  // Frames of oblique directions and axes round the coordinates of both, and may part them.
  const TriMesh cube = box({-1, -1, -1}, {1, 1, 1});
  const contact::BodyPair pair(cube, cube);
  std::mt19937 random(31);
  std::uniform_int_distribution<int> whole(-3, 3);
  const auto any = [&] { return Vec3(whole(random), whole(random), whole(random)); };
  for (int k = 0; k < 300; ++k) {
    const Pose X_FM = at(Vec3(2, whole(random) / 2.0, whole(random) / 2.0));
    Vec3 along = any();
    if (along.isZero()) along.x() = 1;
    ASSERT_TRUE(pair.touch(X_FM));
    const motion::FreeSlides slides = answer_slide(cube, cube, {.along = along, .X_FM = X_FM}).free;
    EXPECT_FALSE(slides.free_at_start) << k;
    EXPECT_EQ(*slides.positive.at_mm, 0) << k;
    for (const motion::FreeSlide& each : slides.intervals)
      EXPECT_TRUE((each.low.at_mm && *each.low.at_mm > -1e-14) ||
                  (each.high.at_mm && *each.high.at_mm < 1e-14))
          << k;
    const motion::FreeAngles turns =
        answer_turn(cube, cube, {.axis = along, .centre = any(), .X_FM = X_FM}).free;
    EXPECT_EQ(turns.from_start.negative.reason, motion::LimitReason::contact_at_start) << k;
    EXPECT_EQ(turns.from_start.positive.turned.degrees(), 0) << k;
    ASSERT_TRUE(turns.from_start.positive.contact) << k;
    EXPECT_NEAR(turns.from_start.positive.contact->fixed_point.x(), 1, 1e-12) << k;
    for (const motion::FreeInterval& each : turns.intervals) {
      EXPECT_GE(each.low.degrees(), -1e-9) << k;
      EXPECT_LE(each.high.degrees(), 360 + 1e-9) << k;
      EXPECT_GT((each.high - each.low).degrees(), 0) << k;
    }
  }
}

/// Positions of contact of all pairs of triangles are what exact tests beside every end say.
TEST(Slide, OfRandomTrianglesMissesNoContactAndInventsNone) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> whole(-2, 2);
  std::uniform_real_distribution<double> real(-2, 2);
  int met = 0;
  for (int k = 0; k < 1500; ++k) {
    // Whole numbers: coplanar, edge on, vertex on edge, parallel to the direction, degenerate.
    const auto coordinate = [&] { return k % 2 ? real(random) : whole(random); };
    TriMesh a, b;
    for (int i = 0; i < 3; ++i) {
      a.vertices.push_back({coordinate(), coordinate(), coordinate()});
      b.vertices.push_back({coordinate(), coordinate(), coordinate()});
    }
    a.triangles = b.triangles = {{0, 1, 2}};
    const auto contacts = motion::translation_contacts(a, b, Vec3::UnitX());
    ASSERT_LE(contacts.size(), 1u);
    const auto meet = [&](double t) {
      const auto pair = contact::BodyPair(a, b);
      return !pair.pairs(at({t, 0, 0})).empty();
    };
    for (int i = 0; i < 6; ++i) {
      const double t = k % 2 ? 3 * real(random) : whole(random) + 0.5 * (i % 2);
      const bool holds = !contacts.empty() && contacts[0].low.at_mm <= t && t <= contacts[0].high.at_mm;
      if (!holds) {
        EXPECT_FALSE(meet(t)) << k << " " << t;
      }
      const bool sure = !contacts.empty() && contacts[0].low.sure_mm <= t && t <= contacts[0].high.sure_mm;
      if (sure && t > contacts[0].low.sure_mm + 1e-9 && t < contacts[0].high.sure_mm - 1e-9) {
        EXPECT_TRUE(meet(t)) << k << " " << t;
      }
    }
    if (contacts.empty()) continue;
    ++met;
    EXPECT_LT(contacts[0].low.sure_mm - contacts[0].low.at_mm, 1e-9) << k;
    EXPECT_FALSE(meet(contacts[0].low.at_mm - 1e-9)) << k;
    EXPECT_FALSE(meet(contacts[0].high.at_mm + 1e-9)) << k;
    if (contacts[0].high.at_mm - contacts[0].low.at_mm > 1e-6) {
      EXPECT_TRUE(meet(contacts[0].low.at_mm + 1e-7)) << k;
      EXPECT_TRUE(meet(contacts[0].high.at_mm - 1e-7)) << k;
    }
  }
  EXPECT_GT(met, 300);
}

TEST(Slide, IntervalsEndWhereContactDoes) {
  std::mt19937 random(23);
  const TriMesh ring = torus(5, 1, 24, 12), ball = sphere({0, 0, 0}, 1.5, 2);
  const contact::JointContact bodies(ring, ball);
  for (int k = 0; k < 12; ++k) {
    Pose X_FM = random_pose(random, 1);
    const Vec3 along = k < 3 ? Vec3(Vec3::Unit(k)) : Vec3(random_pose(random, 1).linear().col(0));
    const SlideAnswer answer = answer_slide(ring, ball, {.along = along, .X_FM = X_FM});
    const auto in_contact = [&](double t) {
      Pose X = X_FM;
      X.translation() += along.normalized() * t;
      return bodies.in_contact(X);
    };
    for (const motion::FreeSlide& each : answer.free.intervals) {
      if (each.low.at_mm) {
        EXPECT_TRUE(!in_contact(*each.low.at_mm + 1e-9) && in_contact(*each.low.at_mm - 1e-9));
      }
      if (each.high.at_mm) {
        EXPECT_TRUE(!in_contact(*each.high.at_mm - 1e-9) && in_contact(*each.high.at_mm + 1e-9));
      }
      if (each.low.at_mm && each.high.at_mm) {
        EXPECT_FALSE(in_contact((*each.low.at_mm + *each.high.at_mm) / 2));
      }
    }
    for (int i = -40; i <= 40; ++i) {
      const double t = 0.25 * i;
      bool is_free = false;
      for (const motion::FreeSlide& each : answer.free.intervals)
        is_free |= (!each.low.at_mm || *each.low.at_mm < t) && (!each.high.at_mm || t < *each.high.at_mm);
      EXPECT_EQ(in_contact(t), !is_free) << k << " " << t;
    }
  }
}

TEST(Touch, OfRealBonesIsThatOfTheirPoints) {
  const auto hip = hip_vhf_right();
  if (!hip) GTEST_SKIP() << "no real hip";
  const Pose X_FM = at({0.5, 6, 1});
  const TouchAnswer answer =
      answer_touch(hip->fixed.mesh, hip->mobile.mesh, {.X_FM = X_FM, .along = {{1, 0, 0}, {0, -1, 0}}});
  ASSERT_TRUE(answer.deepest && answer.overlap);
  EXPECT_LT(answer.deepest->error_mm, 1e-9);
  // The deepest vertex, whose distance depth has always had, is not deeper, and less deep by less than an edge.
  const contact::JointContact bodies(hip->fixed.mesh, hip->mobile.mesh);
  const DepthAnswer by_vertices = answer_depth(bodies, *hip, {.X_FM = X_FM, .method = DepthMethod::radial});
  double deepest = 0;
  for (const auto* distances :
       {&by_vertices.measures.distances.mobile, &by_vertices.measures.distances.fixed})
    for (const double each : *distances)
      if (each > deepest) deepest = each;
  EXPECT_GT(deepest, 0.5);
  EXPECT_GE(answer.deepest->depth_mm, deepest - 1e-12);
  EXPECT_LT(answer.deepest->depth_mm, deepest + 2);
  EXPECT_EQ(answer.overlap->volume_mm3, by_vertices.measures.volume_mm3);
  EXPECT_EQ(answer.overlap->mobile_area_mm2, by_vertices.measures.mobile->area_mm2);
  EXPECT_EQ(answer.pairs.size(), std::get<RayDepths>(by_vertices.depths).contact.pairs.size());
  for (const FreeTranslation& free : answer.free) expect_frees(bodies, X_FM, free);
}

}  // namespace
}  // namespace condyle::test
