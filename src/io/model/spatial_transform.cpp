#include "io/model/spatial_transform.hpp"

#include "core/trigonometry.hpp"

namespace condyle::io {

double TransformAxis::value(std::span<const double> q) const {
  std::vector<double> own;
  own.reserve(coordinates.size());
  for (const std::size_t coordinate : coordinates) own.push_back(q[coordinate]);
  return value_of(function, own);
}

Eigen::Matrix3d rotation_about(const Vec3& axis, double radians) {
  const auto [s, c] = core::sine_cosine(radians);
  Eigen::Matrix3d cross;
  cross << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  return c * Eigen::Matrix3d::Identity() + s * cross + (1 - c) * axis * axis.transpose();
}

Eigen::Matrix3d body_fixed_xyz(const Vec3& angles) {
  return rotation_about(Vec3::UnitX(), angles.x()) * rotation_about(Vec3::UnitY(), angles.y()) *
         rotation_about(Vec3::UnitZ(), angles.z());
}

Pose pose_of(const SpatialTransform& transform, std::span<const double> q) {
  Pose X = Pose::Identity();
  for (std::size_t i = 0; i < 3; ++i)
    X.linear() = X.linear() * rotation_about(transform[i].axis, transform[i].value(q));
  for (std::size_t i = 3; i < 6; ++i) X.translation() += transform[i].value(q) * transform[i].axis;
  return X;
}

}  // namespace condyle::io
