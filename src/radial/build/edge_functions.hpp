#pragma once

#include "condyle/pose.hpp"
#include "simd/packed_interval.hpp"

namespace condyle::radial {

using simd::PackedInterval;

/// Four linear forms of a point v, side by side: a . v in lanes x[k] v_x + y[k] v_y + z[k] v_z. For a
/// triangle (a, b, c) with normal N and D = a . (b x c):
///
///     lanes 0 1 2    (a x b) / D, (b x c) / D, (c x a) / D      all > 0 if the ray through v crosses it
///     lane 3         N / |D|        its magnitude is |v| over the crossing's radius, > 1 where the crossing
///                                   lies before v; positive where the ray leaves the solid
///
/// NaN throughout where floats could not say enough of the triangle: a plane nearly through the centre, a
/// sliver. Every comparison with them is false, and the point is decided in double.
///
/// `low` has what lane 3 leaves out: the sum of both is scaled_normal(), NaN if that is. `radii` are the
/// squared radii that the triangle takes, of the table's scale.
struct alignas(64) EdgeFunctions {
  float x[4], y[4], z[4], low[3];
  PackedInterval radii;

  Vec3 scaled_normal() const noexcept {
    return {double{x[3]} + double{low[0]}, double{y[3]} + double{low[1]}, double{z[3]} + double{low[2]}};
  }
};

/// Lengths that floats square and multiply without overflow or loss, mm.
inline constexpr double least_length = 0x1p-40, greatest_length = 0x1p40;

/// Relative error of a form's coefficients beyond their rounding to float: with that, a form of a point v
/// errs by less than form_error * max|v_k| * (|x| + |y| + |z|), and `form_error_of_translation` times |t| / r
/// more. In units of u: 1 for rounding a coefficient, 4 for this, 4 for the form's own operations, 10.4 for
/// the point: 6u (|v| + 2 |t|) in each coordinate, |v| <= sqrt(3) max|v_k|. The bound's own rounding takes
/// the rest.
inline constexpr double coefficient_error = 0x1p-22;
inline constexpr float form_error = 24 * 0x1p-24f;
inline constexpr float form_error_of_translation = 24 * 0x1p-24f;

}  // namespace condyle::radial
