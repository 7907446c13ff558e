#pragma once

#include "condyle/pose.hpp"

/// Eigen's decompositions of symmetric matrices of 3 x 3, compiled once: each unit that has one of its own takes seconds more. They read the
/// lower half.

namespace condyle::core {

/// Eigenvalues, ascending, and their directions, of unit length, in columns.
struct SymmetricAxes {
  Vec3 values;
  Eigen::Matrix3d directions;
};
SymmetricAxes axes_of(const Eigen::Matrix3d& symmetric);

/// x with A x = b, for A that is positive or negative semidefinite.
Vec3 solved(const Eigen::Matrix3d& A, const Vec3& b);

/// The shortest x that A x = b leaves least of, for A that is positive semidefinite: along directions of A that rounding could have made there
/// is nothing of it.
Vec3 shortest_solved(const Eigen::Matrix3d& A, const Vec3& b);

}  // namespace condyle::core
