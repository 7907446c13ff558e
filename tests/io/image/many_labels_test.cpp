#include <fmt/format.h>

#include "condyle/io/label_file.hpp"
#include "io/image/label_files.hpp"
#include "io/result/label_result.hpp"
#include "support/test.hpp"

/// Label maps of very many labels: what takes the product of labels and voxels does not end.

namespace condyle {
namespace {

TEST(ManyLabels, BeyondSixteenBitsAreReadWhateverTheyAre) {
  // Multiples of the numbers of buckets that a hash table goes through lie in one bucket of it: 10^10 steps.
  constexpr std::uint32_t labels = 50'000, voxels = 500'000;
  for (const std::uint32_t step : {85'229u, 65'536u, 62'233u}) {
    test::LabelImage image{{voxels, 1, 1}, Eigen::Affine3d::Identity(), {{}}};
    image.layers[0].reserve(voxels);
    for (std::uint32_t v = 0; v < voxels; ++v) image.layers[0].push_back(v % labels * step + step);
    const io::LabelMap map =
        io::read_labels(test::nrrd(image, {.type = 768}), io::LabelFormat::nrrd, "labels");
    ASSERT_EQ(map.labels.size(), labels);
    EXPECT_EQ(map.labels[7], 8 * step);
    EXPECT_EQ(map.layers[0][labels + 7], 7u);
  }
}

TEST(ManyLabels, OfAnImageAreInspectedInOnePassOverIt) {
  // Values of a scan: the box of each is the image, 60,000 times 2^21 voxels.
  constexpr std::int64_t side = 128;
  test::LabelImage image{{side, side, side}, Eigen::Affine3d::Identity(), {{}}};
  std::mt19937 random(1);
  for (std::int64_t v = 0; v < side * side * side; ++v)
    image.layers[0].push_back(static_cast<std::uint32_t>(1 + random() % 60'000));
  const test::TemporaryFolder folder;
  const auto path = folder.file("scan.nrrd", test::nrrd(image, {.type = 512}));
  const io::LabelInspection found = io::inspect_labels(path, {});
  ASSERT_EQ(found.labels.size(), 60'000u);
  // 35 voxels of each, of which few touch.
  for (std::size_t l = 0; l < found.labels.size(); ++l) {
    EXPECT_GE(found.pieces[l], 1u);
    EXPECT_LE(found.pieces[l], static_cast<std::size_t>(found.labels[l].voxels));
  }
}

TEST(ManyLabels, OfOneNameAndManyNamesOfOneLabelAreListedOnce) {
  constexpr int segments = 50'000;
  std::string lines;
  for (int s = 0; s < segments; ++s)
    lines += fmt::format(
        "Segment{0}_Name:=bone\nSegment{0}_ID:=s\nSegment{0}_LabelValue:={1}\nSegment{0}_Layer:=0\n", s,
        s + 1);
  test::LabelImage image{{segments, 1, 1}, Eigen::Affine3d::Identity(), {{}}};
  for (std::uint32_t v = 1; v <= segments; ++v) image.layers[0].push_back(v);
  const test::TemporaryFolder folder;
  const auto path = folder.file("s.seg.nrrd", test::nrrd(image, {.type = 512, .more_lines = lines}));
  const io::LabelInspection found = io::inspect_labels(path, {});
  const std::string text = io::labels_text(std::array{found});
  test::expect_says(text, "50000 bone: 1 voxels in 1 piece, box of 1 x 1 x 1");
  EXPECT_THROW(io::choose_label(io::read_labels(path), "bone"), UsageError);
}

}  // namespace
}  // namespace condyle
