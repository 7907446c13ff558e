#include "contact/placed_trees.hpp"

#include <limits>

namespace condyle::contact {
namespace {

/// Largest size of a coordinate in the tree's root.
double reach_of(const mesh::TriangleTree& tree) noexcept {
  if (tree.empty()) return 0;
  const auto& root = tree.nodes()[0];
  double reach = 0;
  for (std::size_t k = 0; k < 3; ++k)
    reach = std::max(reach, std::abs(double{root.centre[k]}) + double{root.half[k]});
  return reach;
}

Eigen::Array4f lane(const Vec3& v) noexcept {
  const Eigen::Vector3f f = v.cast<float>();
  return {f.x(), f.y(), f.z(), 0};
}

}  // namespace

/// With L = 3 (|p| of both bodies, summed, by their largest coordinate) + 3 |t|: a placed centre errs by at
/// most 6u' L (u' = 2^-24: the entries' own roundings, three products, three sums), its difference to another
/// by u' L more, and the sum of half extents by 7u' L. 32u' L covers them. Where the matrix is not quite a
/// rotation, R^T R = 1 + G, coordinates along its columns and distances from the centre are off by at most
/// 3 |G| L.
PlacedTrees::PlacedTrees(const mesh::TriangleTree& fixed, const mesh::TriangleTree& mobile,
                         const Pose& X_FM) noexcept
    : fixed_(fixed), mobile_(mobile) {
  const Eigen::Matrix3d R = X_FM.linear();
  const Vec3 t = X_FM.translation();
  const double L = 3 * (reach_of(fixed) + reach_of(mobile) + t.lpNorm<1>());
  const double G = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  const double slack = (32 * 0x1p-24 + 3 * G) * L + std::numeric_limits<float>::min();
  const auto placing = [&](const Eigen::Matrix3d& turn, const Vec3& shift) {
    Placing out;
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      out.column[i] = lane(turn.col(k)), out.size[i] = out.column[i].abs();
    }
    out.translation = lane(shift), out.slack = lane(Vec3::Constant(slack));
    return out;
  };
  to_fixed_ = placing(R, t);
  to_mobile_ = placing(R.transpose(), -(R.transpose() * t));
  centres_apart_ = static_cast<float>((t.norm() + slack) * (1 + 0x1p-20));
}

}  // namespace condyle::contact
