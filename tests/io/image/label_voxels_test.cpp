#include "condyle/io/label_file.hpp"
#include "io/image/label_files.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

/// Few labels in a large image, so that boxes are small and some touch no border.
test::LabelImage sparse_image(std::uint32_t seed) {
  test::LabelImage image{{7, 6, 5}, Eigen::Affine3d::Identity(), {{}, {}}};
  std::mt19937 random(seed);
  for (auto& layer : image.layers) {
    layer.assign(7 * 6 * 5, 0);
    for (int i = 0; i < 6; ++i)
      layer[random() % layer.size()] = static_cast<std::uint32_t>(10 * (random() % 3));
  }
  return image;
}

io::LabelMap read(const test::LabelImage& image) {
  return io::read_labels(test::nrrd(image), io::LabelFormat::nrrd, "bones");
}

std::uint32_t value_at(const test::LabelImage& image, std::size_t layer, std::array<std::int64_t, 3> v) {
  return image.layers[layer][static_cast<std::size_t>(v[0] + image.size[0] * (v[1] + image.size[1] * v[2]))];
}

/// Every voxel of the image, and whether the mask has it: outside of the box it has none.
std::vector<bool> unpacked(const VoxelMask& mask) {
  std::vector<bool> inside;
  for (std::int64_t k = 0; k < mask.image.size[2]; ++k)
    for (std::int64_t j = 0; j < mask.image.size[1]; ++j)
      for (std::int64_t i = 0; i < mask.image.size[0]; ++i) {
        const std::array<std::int64_t, 3> at = {i - mask.first[0], j - mask.first[1], k - mask.first[2]};
        const bool is_in_box = at[0] >= 0 && at[1] >= 0 && at[2] >= 0 && at[0] < mask.size[0] &&
                               at[1] < mask.size[1] && at[2] < mask.size[2];
        inside.push_back(is_in_box && mask.inside.at(static_cast<std::size_t>(
                                          at[0] + mask.size[0] * (at[1] + mask.size[1] * at[2]))) == 1);
      }
  return inside;
}

TEST(LabelMask, HasTheVoxelsOfTheLabelInTheirSmallestBox) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    const auto image = sparse_image(seed);
    const auto map = read(image);
    const auto summaries = io::summaries_of(map);
    for (std::size_t layer = 0; layer < 2; ++layer)
      for (const std::uint32_t label : {0u, 10u, 20u, 30u}) {
        const auto mask = io::mask_of(map, layer, label);
        std::vector<bool> expected;
        for (const auto value : image.layers[layer]) expected.push_back(value == label);
        EXPECT_EQ(unpacked(mask), expected);

        std::array<bool, 6> touches{};
        std::int64_t voxels = 0;
        for (std::int64_t k = 0; k < 5; ++k)
          for (std::int64_t j = 0; j < 6; ++j)
            for (std::int64_t i = 0; i < 7; ++i) {
              if (value_at(image, layer, {i, j, k}) != label) continue;
              ++voxels;
              const std::array<bool, 6> here = {i == 0, i == 6, j == 0, j == 5, k == 0, k == 4};
              for (std::size_t side = 0; side < 6; ++side) touches[side] = touches[side] || here[side];
            }
        const auto summary = std::find_if(summaries.begin(), summaries.end(), [&](const auto& each) {
          return each.layer == layer && each.label == label;
        });
        ASSERT_EQ(summary != summaries.end(), voxels > 0);
        if (voxels == 0) {
          EXPECT_EQ(mask.size, (std::array<std::int64_t, 3>{0, 0, 0}));
          EXPECT_TRUE(mask.inside.empty());
          continue;
        }
        EXPECT_EQ(summary->voxels, voxels);
        EXPECT_EQ(summary->first, mask.first);
        EXPECT_EQ(summary->size, mask.size);
        EXPECT_EQ(summary->touches, touches);
      }
  }
}

TEST(LabelMask, KeepsTheGridOfTheImage) {
  auto image = sparse_image(1);
  image.X_WI.translation() << 1, 2, 3;
  const auto mask = io::mask_of(read(image), 0, 10);
  EXPECT_EQ(mask.image.size, image.size);
  EXPECT_EQ(mask.image.X_WI.matrix(), image.X_WI.matrix());
}

}  // namespace
}  // namespace condyle
