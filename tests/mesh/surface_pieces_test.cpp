#include "mesh/surface_pieces.hpp"

#include "support/test.hpp"

/// The connected pieces of a surface, and which of it nothing outside can touch.

namespace condyle::mesh {
namespace {

using namespace test;

TEST(SurfacePieces, OfOneSolidAreIt) {
  const Mesh ball(sphere({1, 2, 3}, 10, 3));
  const SurfacePieces& pieces = pieces_of(ball);
  ASSERT_EQ(pieces.all.size(), 1u);
  EXPECT_TRUE(pieces.of_triangle.empty() && pieces.is_inner.empty());
  EXPECT_EQ(&outer_surface(ball), &ball);
}

TEST(SurfacePieces, InsideAnotherAreInnerWhicheverWayEitherIsWound) {
  const TriMesh around = sphere(Vec3::Zero(), 10, 3), within = sphere({1, 0, 0}, 4, 2);
  for (const bool flip_around : {false, true})
    for (const bool flip_within : {false, true}) {
      const Mesh both(joined(flip_around ? flipped(around) : around, flip_within ? flipped(within) : within));
      const SurfacePieces& pieces = pieces_of(both);
      ASSERT_EQ(pieces.all.size(), 2u);
      EXPECT_FALSE(pieces.all[0].is_inner());
      EXPECT_TRUE(pieces.all[1].is_inner());
      EXPECT_EQ(pieces.all[1].around, 0u);
      EXPECT_EQ(outer_surface(both).triangles().size(), around.triangles.size());
      EXPECT_EQ(outer_surface(both).vertices().size(), both.vertices().size()) << "numbers stay";
    }
}

TEST(SurfacePieces, BesideEachOtherAreBothOuterHoweverNear) {
  // Boxes that share a face, and one that touches a corner from outside.
  const Mesh touching(joined(joined(box({0, 0, 0}, {10, 10, 10}), box({10, 0, 0}, {20, 10, 10})),
                             box({-5, -5, -5}, {0, 0, 0})));
  const SurfacePieces& pieces = pieces_of(touching);
  ASSERT_EQ(pieces.all.size(), 3u);
  EXPECT_TRUE(pieces.is_inner.empty());
}

TEST(SurfacePieces, ThatPierceEachOtherLoseWhatLiesWithin) {
  // A post through a ball: its two middle rings of vertices are inside, its ends are not.
  const TriMesh ball = sphere(Vec3::Zero(), 10, 4);
  TriMesh post;
  for (const double z : {-20.0, -3.0, 3.0, 20.0})
    for (const auto& [x, y] : {std::pair{-2, -2}, std::pair{2, -2}, std::pair{2, 2}, std::pair{-2, 2}})
      post.vertices.push_back({x + 0.1, y + 0.05, z});
  for (Index ring = 0; ring < 3; ++ring)
    for (Index k = 0; k < 4; ++k) {
      const Index a = 4 * ring + k, b = 4 * ring + (k + 1) % 4;
      post.triangles.push_back({a, b, b + 4}), post.triangles.push_back({a, b + 4, a + 4});
    }
  post.triangles.insert(post.triangles.end(), {{0, 2, 1}, {0, 3, 2}, {12, 13, 14}, {12, 14, 15}});
  const Mesh both(joined(ball, post));
  const SurfacePieces& pieces = pieces_of(both);
  ASSERT_EQ(pieces.all.size(), 2u);
  EXPECT_EQ(pieces.all[1].inner_vertices, 8u);
  EXPECT_FALSE(pieces.all[1].is_inner()) << "half of it";
  const auto& outer = outer_surface(both).triangles();
  const auto of_post = std::count_if(outer.begin(), outer.end(),
                                     [&](const Triangle& t) { return t[0] >= ball.vertices.size(); });
  EXPECT_EQ(of_post, static_cast<std::ptrdiff_t>(post.triangles.size()) - 8)
      << "without those between the two rings";
}

TEST(SurfacePieces, InnermostOnesNameTheSmallestAround) {
  const Mesh three(joined(joined(sphere(Vec3::Zero(), 20, 3), flipped(sphere(Vec3::Zero(), 15, 3))),
                          sphere(Vec3::Zero(), 5, 3)));
  const SurfacePieces& pieces = pieces_of(three);
  EXPECT_EQ(pieces.all[2].around, 1u);
  EXPECT_EQ(pieces.all[1].around, 0u);
  using Kept = std::vector<bool>;
  EXPECT_EQ(kept_pieces(pieces, {}), (Kept{true, true, false}));
  EXPECT_EQ(kept_pieces(pieces, {.keep_cavities = false}), (Kept{true, false, false}));
  EXPECT_EQ(kept_pieces(pieces, {.all_solids = true}), (Kept{true, true, true}));
}

TEST(SurfacePieces, HaveAsInnerVerticesThoseThatLieInOtherBoxes) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(0, 100), size(1, 30);
  std::vector<std::pair<Vec3, Vec3>> corners;
  TriMesh all;
  for (int i = 0; i < 300; ++i) {
    const Vec3 low(place(random), place(random), place(random));
    const Vec3 high = low + Vec3(size(random), size(random), size(random));
    corners.emplace_back(low, high);
    const TriMesh one = box(low, high);
    all = joined(all, i % 2 ? flipped(one) : one);
  }
  const Mesh mesh(all);
  const SurfacePieces& pieces = pieces_of(mesh);
  ASSERT_EQ(pieces.all.size(), corners.size());
  const auto volume_of = [&](std::size_t piece) {
    return (corners[piece].second - corners[piece].first).prod();
  };
  std::vector<std::size_t> around(corners.size(), SurfacePiece::no_piece), inner(corners.size());
  for (std::size_t v = 0; v < mesh.vertices().size(); ++v) {
    const Vec3 p = mesh.vertices()[v];
    const std::size_t own = pieces.of_vertex[v];
    bool is_inner = false;
    for (std::size_t other = 0; other < corners.size(); ++other) {
      const auto& [low, high] = corners[other];
      if (other == own || !(p.array() > low.array()).all() || !(p.array() < high.array()).all()) continue;
      is_inner = true;
      if (around[own] == SurfacePiece::no_piece || volume_of(other) < volume_of(around[own]))
        around[own] = other;
    }
    EXPECT_EQ(pieces.is_inner[v] != 0, is_inner) << v;
    inner[own] += is_inner;
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    EXPECT_EQ(pieces.all[i].inner_vertices, inner[i]) << i;
    EXPECT_EQ(pieces.all[i].around, around[i]) << i;
  }
}

TEST(LargestPiece, IsTheSolidOfMostVolumeWithItsCavities) {
  const TriMesh hollow = joined(sphere(Vec3::Zero(), 10, 3), flipped(sphere(Vec3::Zero(), 5, 3)));
  const TriMesh sheet_like = box({20, 0, 0}, {60, 60, 0.1});  // more area, less volume
  const TriMesh kept = largest_piece(joined(joined(sheet_like, hollow), box({0, 0, 20}, {1, 1, 21})));
  EXPECT_EQ(kept.triangles.size(), hollow.triangles.size());
  EXPECT_EQ(kept.vertices.size(), hollow.vertices.size());
}

TEST(PieceAt, IsThatNearestThePoint) {
  const TriMesh near = box({0, 0, 0}, {1, 1, 1}), far = sphere({100, 0, 0}, 30, 3);
  EXPECT_EQ(piece_at(joined(far, near), {5, 0, 0}).vertices.size(), near.vertices.size());
  EXPECT_EQ(piece_at(joined(far, near), {60, 0, 0}).vertices.size(), far.vertices.size());
}

TEST(SurfacePieces, ManySpecksAreFoundInLittleMoreThanLinearTime) {
  // Each speck alone: a quadratic search would look at 2,000 specks for each of them.
  TriMesh dust = sphere(Vec3::Zero(), 50, 4);
  const Index first = static_cast<Index>(dust.vertices.size());
  for (Index i = 0; i < 2000; ++i) {
    const Vec3 at(-60 + 0.06 * i, 3 * std::sin(i), 3 * std::cos(i));
    const Index v = first + 4 * i;
    for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(0.01, 0, 0), Vec3(0, 0.01, 0), Vec3(0, 0, 0.01)})
      dust.vertices.push_back(at + corner);
    for (const Triangle& t : {Triangle{0, 2, 1}, Triangle{0, 1, 3}, Triangle{0, 3, 2}, Triangle{1, 2, 3}})
      dust.triangles.push_back({v + t[0], v + t[1], v + t[2]});
  }
  const Mesh mesh(std::move(dust));
  const SurfacePieces& pieces = pieces_of(mesh);
  ASSERT_EQ(pieces.all.size(), 2001u);
  std::size_t inner = 0;
  for (std::size_t i = 1; i < pieces.all.size(); ++i) {
    const Vec3 at = mesh.vertices()[first + 4 * (i - 1)];
    // Facets sag by less than half a millimetre.
    const bool is_inner = pieces.all[i].is_inner();
    EXPECT_TRUE(is_inner || at.norm() > 49.5) << i;
    EXPECT_TRUE(!is_inner || at.norm() < 50.1) << i;
    inner += pieces.all[i].is_inner();
  }
  EXPECT_GT(inner, 1000u);
}

}  // namespace
}  // namespace condyle::mesh
