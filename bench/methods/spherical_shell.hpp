#pragma once

#include <algorithm>
#include <span>

#include "ball.hpp"

namespace bench {

/// Directions within an angle of an axis; less than a right angle, so that it is convex, or all directions.
struct Cap {
  condyle::Vec3 axis = condyle::Vec3::UnitX();
  double cos = -1, sin = 0;

  bool is_all() const { return cos < 0; }

  /// The most that d . u reaches over the unit vectors u of the cap.
  double reach(const condyle::Vec3& d) const {
    const double along = d.dot(axis), across = d.cross(axis).norm();
    if (is_all() || across * cos <= along * sin) return d.norm();
    return along * cos + across * sin;
  }
};

/// The part of the space between two concentric spheres that a cone from their centre cuts out:
///
///         . - ' ' - .
///        '. - ' ' - .'   outer
///          .       .     inner
///           .     .
///             . .        centre
///
/// Krishnan, Pattekar, Lin, Manocha 1998, "Spherical shell: a higher order bounding volume for fast proximity
/// queries". It follows a curved patch, so that shells come apart sooner than boxes where surfaces nearly
/// touch, and costs more to test.
struct SphericalShell {
  condyle::Vec3 centre = condyle::Vec3::Zero();
  double inner = 0, outer = 0;
  Cap cap;
  Ball ball;  ///< Of the same triangles.

  /// About triangles, three corners each; its centre by least squares.
  static SphericalShell around(std::span<const condyle::Vec3> corners);

  SphericalShell posed(const condyle::Pose& X) const;

  /// Whether nothing shows them apart: the balls, the distances of each from the other's centre, the cones
  /// about each other's balls.
  bool meets(const SphericalShell& other) const {
    return ball.meets(other.ball) && !is_beside(other) && !other.is_beside(*this) &&
           !looks_past(other.ball) && !other.looks_past(ball);
  }

  double size() const { return ball.radius; }

 private:
  bool is_beside(const SphericalShell& other) const;
  bool looks_past(const Ball& other) const;
  void widen(const condyle::Vec3& before);
};

}  // namespace bench
