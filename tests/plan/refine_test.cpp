#include "plan/refine.hpp"

#include <cstddef>

#include "mesh/edge_table.hpp"
#include "support/test.hpp"

/// Smaller triangles around a cut, counted before they are made.

namespace condyle::test {
namespace {

Body body_of(TriMesh mesh) {
  return {.name = "bone", .mesh = Mesh(std::move(mesh))};
}

std::vector<std::uint8_t> all(const TriMesh& pieces, const std::vector<Index>&,
                              const std::vector<std::uint8_t>&) {
  return std::vector<std::uint8_t>(pieces.triangles.size(), 1);
}

/// Two triangles of each face: a side of 2 and a diagonal. Halving all twice makes 16 of each.
const Body& cube() {
  static const Body body = body_of(box({-1, -1, -1}, {1, 1, 1}));
  return body;
}

TEST(Refined, MakesNoMoreTrianglesThanItMay) {
  const std::size_t added = 12 * 16 - 12;
  const auto made = plan::refined(cube(), all, 0.75, added);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->body.mesh.triangles().size(), 12 * 16U);
  EXPECT_FALSE(plan::refined(cube(), all, 0.75, added - 1));
}

// 10^13 triangles of a thousandth of a micrometre.
TEST(Refined, CountsTrianglesBeforeItMakesThem) {
  EXPECT_FALSE(plan::refined(cube(), all, 1e-6, 100'000));
}

TEST(Refined, SplitsWhereItIsSaidUpToTheirNumber) {
  const mesh::EdgeTable edges(cube().mesh);
  std::vector<double> shares(edges.size(), 0);
  shares[3] = 0.25;
  const auto made = plan::split_at(cube(), shares, 14);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->refined.body.mesh.triangles().size(), 14U);
  EXPECT_FALSE(plan::split_at(cube(), shares, 13));
}

/// A fan whose spokes grow, its triangles from the longest spokes to the shortest: halving the first spoke halves the longest side of each
/// triangle after it, one by one.
TEST(Refined, HalvesTheLongestSidesOfALongRowOfTrianglesInOneGo) {
  constexpr Index count = 200'000;
  TriMesh fan;
  fan.vertices.push_back(Vec3::Zero());
  for (Index i = 0; i <= count; ++i) {
    const double angle = 6.0 * i / count, radius = 1 + 1e-6 * i;
    fan.vertices.push_back(Vec3(radius * std::cos(angle), radius * std::sin(angle), 0));
  }
  for (Index i = count; i > 0; --i) fan.triangles.push_back({0, i, i + 1});
  const Body body = body_of(std::move(fan));
  bool is_first = true;
  const auto made = plan::refined(
      body,
      [&](const TriMesh& pieces, const std::vector<Index>&, const std::vector<std::uint8_t>&) {
        std::vector<std::uint8_t> marks(pieces.triangles.size(), 0);
        if (std::exchange(is_first, false)) marks.back() = 1;
        return marks;
      },
      0.9, 10 * count);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->body.mesh.triangles().size(), 3 * count);
}

}  // namespace
}  // namespace condyle::test
