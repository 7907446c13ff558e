#pragma once

#include <gtest/gtest.h>

#include <random>

/// In place of RapidCheck, which Debian has compiled for Linux only: draws what a property asks for, a hundred times, from a fixed start. What
/// it finds it does not make smaller.

namespace rc::gen {

template <class Number>
class Range {
 public:
  Range(Number low, Number high) : low_(low), high_(high) {}
  Number operator*() const {
    static std::mt19937_64 random;
    return static_cast<Number>(low_ +
                               static_cast<Number>(random() % static_cast<std::uint64_t>(high_ - low_)));
  }

 private:
  Number low_, high_;
};

/// From `low` to below `high`.
template <class Number>
Range<Number> inRange(Number low, Number high) {
  return {low, high};
}

}  // namespace rc::gen

#define RC_ASSERT(condition) ASSERT_TRUE(condition)

#define RC_GTEST_PROP(suite, name, arguments)                                                            \
  static void property_##suite##_##name arguments;                                                       \
  TEST(suite, name) {                                                                                    \
    for (int drawn = 0; drawn < 100 && !HasFatalFailure(); ++drawn) property_##suite##_##name arguments; \
  }                                                                                                      \
  static void property_##suite##_##name arguments
