#include "condyle/answer.hpp"
#include "contact/body_pair.hpp"
#include "core/rotation_about.hpp"
#include "core/trigonometry.hpp"
#include "mesh/subdivide.hpp"
#include "motion/search/translation_contacts.hpp"
#include "support/random_pose.hpp"
#include "support/test.hpp"

/// Two meshes without a joint: how far one turns or slides, against closed forms, sampling and exact tests beside every end.

namespace condyle::test {
namespace {

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
      // Within its bound and the rounding of the input: six roundings turn a coordinate of up to 31 mm, less than 2e-14 on each body.
      constexpr double corners_mm = 1e-13;
      const auto& [first, last] = std::pair(free.positive, free.intervals[1].low);
      EXPECT_NEAR(*first.at_mm, 20, first.error_bound_mm + corners_mm) << k;
      EXPECT_NEAR(*last.at_mm, 31, last.error_bound_mm + corners_mm) << k;
      EXPECT_LT(first.error_bound_mm, 2e-12) << k;
      EXPECT_LT(last.error_bound_mm, 2e-12) << k;
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

}  // namespace
}  // namespace condyle::test
