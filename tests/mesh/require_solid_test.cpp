#include "mesh/require_solid.hpp"

#include "mesh/enclosed_volume.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

std::string refusal(const TriMesh& mesh) {
  return test::complaint_of<MeshError>([&] { mesh::require_solid(mesh, "bone.ply"); });
}

TEST(RequireSolid, ASolidAndASolidWithACavityPass) {
  EXPECT_EQ(refusal(test::sphere({0, 0, 0}, 1, 2)), "accepted");
  EXPECT_EQ(
      refusal(test::joined(test::box({-2, -2, -2}, {2, 2, 2}), test::flipped(test::sphere({0, 0, 0}, 1, 2)))),
      "accepted");
}

TEST(IsInsideOut, SaysTheSignOfSumsOfBoxesWhoseVolumesAreWholeNumbers) {
  std::mt19937 random(63);
  const auto whole = [&](int most) {
    return static_cast<double>(1 + random() % static_cast<unsigned>(most));
  };
  std::array<int, 2> close{}, clear{};  // above 0 and below
  for (int k = 0; k < 300; ++k) {
    const Vec3 far = (k % 3 == 0 ? 1 << 20 : 10) * Vec3(whole(9), whole(9), whole(9));
    TriMesh mesh;
    double volume = 0;
    for (int n = 0; n < 3; ++n) {
      // The last differs from what is there by 1 at most, of 10^9: a plain sum could not say which way.
      Vec3 sides(whole(1000), whole(1000), whole(1000));
      if (n == 2) sides = {1, 1, std::max(1.0, std::abs(volume) + whole(3) - 2)};
      const bool is_flipped = n == 2 ? volume > 0 : random() % 2 == 0;
      const TriMesh box = test::box(far, far + sides);
      mesh = mesh.triangles.empty() ? (is_flipped ? test::flipped(box) : box)
                                    : test::joined(mesh, is_flipped ? test::flipped(box) : box);
      volume += (is_flipped ? -1 : 1) * sides.prod();
      if (volume == 0) continue;
      EXPECT_EQ(mesh::is_inside_out(mesh), volume < 0) << k << ", " << n;
      ++(n == 2 ? close : clear)[volume < 0];
    }
  }
  for (const int count : {close[0], close[1], clear[0], clear[1]}) EXPECT_GT(count, 50);
}

TEST(RequireSolid, AnOpenMeshIsRefusedByFileAndBoundary) {
  TriMesh open = test::sphere({0, 0, 0}, 1, 1);
  open.triangles.pop_back();
  const std::string message = refusal(open);
  EXPECT_EQ(message.rfind("bone.ply: an open boundary of 3 edges", 0), 0u) << message;
  test::expect_says(message, "intersecting triangle pairs can still be computed");
}

TEST(RequireSolid, InconsistentWindingIsRefusedByFileAndEdge) {
  TriMesh mesh = test::sphere({0, 0, 0}, 1, 1);
  std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
  test::expect_says(refusal(mesh), "bone.ply: triangles wound against each other at the edge from vertex ");
}

TEST(RequireSolid, AnInvertedMeshIsRefusedWithItsRepair) {
  const TriMesh ball = test::sphere({0, 0, 0}, 1, 1);
  test::expect_says(refusal(test::joined(ball, test::flipped(ball))), "twice, once in each sense");
  test::expect_says(refusal(test::flipped(test::sphere({0, 0, 0}, 1, 1))), "flip_inverted");
}

std::string refused_orientation(const TriMesh& mesh) {
  return test::complaint_of<MeshError>([&] { mesh::require_oriented(mesh, "bone.ply"); });
}

TEST(RequireOriented, AnOpenMeshPassesUnlessItsTrianglesAreWoundAgainstEachOther) {
  TriMesh mesh = test::sphere({0, 0, 0}, 1, 1);
  EXPECT_EQ(refused_orientation(mesh), "accepted");
  test::expect_says(refused_orientation(test::flipped(mesh)), "flip_inverted");
  mesh.triangles.pop_back();
  EXPECT_EQ(refused_orientation(mesh), "accepted");
  std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
  test::expect_begins(refused_orientation(mesh),
                      "bone.ply: triangles wound against each other at the edge from ");
}

}  // namespace
}  // namespace condyle
