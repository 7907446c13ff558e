#include "io/image/hips_of_labels.hpp"

#include <fmt/format.h>

#include "support/test.hpp"

namespace condyle {
namespace {

/// Blocks of voxels along i, one for each label; a label that stands twice is in two pieces.
io::LabelMap blocks(const std::vector<std::uint32_t>& of, const std::vector<std::string>& names) {
  io::LabelMap map;
  map.grid.size = {static_cast<std::int64_t>(4 * of.size()), 3, 3};
  map.labels = {0};
  for (std::uint32_t label = 1; label <= 99; ++label) map.labels.push_back(label);
  map.layers.emplace_back();
  for (int row = 0; row < 9; ++row)
    for (const std::uint32_t label : of)
      for (int i = 0; i < 4; ++i)
        map.layers[0].push_back(i < 3 ? static_cast<std::uint16_t>(label) : std::uint16_t{0});
  for (std::size_t i = 0; i < names.size(); ++i)
    map.segments.push_back({names[i], "", 0, static_cast<std::uint32_t>(i + 1)});
  return map;
}

/// "left: hip_left + femur_left, ...", or the error.
std::string hips(const io::LabelMap& map, const io::HipLabels& wanted = {}) {
  try {
    std::string text;
    const io::LabelHips found = io::hips_in(map, "ct.nrrd", wanted);
    for (const io::LabelHip& hip : found.hips)
      text += fmt::format("{}{}: {} + {}", text.empty() ? "" : ", ", hip.side ? name_of(*hip.side) : "-",
                          hip.fixed, hip.mobile);
    for (const std::string& bone : found.left_out) text += "; " + bone;
    return text;
  } catch (const UsageError& error) {
    return error.what();
  }
}

TEST(HipsOfLabels, AreFoundByTheNamesOfTheFile) {
  EXPECT_EQ(hips(blocks({1, 2, 3, 4}, {"femur_right", "hip_right", "femur_left", "hip_left"})),
            "left: hip_left + femur_left, right: hip_right + femur_right");
  EXPECT_EQ(hips(blocks({1, 2, 3}, {"Right Femur", "Pelvis", "L Femur"})),
            "left: Pelvis + L Femur, right: Pelvis + Right Femur");
  EXPECT_EQ(hips(blocks({1, 2}, {"proximal femur", "os coxae"})), "-: os coxae + proximal femur");
  EXPECT_EQ(hips(blocks({1, 2}, {"Femur-R", "hip bone"})), "right: hip bone + Femur-R");
  EXPECT_EQ(hips(blocks({1, 2}, {"femur", "innominate_left"})), "left: innominate_left + femur");
}

TEST(HipsOfLabels, AreFoundByTheNumbersOfATable) {
  const io::LabelMap map = blocks({75, 76, 77, 78, 25}, {});
  EXPECT_EQ(hips(map, {.task = io::LabelTask::total}),
            "left: hip_left + femur_left, right: hip_right + femur_right");
  EXPECT_EQ(hips(map, {.task = io::LabelTask::total, .side = Side::right}), "right: hip_right + femur_right");
}

TEST(HipsOfLabels, OfOneLabelForBothFemoraAreOfBothSides) {
  const io::LabelMap map = blocks({2, 1, 1, 2}, {});
  EXPECT_EQ(hips(map, {.fixed = "1", .mobile = "2"}), "left: 1 + 2, right: 1 + 2");
  EXPECT_EQ(hips(map, {.fixed = "1", .mobile = "2", .side = Side::left}), "left: 1 + 2");
  EXPECT_EQ(hips(blocks({2, 1}, {}), {.fixed = "1", .mobile = "2"}), "-: 1 + 2");
}

TEST(HipsOfLabels, WithoutTheirOtherBoneAreNamed) {
  EXPECT_EQ(hips(blocks({1, 2, 3}, {"hip_left", "femur_left", "femur_right"})),
            "left: hip_left + femur_left; femur_right: no hip bone or pelvis of its side");
  EXPECT_EQ(hips(blocks({1, 2, 3}, {"hip_left", "femur_left", "hip_right"})),
            "left: hip_left + femur_left; hip_right: no femur of its side");
  EXPECT_EQ(hips(blocks({1, 2, 3}, {"hip_left", "femur_left", "hip_right"}), {.side = Side::left}),
            "left: hip_left + femur_left");
  EXPECT_EQ(hips(blocks({1, 2, 2, 3}, {"hip_left", "femur_left", "hip_right"})),
            "left: hip_left + femur_left; femur_left: the other of its two large pieces; "
            "hip_right: no femur of its side");
}

TEST(HipsOfLabels, ThatAreNotClearAreRefused) {
  EXPECT_EQ(
      hips(blocks({1, 2}, {})),
      "ct.nrrd: no label is called a hip bone or pelvis: the image holds 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, "
      "12 and 87 more; --fixed and --mobile take numbers");
  EXPECT_EQ(
      hips(blocks({1, 2}, {"hip_left", "hip implant"})),
      "ct.nrrd: no label is called a femur: the image holds 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12 and 87 "
      "more; --fixed and --mobile take numbers");
  EXPECT_EQ(hips(blocks({1, 2}, {"hip_left", "femur_right"})),
            "ct.nrrd: no femur and hip bone are of one side");
  EXPECT_EQ(
      hips(blocks({1, 2, 3}, {"hip_left", "pelvis_left", "femur_left"})),
      "ct.nrrd: hip_left and pelvis_left are both a hip bone or pelvis: --fixed and --mobile say which is "
      "meant");
  EXPECT_EQ(
      hips(blocks({1, 2, 3}, {"pelvis", "femur", "proximal femur"})),
      "ct.nrrd: femur and proximal femur are femora of one side, or have none in their names: --fixed and "
      "--mobile say which is meant");
  EXPECT_EQ(hips(blocks({1, 2}, {"pelvis", "femur_right"}), {.side = Side::left}),
            "ct.nrrd: no femur and hip bone are of one side, the left");
}

}  // namespace
}  // namespace condyle
