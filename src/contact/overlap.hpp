#pragma once

#include <span>
#include <vector>

#include "condyle/contact.hpp"

/// The space inside two bodies at once, by signed prisms. docs/mathematics/03-both-directions.md.

namespace condyle::contact {

/// A body's surface in F, and what is known of it against the other body.
struct OverlapBody {
  const TriMesh& surface;
  /// One per vertex; empty if the other body is open and has no inside.
  std::span<const PointState> states;
};

/// The part of a triangle that is inside the other body.
struct PatchPart {
  Index triangle;
  double area;
  Vec3 centroid;  ///< in F
};

struct Overlap {
  /// Integral over space of the product of both winding numbers: the volume, where neither is above 1. mm^3, with a bound on its
  /// error: what all roundings after the vertices in F can amount to.
  double volume = 0, volume_error = 0;
  /// Below 0 it is none: a body that crosses itself is inside out there.
  [[nodiscard]] bool has_volume() const noexcept { return volume >= -volume_error; }
  /// How much of that is counted again because a body covers space of the overlap more than once, mm^3: the integral of w - 1 where w is
  /// above 1 and the other body is. 0 if it is no more than rounding.
  double fixed_covered_again = 0, mobile_covered_again = 0;
  /// In the order of triangles; of a body without states none.
  std::vector<PatchPart> fixed, mobile;
};

/// `pairs` are all intersecting pairs of the two surfaces. The volume is 0 unless both bodies have states. On all threads; the same
/// bits whatever their number.
///
/// Where surfaces coincide, to rounding, a part of the surface belongs to the patch if the space just below it, on the inner side of
/// its own body, is inside the other body: bodies that touch have no patch there, and a body with itself all of its surface.
Overlap overlap_of(const OverlapBody& fixed, const OverlapBody& mobile, std::span<const TrianglePair> pairs);

}  // namespace condyle::contact
