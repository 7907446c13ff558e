#pragma once

#include <cstdint>
#include <optional>

#include "condyle/angle.hpp"
#include "condyle/points.hpp"

/// How far one mesh turns about an axis before it touches another: in closed form, complete, without a step
/// size (docs/mathematics.md, section 5).

namespace condyle {

enum class FeatureKind : std::uint8_t { vertex, edge, face };

/// A vertex by its number, an edge by its two vertices (ascending), a face by its triangle's number: numbers
/// of the mesh.
struct Feature {
  FeatureKind kind = FeatureKind::vertex;
  Index id = no_index;
  Index other_end = no_index;  ///< Edges only.

  friend auto operator<=>(const Feature&, const Feature&) = default;
};

struct FeaturePair {
  Feature turning, resting;
  friend auto operator<=>(const FeaturePair&, const FeaturePair&) = default;
};

/// What touches, and where on each body in its own frame, in mm. Of several pairs that touch at the same
/// reported angle the first in the order of FeaturePair.
struct TouchingFeatures {
  FeaturePair features;
  Vec3 turning_point, resting_point;
};

enum class LimitReason : std::uint8_t {
  contact,           ///< The surfaces touch at the angle, and not before.
  end_of_range,      ///< Nothing touches in the whole range.
  contact_at_start,  ///< The surfaces touch at the start already, or one body is inside the other.
};

/// One end of a free turn.
struct Limit {
  Angle angle;  ///< Signed; 0 for contact_at_start.
  LimitReason reason = LimitReason::end_of_range;
  /// For contact and contact_at_start; empty where one body is inside the other without touching it.
  std::optional<TouchingFeatures> touching;
  /// First contact is at `angle` or past it by at most this; never before.
  Angle shortfall;
};

/// What a search has looked at.
struct TurnWork {
  std::int64_t node_pairs = 0;       ///< Pairs of regions compared.
  std::int64_t leaf_pairs = 0;       ///< Pairs of leaves whose features were compared.
  std::int64_t events = 0;           ///< Pairs of features whose angles were solved for.
  std::int64_t exact_decisions = 0;  ///< Roots that doubles could not decide.
  std::int64_t triangle_tests = 0;   ///< Pairs of triangles tested at the start.

  TurnWork& operator+=(const TurnWork& more) noexcept;
};

struct TurnLimits {
  Limit negative, positive;
  TurnWork work;
};

/// From `negative` <= 0 to `positive` >= 0, at most a full turn each way.
struct TurnRange {
  Angle negative = Angle::radians(-two_pi);
  Angle positive = Angle::radians(two_pi);
};

}  // namespace condyle
