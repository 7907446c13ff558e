#pragma once

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

}  // namespace condyle::core
