#include "mesh/label_surface/repeated_slices.hpp"
#include "mesh/label_surface/voxel_pieces.hpp"
#include "support/test.hpp"
#include "support/voxel_masks.hpp"

/// Which pieces of a label are one bone, and how thick the slices were in which it was drawn.

namespace condyle {
namespace {

struct Block {
  Vec3 low, high;  ///< mm, the latter excluded
};

/// Voxels kept of blocks, and those left out with a * if of the other side.
std::string kept(const std::vector<Block>& blocks, double voxel, const std::optional<Vec3>& at = {}) {
  const auto across = static_cast<std::int64_t>(120 / voxel);
  const VoxelMask mask = test::mask_where({across, across, across}, [&](const Vec3& v) {
    return std::any_of(blocks.begin(), blocks.end(), [&](const Block& block) {
      return (voxel * v - block.low).minCoeff() >= 0 && (block.high - voxel * v).minCoeff() > 0;
    });
  });
  mesh::VoxelBox box{mask.size, mask.inside};
  const mesh::KeptBone bone = mesh::keep_bone(box, Eigen::Affine3d(Eigen::Scaling(voxel)), at);
  std::string text = std::to_string(std::count(box.inside.begin(), box.inside.end(), 1));
  for (const auto& [voxels, other] : bone.left_out)
    text += " -" + std::to_string(voxels) + (other ? "*" : "");
  return text;
}

TEST(KeepBone, TakesPiecesThatFaceEachOtherForOne) {
  const Block shaft{{0, 0, 0}, {20, 20, 60}};  // 24000 mm3
  const auto beyond = [](double gap) { return Block{{0, 0, 60 + gap}, {20, 20, 80 + gap}}; };
  EXPECT_EQ(kept({shaft, beyond(4)}, 1), "32000");
  EXPECT_EQ(kept({shaft, beyond(4)}, 2), "4000");
  EXPECT_EQ(kept({shaft, beyond(12)}, 1), "24000 -8000") << "a fragment far off";
  EXPECT_EQ(kept({shaft, beyond(12)}, 1, Vec3(10, 10, 100)), "8000 -24000") << "the large piece at the point";
  // Of its border of 2168 voxels some 26 at a corner are within 6 mm of the shaft: no section.
  EXPECT_EQ(kept({shaft, {{21, 21, 61}, {41, 41, 81}}}, 1).substr(0, 5), "24000");
}

TEST(KeepBone, TakesHalvesBesideEachOtherForTwo) {
  const Block right{{0, 0, 0}, {40, 20, 40}}, left{{43, 0, 0}, {83, 20, 40}};
  EXPECT_EQ(kept({right, left}, 1, Vec3(0, 0, 0)), "32000 -32000*") << "a symphysis";
  EXPECT_EQ(kept({right, left}, 1, Vec3(83, 0, 0)), "32000 -32000*");
  EXPECT_EQ(kept({right, {{43, 0, 0}, {53, 20, 20}}}, 1), "36000")
      << "a fragment, an eighth, beside its bone";
  EXPECT_EQ(kept({{{0, 0, 0}, {40, 40, 20}}, {{0, 0, 23}, {40, 40, 43}}}, 1), "64000") << "above it";
}

TEST(KeepBone, LeavesSpecksToTheSurface) {
  EXPECT_EQ(kept({{{0, 0, 0}, {20, 20, 60}}, {{0, 0, 70}, {4, 4, 74}}}, 1), "24064");
}

/// A ball at the end of a straight shaft along the axis, drawn in slices of so many voxels.
VoxelMask drawn_in_slices(std::size_t axis, double slice) {
  return test::mask_where({70, 70, 70}, [&](const Vec3& v) {
    Vec3 p = v - Vec3::Constant(35);
    const auto a = static_cast<Eigen::Index>(axis);
    p[a] = slice * (std::floor(v[a] / slice) + 0.5) - 35;
    const double along = p[a];
    p[a] = 0;
    return along < 0 ? p.norm() < 8.2 : std::hypot(p.norm(), along) < 20.3;
  });
}

TEST(RepeatedSlices, CountAsOne) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double slice : {2.0, 2.5, 5.0}) {
      const VoxelMask mask = drawn_in_slices(axis, slice);
      EXPECT_NEAR(mesh::slices_in_one(mask, axis), slice, 0.35);
      EXPECT_NEAR(mesh::slices_in_one(test::cropped(mask), axis), slice, 0.35);
      EXPECT_EQ(mesh::slices_in_one(mask, (axis + 1) % 3), 1);
      EXPECT_NEAR(surface_of(mask).digitisation, slice / 2, 0.18);
    }
    EXPECT_EQ(mesh::slices_in_one(drawn_in_slices(axis, 1), axis), 1) << "a straight shaft";
  }
  EXPECT_EQ(mesh::slices_in_one(test::mask_where({8, 8, 8}, [](const Vec3&) { return false; }), 0), 1);
}

}  // namespace
}  // namespace condyle
