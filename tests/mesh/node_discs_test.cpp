#include "mesh/node_discs.hpp"

#include "mesh/subdivide.hpp"
#include "mesh/surface_distance.hpp"
#include "support/test.hpp"

namespace condyle::mesh {
namespace {

TEST(NodeDiscs, NoTriangleOfANodeIsNearer) {
  // Without area, and far from the origin, too.
  TriMesh slivers = test::sphere({300, -200, 1e4}, 20, 3);
  for (Index v = 0; v + 2 < slivers.vertices.size(); v += 40) slivers.triangles.push_back({v, v + 2, v});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const TriMesh& mesh : {test::torus(5, 1, 48, 24), test::box({-1, -2, -3}, {1, 2, 3}),
                              test::plane(40, 20), test::socket({1, 2, 3}, 24, 30, 3), slivers}) {
    const TriangleTree tree(mesh);
    const NodeDiscs discs(tree);
    for (const double scale : {1.0, 30.0, 1e3, 1e7})
      for (int i = 0; i < 10; ++i) {
        const Vec3 p = Vec3(mesh.vertices[0]) + scale * Vec3(number(random), number(random), number(random));
        for (Index n = 0; n < tree.nodes().size(); ++n) {
          double least = std::numeric_limits<double>::infinity();
          for (Index t = tree.nodes()[n].first; t < tree.nodes()[n].last; ++t)
            least = std::min(least, distance_to_triangle(p, tree.corners(t)));
          EXPECT_LE(discs.squared_distance(p, n), least * least) << "node " << n << ", scale " << scale;
        }
      }
  }
}

TEST(NodeDiscs, AsManyLeavesOfAFineMeshAsOfACoarseOneAreAsNearAsItsSurface) {
  // A bone's curvature, seen from far: by boxes alone their number doubles with each split into four.
  TriMesh mesh = test::torus(30, 10, 96, 48);
  const Vec3 p(90, -40, 30);
  const auto near_leaves = [&] {
    const TriangleTree tree(mesh);
    const NodeDiscs discs(tree);
    const double distance = distance_to_surface(tree, p);
    std::size_t near = 0;
    for (Index n = 0; n < tree.nodes().size(); ++n)
      near += tree.nodes()[n].is_leaf() && discs.squared_distance(p, n) <= distance * distance;
    return near;
  };
  const std::size_t coarse = near_leaves();
  mesh = subdivided(subdivided(mesh));
  EXPECT_LE(near_leaves(), 2 * coarse);
}

TEST(DistancesToSurface, AreThoseOfEachPointWhateverTheyBeginWith) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> number(-1, 1);
  // The last is fine enough for discs.
  for (const TriMesh& mesh :
       {test::torus(5, 1, 48, 24), test::sphere({3, 4, 5}, 6, 4), test::torus(5, 1, 500, 200)}) {
    const TriangleTree tree(mesh);
    const DistancesToSurface distance(tree);
    Index nearest = no_index;
    for (const double scale : {1.0, 5.0, 7.0, 1e3, 1e9})
      for (int i = 0; i < 100; ++i) {
        const Vec3 p = scale * Vec3(number(random), number(random), number(random));
        const double found = distance(p, nearest);
        EXPECT_EQ(found, distance_to_surface(tree, p));
        EXPECT_EQ(found, distance_to_triangle(p, tree.corners(nearest)));
      }
  }
}

}  // namespace
}  // namespace condyle::mesh
