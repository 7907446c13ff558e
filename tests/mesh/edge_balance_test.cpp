#include "mesh/edge_balance.hpp"

#include "mesh/edge_table.hpp"
#include "simd/instruction_set.hpp"
#include "support/parameter_names.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

TEST(EdgeBalance, ClosedMeshesHaveNoUnbalancedEdge) {
  EXPECT_FALSE(mesh::first_unbalanced_edge(test::box({0, 0, 0}, {1, 1, 1})));
  EXPECT_FALSE(mesh::first_unbalanced_edge(test::socket({0, 0, 0}, 1, 2, 2)));
  EXPECT_FALSE(mesh::first_unbalanced_edge(test::flipped(test::torus(2, 1, 5, 5))));
}

TEST(EdgeBalance, TheFirstBoundaryEdgeIsNamedInItsDirection) {
  TriMesh mesh = test::box({0, 0, 0}, {1, 1, 1});
  const Triangle removed = mesh.triangles.back();  // {3, 7, 5}
  mesh.triangles.pop_back();
  const auto edge = mesh::first_unbalanced_edge(mesh);
  ASSERT_TRUE(edge);
  // The other triangles use each edge of the hole once, against the direction of the removed triangle.
  const auto has = [&](Index from, Index to) {
    for (int k = 0; k < 3; ++k) {
      if (removed[k] == from && removed[(k + 1) % 3] == to) return true;
    }
    return false;
  };
  EXPECT_TRUE(has(edge->to, edge->from));
}

TEST(EdgeBalance, AFlippedTriangleIsUnbalanced) {
  TriMesh mesh = test::box({0, 0, 0}, {1, 1, 1});
  std::swap(mesh.triangles[4][0], mesh.triangles[4][1]);
  EXPECT_TRUE(mesh::first_unbalanced_edge(mesh));
}

TEST(EdgeBalance, AnEdgeOfFourTrianglesMayBalance) {
  // Two boxes that share an edge: not a manifold, yet a solid.
  TriMesh two = test::joined(test::box({0, 0, 0}, {1, 1, 1}), test::box({1, 1, 0}, {2, 2, 1}));
  for (auto& triangle : two.triangles) {
    for (auto& v : triangle) {
      if (v == 8) v = 3;
      if (v == 12) v = 7;
    }
  }
  EXPECT_FALSE(mesh::first_unbalanced_edge(two));
}

class EdgeBalanceOn : public testing::TestWithParam<simd::InstructionSet> {
 protected:
  simd::InstructionSetInUse in_use_{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, EdgeBalanceOn, testing::ValuesIn(simd::instruction_sets()),
                         [](const auto& set) { return set.param.name; });

/// Triangles in another order, each from another corner on.
TriMesh shuffled(TriMesh mesh, unsigned seed) {
  std::mt19937 random(seed);
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
  for (Triangle& t : mesh.triangles) std::rotate(t.begin(), t.begin() + random() % 3, t.end());
  return mesh;
}

/// Two cones over one circle: two vertices of many edges.
TriMesh double_cone(Index around) {
  return test::turned_solid({{0, 1}, {1, 0}, {0, -1}}, around);
}

TEST_P(EdgeBalanceOn, OneTriangleTooFewOrTwiceOrTurnedIsFoundAmongMany) {
  const TriMesh torus = test::torus(2, 1, 24, 16);
  for (const TriMesh& closed : {shuffled(torus, 1), shuffled(double_cone(200), 2), torus}) {
    EXPECT_FALSE(mesh::first_unbalanced_edge(closed));
    for (std::size_t i = 0; i < closed.triangles.size(); i += 37) {
      TriMesh mesh = closed;
      std::swap(mesh.triangles[i][0], mesh.triangles[i][1]);
      EXPECT_TRUE(mesh::first_unbalanced_edge(mesh));
      mesh = closed;
      mesh.triangles.push_back(mesh.triangles[i]);
      EXPECT_TRUE(mesh::first_unbalanced_edge(mesh));
      mesh = closed;
      mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(i));
      EXPECT_TRUE(mesh::first_unbalanced_edge(mesh));
    }
  }
}

TEST_P(EdgeBalanceOn, OfManyTrianglesInAnyOrderTheOneThatIsMissingIsFound) {
  // Far more edges than wait at a time.
  const TriMesh torus = test::torus(2, 1, 200, 150);
  for (const TriMesh& closed : {torus, shuffled(torus, 4), shuffled(test::joined(torus, torus), 5)}) {
    EXPECT_FALSE(mesh::first_unbalanced_edge(closed));
    TriMesh mesh = closed;
    const Triangle gone = mesh.triangles.back();
    mesh.triangles.pop_back();
    const auto edge = mesh::first_unbalanced_edge(mesh);
    ASSERT_TRUE(edge);
    int sides = 0;
    for (int k = 0; k < 3; ++k) sides += gone[k] == edge->to && gone[(k + 1) % 3] == edge->from;
    EXPECT_EQ(sides, 1);
  }
}

TEST_P(EdgeBalanceOn, SheetsUsedSeveralTimesCancelAsOftenAsTheyAreUsed) {
  TriMesh mesh = test::torus(2, 1, 60, 50);
  const std::vector<Triangle> once = mesh.triangles;
  for (int copy = 0; copy < 4; ++copy) mesh.triangles.insert(mesh.triangles.end(), once.begin(), once.end());
  mesh = shuffled(mesh, 6);
  EXPECT_FALSE(mesh::first_unbalanced_edge(mesh));
  mesh.triangles.pop_back();
  EXPECT_TRUE(mesh::first_unbalanced_edge(mesh));
}

TEST_P(EdgeBalanceOn, EverySizeOfMeshIsGoneThroughToItsLastTriangle) {
  for (int around = 3; around < 140; ++around) {
    TriMesh mesh = double_cone(static_cast<Index>(around));
    EXPECT_FALSE(mesh::first_unbalanced_edge(mesh)) << around;
    mesh.triangles.pop_back();
    EXPECT_TRUE(mesh::first_unbalanced_edge(mesh)) << around;
  }
}

TEST_P(EdgeBalanceOn, TrianglesThatAreAnEdgeOrAPointChangeNothing) {
  TriMesh mesh = test::torus(2, 1, 24, 16);
  for (Index v = 0; v < 60; ++v) {
    mesh.triangles.push_back({v, v, v});
    mesh.triangles.push_back({v, v, v + 1});
  }
  EXPECT_FALSE(mesh::first_unbalanced_edge(shuffled(mesh, 3)));
}

/// Boundaries of some tetrahedra over few vertices, which cancel and pile up in edges of many triangles: closed,
/// but for what `spoil` of the triangles has done to it.
TriMesh random_chain(std::mt19937& random, int spoilt) {
  TriMesh mesh;
  mesh.vertices = Points(9);
  const auto any_vertex = [&] { return static_cast<Index>(random() % mesh.vertices.size()); };
  const auto tetrahedra = 1 + random() % 12;
  for (std::size_t i = 0; i < tetrahedra; ++i) {
    const Index a = any_vertex(), b = any_vertex(), c = any_vertex(), d = any_vertex();
    mesh.triangles.insert(mesh.triangles.end(), {{a, c, b}, {a, b, d}, {b, c, d}, {c, a, d}});
  }
  for (int i = 0; i < spoilt; ++i) {
    Triangle& t = mesh.triangles[random() % mesh.triangles.size()];
    if (random() % 2 == 0) {
      std::swap(t[0], t[1]);
    } else {
      t[2] = any_vertex();
    }
  }
  return mesh;
}

TEST_P(EdgeBalanceOn, TheDoorAndTheEdgeTableAgreeOnEveryChain) {
  std::mt19937 random(11);
  int closed = 0, open = 0;
  for (int i = 0; i < 3000; ++i) {
    const int spoilt = static_cast<int>(random() % 3);
    const TriMesh mesh = shuffled(random_chain(random, spoilt), static_cast<unsigned>(i));
    const auto edge = mesh::first_unbalanced_edge(mesh);
    EXPECT_EQ(edge, mesh::EdgeTable(mesh).unbalanced_edge(mesh));
    EXPECT_EQ(Mesh(mesh).unbalanced_edge(), edge);
    EXPECT_TRUE(spoilt > 0 || !edge);
    ++(edge ? open : closed);
  }
  EXPECT_GT(closed, 1000);
  EXPECT_GT(open, 1000);
}

}  // namespace
}  // namespace condyle
