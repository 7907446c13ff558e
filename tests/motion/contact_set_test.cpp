#include "motion/search/contact_set.hpp"

#include <rapidcheck/gtest.h>

#include "core/thread_limit.hpp"
#include "motion/rotation_scenes.hpp"
#include "support/test.hpp"

namespace condyle::motion {
namespace {

using namespace test;
using std::numbers::pi;

core::ArcSet contact_set_of(const RotationScene& scene) {
  const FeatureTree stationary(scene.stationary), rotating(scene.rotating);
  RotatingBody at_rest(stationary), moving(rotating);
  at_rest.start_at(scene.axis, Pose::Identity());
  moving.start_at(scene.axis, Pose::Identity());
  const core::ArcSet found = motion::contact_set(at_rest, moving);
  EXPECT_EQ(motion::contact_set(RotationTable(stationary, scene.axis), moving), found)
      << "the same features, all made ready before";
  return found;
}

std::vector<RotationScene> everywhere(const RotationScene& scene) {
  std::mt19937 random(2);
  return {scene, moved(far_away(random), scene), moved(far_away(random), scene)};
}

constexpr int teeth = 12;
constexpr double pitch = two_pi / teeth;
/// Fraction of the pitch a tooth takes, of the wheel and of the ring, and where the ring's teeth begin.
constexpr double wheel_tooth = 0.25, ring_tooth = 0.3, ring_start = 0.45;

/// Corners of a toothed outline: in each pitch from `start` for `fraction` of it at radius `tooth`, the rest at
/// `gap`.
std::vector<Eigen::Vector2d> toothed(double start, double fraction, double tooth, double gap) {
  std::vector<Eigen::Vector2d> outline;
  const auto corner = [&](double pitches, double radius) {
    outline.emplace_back(radius * std::cos(pitches * pitch), radius * std::sin(pitches * pitch));
  };
  for (int i = 0; i < teeth; ++i) {
    corner(i + start, gap), corner(i + start, tooth);
    corner(i + start + fraction, tooth), corner(i + start + fraction, gap);
  }
  return outline;
}

/// Closed ring between an outline and the same outline scaled up.
TriMesh ring(const std::vector<Eigen::Vector2d>& inner, double radius, double low, double high) {
  const auto n = static_cast<Index>(inner.size());
  TriMesh mesh;
  for (const double z : {low, high}) {
    for (const auto& p : inner) mesh.vertices.push_back({p.x(), p.y(), z});
    for (const auto& p : inner) {
      const Eigen::Vector2d q = radius * p.normalized();
      mesh.vertices.push_back({q.x(), q.y(), z});
    }
  }
  const auto number = [n](Index i, Index outer, Index top) { return (2 * top + outer) * n + i % n; };
  for (Index i = 0; i < n; ++i) {
    const auto quad = [&](Index a, Index b, Index c, Index d) {
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    };
    quad(number(i, 0, 0), number(i, 0, 1), number(i + 1, 0, 1), number(i + 1, 0, 0));
    quad(number(i, 1, 0), number(i + 1, 1, 0), number(i + 1, 1, 1), number(i, 1, 1));
    quad(number(i, 0, 1), number(i, 1, 1), number(i + 1, 1, 1), number(i + 1, 0, 1));
    quad(number(i, 0, 0), number(i + 1, 0, 0), number(i + 1, 1, 0), number(i, 1, 0));
  }
  return mesh;
}

/// The wheel's teeth reach to 3, the ring's from outside to 2.5; tips and bottoms pass one another.
RotationScene wheel_in_ring() {
  return {prism(toothed(0, wheel_tooth, 3, 2), 0, 1),
          ring(toothed(ring_start, ring_tooth, 2.5, 4), 6, -1, 2)};
}

TEST(ToothedWheel, InAToothedRingTouchesOncePerToothWhereTheAnglesSay) {
  for (const RotationScene& scene : everywhere(wheel_in_ring())) {
    const auto arcs = contact_set_of(scene).arcs();
    ASSERT_EQ(arcs.size(), static_cast<std::size_t>(teeth));
    for (int i = 0; i < teeth; ++i) {
      // The leading side of a tooth reaches the ring's tooth, its trailing side leaves it: side on side,
      // edges and all.
      EXPECT_NEAR(arcs[i].start.radians(), (i + ring_start - wheel_tooth) * pitch, 1e-10);
      EXPECT_NEAR(arcs[i].width.radians(), (wheel_tooth + ring_tooth) * pitch, 2e-10);
    }
  }
}

TEST(ToothedWheel, InAToothedRingTurnsFreelyToEitherEndOfTheGap) {
  for (const RotationScene& scene : everywhere(wheel_in_ring())) {
    const auto found = limits(scene);
    EXPECT_NEAR(found.positive.turned.radians(), (ring_start - wheel_tooth) * pitch, 1e-10);
    EXPECT_NEAR(found.negative.turned.radians(), (1 - ring_start - ring_tooth) * pitch, 1e-10);
  }
}

TEST(BodyOfRevolution, TouchesAtNoAngleOrAtAll) {
  const TriMesh ring_torus = torus(3, 1, 64, 16);
  for (const RotationScene& scene : everywhere({ring_torus, box({4.5, -1, -1}, {6, 1, 1})})) {
    EXPECT_TRUE(contact_set_of(scene).empty());
    EXPECT_TRUE(contact_set_of(exchanged(scene)).empty());
  }
  for (const RotationScene& scene : everywhere({ring_torus, box({3, -1, -3}, {6, 1, 3})})) {
    EXPECT_TRUE(contact_set_of(scene).is_full_turn());
    EXPECT_TRUE(contact_set_of(exchanged(scene)).is_full_turn());
  }
}

TEST(ContactSet, OfABarThroughAHubOnTheAxisIsTheFullTurn) {
  const RotationScene scene{box({-1, -1, -1}, {1, 1, 1}), box({-0.5, -0.5, -3}, {0.5, 0.5, 3})};
  EXPECT_TRUE(contact_set_of(scene).is_full_turn());
}

std::mt19937 any_random() {
  return std::mt19937(*rc::gen::arbitrary<unsigned>());
}

RC_GTEST_PROP(ContactSet, HoldsTheAnglesAtWhichExactTriangleTestsFindContactAndNoOthers, ()) {
  auto random = any_random();
  const RotationScene scene = random_scene(random);
  const core::ArcSet touching = contact_set_of(scene);
  const auto ends = touching.arcs();
  std::uniform_real_distribution<double> any_angle(0, two_pi);
  std::vector<double> angles = {0.0};
  for (int i = 0; i < 10; ++i) angles.push_back(any_angle(random));
  for (const core::Arc& arc : ends) {
    for (const double beside : {-1e-8, 1e-8}) {
      angles.push_back(arc.start.radians() + beside);
      angles.push_back(arc.start.radians() + arc.width.radians() + beside);
    }
  }
  for (const double angle : angles) {
    RC_ASSERT(touching.contains(Angle::radians(angle)) == brute_contact_at(scene, angle));
  }
}

RC_GTEST_PROP(ContactSet, BeginsWhereTheFirstContactIs, ()) {
  auto random = any_random();
  for (int i = 0; i < 10; ++i) {
    const RotationScene scene = random_scene(random);
    const auto found = limits(scene);
    const core::ArcSet touching = contact_set_of(scene);
    if (found.positive.reason == LimitReason::contact_at_start) {
      RC_ASSERT(touching.contains(Angle()) == found.positive.contact.has_value());
    } else if (found.positive.reason == LimitReason::end_of_range) {
      RC_ASSERT(touching.empty());
    } else {
      const auto arcs = touching.arcs();
      RC_ASSERT(std::abs(arcs.front().start.radians() - found.positive.turned.radians()) <= 4e-12);
      const double end = (arcs.back().start + arcs.back().width).radians();
      RC_ASSERT(std::abs(end - two_pi + found.negative.turned.radians()) <= 4e-12);
    }
  }
}

TEST(ContactSet, IsTheSameToTheByteOnOneThreadAndMany) {
  const RotationScene scene{sphere({3, 0, 0}, 1.2, 3),
                            joined(sphere({0, 3, 0.2}, 1, 3), sphere({-3, 0, 1}, 1, 3))};
  const core::ArcSet many = contact_set_of(scene);
  const core::ThreadLimit one_thread(1);
  EXPECT_EQ(contact_set_of(scene), many);
  EXPECT_EQ(many.arcs().size(), 2u);
}

}  // namespace
}  // namespace condyle::motion
