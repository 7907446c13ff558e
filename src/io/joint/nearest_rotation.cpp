#include "io/joint/nearest_rotation.hpp"

#include <Eigen/SVD>

namespace condyle::io {

double orthonormality_error(const Eigen::Matrix3d& R) {
  return (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
}

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& R) {
  // A preconditioner is for matrices that are not square.
  const Eigen::JacobiSVD<Eigen::Matrix3d, Eigen::NoQRPreconditioner> svd(
      R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

}  // namespace condyle::io
