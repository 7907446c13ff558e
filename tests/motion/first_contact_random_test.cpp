#include <rapidcheck/gtest.h>

#include "mesh/surface_distance.hpp"
#include "motion/rotation_scenes.hpp"
#include "support/brute_force.hpp"
#include "support/test.hpp"

/// First contact of random meshes: against every pair of features, against exact triangle tests just before
/// and just after, and against itself in other words.

namespace condyle::motion {
namespace {

using namespace test;

constexpr double microdegree = 1e-6 * std::numbers::pi / 180;

std::mt19937 random_by_rapidcheck() {
  return std::mt19937(*rc::gen::arbitrary<unsigned>());
}

void expect_brute_force_agrees(const RotationScene& scene) {
  const auto found = limits(scene);
  if (found.positive.reason == LimitReason::contact_at_start) {
    RC_ASSERT(found.negative.reason == LimitReason::contact_at_start);
    return;
  }
  for (const auto& [limit, sense] : {std::pair{found.negative, RotationSense::negative},
                                     std::pair{found.positive, RotationSense::positive}}) {
    const auto truth = brute_first_contact(scene, sense);
    RC_ASSERT(truth.has_value() == (limit.reason == LimitReason::contact));
    if (!truth) {
      RC_ASSERT(limit.turned.radians() == two_pi);
      continue;
    }
    RC_ASSERT(limit.turned.radians() == truth->size);
    RC_ASSERT(limit.contact->mobile_feature == truth->features.rotating);
    RC_ASSERT(limit.contact->fixed_feature == truth->features.stationary);
    RC_ASSERT(limit.error_bound.radians() <= 4e-12);
    RC_ASSERT(limit.error_bound.radians() >= 0);
  }
}

/// 100 runs of 100 pairs.
RC_GTEST_PROP(FirstContactRandom, EqualsTheFirstOfAllPairsOfFeatures, ()) {
  auto random = random_by_rapidcheck();
  for (int i = 0; i < 100; ++i) expect_brute_force_agrees(random_scene(random));
}

RC_GTEST_PROP(FirstContactRandom, EqualsTheFirstOfAllPairsOfFeaturesTenMetresAway, ()) {
  auto random = random_by_rapidcheck();
  for (int i = 0; i < 10; ++i) expect_brute_force_agrees(moved(far_away(random), random_scene(random)));
}

/// As of every pair of features, each at a point that the turn brings to where the other body is.
RC_GTEST_PROP(FirstContactRandom, EveryFeatureThatMeetsIsFoundAtItsFirstContact, ()) {
  auto random = any_random();
  for (int i = 0; i < 50; ++i) {
    const RotationScene scene = random_scene(random);
    if (limits(scene).positive.reason == LimitReason::contact_at_start) continue;
    const Mesh stationary_mesh = scene.stationary, rotating_mesh = scene.rotating;
    const FeatureTree stationary_tree(stationary_mesh), rotating_tree(rotating_mesh);
    const RotationTable stationary(stationary_tree, scene.axis);
    RotatingBody rotating(rotating_tree);
    rotating.start_at(scene.axis, Pose::Identity());
    for (const RotationSense sense : {RotationSense::negative, RotationSense::positive})
      for (const double range : {0.5, 3.0}) {
        const auto truth = brute_feature_contacts(scene, sense, range);
        const auto found = motion::feature_contacts(stationary, rotating, sense, Angle::radians(range));
        RC_ASSERT(found.size() == truth.size());
        double last = 0;
        for (const FeatureContact& contact : found) {
          RC_ASSERT(truth.at(contact.feature) == contact.turned.radians());
          RC_ASSERT(last <= contact.turned.radians());
          last = contact.turned.radians();
          const Vec3 there = Eigen::AngleAxisd(sign_of(sense) * last, scene.axis.direction()) * contact.point;
          RC_ASSERT(mesh::distance_to_surface(mesh::TriangleTree(scene.rotating), contact.point) < 1e-9);
          RC_ASSERT(mesh::distance_to_surface(mesh::TriangleTree(scene.stationary), there) < 1e-9);
        }
      }
  }
}

/// Coordinates from a coarse lattice: coplanar faces, parallel edges, features on the axis and in planes of
/// the motion.
RC_GTEST_PROP(FirstContactRandom, EqualsTheFirstOfAllPairsOfFeaturesOnALattice, ()) {
  auto random = random_by_rapidcheck();
  for (int i = 0; i < 20; ++i) {
    RotationScene scene = random_scene(random);
    for (auto* mesh : {&scene.rotating, &scene.stationary}) {
      for (std::size_t v = 0; v < mesh->vertices.size(); ++v) {
        const Vec3 p = 2 * mesh->vertices[v];
        mesh->vertices.set(v, p.array().round());
      }
    }
    expect_brute_force_agrees(scene);
  }
}

RC_GTEST_PROP(FirstContactRandom, IsFreeJustBeforeAndTouchingJustAfterByExactTriangleTests, ()) {
  auto random = random_by_rapidcheck();
  for (int i = 0; i < 2; ++i) {
    const RotationScene scene = random_scene(random);
    const auto found = limits(scene);
    for (const auto& [limit, sense] : {std::pair{found.negative, RotationSense::negative},
                                       std::pair{found.positive, RotationSense::positive}}) {
      if (limit.reason == LimitReason::contact_at_start) {
        if (limit.contact) RC_ASSERT(brute_contact_at(scene, 0));
        continue;
      }
      const double sign = sign_of(sense), size = limit.turned.radians();
      for (int k = 0; k < 10; ++k) RC_ASSERT(!brute_contact_at(scene, sign * size * k / 10));
      RC_ASSERT(!brute_contact_at(scene, sign * (size - microdegree)));
      if (limit.reason == LimitReason::contact)
        RC_ASSERT(brute_contact_at(scene, sign * (size + microdegree)));
    }
  }
}

/// Containment by an independent winding number.
RC_GTEST_PROP(FirstContactRandom, StartsInContactExactlyWhereSurfacesTouchOrOneIsInside, ()) {
  auto random = random_by_rapidcheck();
  for (int i = 0; i < 5; ++i) {
    RotationScene scene = random_scene(random);
    const Vec3 c = scene.stationary.vertices[0];
    for (std::size_t v = 0; v < scene.rotating.vertices.size(); ++v) {
      const Vec3 p = scene.rotating.vertices[v], centre = scene.rotating.vertices[1];
      scene.rotating.vertices.set(v, 0.9 * c + 0.1 * centre + 0.2 * (p - centre));
    }
    const TriMesh rotating = in_axis_frame(scene.axis, scene.rotating);
    const TriMesh stationary = in_axis_frame(scene.axis, scene.stationary);
    const bool inside = test::winding_number(stationary, rotating.vertices[0]).winding > 0 ||
                        test::winding_number(rotating, stationary.vertices[0]).winding > 0;
    const bool touching = brute_contact_at(scene, 0);
    const auto found = limits(scene).positive;
    RC_ASSERT((found.reason == LimitReason::contact_at_start) == (inside || touching));
    if (found.reason == LimitReason::contact_at_start) RC_ASSERT(found.contact.has_value() == touching);
  }
}

RC_GTEST_PROP(FirstContactRandom, ExchangingTheBodiesNegatesAndAgrees, ()) {
  auto random = random_by_rapidcheck();
  for (int i = 0; i < 20; ++i) {
    const RotationScene scene = random_scene(random);
    const auto one = limits(scene), other = limits(exchanged(scene));
    const auto expect_same = [](const Limit& a, const Limit& b) {
      RC_ASSERT(a.reason == b.reason);
      RC_ASSERT(std::abs(a.turned.radians() - b.turned.radians()) <=
                a.error_bound.radians() + b.error_bound.radians());
      if (a.reason == LimitReason::contact) {
        RC_ASSERT((a.contact->mobile_point - b.contact->fixed_point).norm() <= 1e-9);
        RC_ASSERT((a.contact->fixed_point - b.contact->mobile_point).norm() <= 1e-9);
      }
    };
    expect_same(one.positive, other.negative);
    expect_same(one.negative, other.positive);
  }
}

RC_GTEST_PROP(FirstContactRandom, SplittingEveryTriangleInPlaceChangesNothing, ()) {
  auto random = random_by_rapidcheck();
  for (int i = 0; i < 5; ++i) {
    const RotationScene scene = random_scene(random);
    const RotationScene finer{split_in_four(split_in_four(scene.rotating)), split_in_four(scene.stationary),
                              scene.axis};
    const auto coarse = limits(scene), fine = limits(finer);
    for (const auto& [a, b] :
         {std::pair{coarse.positive, fine.positive}, std::pair{coarse.negative, fine.negative}}) {
      RC_ASSERT(a.reason == b.reason);
      RC_ASSERT(std::abs(a.turned.radians() - b.turned.radians()) <= 1e-9);
    }
  }
}

RC_GTEST_PROP(FirstContactRandom, TouchesAtOnePointOfBothBodies, ()) {
  auto random = random_by_rapidcheck();
  for (int i = 0; i < 10; ++i) {
    const RotationScene scene = moved(Pose(Eigen::Translation3d(1, 2, 3)), random_scene(random));
    const auto found = limits(scene);
    for (const auto& [limit, sense] : {std::pair{found.negative, RotationSense::negative},
                                       std::pair{found.positive, RotationSense::positive}}) {
      if (limit.reason != LimitReason::contact) continue;
      const double angle = sign_of(sense) * limit.turned.radians();
      const Pose rotation(Eigen::Translation3d(scene.axis.point()) *
                          Eigen::AngleAxisd(angle, scene.axis.direction()) *
                          Eigen::Translation3d(-scene.axis.point()));
      RC_ASSERT((rotation * limit.contact->mobile_point - limit.contact->fixed_point).norm() <= 1e-9);
    }
  }
}

/// Scenes that the properties above compare: some end in contact, some start in it, and some are free.
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
}  // namespace condyle::motion
