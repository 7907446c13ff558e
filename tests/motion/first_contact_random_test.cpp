#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "motion/turn_scenes.hpp"
#include "support/brute_force.hpp"

/// First contact of random meshes: against every pair of features, against exact triangle tests just before
/// and just after, and against itself in other words.

namespace condyle {
namespace {

using namespace test;

constexpr double microdegree = 1e-6 * std::numbers::pi / 180;

std::mt19937 any_random() {
  return std::mt19937(*rc::gen::arbitrary<unsigned>());
}

double size_of(const Limit& limit) {
  return std::abs(limit.angle.radians());
}

void expect_brute_force_agrees(const TurnScene& scene) {
  const auto found = limits(scene);
  if (found.positive.reason == LimitReason::contact_at_start) {
    RC_ASSERT(found.negative.reason == LimitReason::contact_at_start);
    return;
  }
  for (const auto& [limit, direction] : {std::pair{found.negative, motion::TurnDirection::negative},
                                         std::pair{found.positive, motion::TurnDirection::positive}}) {
    const auto truth = brute_first_contact(scene, direction);
    RC_ASSERT(truth.has_value() == (limit.reason == LimitReason::contact));
    if (!truth) {
      RC_ASSERT(size_of(limit) == two_pi);
      continue;
    }
    RC_ASSERT(size_of(limit) == truth->size);
    RC_ASSERT(limit.touching->features == truth->features);
    RC_ASSERT(limit.shortfall.radians() <= 4e-12);
    RC_ASSERT(limit.shortfall.radians() >= 0);
  }
}

/// 100 runs of 100 pairs.
RC_GTEST_PROP(FirstContactRandom, equals_the_first_of_all_pairs_of_features, ()) {
  auto random = any_random();
  for (int i = 0; i < 100; ++i) expect_brute_force_agrees(random_scene(random));
}

RC_GTEST_PROP(FirstContactRandom, equals_the_first_of_all_pairs_of_features_ten_metres_away, ()) {
  auto random = any_random();
  for (int i = 0; i < 10; ++i) expect_brute_force_agrees(moved(far_away(random), random_scene(random)));
}

/// Coordinates from a coarse lattice: coplanar faces, parallel edges, features on the axis and in planes of
/// the motion.
RC_GTEST_PROP(FirstContactRandom, equals_the_first_of_all_pairs_of_features_on_a_lattice, ()) {
  auto random = any_random();
  for (int i = 0; i < 20; ++i) {
    TurnScene scene = random_scene(random);
    for (auto* mesh : {&scene.turning, &scene.resting}) {
      for (std::size_t v = 0; v < mesh->vertices.size(); ++v) {
        const Vec3 p = 2 * mesh->vertices[v];
        mesh->vertices.set(v, p.array().round());
      }
    }
    expect_brute_force_agrees(scene);
  }
}

RC_GTEST_PROP(FirstContactRandom, is_free_just_before_and_touching_just_after_by_exact_triangle_tests, ()) {
  auto random = any_random();
  for (int i = 0; i < 2; ++i) {
    const TurnScene scene = random_scene(random);
    const auto found = limits(scene);
    for (const Limit& limit : {found.negative, found.positive}) {
      if (limit.reason == LimitReason::contact_at_start) {
        if (limit.touching) RC_ASSERT(brute_touching(scene, 0));
        continue;
      }
      const double sign = limit.angle.radians() < 0 ? -1 : 1, size = size_of(limit);
      for (int k = 0; k < 10; ++k) RC_ASSERT(!brute_touching(scene, sign * size * k / 10));
      RC_ASSERT(!brute_touching(scene, sign * (size - microdegree)));
      if (limit.reason == LimitReason::contact) RC_ASSERT(brute_touching(scene, sign * (size + microdegree)));
    }
  }
}

/// Containment by an independent winding number.
RC_GTEST_PROP(FirstContactRandom, starts_in_contact_exactly_where_surfaces_touch_or_one_is_inside, ()) {
  auto random = any_random();
  for (int i = 0; i < 5; ++i) {
    TurnScene scene = random_scene(random);
    const Vec3 c = scene.resting.vertices[0];
    for (std::size_t v = 0; v < scene.turning.vertices.size(); ++v) {
      const Vec3 p = scene.turning.vertices[v], centre = scene.turning.vertices[1];
      scene.turning.vertices.set(v, 0.9 * c + 0.1 * centre + 0.2 * (p - centre));
    }
    const bool inside =
        winding_number(scene.axis.to_axis(scene.resting), scene.axis.to_axis(scene.turning).vertices[0])
                .winding > 0 ||
        winding_number(scene.axis.to_axis(scene.turning), scene.axis.to_axis(scene.resting).vertices[0])
                .winding > 0;
    const bool touching = brute_touching(scene, 0);
    const auto found = limits(scene).positive;
    RC_ASSERT((found.reason == LimitReason::contact_at_start) == (inside || touching));
    if (found.reason == LimitReason::contact_at_start) RC_ASSERT(found.touching.has_value() == touching);
  }
}

RC_GTEST_PROP(FirstContactRandom, exchanging_the_bodies_negates_and_agrees, ()) {
  auto random = any_random();
  for (int i = 0; i < 20; ++i) {
    const TurnScene scene = random_scene(random);
    const auto one = limits(scene), other = limits(exchanged(scene));
    const auto expect_same = [](const Limit& a, const Limit& b) {
      RC_ASSERT(a.reason == b.reason);
      RC_ASSERT(std::abs(a.angle.radians() + b.angle.radians()) <=
                a.shortfall.radians() + b.shortfall.radians());
      if (a.reason == LimitReason::contact) {
        RC_ASSERT((a.touching->turning_point - b.touching->resting_point).norm() <= 1e-9);
        RC_ASSERT((a.touching->resting_point - b.touching->turning_point).norm() <= 1e-9);
      }
    };
    expect_same(one.positive, other.negative);
    expect_same(one.negative, other.positive);
  }
}

RC_GTEST_PROP(FirstContactRandom, splitting_every_triangle_in_place_changes_nothing, ()) {
  auto random = any_random();
  for (int i = 0; i < 5; ++i) {
    const TurnScene scene = random_scene(random);
    const TurnScene finer{split_in_four(split_in_four(scene.turning)), split_in_four(scene.resting),
                          scene.axis};
    const auto coarse = limits(scene), fine = limits(finer);
    for (const auto& [a, b] :
         {std::pair{coarse.positive, fine.positive}, std::pair{coarse.negative, fine.negative}}) {
      RC_ASSERT(a.reason == b.reason);
      RC_ASSERT(std::abs(a.angle.radians() - b.angle.radians()) <= 1e-9);
    }
  }
}

RC_GTEST_PROP(FirstContactRandom, touches_at_one_point_of_both_bodies, ()) {
  auto random = any_random();
  for (int i = 0; i < 10; ++i) {
    const TurnScene scene = moved(Pose(Eigen::Translation3d(1, 2, 3)), random_scene(random));
    for (const Limit& limit : {limits(scene).positive, limits(scene).negative}) {
      if (limit.reason != LimitReason::contact) continue;
      const Pose turn(Eigen::Translation3d(scene.axis.point()) *
                      Eigen::AngleAxisd(limit.angle.radians(), scene.axis.direction()) *
                      Eigen::Translation3d(-scene.axis.point()));
      RC_ASSERT((turn * limit.touching->turning_point - limit.touching->resting_point).norm() <= 1e-9);
    }
  }
}

/// What the properties above compare: scenes that end in contact, that start in it, and that are free.
TEST(FirstContactRandom, RandomScenesEndInContactStartInItAndStayFreeOften) {
  std::mt19937 random(1);
  int contact = 0, at_start = 0, free = 0;
  for (int i = 0; i < 500; ++i) {
    const LimitReason reason = limits(random_scene(random)).positive.reason;
    ++(reason == LimitReason::contact ? contact : reason == LimitReason::contact_at_start ? at_start : free);
  }
  EXPECT_GT(contact, 50);
  EXPECT_GT(at_start, 10);
  EXPECT_GT(free, 50);
}

}  // namespace
}  // namespace condyle
