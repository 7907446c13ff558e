#pragma once

#include <cstdlib>
#include <string>

#include "condyle/pose.hpp"
#include "core/formatted.hpp"

namespace condyle::core {

/// A number with so many decimals, for people; what rounds to zero has no minus sign, which would say nothing.
inline std::string rounded(double value, int decimals) {
  std::string text = formatted("%.*f", decimals, value);
  if (text.front() == '-' && text.find_first_of("123456789") == text.npos) text.erase(0, 1);
  return text;
}

/// "(1.00, -2.50, 0.00)".
inline std::string rounded(const Vec3& p, int decimals) {
  return "(" + rounded(p.x(), decimals) + ", " + rounded(p.y(), decimals) + ", " + rounded(p.z(), decimals) +
         ")";
}

/// A bound in one or two significant digits, for people: never below it, as rounding to the nearest may be.
inline std::string at_most(double bound, int digits) {
  double value = bound;
  std::string text = formatted("%.*g", digits, value);
  // A step of one in a hundred passes over no number of so few digits.
  while (std::strtod(text.c_str(), nullptr) < bound) text = formatted("%.*g", digits, value *= 1.01);
  return text;
}

}  // namespace condyle::core
