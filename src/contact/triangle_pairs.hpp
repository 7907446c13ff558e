#pragma once

#include <compare>

#include "condyle/points.hpp"

namespace condyle {

/// A triangle of the fixed and one of the mobile body that share a point.
struct TrianglePair {
  Index fixed, mobile;
  friend auto operator<=>(const TrianglePair&, const TrianglePair&) = default;
};

}  // namespace condyle
