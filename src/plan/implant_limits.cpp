#include <algorithm>
#include <cmath>

#include "condyle/implant.hpp"
#include "core/trigonometry.hpp"
#include "plan/implant_limits.hpp"

namespace condyle::plan {
namespace {

double tangent(Angle angle) noexcept {
  const auto [sine, cosine] = core::sine_cosine(angle.radians());
  return sine / cosine;
}

/// A face between two edges, each in the half-plane through the axis: along the axis out of the opening, and beside it.
struct Face {
  double inner_along, inner_beside, outer_along, outer_beside;
};

/// `share`: of the distance from the axis that is left in the middle of a chord of a facet; 1 for the body of revolution.
Face face_of(const LinerShape& liner, double share) noexcept {
  const auto [si, ci] = core::sine_cosine(liner.half_angle.radians());
  const auto [so, co] = core::sine_cosine((liner.half_angle - liner.chamfer).radians());
  return {-liner.radius_mm * ci, liner.radius_mm * si * share, -liner.outer_radius_mm * co,
          liner.outer_radius_mm * so * share};
}

/// Half-angle of the cone from the centre that holds the neck where it leaves the sphere of radius rho.
double half_width(const NeckShape& neck, double share, double rho) noexcept {
  const double a = neck.radius_mm * share, t = tangent(neck.taper) * share;
  // z^2 + (a + t z)^2 = rho^2
  const double q = 1 + t * t, root = std::sqrt(std::max(0.0, rho * rho * q - a * a));
  const double z = (root - a * t) / q;
  return core::arctangent(a + t * z, z);
}

/// The least of delta - gamma over the face: by places along it, then by golden section between the neighbours of the least.
double half_angle_of(const LinerShape& liner, double liner_share, const NeckShape& neck, double neck_share) {
  const Face face = face_of(liner, liner_share);
  const auto at = [&](double s) {
    const double along = face.inner_along + s * (face.outer_along - face.inner_along);
    const double beside = face.inner_beside + s * (face.outer_beside - face.inner_beside);
    return core::arctangent(beside, along) - half_width(neck, neck_share, core::hypotenuse(along, beside));
  };
  constexpr int places = 64;
  int least = 0;
  for (int i = 1; i <= places; ++i)
    if (at(static_cast<double>(i) / places) < at(static_cast<double>(least) / places)) least = i;
  double low = std::max(0, least - 1) / static_cast<double>(places),
         high = std::min(places, least + 1) / static_cast<double>(places);
  double best = at(static_cast<double>(least) / places);
  constexpr double golden = 0.6180339887498949;
  for (int i = 0; i < 60; ++i) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    const double at_a = at(a), at_b = at(b);
    best = std::min({best, at_a, at_b});
    (at_a < at_b ? high : low) = at_a < at_b ? b : a;
  }
  return best;
}

/// Where P + A cos t + B sin t falls to cos(half_angle).
struct Course {
  double P, A, B;

  /// Empty if it never does; 0 if it is below at the start.
  std::optional<double> first_below(double cosine) const noexcept {
    if (P + A < cosine) return 0;
    const double swing = core::hypotenuse(A, B);
    if (P - swing >= cosine) return std::nullopt;
    // cos(t - middle) = q: free while |t - middle| <= arccos q, which holds t = 0.
    const double q = std::clamp((cosine - P) / swing, -1.0, 1.0);
    const double half = core::arctangent(std::sqrt((1 - q) * (1 + q)), q);
    return std::max(0.0, core::arctangent(B, A) + half);
  }
};

}  // namespace

Angle contact_half_angle(const LinerShape& liner, const NeckShape& neck) noexcept {
  return Angle::radians(half_angle_of(liner, 1, neck, 1));
}

HalfAngles half_angles(const LinerShape& liner, const NeckShape& neck, int facets) noexcept {
  const double share = core::sine_cosine(two_pi / 2 / facets).cosine;
  const double exact = half_angle_of(liner, 1, neck, 1), rim = half_angle_of(liner, share, neck, 1),
               thin = half_angle_of(liner, 1, neck, share), both = half_angle_of(liner, share, neck, share);
  return {Angle::radians(exact), Angle::radians(std::min({exact, rim, thin, both})),
          Angle::radians(std::max({exact, rim, thin, both}))};
}

ClosedLimit closed_limit(const RevolvedPair& pair, CoordinateSystem system,
                         const motion::Motion& motion) noexcept {
  const Vec3 k = axis_of(motion.vary, system, motion.start) * sign_of(motion.sense);
  const Vec3 v = posed(pose_at(system, motion.start), pair.mobile_axis);
  const Vec3& c = pair.fixed_axis;
  const double P = k.dot(c) * k.dot(v);
  const Course course{P, c.dot(v) - P, c.dot(k.cross(v))};
  const auto end_at = [&](Angle half_angle) {
    const auto t = course.first_below(core::sine_cosine(half_angle.radians()).cosine);
    return t && *t < motion.range.radians() ? Angle::radians(*t) : motion.range;
  };
  ClosedLimit limit{end_at(pair.half_angle), motion::LimitReason::contact, end_at(pair.of_facets_low),
                    end_at(pair.of_facets_high)};
  if (limit.turned.radians() == 0)
    limit.reason = motion::LimitReason::contact_at_start;
  else if (limit.turned == motion.range)
    limit.reason = motion::LimitReason::end_of_range;
  return limit;
}

}  // namespace condyle::plan
