#include "sample/field.hpp"

#include "sample/cartilage_shape.hpp"
#include "sample/femur_shape.hpp"
#include "sample/hip_bone_shape.hpp"
#include "sample/projection.hpp"
#include "sample/skeleton.hpp"
#include "support/test.hpp"

namespace condyle::sample {
namespace {

const Ball a = {{0, 0, 0}, 3}, b = {{10, 0, 0}, 5}, c = {{2, 9, 1}, 4};

TEST(Field, ABallIsTheDistanceToItsSphere) {
  EXPECT_DOUBLE_EQ(ball(b, Vec3(10, 0, 12)).value, 7);
  EXPECT_EQ(ball(b, Vec3(10, 0, 12)).gradient, Vec3(0, 0, 1));
  EXPECT_EQ(ball(b, b.centre).value, -5);
}

TEST(Field, ABarOfEqualBallsIsTheDistanceToItsCapsule) {
  const Ball end = {{10, 0, 0}, 3};
  EXPECT_DOUBLE_EQ(bar(a, end, Vec3(4, 5, 0)).value, 2);
  EXPECT_DOUBLE_EQ(bar(a, end, Vec3(-3, 4, 0)).value, 2);
  EXPECT_DOUBLE_EQ(bar(a, end, Vec3(13, 0, -4)).value, 2);
}

TEST(Field, APlateIsHalfAsThickAsItsInterpolatedRadius) {
  // Over the centroid of the centres the radius is the mean, and the height is measured at right angles.
  const Vec3 centroid = (a.centre + b.centre + c.centre) / 3;
  const Vec3 normal = (b.centre - a.centre).cross(c.centre - a.centre).normalized();
  EXPECT_NEAR(Plate(a, b, c)(centroid + 6 * normal).value, 2, 1e-12);
  EXPECT_NEAR(Plate(a, b, c)(centroid - 6 * normal).value, 2, 1e-12);
}

TEST(Field, ATubeIsTheDistanceToItsTorus) {
  const Circle circle = {{1, 2, 3}, {0, 0, 1}, 10};
  EXPECT_DOUBLE_EQ(tube(circle, 2, Vec3(14, 2, 7)).value, 3);
  EXPECT_DOUBLE_EQ(tube(circle, 2, Vec3(1, 9, 7)).value, 3);
  EXPECT_DOUBLE_EQ(tube(circle, 2, Vec3(1, -8, 3)).value, -2);
}

TEST(Field, ASeamFillsOnlyWhereTheValuesDifferByLessThanItsWidth) {
  const FieldValue low = {1, Vec3::UnitX()}, high = {4, Vec3::UnitY()};
  EXPECT_EQ(joined(low, high, 3).value, 1);
  EXPECT_EQ(joined(low, high, 3).gradient, Vec3::UnitX());
  EXPECT_EQ(joined(low, low, 8).value, 1 - 8.0 / 4);
  EXPECT_EQ(common(low, high, 3).value, 4);
  EXPECT_EQ(without(low, high, 5).value, 1);  // max(1, -4)
}

/// Central differences err by at most M h^2 / 6 + eps |f| / h, with third derivatives M of order 1 / (1 mm)^2
/// off creases: for h = 1e-5 mm and |f| < 200 mm that is below 1e-8. On a crease the two sides differ: such
/// points are rare, and counted.
void expect_gradient(const Field& field, const Box& box, const std::string& name) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  constexpr double h = 1e-5, tolerance = 1e-8;
  constexpr int points = 2000;
  int on_crease = 0;
  for (int i = 0; i < points; ++i) {
    const Vec3 p = box.low + Vec3(unit(random), unit(random), unit(random)).cwiseProduct(box.high - box.low);
    const Vec3 gradient = field(p).gradient;
    EXPECT_LE(gradient.norm(), std::numbers::sqrt2) << name;
    for (int k = 0; k < 3; ++k) {
      const double slope =
          (field(p + h * Vec3::Unit(k)).value - field(p - h * Vec3::Unit(k)).value) / (2 * h);
      if (std::abs(slope - gradient[k]) > tolerance) ++on_crease;
    }
  }
  EXPECT_LT(on_crease, points / 200) << name;
}

TEST(Field, GradientsAreThoseOfTheValuesAndNowhereSteep) {
  const Box box = {Vec3(-10, -10, -10), Vec3(20, 20, 12)};
  expect_gradient([](const Vec3& p) { return bar(a, b, p); }, box, "bar");
  expect_gradient(Plate(a, b, c), box, "plate");
  const Circle circle = {{1, 2, 3}, Vec3(2, -1, 2) / 3, 10};
  expect_gradient([&](const Vec3& p) { return tube(circle, 2, p); }, box, "tube");
  expect_gradient([](const Vec3& p) { return joined(ball(a, p), ball(b, p), 6); }, box, "joined");
  expect_gradient([](const Vec3& p) { return without(ball(b, p), ball(c, p), 6); }, box, "without");
  const Solid femur = femur_shape({}), hip_bone = hip_bone_shape({});
  expect_gradient(femur.field, femur.box, "femur");
  HipParameters with_cam;
  with_cam.alpha_angle = Angle::degrees(80);
  expect_gradient(femur_shape(with_cam).field, femur.box, "femur with a cam");
  const Cartilage acetabular = acetabular_cartilage_shape({}, {}), femoral = femoral_cartilage_shape({}, {});
  expect_gradient(acetabular.solid.field, acetabular.solid.box, "acetabular cartilage");
  expect_gradient(femoral.solid.field, femoral.solid.box, "femoral cartilage");
  const auto widening = [](const Vec3& p) { return FieldValue{6 + 0.3 * p.y(), 0.3 * Vec3::UnitY()}; };
  expect_gradient([&](const Vec3& p) { return joined(ball(a, p), ball(b, p), widening(p)); }, box,
                  "joined with a widening seam");
  expect_gradient(hip_bone.field, hip_bone.box, "hip bone");
}

TEST(Skeleton, AStraightChainOfEqualBallsIsTheirBar) {
  const std::vector<Ball> balls = {{{0, 0, 0}, 3}, {{4, 0, 0}, 3}, {{10, 0, 0}, 3}};
  const Skeleton chain = Skeleton::chain(balls);
  for (const Vec3& p : {Vec3(5, 7, 0), Vec3(-3, 4, 0), Vec3(12, 1, 1), Vec3(3, 0, -1)}) {
    EXPECT_NEAR(chain(p).value, bar(balls.front(), balls.back(), p).value, 1e-12);
  }
}

TEST(Skeleton, SkippingFarPiecesChangesNothing) {
  // The same sheet one triangle at a time: the union's value is the least of all, whatever was skipped.
  const std::vector<Ball> balls = {a, b, c, {{12, 10, 3}, 2}};
  const std::vector<std::array<Index, 3>> both = {{0, 1, 2}, {1, 3, 2}};
  const Skeleton sheet = Skeleton::sheet(balls, both);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> far(-30, 40);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p(far(random), far(random), far(random));
    // No piece reaches beyond a ball about one of the sheet's balls; the nearest ball bounds the value from
    // above.
    double nearest_ball = std::numeric_limits<double>::infinity();
    for (const Ball& piece : sheet.balls()) nearest_ball = std::min(nearest_ball, ball(piece, p).value);
    EXPECT_LE(sheet(p).value, nearest_ball);
    // A sheet cut three times has edges of at most an eighth of its longest side: no point of it is 2 mm from
    // a ball.
    EXPECT_GE(sheet(p).value, nearest_ball - 2);
  }
}

TEST(Skeleton, UpToALimitItIsWhatItIsWithoutOne) {
  const std::vector<Ball> balls = {a, b, c, {{12, 10, 3}, 2}};
  const std::vector<std::array<Index, 3>> both = {{0, 1, 2}, {1, 3, 2}};
  std::mt19937 random(8);
  std::uniform_real_distribution<double> around(-15, 25);
  int below = 0, skipped = 0;
  for (const Skeleton& skeleton : {Skeleton::sheet(balls, both), Skeleton::chain(balls)}) {
    for (int i = 0; i < 2000; ++i) {
      const Vec3 p(around(random), around(random), around(random));
      const FieldValue whole = skeleton(p), found = skeleton.up_to(10, p);
      if (whole.value <= 10) {
        EXPECT_EQ(found.value, whole.value);
        EXPECT_EQ(found.gradient, whole.gradient);
        ++below;
      } else {
        EXPECT_TRUE(found.value == whole.value || std::isinf(found.value));
        skipped += std::isinf(found.value);
      }
    }
  }
  EXPECT_GT(below, 300);
  EXPECT_GT(skipped, 300);
}

TEST(Field, APlateSaidToBeAboveAValueIs) {
  const Plate plate(a, b, c);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> near(-15, 20), value(-5, 10);
  int above = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 p(near(random), near(random), near(random));
    const double bound = value(random);
    if (!plate.is_above(bound, p)) continue;
    EXPECT_GT(plate(p).value, bound);
    ++above;
  }
  EXPECT_GT(above, 1000);
}

TEST(Projection, LaysPointsOnTheSphereWithinItsTolerance) {
  const Field sphere = [](const Vec3& p) { return ball({Vec3(1, 2, 3), 20}, p); };
  for (const Vec3& p : {Vec3(25, 2, 3), Vec3(1, 2, 4), Vec3(-3, 9, 14)}) {
    const auto [laid, gradient] = laid_on(sphere, p);
    EXPECT_NEAR((laid - Vec3(1, 2, 3)).norm(), 20, laid_tolerance);
    EXPECT_LT((laid - Vec3(1, 2, 3)).cross(p - Vec3(1, 2, 3)).norm(), 1e-9 * 20 * 25);
    EXPECT_EQ(gradient, sphere(laid).gradient);
  }
}

TEST(Projection, LaysPointsOnACreaseWhereStepsAlternate) {
  // Two planes meeting at a sharp inward edge: Newton from the edge's plane jumps between them.
  const Field wedge = [](const Vec3& p) {
    return joined(half_space(Vec3(0.6, 0.8, 0), 0, p), half_space(Vec3(-0.6, 0.8, 0), 0, p), 1e-12);
  };
  EXPECT_LT(std::abs(wedge(laid_on(wedge, Vec3(0, 3, 0)).point).value), laid_tolerance);
  EXPECT_LT(std::abs(wedge(laid_on(wedge, Vec3(1e-3, -3, 0)).point).value), laid_tolerance);
}

TEST(Projection, SaysWhereThereIsNoSurfaceToLayOn) {
  const Field nothing = [](const Vec3&) { return FieldValue{1, Vec3::Zero()}; };
  EXPECT_THROW(laid_on(nothing, Vec3(1, 2, 3)), MeshError);
}

}  // namespace
}  // namespace condyle::sample
