#pragma once

#include <cmath>
#include <span>

#include "volume_tree.hpp"

namespace bench {

/// A ball that holds triangles, nearly the smallest one.
struct Ball {
  condyle::Vec3 centre = condyle::Vec3::Zero();
  double radius = 0;

  /// Begins at the middle of the box and steps towards the farthest corner, each time less far (Badoiu and
  /// Clarkson 2003); the best of the few is kept.
  static Ball around(std::span<const condyle::Vec3> corners) {
    constexpr int steps = 8;  // within a few percent of the smallest; each costs a pass over the corners
    Eigen::AlignedBox3d box;
    for (const condyle::Vec3& p : corners) box.extend(p);
    condyle::Vec3 centre = box.center();
    Ball best{centre, std::numeric_limits<double>::infinity()};
    for (int i = 0; i < steps; ++i) {
      const condyle::Vec3 farthest = *std::max_element(corners.begin(), corners.end(), [&](auto& p, auto& q) {
        return (p - centre).squaredNorm() < (q - centre).squaredNorm();
      });
      const double radius = (farthest - centre).norm();
      if (radius < best.radius) best = {centre, radius};
      centre += (farthest - centre) / (i + 2);
    }
    return best.widened(best.centre);
  }

  Ball posed(const condyle::Pose& X) const { return Ball{condyle::posed(X, centre), radius}.widened(centre); }

  bool meets(const Ball& other) const {
    const double reach = radius + other.radius;
    return (centre - other.centre).squaredNorm() <= reach * reach;
  }

  double size() const { return radius; }

 private:
  /// By the rounding of its centre and of what it holds, where the centre was `before`.
  Ball widened(const condyle::Vec3& before) const {
    return {centre, radius + relative_rounding * (before.norm() + centre.norm() + radius)};
  }
};

}  // namespace bench
