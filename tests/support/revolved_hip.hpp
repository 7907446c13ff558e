#pragma once

#include "condyle/inspect.hpp"
#include "condyle/make_joint.hpp"
#include "support/parametric_shoulder.hpp"
#include "support/test.hpp"

/// A right hip of two solids of revolution whose abduction and adduction have a closed form, and strange things to put into its meshes.

namespace condyle::test {

/// Polar angles are from +Z, the opening; a neck of radius rho meets the socket's inner edge at (R, psi) after psi - asin(rho / R). A ridge
/// around the head meets a ridge in the socket before: bearing contact.
///
///        outer   ,-----.
///              /  ,---. \  edge (R, psi)
///             |  /     \ '
///             | |  head  ======== neck, radius rho   -> +Z
///             |  \     / .
///              \  '---' /
///                '-----'
struct RevolvedHip {
  double inner = 25, outer = 31, rim_deg = 85, head = 22, neck = 10, length = 60;
  double ridge = 1.6, ridge_deg = 110, bump = 1.8, bump_deg = 150;
  Index around = 48;

  double limit_deg() const { return rim_deg - std::asin(neck / inner) * 180 / std::numbers::pi; }
  /// Where the two ridges meet, about: each is a degree or two wide.
  double bearing_contact_deg() const { return bump_deg - ridge_deg; }

  TriMesh hip_bone() const {
    Profile profile = arc(inner, 180, rim_deg, bump_deg, inner - bump);
    const Profile outside = arc(outer, rim_deg, 180, -1, 0);
    profile.insert(profile.end(), outside.begin(), outside.end());
    return outwards(turned_solid(profile, around));
  }
  TriMesh femur() const {
    Profile profile =
        arc(head, 180, std::asin(neck / head) * 180 / std::numbers::pi, ridge_deg, head + ridge);
    profile.push_back({neck, length});
    profile.push_back({0, length});
    return outwards(turned_solid(profile, around));
  }

 private:
  using Profile = std::vector<std::array<double, 2>>;

  /// A vertex each three degrees, and one of another radius at `at`, without neighbours nearer than two degrees.
  static Profile arc(double radius, double from, double to, double at, double there) {
    constexpr int steps = 36;
    std::vector<std::array<double, 2>> polar;
    for (int i = 0; i <= steps; ++i) {
      const double t = from + (to - from) * i / steps;
      if (at < 0 || std::abs(t - at) >= 2) polar.push_back({t, radius});
    }
    if (at >= 0) {
      polar.push_back({at, there});
      std::sort(polar.begin(), polar.end(),
                [&](const auto& a, const auto& b) { return (a[0] < b[0]) == (from < to) && a[0] != b[0]; });
    }
    Profile points;
    for (const auto& [t, r] : polar) {
      const double angle = t * std::numbers::pi / 180;
      points.push_back({t == 180 ? 0 : r * std::sin(angle), r * std::cos(angle)});
    }
    return points;
  }
  static TriMesh outwards(TriMesh mesh) {
    return *inspect(mesh).signed_volume < 0 ? flipped(std::move(mesh)) : mesh;
  }
};

}  // namespace condyle::test
