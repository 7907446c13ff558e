#include "core/latest_few.hpp"

#include <atomic>
#include <stdexcept>
#include <thread>

#include "support/test.hpp"

namespace condyle::core {
namespace {

TEST(LatestFew, AValueIsMadeOnceForAllThreads) {
  const LatestFew<int, int, 2> kept;
  std::atomic<int> made = 0;
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 8; ++i)
      threads.emplace_back([&] { EXPECT_EQ(*kept.get(7, [&](int& value) { value = 70, ++made; }), 70); });
  }
  EXPECT_EQ(made, 1);
}

TEST(LatestFew, TheOneAskedForLongestAgoIsForgottenAndLivesOnWhereItIsHeld) {
  const LatestFew<int, int, 2> kept;
  int made = 0;
  const auto get = [&](int key) { return kept.get(key, [&](int& value) { value = 10 * key, ++made; }); };
  const auto one = get(1);
  get(2), get(1), get(3);
  EXPECT_EQ(made, 3);
  EXPECT_EQ(*get(1), 10);
  EXPECT_EQ(made, 3) << "2 was asked for longest ago";
  EXPECT_EQ(*get(2), 20);
  EXPECT_EQ(made, 4);
  get(3), get(2);
  EXPECT_EQ(*one, 10);
}

TEST(LatestFew, WhatCannotBeMadeIsTriedAgain) {
  const LatestFew<int, int, 2> kept;
  EXPECT_THROW(kept.get(1, [](int&) { throw std::runtime_error("no"); }), std::runtime_error);
  EXPECT_EQ(*kept.get(1, [](int& value) { value = 5; }), 5);
}

}  // namespace
}  // namespace condyle::core
