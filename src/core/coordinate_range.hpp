#pragma once

#include <cstddef>
#include <optional>

#include "condyle/pose.hpp"

/// Which coordinates are computed with: docs/mathematics/01-setting.md, "What a coordinate is". Signs are exact for any
/// double, but the tables find their candidates by single precision and by squares, which hold no more than this.

namespace condyle::core {

/// In the mesh's unit, mm once past the file readers. Some metres are a body, and single precision ends at 3e38.
inline constexpr double largest_coordinate = 1e30, least_size = 1e-30;

/// Nearer to a centre, and not at it, single precision knows no direction: its normal numbers begin at 1.2e-38.
inline constexpr double least_distance = 1e-36;

/// How far the products of a rotation's columns may be from those of an identity: poses of single precision are, at most.
inline constexpr double largest_skew = 1e-6;

/// The first point with a coordinate that is not finite or beyond the largest one.
std::optional<std::size_t> first_out_of_range(PointsView points) noexcept;

/// Throws UsageError for a point that is out of range, naming it.
void require_in_range(PointsView points);
/// Throws UsageError for entries that are not finite and for a translation out of range. Whether it is a rotation is not
/// checked.
void require_in_range(const Pose& X_FM);
/// And for a matrix that is no rotation within largest_skew.
void require_rotation(const Pose& X_FM);

}  // namespace condyle::core
