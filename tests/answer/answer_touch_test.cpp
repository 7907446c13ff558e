#include <tuple>

#include "condyle/answer.hpp"
#include "contact/body_pair.hpp"
#include "contact/deepest_place.hpp"
#include "mesh/subdivide.hpp"
#include "mesh/surface_distance.hpp"
#include "mesh/winding_number.hpp"
#include "support/brute_force.hpp"
#include "support/random_pose.hpp"
#include "support/real_hip.hpp"
#include "support/test.hpp"

/// Two meshes without a joint: depth, volume and ways out against closed forms, sampling and the question asked again.

namespace condyle::test {
namespace {

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

/// The balls' poles are off the line between their centres: few triangles reach in, and only a little.
TEST(Touch, DepthOfAThinOverlapTakesFewParts) {
  const TriMesh ball = sphere({0, 0, 0}, 24, 4);
  for (const double overlap_mm : {0.3, 0.03, 0.01}) {
    const Pose X_FM = translated((48 - 0.05 - overlap_mm) * Vec3(47.7, 0.3, 0.7).normalized());
    const contact::JointContact bodies(ball, ball);
    const contact::BodyPair& pair = contact::body_pair_of(bodies);
    const auto reaching = pair.reaching(BodyRole::mobile, X_FM, pair.pairs(X_FM));
    const auto found = contact::deepest_place(pair.fixed_tree(), pair.mobile_tree(), X_FM, reaching, 0, 400);
    ASSERT_TRUE(found.deepest) << overlap_mm;
    EXPECT_LT(found.bound_mm - found.deepest->depth_mm, 1e-9) << overlap_mm;
  }
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
      const contact::Reaching reaching = pair.reaching(role, X_FM, pairs);
      const mesh::TriangleTree& tree = is_fixed ? pair.fixed_tree() : pair.mobile_tree();
      std::vector<Index> expected_places;
      for (Index t = 0; t < expected.size(); ++t)
        if (expected[tree.mesh_triangles()[t]]) expected_places.push_back(t);
      EXPECT_EQ(reaching.places, expected_places) << k;

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

TEST(Touch, OfThinOverlapsIsAsCloseAsOfDeepOnes) {
  const TriMesh cube = box({0, 0, 0}, {10, 10, 10});
  for (const double depth : {1e-9, 1e-6, 1e-4, 1e-3, 1e-2, 0.1, 1.0})
    for (const TriMesh& other :
         {box({10 - depth, 3, 4}, {20, 13, 14}), box({10 - depth, 0, 0}, {20, 10, 10}),
          box({10 - depth, -5, -5}, {20, 15, 15}), box({10 - depth, 10 - depth, 0}, {20, 20, 10})}) {
      const TouchAnswer answer = touch(cube, other);
      ASSERT_TRUE(answer.deepest) << depth;
      EXPECT_NEAR(answer.deepest->depth_mm, depth, 1e-14);
      EXPECT_LT(answer.deepest->error_mm, 1e-10) << depth;
    }
  // Pushed into each other from where they first meet: no place is deeper than they were pushed.
  std::mt19937 random(65);
  const std::vector<TriMesh> shapes = {box({-3, -4, -5}, {3, 4, 5}), torus(4, 1.5, 10, 7),
                                       sphere({0, 0, 0}, 4, 1)};
  int pushed = 0;
  for (int k = 0; k < 60; ++k) {
    const TriMesh &fixed = shapes[random() % 3], &mobile = shapes[random() % 3];
    Pose X_FM = random_pose(random, 2);
    X_FM.translation().x() -= 20;
    const auto met = answer_slide(fixed, mobile, {.along = {1, 0, 0}, .X_FM = X_FM}).free.positive.at_mm;
    if (!met) continue;
    ++pushed;
    const double push = std::pow(10, -1 - k % 6);
    X_FM.translation().x() += *met + push;
    const TouchAnswer answer = touch(fixed, mobile, X_FM);
    ASSERT_TRUE(answer.deepest) << k;
    EXPECT_LT(answer.deepest->depth_mm, push + 1e-13) << k;
    // Cut into other pieces, the surfaces have the same depth: none that is deep was dropped.
    const TouchAnswer finer = touch(mesh::subdivided(fixed), mesh::subdivided(mobile), X_FM);
    ASSERT_TRUE(finer.deepest) << k;
    EXPECT_LE(std::abs(finer.deepest->depth_mm - answer.deepest->depth_mm),
              std::max(finer.deepest->error_mm, answer.deepest->error_mm))
        << k;
    EXPECT_LT(answer.deepest->error_mm, 1e-10) << k;
  }
  EXPECT_GT(pushed, 40);
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

TEST(Touch, HasNoVolumeWhereABodyThatCrossesItselfIsInsideOut) {
  TriMesh pulled = box({-4, -4, -4}, {4, 4, 4});
  // Out through the opposite corner, so that a part beyond the wall winds the other way.
  pulled.vertices.x[0] = pulled.vertices.y[0] = pulled.vertices.z[0] = 12;
  const Vec3 there(6, 1, 1), half(0.2, 0.2, 0.2);
  ASSERT_LT(winding_number(pulled, there).winding, 0);
  const TouchAnswer found = touch(pulled, box(there - half, there + half));
  EXPECT_TRUE(found.in_contact);
  EXPECT_FALSE(found.overlap->volume_mm3);
  EXPECT_TRUE(std::any_of(found.notes.begin(), found.notes.end(),
                          [](const JointNote& note) { return note.code == JointNoteCode::self_crossings; }));
}

TEST(Touch, VolumesThatRoundingTakesBelowZeroAreZero) {
  TriMesh pulled = box({-4, -4, -4}, {4, 4, 4});
  pulled.vertices.x[0] = 8, pulled.vertices.y[0] = 9, pulled.vertices.z[0] = 10;
  const TouchAnswer found = touch(pulled, box({6.8, 6.8, 6.8}, {7.2, 7.2, 7.2}));
  ASSERT_TRUE(found.overlap->volume_mm3);
  EXPECT_GE(*found.overlap->volume_mm3, 0);
  EXPECT_FALSE(std::signbit(*found.overlap->volume_mm3));
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

/// The notes without those of a size that no bone has: these boxes are of few millimetres.
std::vector<JointNote> notes_of(TouchAnswer answer) {
  std::erase_if(answer.notes,
                [](const JointNote& note) { return note.code == JointNoteCode::unlikely_size; });
  return answer.notes;
}

TEST(Touch, OfSurfacesWithoutAnInsideAnswersForTheSurfaces) {
  const TriMesh solid = box({-2, -2, -2}, {2, 2, 2}), sheet = plane(1, 2);
  const TouchAnswer open = touch(solid, posed(at({0, 0, 1.5}), sheet));
  EXPECT_TRUE(
      open.in_contact);  // the sheet reaches through the box's top? it lies within: pieces of it are inside
  EXPECT_EQ(notes_of(open).at(0).code, JointNoteCode::open_mesh);
  ASSERT_TRUE(open.deepest);  // of the sheet, whose lower edge is deepest in the solid, 1.5 below its top
  EXPECT_EQ(open.deepest->of, BodyRole::mobile);
  EXPECT_NEAR(open.deepest->depth_mm, 1.5, 1e-10);
  EXPECT_FALSE(open.overlap->volume_mm3 || open.overlap->fixed_area_mm2);
  EXPECT_TRUE(open.overlap->mobile_area_mm2);

  const TouchAnswer inverted = touch(flipped(solid), box({1, -1, -1}, {4, 1, 1}));
  EXPECT_TRUE(inverted.in_contact);
  EXPECT_EQ(notes_of(inverted).at(0).code, JointNoteCode::inverted_mesh);
  EXPECT_FALSE(inverted.overlap->volume_mm3);
  ASSERT_TRUE(inverted.deepest);  // of the inverted body's surface in the other
  EXPECT_NEAR(inverted.deepest->depth_mm, 1, 1e-10);

  // Only a piece is inside out, which no other holds.
  const TouchAnswer partly =
      touch(joined(solid, flipped(box({5, -1, -1}, {8, 1, 1}))), box({6, 0, 0}, {7, 0.5, 0.5}));
  EXPECT_FALSE(partly.in_contact);
  const std::vector<JointNote> of_piece = notes_of(partly);
  ASSERT_EQ(of_piece.size(), 1u);
  EXPECT_EQ(of_piece[0].code, JointNoteCode::inverted_mesh);
  EXPECT_NE(of_piece[0].text.find("that of triangle 12"), std::string::npos) << of_piece[0].text;
  EXPECT_TRUE(notes_of(touch(joined(solid, flipped(box({-1, -1, -1}, {1, 1, 1}))), solid)).empty());
}

TEST(Touch, HasTheNotesOfAJoint) {
  using enum JointNoteCode;
  const TriMesh ball = sphere({0, 0, 0}, 20, 2), beside = box({-1, -1, -1}, {1, 1, 1}),
                big = box({-60, -60, -60}, {60, 60, 60});
  TriMesh twice = ball, mixed = ball;
  twice.triangles.insert(twice.triangles.end(), ball.triangles.begin(), ball.triangles.end());
  std::swap(mixed.triangles[3][0], mixed.triangles[3][1]);
  const auto codes = [](const TriMesh& fixed, const TriMesh& mobile, bool units_are_stated = false) {
    const TouchAnswer answer = answer_touch(fixed, mobile, {.units_are_stated = units_are_stated});
    const auto same = [&](const std::vector<JointNote>& notes) {
      return std::equal(
          notes.begin(), notes.end(), answer.notes.begin(), answer.notes.end(),
          [](const JointNote& a, const JointNote& b) { return a.code == b.code && a.text == b.text; });
    };
    EXPECT_TRUE(same(answer_turn(fixed, mobile, {.units_are_stated = units_are_stated}).notes));
    EXPECT_TRUE(same(answer_slide(fixed, mobile, {.units_are_stated = units_are_stated}).notes));
    std::vector<JointNoteCode> found;
    for (const JointNote& note : answer.notes) found.push_back(note.code);
    return found;
  };
  using Codes = std::vector<JointNoteCode>;
  EXPECT_EQ(codes(ball, big), Codes());
  EXPECT_EQ(codes(twice, big), Codes{doubled_triangles});
  EXPECT_EQ(codes(big, mixed), Codes{mixed_orientation});
  EXPECT_EQ(codes(joined(ball, flipped(ball)), big), Codes{two_sided});
  const TouchAnswer without = touch(joined(ball, flipped(ball)), beside);
  EXPECT_FALSE(without.in_contact || without.depth_bound_mm == 0);
  EXPECT_NE(without.notes[0].text.find("twice, once in each sense"), std::string::npos)
      << without.notes[0].text;
  // A bone of 0.3 "mm" is one in metres, of 15 in centimetres or inches.
  for (const double by : {0.3, 15.0}) {
    const TriMesh small = box({0, 0, 0}, Vec3(1, 0.4, 0.3) * by);
    EXPECT_EQ(codes(big, small), Codes{unlikely_size}) << by;
    EXPECT_EQ(codes(big, small, true), Codes()) << by;
  }
}

TEST(Touch, DepthAlongRaysIsThatOfAJointAboutTheirCentre) {
  const TriMesh wall = box({40, -120, -50}, {60, -20, 50}), arm = box({-1, -100, -2}, {1, -10, 2});
  const Joint joint{.name = "arm",
                    .kind = JointKind::ball,
                    .side = Side::right,
                    .fixed = {"wall", wall},
                    .mobile = {"arm", arm}};
  const Pose X_FM = pose_at(joint.coordinates(), {Angle::degrees(25), {}, {}});
  const DepthAnswer depth = answer_depth(joint, {.X_FM = X_FM, .method = DepthMethod::radial});
  const Pose moved = at({7, 8, 9});
  const TouchAnswer answer =
      answer_touch(posed(moved, wall), arm, {.X_FM = Pose(moved * X_FM), .centre = Vec3(7, 8, 9)});
  EXPECT_NEAR(*answer.ray_depth_mm,
              contact::deepest_of(std::get<RayDepths>(depth.depths).reliable)->vertex.depth_mm, 1e-9);
  EXPECT_FALSE(touch(wall, arm).ray_depth_mm);
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

TEST(Touch, OfRealBonesIsThatOfTheirPoints) {
  FOUND_OR_SKIP(hip, hip_vhf_right());
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
