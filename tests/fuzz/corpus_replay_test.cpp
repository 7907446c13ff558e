#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "fuzz/largest_allocation.hpp"
#include "fuzz/targets.hpp"

namespace condyle {
namespace {

/// A target, and the folder of its inputs: seeds, and whatever was once found.
struct Target {
  const char* name;
  std::string (*broken_promise)(std::string_view bytes);
  friend void PrintTo(const Target& target, std::ostream* out) { *out << target.name; }
};

std::vector<std::filesystem::path> inputs_of(const Target& target) {
  const std::filesystem::directory_iterator folder(std::filesystem::path(CONDYLE_CORPUS) / target.name);
  std::vector<std::filesystem::path> inputs(begin(folder), end(folder));
  std::sort(inputs.begin(), inputs.end());
  return inputs;
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class KeptInputs : public testing::TestWithParam<Target> {};

TEST_P(KeptInputs, KeepThePromiseInMemoryAndTimeInProportion) {
  // A kilobyte takes milliseconds; an unoptimised build under sanitizers on a busy machine a hundred times that.
  constexpr std::chrono::seconds longest{5};
  const auto inputs = inputs_of(GetParam());
  EXPECT_FALSE(inputs.empty());
  for (const auto& input : inputs) {
    const std::string bytes = bytes_of(input);
    test::largest_allocation = 0;
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(GetParam().broken_promise(bytes), "") << input;
    EXPECT_LE(std::chrono::steady_clock::now() - start, longest) << input;
    EXPECT_LE(test::largest_allocation, test::allowed_at_once(bytes.size())) << input;
  }
}

TEST_P(KeptInputs, AreFewBytes) {
  std::uintmax_t bytes = 0;
  for (const auto& input : inputs_of(GetParam())) bytes += std::filesystem::file_size(input);
  EXPECT_LE(bytes, 20480u);
}

INSTANTIATE_TEST_SUITE_P(
    EveryTarget, KeptInputs,
    testing::Values(Target{"mesh_reader", test::fuzz_mesh_reader},
                    Target{"label_file", test::fuzz_label_file}, Target{"model_file", test::fuzz_model_file},
                    Target{"model_limits", test::fuzz_model_limits},
                    Target{"joint_file", test::fuzz_joint_file},
                    Target{"motion_file", test::fuzz_motion_file},
                    Target{"study_table", test::fuzz_study_table}, Target{"text", test::fuzz_text},
                    Target{"inspect", test::fuzz_inspect}, Target{"radial", test::fuzz_radial},
                    Target{"tangential", test::fuzz_tangential}, Target{"pairs", test::fuzz_pairs},
                    Target{"first_contact", test::fuzz_first_contact}, Target{"turns", test::fuzz_turns},
                    Target{"slides", test::fuzz_slides}, Target{"touch", test::fuzz_touch},
                    Target{"results", test::fuzz_results}),
    [](const auto& target) { return target.param.name; });

}  // namespace
}  // namespace condyle
