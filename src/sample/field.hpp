#pragma once

#include <functional>
#include <span>
#include <vector>

#include "condyle/pose.hpp"

/// Solids as scalar fields: negative inside, positive outside, zero on the surface, growing by about one per
/// millimetre.
///
/// Bones are blended from a few round pieces. Every piece knows its gradient, so a point near the surface
/// finds it in a few Newton steps; blends are convex combinations of the pieces' gradients, so no blend is
/// steeper than its steepest piece.

namespace condyle::sample {

/// Value of a field in millimetres, and its gradient.
struct FieldValue {
  double value;
  Vec3 gradient;
};

/// Negative inside a solid. Must be safe to call from several threads.
using Field = std::function<FieldValue(const Vec3&)>;

/// A box with edges along the axes.
struct Box {
  Vec3 low, high;
};

/// A sphere of the skeleton that a piece of bone is stretched over.
struct Ball {
  Vec3 centre;
  double radius;
};

/// A circle in the plane through its centre at right angles to its axis, which has length one.
struct Circle {
  Vec3 centre, axis;
  double radius;
};

/// A solid, a box around it with some margin, and the places with details smaller than elsewhere.
struct Solid {
  Field field;
  Box box;
  std::vector<Ball> details;
};

/// Far above the rounding of values at some hundred millimetres: what bounds leave room for.
inline constexpr double rounding_mm = 1e-6;

/// A box around balls and what is stretched over them.
Box box_around(std::span<const Ball> balls);

/// Distance to a sphere.
FieldValue ball(const Ball& a, const Vec3& p) noexcept;

/// A bar between two balls: distance to the segment, less the radius interpolated along it.
///
///      .----------------.
///     (  a ---------- b  )
///      '----------------'
///
/// For |r_b - r_a| well below the length |b - a| this is near the hull of the two balls; it is not meant for
/// one ball inside the other.
FieldValue bar(const Ball& a, const Ball& b, const Vec3& p) noexcept;

/// A plate over three balls: distance to the triangle, less the radius interpolated over it. What does not
/// depend on the point is computed once.
class Plate {
 public:
  Plate() = default;
  Plate(const Ball& a, const Ball& b, const Ball& c) noexcept;

  FieldValue operator()(const Vec3& p) const noexcept;

  /// Whether the value is certainly above another one, for the price of a root: a disc around the triangle is
  /// no farther away than the triangle, and the plate is nowhere thicker than at its largest ball.
  bool is_above(double value, const Vec3& p) const noexcept;

 private:
  Ball a_ = {Vec3::Zero(), 0}, b_ = a_, c_ = a_;
  Vec3 normal_ = Vec3::Zero();   ///< twice the area long
  Vec3 upwards_ = Vec3::Zero();  ///< of length one
  double length_ = 0;
  /// Gradients of the barycentric coordinates of b and c: p's shadow in the plate is a + v ab + w ac.
  Vec3 grad_v_ = Vec3::Zero(), grad_w_ = Vec3::Zero();
  Ball disc_ = a_;  ///< around the triangle, in its plane
  double thickest_ = 0;
};

/// Distance to a tube around a circle. No gradient on the circle itself and on its axis, where no direction
/// is nearer than others.
FieldValue tube(const Circle& along, double tube_radius, const Vec3& p) noexcept;

/// The side p . normal < offset of a plane; `normal` of length one.
FieldValue half_space(const Vec3& normal, double offset, const Vec3& p) noexcept;

/// Union of two solids, the seam between them filled over the width `blend` in millimetres: where the values
/// differ by `blend` or more, the result is the smaller one to the last bit, so a piece keeps its exact shape
/// away from seams.
///
/// Polynomial minimum: with h = 1 - |a - b| / blend > 0, min(a, b) - blend h^2 / 4, whose slope is
/// continuous.
FieldValue joined(const FieldValue& a, const FieldValue& b, double blend) noexcept;

/// The same with a width > 0 that changes from place to place. Its slope counts at most a quarter: the
/// derivative of -blend h^2 / 4 by the width is -(1 - (1 - h)^2) / 4.
FieldValue joined(const FieldValue& a, const FieldValue& b, const FieldValue& blend) noexcept;

/// Intersection, its edge rounded in the same way.
FieldValue common(const FieldValue& a, const FieldValue& b, double blend) noexcept;

/// a without b, its edge rounded in the same way.
FieldValue without(const FieldValue& a, const FieldValue& b, double blend) noexcept;

}  // namespace condyle::sample
