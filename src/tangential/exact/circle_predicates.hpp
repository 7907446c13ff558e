#pragma once

#include "tangential/exact/circle_crossing.hpp"

/// The exact signs behind a circle's crossings. Each first tries double arithmetic within a bound in units of
/// the circle's scale M; u = 2^-53. Bounds are worst cases with every coordinate at M, rounded up.

namespace condyle::tangential {

/// Sign of |end|^2 - rho^2; zero counts as outside. A quartic form of the coordinates:
/// |a_xy (b_z - h) + b_xy (h - a_z)|^2 - (x^2 + y^2)(b_z - a_z)^2.
bool end_is_inside(const Circle& circle, const CircleCut::End& end, TangentialWork& work);

/// Whether the cut, both ends outside, has a chord in the circle: the foot of the axis lies within it, nearer
/// than rho.
bool has_chord(const Circle& circle, const CircleCut& cut, TangentialWork& work);

/// Sign of x_point y_end - y_point x_end: positive where the end is ahead of the point by less than half a
/// turn. Zero counts as negative, for the point stands a little ahead.
core::Sign side_of_end(const Circle& circle, const CircleCut::End& end, TangentialWork& work);

}  // namespace condyle::tangential
