#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "io/result/contour_fill.hpp"

namespace condyle::test {
namespace {

using namespace io;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A field that owns its numbers.
struct Field {
  std::vector<double> x, y, values;
  operator io::GridField() const { return {x, y, values}; }
};

/// Points low, low + h, ... over a square of `cells` cells a side.
template <class F>
Field sampled(double low, double h, int cells, const F& f) {
  Field field;
  for (int i = 0; i <= cells; ++i) field.x.push_back(low + h * i);
  field.y = field.x;
  for (const double y : field.y)
    for (const double x : field.x) field.values.push_back(f(x, y));
  return field;
}

/// Positive counter-clockwise with y up.
double signed_area(std::span<const ScreenPoint> ring) {
  // About the first point, so that a ring far from the origin keeps its digits.
  double twice = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    twice += (ring[i].x - ring[0].x) * (ring[i + 1].y - ring[0].y) -
             (ring[i].y - ring[0].y) * (ring[i + 1].x - ring[0].x);
  return twice / 2;
}

double area(const io::ContourRegion& region) {
  double sum = 0;
  for (const Ring& ring : region.rings) sum += signed_area(ring);
  return sum;
}

double length(const io::ContourRegion& region) {
  double sum = 0;
  for (const Ring& line : region.lines)
    for (std::size_t i = 1; i < line.size(); ++i)
      sum += std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y);
  return sum;
}

/// Area of the part at or above the level of a triangle with corners at a, b, c: by proportion, without
/// walking around it.
double part_above(std::array<double, 3> value, double triangle_area, double level) {
  std::sort(value.begin(), value.end());
  const auto [low, middle, high] = value;
  if (level <= low) return triangle_area;
  if (level > high) return 0;
  // A corner cut off by a level line is similar in two sides to the whole.
  if (level > middle)
    return triangle_area * ((high - level) / (high - low)) * ((high - level) / (high - middle));
  return triangle_area * (1 - ((level - low) / (high - low)) * ((level - low) / (middle - low)));
}

/// The plain definition: triangles of all cells one by one.
double plain_area(const io::GridField& field, double level) {
  double sum = 0;
  const std::size_t columns = field.x.size();
  for (std::size_t j = 0; j + 1 < field.y.size(); ++j) {
    for (std::size_t i = 0; i + 1 < columns; ++i) {
      const double cell = (field.x[i + 1] - field.x[i]) * (field.y[j + 1] - field.y[j]);
      const std::array corner{field.values[j * columns + i], field.values[j * columns + i + 1],
                              field.values[(j + 1) * columns + i + 1], field.values[(j + 1) * columns + i]};
      std::vector<double> known;
      for (const double value : corner)
        if (!std::isnan(value)) known.push_back(value);
      if (known.size() == 4) {
        const double middle = ((corner[0] + corner[2]) + (corner[1] + corner[3])) / 4;
        for (std::size_t k = 0; k < 4; ++k)
          sum += part_above({corner[k], corner[(k + 1) % 4], middle}, cell / 4, level);
      } else if (known.size() == 3) {
        sum += part_above({known[0], known[1], known[2]}, cell / 2, level);
      }
    }
  }
  return sum;
}

// Every coordinate and area below is rounded some ten times per cell, at magnitudes of a few units.
double rounding(const Field& field) {
  return static_cast<double>(field.values.size()) * 100 * std::numeric_limits<double>::epsilon();
}

TEST(ContourFill, A_plane_is_cut_exactly_along_its_level_line) {
  // f = x + 2 y on [0, 1]^2 is at or above 1 where y >= (1 - x) / 2: all but a triangle with sides 1 and 1/2.
  const Field plane = sampled(0, 0.125, 8, [](double x, double y) { return x + 2 * y; });
  const io::ContourRegion region = io::region_at_or_above(plane, 1);
  ASSERT_EQ(region.rings.size(), 1u);
  EXPECT_NEAR(area(region), 1 - 0.25, rounding(plane));
  ASSERT_EQ(region.lines.size(), 1u);
  EXPECT_NEAR(length(region), std::hypot(1, 0.5), rounding(plane));
}

TEST(ContourFill, A_cone_is_cut_in_its_circle_as_well_as_linear_pieces_can) {
  // f = R - r, cut at 0. Where r >= R - h the second derivative is at most 1 / (R - h) = M. Taking the middle
  // of a cell of side h as the mean of its corners errs by at most (h / sqrt 2)^2 M / 2, interpolating in a
  // triangle with h as its longest side and a right angle by at most (h / 2)^2 M / 2: together e. The slope
  // is 1, so the outline is between the circles of R - e and R + e.
  constexpr double R = 1;
  for (const int cells : {10, 20, 40, 80}) {
    const double h = 3.0 / cells, e = (h * h / 4 + h * h / 8) / (R - h);
    const Field cone = sampled(-1.5, h, cells, [](double x, double y) { return R - std::hypot(x, y); });
    const io::ContourRegion region = io::region_at_or_above(cone, 0);
    ASSERT_EQ(region.rings.size(), 1u);
    EXPECT_GE(area(region), std::numbers::pi * (R - e) * (R - e));
    EXPECT_LE(area(region), std::numbers::pi * (R + e) * (R + e));
    for (const ScreenPoint& p : region.rings[0]) EXPECT_NEAR(std::hypot(p.x, p.y), R, e);
    ASSERT_EQ(region.lines.size(), 1u);
    EXPECT_EQ(region.lines[0].front(), region.lines[0].back());
  }
}

TEST(ContourFill, A_pit_is_a_hole_with_the_opposite_turn) {
  const Field pit = sampled(-1.5, 0.1, 30, [](double x, double y) { return std::hypot(x, y); });
  const io::ContourRegion region = io::region_at_or_above(pit, 1);
  ASSERT_EQ(region.rings.size(), 2u);
  const double a = signed_area(region.rings[0]), b = signed_area(region.rings[1]);
  EXPECT_NEAR(std::max(a, b), 9, rounding(pit));
  EXPECT_LT(std::min(a, b), -3);
}

TEST(ContourFill, A_saddle_is_joined_below_its_mean_and_parted_above_it) {
  // Corners 1 0 / 0 1 (high on one diagonal): the middle is 1/2.
  const Field saddle{{0, 1}, {0, 1}, {1, 0, 0, 1}};
  EXPECT_EQ(io::region_at_or_above(saddle, 0.4).rings.size(), 1u);
  EXPECT_EQ(io::region_at_or_above(saddle, 0.6).rings.size(), 2u);
  // At 0.6 each high corner keeps, of both triangles beside it, the similar part 0.4 x 0.8 of area 1/4.
  EXPECT_NEAR(area(io::region_at_or_above(saddle, 0.6)), 4 * 0.25 * 0.4 * 0.8, rounding(saddle));
  // Turning the levels around exchanges high and low.
  EXPECT_NEAR(area(io::region_at_or_above(saddle, 0.4)) + area(io::region_at_or_above(saddle, 0.6)), 1,
              rounding(saddle));
}

TEST(ContourFill, A_value_equal_to_the_level_counts_as_above) {
  const Field level = sampled(0, 1, 3, [](double, double) { return 20; });
  EXPECT_EQ(area(io::region_at_or_above(level, 20)), 9);
  EXPECT_EQ(io::region_at_or_above(level, 20).rings.size(), 1u);
  EXPECT_EQ(io::region_at_or_above(level, 20).rings[0].size(), 4u);
  EXPECT_TRUE(io::region_at_or_above(level, 20).lines.empty());
  EXPECT_TRUE(io::region_at_or_above(level, std::nextafter(20, 21)).rings.empty());
  // One line of points at the level, the rest below: nothing with an area.
  const Field ridge = sampled(0, 1, 2, [](double x, double) { return x == 1 ? 5 : 0; });
  EXPECT_TRUE(io::region_at_or_above(ridge, 5).rings.empty());
  // Half of the grid at the level: the line between is drawn once.
  const Field step = sampled(0, 1, 2, [](double x, double) { return x >= 1 ? 5 : 0; });
  EXPECT_EQ(area(io::region_at_or_above(step, 5)), 2);
  EXPECT_EQ(length(io::region_at_or_above(step, 5)), 2);
}

TEST(ContourFill, Missing_points_take_their_cells_with_them_but_for_the_opposite_corners) {
  Field field = sampled(0, 1, 4, [](double, double) { return 1; });
  field.values[2 * 5 + 2] = nan;  // in the middle: four cells keep half
  EXPECT_EQ(area(io::region_at_or_above(field, 0)), 16 - 2);
  EXPECT_TRUE(io::region_at_or_above(field, 0).lines.empty());
  field.values[2 * 5 + 3] = nan;  // beside it: two cells lose all, two more keep half
  EXPECT_EQ(area(io::region_at_or_above(field, 0)), 16 - 2 - 2);
  field.values.assign(25, nan);
  EXPECT_TRUE(io::region_at_or_above(field, 0).rings.empty());
}

TEST(ContourFill, One_row_or_no_point_at_all_has_no_area) {
  EXPECT_TRUE(io::region_at_or_above(Field{{0, 1, 2}, {0}, {1, 1, 1}}, 0).rings.empty());
  EXPECT_TRUE(io::region_at_or_above(Field{}, 0).rings.empty());
}

/// Small whole values with gaps: levels through corners and middles, saddles and plateaus are common.
Field random_field() {
  Field field;
  const int columns = *rc::gen::inRange(2, 7), rows = *rc::gen::inRange(2, 7);
  for (int i = 0; i < columns; ++i) field.x.push_back(i * 1.5);
  for (int j = 0; j < rows; ++j) field.y.push_back(10 + j * 0.5);
  for (int i = 0; i < columns * rows; ++i) {
    const int value = *rc::gen::inRange(0, 8);
    field.values.push_back(value == 7 ? nan : value);
  }
  return field;
}

RC_GTEST_PROP(ContourFill, Has_the_area_of_its_triangles_one_by_one, ()) {
  const Field field = random_field();
  for (const double level : {-1.0, 0.0, 0.5, 1.0, 2.25, 3.0, 3.7, 6.0, 7.0})
    RC_ASSERT(std::abs(area(io::region_at_or_above(field, level)) - plain_area(field, level)) <=
              100 * rounding(field));
}

RC_GTEST_PROP(ContourFill, Closes_every_ring_and_walks_no_edge_twice, ()) {
  const Field field = random_field();
  const double level = *rc::gen::elementOf(std::vector<double>{0, 1, 2.5, 3, 4.2});
  using Edge = std::array<double, 4>;
  std::set<Edge> edges;
  for (const Ring& ring : io::region_at_or_above(field, level).rings) {
    RC_ASSERT(ring.size() >= 3u);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const ScreenPoint &a = ring[i], &b = ring[(i + 1) % ring.size()];
      RC_ASSERT(edges.insert(Edge{a.x, a.y, b.x, b.y}).second);
      RC_ASSERT(!edges.contains(Edge{b.x, b.y, a.x, a.y}));
    }
  }
}

}  // namespace
}  // namespace condyle::test
