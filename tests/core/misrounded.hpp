#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cstddef>

#include "support/test.hpp"

namespace condyle::core {

using Long = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>>;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Values that are not the exact one rounded once: a neighbour of it, where that lies within 2^-67 of the middle between the two,
/// 2^-13 of the time.
struct Misrounded {
  std::size_t of = 0, count = 0;

  void hold(double value, const Long& exact) {
    const auto rounded = static_cast<double>(exact);
    ++of, count += value != rounded;
    EXPECT_LE(abs(Long(value) - exact), abs(exact) * (0x1p-53 + 0x1p-67)) << value << " and not " << rounded;
  }
  ~Misrounded() { EXPECT_LE(count, 1 + of / 2048); }
};

}  // namespace condyle::core
