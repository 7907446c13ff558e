#include "command.hpp"

/// Every option that counts something: what is no whole number, or beyond its bound, is refused before anything is made of it.
/// docs/bounds.md lists the bounds.

namespace condyle::test {
namespace {

struct CountOption {
  const char *command, *option;
  bool may_be_zero = false;
};

constexpr CountOption count_options[] = {
    {"rom joint.toml", "--band"},
    {"measure joint.toml", "--band"},
    {"resect joint.toml --reach flexion=90", "--band", true},
    {"report joint.toml --out page.html", "--band"},
    {"study table.csv --out out", "--band"},
    {"rom joint.toml --band", "--seed", true},
    {"resect joint.toml --reach flexion=90", "--curve", true},
    {"report joint.toml --out page.html --resect flexion=90", "--curve", true},
    {"surface labels.nrrd --label 1 --out surface.ply", "--triangles"},
    {"init labels.nrrd --fixed 1 --mobile 2", "--triangles"},
    {"inspect labels.nrrd", "--volume", true},
    {"implant joint.toml", "--facets"},
    {"sample hip --out out", "--scenario"},
    {"sample hip --out out --hip-bone-triangles 2000", "--femur-triangles"},
    {"sample hip --out out --femur-triangles 2000", "--hip-bone-triangles"},
    {"sample cohort --out out", "--n", true},
    {"sample cohort --n 2 --out out", "--seed", true},
    {"sample cohort --n 2 --out out", "--scenario"},
    {"sample replacement --out out", "--scenario"},
    {"frame joint.toml", "--threads"},
};

TEST(Counts, ThatAreNoWholeNumbersAreRefusedInOneLine) {
  const TemporaryFolder folder;
  for (const auto& [command, option, may_be_zero] : count_options) {
    std::vector<std::string> wrong = {"-1",  "1.5", "1e3", "0x10",
                                      "ten", "nan", "2 0", "18446744073709551616"};
    if (!may_be_zero) wrong.emplace_back("0");
    for (const std::string& value : wrong) {
      const std::string arguments = fmt::format("{} '{}={}'", command, option, value);
      expect_refusal(run_condyle(folder.path(), arguments), 2,
                     fmt::format("{}: '{}' is no whole number from", option, value), arguments);
    }
  }
}

TEST(Counts, BeyondTheirBoundsAreRefusedInOneLine) {
  const TemporaryFolder folder;
  sample_into(folder.path(), "hip");
  const auto expect_refused = [&](const std::string& arguments, std::string_view saying) {
    expect_refusal(run_condyle(folder.path(), arguments), 2, saying, arguments);
  };
  for (const char* command : {"rom", "measure", "resect --reach flexion=90"})
    for (const char* samples : {"19", "100001", "1000000000"})
      expect_refused(fmt::format("{} hip.toml --band={}", command, samples),
                     fmt::format("band: 20 samples or more are needed, up to 100000, not {}", samples));
  expect_refused("sample cohort --n 10000001 --out out", "1 to 10000000 hips");
  expect_refused("sample hip --femur-triangles 4000002 --hip-bone-triangles 2000 --out out", "to 4000000");
  expect_refused("implant hip.toml --facets 2884", "must be a multiple of 4 from 24 to 2880");
  expect_refused("--threads 4097 frame hip.toml", "from 1 to 4096");
  expect_refused("resect hip.toml --reach flexion=90 --curve 1001", "from 0 to 1000");
  expect_refused("rom hip.toml --map flexion=0:90:1e-9 adduction=0:1:1", "points are more than 10000000");
  expect_refused("picture hip.toml --size 8193x64 --out p.png", "each side is 64 to 8192");
  expect_refused("study t.csv --shard 1/1000001 --out out", "up to 1000000");
  // Zeros before a number do not make it octal.
  EXPECT_EQ(run_condyle(folder.path(), "--threads 010 frame hip.toml").exit_code, 0);
  expect_refused("--threads 04097 frame hip.toml", "'04097' is no whole number from 1 to 4096");
}

}  // namespace
}  // namespace condyle::test
