#include "condyle/tangential/circle_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "condyle/mesh/triangle_intersection.hpp"

namespace condyle {
namespace {

struct Counts {
  std::size_t asked = 0, left_out = 0, crossing = 0;
};

/// Against what is decided exactly, one triangle at a time: nothing that crosses or holds is left out, and
/// what is called cut is.
void expect_no_loss(const Circle& circle, const std::vector<TriangleCorners>& triangles, Counts& counts) {
  CircleFilter filter;
  filter.begin(circle);
  for (std::size_t first = 0; first < triangles.size(); first += CircleFilter::width) {
    const std::size_t count = std::min(CircleFilter::width, triangles.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const auto& t = triangles[first + i];
      filter.put(i, {&t[0], &t[1], &t[2]});
    }
    const auto verdict = filter.judge(count);
    EXPECT_EQ((verdict.cut | verdict.may_cross | verdict.may_hold) >> count, 0u);
    for (std::size_t i = 0; i < count; ++i) {
      const auto& t = triangles[first + i];
      std::vector<CircleCrossing> crossings;
      TangentialWork work;
      add_crossings(circle, {&t[0], &t[1], &t[2]}, 0, crossings, work);
      const bool may_cross = verdict.may_cross >> i & 1, may_hold = verdict.may_hold >> i & 1;
      EXPECT_EQ(verdict.cut >> i & 1, work.cut);
      EXPECT_TRUE(may_cross || crossings.empty());
      const bool holds =
          orientation(t[0], t[1], t[2], circle.point) == Sign::zero && contains_coplanar(t, circle.point);
      EXPECT_TRUE(may_hold || !holds);
      ++counts.asked, counts.left_out += !may_cross, counts.crossing += !crossings.empty();
    }
  }
}

Circle circle_of(const Vec3& p, double scale) {
  return {p, p.x() * p.x() + p.y() * p.y(), scale};
}

TEST(CircleFilter, LeavesOutNothingThatMeetsTheCircleOfAnySize) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1), weight(0, 1);
  for (const double scale : {1.0, 300.0, 1e-5, 1e-8, 1e-10, 1e-30, 1e17, 1e25}) {
    Counts counts;
    for (int round = 0; round < 400; ++round) {
      const Vec3 p = 0.5 * scale * Vec3(uniform(random), uniform(random), uniform(random));
      std::vector<TriangleCorners> triangles;
      for (int i = 0; i < 13; ++i) {
        // About a place of the circle, from large to as small as single precision tells no more; a third of
        // them with a corner at its height, or in the point itself.
        const double angle = 3.2 * uniform(random), size = scale * std::exp2(-26 * weight(random));
        const double c = std::cos(angle), s = std::sin(angle);
        const Vec3 at(c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z());
        TriangleCorners t;
        for (Vec3& corner : t) corner = at + size * Vec3(uniform(random), uniform(random), uniform(random));
        if (i % 3 == 0) t[0].z() = p.z();
        if (i % 6 == 0) t[0] = p;
        triangles.push_back(t);
      }
      expect_no_loss(circle_of(p, 2 * scale), triangles, counts);
    }
    EXPECT_GT(counts.crossing, counts.asked / 10) << scale;
    if (scale >= 1 && scale < 1e3) {
      EXPECT_GT(counts.left_out, counts.asked / 3) << scale;
    }
  }
}

/// Heights so small that their squares lose digits in single precision.
TEST(CircleFilter, LeavesOutNothingOfTrianglesThatAreNearlyFlat) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Counts counts;
  for (double flat = 1e-12; flat > 1e-26; flat /= 3) {
    for (int round = 0; round < 40; ++round) {
      std::vector<TriangleCorners> triangles;
      for (int i = 0; i < 16; ++i) {
        TriangleCorners t;
        for (Vec3& p : t) p = {100 * uniform(random), 100 * uniform(random), flat * uniform(random)};
        triangles.push_back(t);
      }
      const Vec3 p(50 * uniform(random), 50 * uniform(random), flat * uniform(random) / 2);
      expect_no_loss(circle_of(p, 100), triangles, counts);
    }
  }
  EXPECT_GT(counts.crossing, 1000u);
}

TEST(CircleFilter, LeavesOutNothingOnALattice) {
  std::mt19937 random(4);
  std::uniform_int_distribution<int> coordinate(-5, 5);
  const auto point = [&] { return Vec3(coordinate(random), coordinate(random), coordinate(random)); };
  Counts counts;
  for (int round = 0; round < 500; ++round) {
    std::vector<TriangleCorners> triangles;
    for (int i = 0; i < 16; ++i) triangles.push_back({point(), point(), point()});
    const Vec3 p = point();
    if (p.x() != 0 || p.y() != 0) expect_no_loss(circle_of(p, 5), triangles, counts);
  }
  EXPECT_GT(counts.crossing, 500u);
  EXPECT_GT(counts.left_out, 1000u);
}

}  // namespace
}  // namespace condyle
