#include "core/spare_blocks.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <thread>
#include <vector>

#include "core/uninitialised.hpp"

namespace condyle {
namespace {

std::vector<void*> released;

void note(void* memory, std::size_t) noexcept {
  released.push_back(memory);
}

class SpareBlocksTest : public testing::Test {
 protected:
  void SetUp() override { released.clear(); }

  void* block(std::size_t i) { return &byte_[i]; }

  std::array<char, 2 * core::SpareBlocks::most_blocks> byte_{};
  core::SpareBlocks spare_{1000, note};
};

TEST_F(SpareBlocksTest, ABlockComesBackOnceAndToWhoAsksForItsSizeOnly) {
  spare_.keep(block(0), 100);
  EXPECT_EQ(spare_.take(99), nullptr);
  EXPECT_EQ(spare_.take(101), nullptr);
  EXPECT_EQ(spare_.take(100), block(0));
  EXPECT_EQ(spare_.take(100), nullptr);
  EXPECT_TRUE(released.empty());
}

TEST_F(SpareBlocksTest, OfEqualBlocksTheLastComesFirst) {
  spare_.keep(block(0), 100);
  spare_.keep(block(1), 100);
  spare_.keep(block(2), 200);
  EXPECT_EQ(spare_.take(100), block(1));
  EXPECT_EQ(spare_.take(200), block(2));
  EXPECT_EQ(spare_.take(100), block(0));
}

TEST_F(SpareBlocksTest, BeyondTheBoundThoseThatWaitedLongestAreReleased) {
  spare_.keep(block(0), 400);
  spare_.keep(block(1), 300);
  spare_.keep(block(2), 300);
  EXPECT_TRUE(released.empty());
  spare_.keep(block(3), 500);
  EXPECT_EQ(released, (std::vector{block(0), block(1)}));
  spare_.keep(block(4), 1001);
  EXPECT_EQ(released.back(), block(4));
  EXPECT_EQ(spare_.take(300), block(2));
  EXPECT_EQ(spare_.take(500), block(3));
}

TEST_F(SpareBlocksTest, ManySmallBlocksReleaseTheOldest) {
  for (std::size_t i = 0; i < core::SpareBlocks::most_blocks + 3; ++i) spare_.keep(block(i), 1);
  EXPECT_EQ(released, (std::vector{block(0), block(1), block(2)}));
}

TEST(LargeMemory, IsAlignedAndHoldsWhatIsWrittenWhoeverHadItBefore) {
  for (const std::size_t bytes : {std::size_t{1}, std::size_t{65535}, std::size_t{65536}, std::size_t{70001},
                                  std::size_t{3} << 20, std::size_t{70} << 20}) {
    for (int again = 0; again < 2; ++again) {
      auto* const memory = static_cast<unsigned char*>(core::allocate_large(bytes));
      const std::size_t alignment = bytes >= std::size_t{2} << 20 ? std::size_t{2} << 20 : 64;
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory) % alignment, 0u) << bytes;
      memory[0] = 1, memory[bytes - 1] = 2;
      core::free_large(memory, bytes);
    }
  }
}

TEST(LargeMemory, ThreadsThatMakeAndDropVectorsNeverShareOne) {
  const auto work = [](std::size_t number) {
    for (std::size_t round = 0; round < 200; ++round) {
      core::UninitialisedVector<std::size_t> values(20000 + 100 * (round % 3));
      for (std::size_t& value : values) value = number;
      for (const std::size_t value : values) ASSERT_EQ(value, number);
    }
  };
  std::vector<std::jthread> threads;
  for (std::size_t number = 0; number < 4; ++number) threads.emplace_back(work, number);
}

}  // namespace
}  // namespace condyle
