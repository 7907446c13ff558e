#include "condyle/mesh.hpp"

#include <type_traits>

#include "support/test.hpp"

namespace condyle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TriMesh small_box() {
  return test::box({0, 0, 0}, {1, 1, 1});
}

/// Message of the constructor for arrays that it refuses, or "accepted".
std::string refusal_of(TriMesh arrays) {
  return test::complaint_of<MeshError>([&] { Mesh{std::move(arrays)}; });
}

TEST(Mesh, TakesArraysAsTheyAre) {
  const TriMesh arrays = small_box();
  const Mesh mesh = arrays;
  EXPECT_EQ(mesh.arrays(), arrays);
  EXPECT_EQ(mesh.corner(3, 2), arrays.corner(3, 2));
  EXPECT_EQ(refusal_of({}), "accepted");
}

TEST(Mesh, ACopySharesTheArrays) {
  const Mesh mesh = small_box(), copy = mesh;
  EXPECT_EQ(&copy.vertices(), &mesh.vertices());
}

TEST(Mesh, AVertexNumberOutOfRangeIsRefusedNamingTheFirstTriangle) {
  for (const Index number : {Index{8}, Index{1000}, no_index}) {
    TriMesh arrays = small_box();
    arrays.triangles[7][1] = arrays.triangles[9][0] = number;
    EXPECT_EQ(refusal_of(arrays), "triangle 7 uses vertex " + std::to_string(number) + " of 8");
  }
  EXPECT_EQ(refusal_of({Points(), {{0, 0, 0}}}), "triangle 0 uses vertex 0 of 0");
}

TEST(Mesh, ACoordinateThatIsNotFiniteIsRefusedNamingTheFirstVertex) {
  for (const double value : {nan, -nan, infinity, -infinity}) {
    for (const auto coordinate : {&Points::x, &Points::y, &Points::z}) {
      TriMesh arrays = small_box();
      (arrays.vertices.*coordinate)[5] = (arrays.vertices.*coordinate)[6] = value;
      EXPECT_EQ(refusal_of(arrays), "vertex 5 has a coordinate that is not finite");
    }
  }
  TriMesh arrays = small_box();
  arrays.vertices.x[2] = infinity, arrays.vertices.y[2] = -infinity;
  EXPECT_EQ(refusal_of(arrays), "vertex 2 has a coordinate that is not finite");
}

TEST(Mesh, CoordinatesAreAtMostTheLargestThatIsComputedWith) {
  constexpr double largest = 1e30;
  TriMesh arrays = small_box();
  arrays.vertices.set(0, {largest, largest, largest}), arrays.vertices.set(1, {-largest, largest, 0});
  EXPECT_EQ(refusal_of(arrays), "accepted");
  arrays.vertices.y[6] = -std::nextafter(largest, 2 * largest);
  EXPECT_EQ(refusal_of(arrays), "vertex 6 has a coordinate beyond 1e30");
}

TEST(Mesh, ACoordinateMayBeAnyThatIsSmallButNotAllOfThem) {
  TriMesh arrays = small_box();
  arrays.vertices.z[3] = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(refusal_of(arrays), "accepted");
  for (auto* column : {&arrays.vertices.x, &arrays.vertices.y, &arrays.vertices.z})
    std::fill(column->begin(), column->end(), 0);
  EXPECT_EQ(refusal_of(arrays), "accepted");
  arrays.vertices.x[4] = -std::nextafter(1e-30, 0);
  EXPECT_EQ(refusal_of(arrays), "the mesh is smaller than 1e-30, too small to compute with");
  arrays.vertices.x[4] = -1e-30;
  EXPECT_EQ(refusal_of(arrays), "accepted");
}

TEST(Mesh, CoordinatesOfDifferentNumberAreRefused) {
  for (const auto coordinate : {&Points::x, &Points::y, &Points::z}) {
    TriMesh more = small_box(), fewer = small_box();
    (more.vertices.*coordinate).push_back(0), (fewer.vertices.*coordinate).pop_back();
    test::expect_says(refusal_of(more), "not as many of each");
    test::expect_says(refusal_of(fewer), "not as many of each");
  }
  TriMesh arrays = small_box();
  arrays.vertices.y.pop_back();
  EXPECT_EQ(refusal_of(arrays), "coordinates are 8 x, 7 y and 8 z, not as many of each");
}

TEST(Mesh, KnowsWhetherItIsClosed) {
  const Mesh closed = small_box();
  EXPECT_TRUE(closed.is_closed());
  EXPECT_FALSE(closed.unbalanced_edge());
  TriMesh arrays = small_box();
  const Triangle dropped = arrays.triangles[4];
  arrays.triangles.erase(arrays.triangles.begin() + 4);
  const Mesh open = arrays;
  EXPECT_FALSE(open.is_closed());
  ASSERT_TRUE(open.unbalanced_edge());
  const auto edge = *open.unbalanced_edge();
  const auto is_of_the_hole = [&](std::size_t k) {
    return dropped[k] == edge.to && dropped[(k + 1) % 3] == edge.from;
  };
  EXPECT_TRUE(is_of_the_hole(0) || is_of_the_hole(1) || is_of_the_hole(2)) << edge.from << " to " << edge.to;
}

// A Mesh is made from arrays by checking them, from nothing else, and its arrays are never written to again.
static_assert(!std::is_default_constructible_v<Mesh>);
static_assert(std::is_same_v<decltype(std::declval<Mesh&>().arrays()), const TriMesh&>);
static_assert(std::is_same_v<decltype(std::declval<Mesh&>().vertices()), const Points&>);
static_assert(std::is_same_v<decltype(std::declval<Mesh&>().triangles()), const std::vector<Triangle>&>);
static_assert(!std::is_convertible_v<Mesh&, TriMesh&>);

TEST(Mesh, MovedToOtherVerticesStaysClosedOrOpen) {
  const Mesh closed(test::sphere({1, 2, 3}, 24, 2));
  TriMesh open_arrays = closed;
  open_arrays.triangles.pop_back();
  const Mesh open = open_arrays;
  const Points shifted = posed(Pose(Eigen::Translation3d(1, 2, 3)), closed.vertices().view());
  EXPECT_TRUE(closed.moved_to(shifted).is_closed());
  EXPECT_EQ(open.moved_to(shifted).unbalanced_edge(), open.unbalanced_edge());
  EXPECT_EQ(closed.moved_to(shifted).arrays(), (TriMesh{shifted, closed.triangles()}));
  EXPECT_THROW(closed.moved_to({}), MeshError);
  Points infinite = shifted;
  infinite.x[2] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(closed.moved_to(infinite), MeshError);
}

}  // namespace
}  // namespace condyle
