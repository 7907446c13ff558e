#include "mesh/label_surface/voxel_pieces.hpp"
#include "support/test.hpp"

/// Pieces of all values in one pass, against the pieces of one value at a time.

namespace condyle {
namespace {

using Size = std::array<std::int64_t, 3>;

std::vector<std::size_t> one_by_one(const std::vector<std::uint16_t>& voxels, const Size& size,
                                    std::size_t values) {
  std::vector<std::size_t> pieces;
  for (std::size_t value = 0; value < values; ++value) {
    mesh::VoxelBox box{size, {}};
    for (const std::uint16_t voxel : voxels) box.inside.push_back(voxel == value);
    pieces.push_back(mesh::keep_pieces(box, true).size());
  }
  return pieces;
}

TEST(PiecesOfAllValues, AreThoseOfEachByItself) {
  std::mt19937 random(1);
  for (int round = 0; round < 2000; ++round) {
    const auto side = [&] { return std::int64_t{1} + static_cast<std::int64_t>(random() % 7); };
    const Size size{side(), side(), side()};
    const std::size_t values = 1 + random() % 6;
    // From voxels that all differ to long runs.
    const std::uint32_t repeats = static_cast<std::uint32_t>(random() % 10);
    std::vector<std::uint16_t> voxels(static_cast<std::size_t>(size[0] * size[1] * size[2]));
    for (std::size_t v = 0; v < voxels.size(); ++v)
      voxels[v] =
          v > 0 && random() % 10 < repeats ? voxels[v - 1] : static_cast<std::uint16_t>(random() % values);
    EXPECT_EQ(mesh::count_pieces(voxels, size, values), one_by_one(voxels, size, values)) << round;
  }
}

TEST(PiecesOfAllValues, MeetAtCornersOnEitherSideOfARun) {
  // 0 0 1 1
  // 1 1 0 0: both values are one piece, each over the corner in the middle.
  const std::vector<std::uint16_t> crossed{0, 0, 1, 1, 1, 1, 0, 0};
  EXPECT_EQ(mesh::count_pieces(crossed, {4, 2, 1}, 2), (std::vector<std::size_t>{1, 1}));
  EXPECT_EQ(mesh::count_pieces(crossed, {4, 1, 2}, 2), (std::vector<std::size_t>{1, 1}));
  // One voxel farther they do not meet.
  const std::vector<std::uint16_t> apart{0, 2, 1, 1, 2, 0};
  EXPECT_EQ(mesh::count_pieces(apart, {3, 2, 1}, 3), (std::vector<std::size_t>{2, 2, 1}));
}

TEST(PiecesOfAllValues, OfAUAreOneThatJoinsInItsLastSlice) {
  const std::vector<std::uint16_t> u{1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 1, 1, 1, 1, 1};
  EXPECT_EQ(mesh::count_pieces(u, {5, 1, 3}, 2), (std::vector<std::size_t>{1, 1}));
}

}  // namespace
}  // namespace condyle
