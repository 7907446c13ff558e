#include "methods/layers.hpp"

#include "methods/depth_raster.hpp"
#include "methods/sphere_raster.hpp"
#include "support/test.hpp"

namespace bench {
namespace {

using condyle::Index;
using condyle::TriMesh;

constexpr double all = std::numeric_limits<double>::infinity();

/// Every line enters as often as it leaves, in turn.
void expect_closed(const LayeredImage& image) {
  for (Index cell = 0; cell < image.cells(); ++cell) {
    const auto layers = image.at(cell);
    ASSERT_EQ(layers.size() % 2, 0u) << "cell " << cell;
    for (std::size_t i = 0; i < layers.size(); ++i) ASSERT_EQ(layers[i].step, i % 2 == 0 ? 1 : -1);
  }
}

TEST(DepthRaster, EveryPixelOverABoxEntersAndLeavesIt) {
  const TriMesh box = condyle::test::box({1, 2, 3}, {5, 7, 9});
  DepthRaster raster;
  LayeredImage image;
  for (int axis = 0; axis < 3; ++axis) {
    ImagePlane plane{axis, {0, 0}, {0.5, 0.5}, {20, 20}};
    const condyle::Vec3 low(1, 2, 3), high(5, 7, 9);
    raster.draw(box.vertices, box.triangles, plane, all, image);
    expect_closed(image);
    for (int j = 0; j < 20; ++j) {
      for (int i = 0; i < 20; ++i) {
        const double u = 0.5 * i + 0.25, v = 0.5 * j + 0.25;
        const bool is_over = u > low[plane.column_axis()] && u < high[plane.column_axis()] &&
                             v > low[plane.row_axis()] && v < high[plane.row_axis()];
        const auto layers = image.at(plane.cell(i, j));
        ASSERT_EQ(layers.size(), is_over ? 2u : 0u);
        if (!is_over) continue;
        EXPECT_FLOAT_EQ(layers[0].position, static_cast<float>(low[axis]));
        EXPECT_FLOAT_EQ(layers[1].position, static_cast<float>(high[axis]));
      }
    }
  }
}

TEST(DepthRaster, LinesThroughEdgesAndVerticesAreCountedOnce) {
  // The middles of pixels lie on the diagonals of the box's faces and on the octahedron's edges and vertices.
  const ImagePlane plane{2, {-4.5, -4.5}, {1, 1}, {9, 9}};
  DepthRaster raster;
  LayeredImage image;
  for (const TriMesh& mesh :
       {condyle::test::box({-3, -3, -3}, {3, 3, 3}), condyle::test::sphere({0, 0, 0}, 4, 0),
        condyle::test::sphere({0, 0, 0}, 4, 2)}) {
    raster.draw(mesh.vertices, mesh.triangles, plane, all, image);
    expect_closed(image);
    EXPECT_EQ(image.at(plane.cell(4, 4)).size(), 2u);
  }
}

TEST(DepthRaster, WhatLiesBehindIsLeftOut) {
  const TriMesh boxes = condyle::test::joined(condyle::test::box({0, 0, 0}, {2, 2, 2}),
                                              condyle::test::box({0, 0, 5}, {2, 2, 7}));
  const ImagePlane plane{2, {0, 0}, {1, 1}, {2, 2}};
  DepthRaster raster;
  LayeredImage image;
  raster.draw(boxes.vertices, boxes.triangles, plane, 3, image);
  EXPECT_EQ(image.at(0).size(), 2u);
  raster.draw(boxes.vertices, boxes.triangles, plane, all, image);
  EXPECT_EQ(image.at(0).size(), 4u);
  EXPECT_EQ(winding_at(image.at(0), 1), 1);
  EXPECT_EQ(winding_at(image.at(0), 3), 0);
  EXPECT_EQ(winding_at(image.at(0), 6), 1);
}

TEST(SphereRaster, EveryRayLeavesABallAboutTheCentreOnceAtItsRadius) {
  constexpr double radius = 25;
  const TriMesh ball = condyle::test::sphere({0, 0, 0}, radius, 3);
  double longest = 0;
  for (std::size_t t = 0; t < ball.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, (ball.corner(t, k) - ball.corner(t, (k + 1) % 3)).norm());
  // A triangle's circumradius is at most its longest edge over sqrt 3: so deep it lies inside the sphere.
  const double sag = longest * longest / (6 * radius) * (1 + longest / radius);
  LayeredImage image;
  // Odd, so that rays go through the octahedron's vertices and edges; even, so that none does.
  for (const int cells : {31, 32}) {
    draw_on_sphere(ball.vertices, ball.triangles, cells, image);
    ASSERT_EQ(image.cells(), static_cast<std::size_t>(6 * cells * cells));
    for (Index cell = 0; cell < image.cells(); ++cell) {
      ASSERT_EQ(image.at(cell).size(), 1u) << "cell " << cell;
      const Layer layer = image.at(cell)[0];
      EXPECT_EQ(layer.step, -1);
      EXPECT_LE(layer.position, radius * (1 + 1e-6));
      EXPECT_GE(layer.position, radius - sag);
    }
  }
}

TEST(SphereRaster, ABodyBesideTheCentreIsEnteredAndLeftOnEveryRay) {
  // The last one reaches round the centre, behind the planes of most faces.
  for (const TriMesh& mesh :
       {condyle::test::box({5, -30, -30}, {9, 30, 30}), condyle::test::socket({0, 0, 0}, 25, 30, 3),
        condyle::test::torus(30, 8, 24, 12)}) {
    LayeredImage image;
    draw_on_sphere(mesh.vertices, mesh.triangles, 31, image);
    expect_closed(image);
    EXPECT_GT(image.layers(), 0u);
  }
}

}  // namespace
}  // namespace bench
