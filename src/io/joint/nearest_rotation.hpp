#pragma once

#include "condyle/pose.hpp"

namespace condyle::io {

/// How far R^T R is from the identity, largest entry: 0 of rotations and reflections.
double orthonormality_error(const Eigen::Matrix3d& R);

/// The rotation nearest to a matrix that is nearly one, in the Frobenius norm: U V^T of R = U S V^T.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& R);

}  // namespace condyle::io
