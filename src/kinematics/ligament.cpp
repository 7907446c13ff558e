#include "condyle/joint.hpp"

#include <algorithm>
#include <cmath>

#include "core/rotation_about.hpp"
#include "core/trigonometry.hpp"
#include "kinematics/ligament_path.hpp"

namespace condyle {
namespace kinematics {
namespace {

/// The part of a point's place that tangents to the wrap are drawn in: all of it at a sphere, across the axis of a cylinder.
Vec3 across(const LigamentWrap& wrap, const Vec3& from_centre) noexcept {
  if (wrap.shape == WrapShape::sphere) return from_centre;
  return from_centre - from_centre.dot(wrap.axis) * wrap.axis;
}

/// Any unit vector at a right angle to a unit vector and, at a cylinder, to its axis.
Vec3 beside(const LigamentWrap& wrap, const Vec3& e) noexcept {
  if (wrap.shape == WrapShape::cylinder) return wrap.axis.cross(e);
  int least = 0;
  e.cwiseAbs().minCoeff(&least);
  return e.cross(Vec3::Unit(least)).normalized();
}

Crossing straight_crossing(const Vec3& fixed, const Vec3& mobile) noexcept {
  const Vec3 along = mobile - fixed;
  const double length = along.norm();
  return {.length_mm = length,
          .direction = length > 0 ? Vec3(along / length) : Vec3::Zero(),
          .on_mobile = mobile};
}

/// Whether the segment comes within the ellipsoid, which is the unit sphere once it is scaled.
bool meets_ellipsoid(const LigamentWrap& wrap, const Vec3& from, const Vec3& to) noexcept {
  const auto scaled = [&](const Vec3& p) -> Vec3 {
    return (wrap.axes.transpose() * (p - wrap.centre)).cwiseQuotient(wrap.radii_mm);
  };
  const Vec3 a = scaled(from), along = scaled(to) - a;
  const double squared = along.squaredNorm();
  const double at = squared > 0 ? std::clamp(-a.dot(along) / squared, 0.0, 1.0) : 0.0;
  return (a + at * along).squaredNorm() < 1;
}

}  // namespace

double distance_from_middle(const LigamentWrap& wrap, const Vec3& point) noexcept {
  return across(wrap, point - wrap.centre).norm();
}

namespace {

/// Where a path lies on its wrap, seen along the axis of a cylinder, or across the plane of both points and the centre of a sphere:
///
///          a                      t_a = sqrt(|a|^2 - r^2), alpha = atan2(t_a, r): from a to where its tangent
///         / `.  t_a               touches; likewise of b. With gamma between a and b seen from the centre it
///        /    ` A                 wraps if gamma > alpha + beta, over r (gamma - alpha - beta).
///       o gamma  )  r             Unrolled, the path on a cylinder is a straight line: with the height h
///        \    . B                 between the ends its length is sqrt(P^2 + h^2), P seen along the axis.
///         \ .'  t_b
///          b
struct OnWrap {
  Vec3 e, n;               ///< towards a, and across it on the side of b
  double alpha, last;      ///< angles from e at which it touches first and last
  double t_a, seen_along;  ///< P
  double from, height;     ///< along the axis of a cylinder: where a is, and h; else 0

  Vec3 at(const LigamentWrap& wrap, double angle) const noexcept {
    const auto [sine, cosine] = core::sine_cosine(angle);
    const double share = (t_a + wrap.radius_mm * (angle - alpha)) / seen_along;
    return wrap.centre + wrap.radius_mm * (cosine * e + sine * n) + (from + share * height) * wrap.axis;
  }
  /// Unit, of the path where it touches.
  Vec3 direction(const LigamentWrap& wrap, double angle) const noexcept {
    const auto [sine, cosine] = core::sine_cosine(angle);
    return (seen_along * (cosine * n - sine * e) + height * wrap.axis) / core::hypotenuse(seen_along, height);
  }
};

enum class Passes { by, over, unknown };

/// How the part between these points passes its wrap, a sphere or a cylinder; fills `path` if it lies on it.
Passes passes(const Vec3& fixed, const Vec3& mobile, const LigamentWrap& wrap, OnWrap& path) noexcept {
  const double r = wrap.radius_mm;
  const Vec3 from_a = fixed - wrap.centre, from_b = mobile - wrap.centre;
  const Vec3 a = across(wrap, from_a), b = across(wrap, from_b);
  const double to_a = a.norm(), to_b = b.norm();
  if (to_a < r || to_b < r) return Passes::unknown;
  const double gamma = core::arctangent(a.cross(b).norm(), a.dot(b));
  const double t_a = std::sqrt((to_a - r) * (to_a + r)), t_b = std::sqrt((to_b - r) * (to_b + r));
  const double alpha = core::arctangent(t_a, r), beta = core::arctangent(t_b, r);
  const double touched = gamma - alpha - beta;
  if (!(touched > 0)) return Passes::by;
  const Vec3 e = a / to_a, aside = b - b.dot(e) * e;
  const bool is_cylinder = wrap.shape == WrapShape::cylinder;
  path = {.e = e,
          .n = aside.norm() > 1e-12 * to_b ? Vec3(aside.normalized()) : beside(wrap, e),
          .alpha = alpha,
          .last = gamma - beta,
          .t_a = t_a,
          .seen_along = t_a + r * touched + t_b,
          .from = is_cylinder ? from_a.dot(wrap.axis) : 0.0,
          .height = is_cylinder ? (from_b - from_a).dot(wrap.axis) : 0.0};
  return Passes::over;
}

}  // namespace

std::optional<Crossing> crossing(const Vec3& fixed, const Vec3& mobile, const LigamentWrap* wrap) noexcept {
  if (!wrap) return straight_crossing(fixed, mobile);
  if (wrap->shape == WrapShape::ellipsoid)
    return meets_ellipsoid(*wrap, fixed, mobile) ? std::nullopt
                                                 : std::optional(straight_crossing(fixed, mobile));
  OnWrap on;
  switch (passes(fixed, mobile, *wrap, on)) {
    case Passes::by:
      return straight_crossing(fixed, mobile);
    case Passes::unknown:
      return std::nullopt;
    case Passes::over:
      break;
  }
  // The straight piece between the bodies ends at the wrap on its own body.
  const bool on_fixed = wrap->body == BodyRole::fixed;
  const double touches = on_fixed ? on.last : on.alpha;
  return Crossing{.length_mm = core::hypotenuse(on.seen_along, on.height),
                  .wraps = true,
                  .direction = on.direction(*wrap, touches),
                  .on_mobile = on_fixed ? mobile : on.at(*wrap, touches)};
}

std::vector<Vec3> ligament_points(const Ligament& ligament, const Pose& X_FM) {
  std::vector<Vec3> points = ligament.fixed;
  LigamentWrap in_fixed;
  const LigamentWrap* wrap = wrap_in_fixed(ligament, X_FM, in_fixed);
  OnWrap on;
  if (wrap && wrap->shape != WrapShape::ellipsoid &&
      passes(points.back(), posed(X_FM, ligament.mobile.back()), *wrap, on) == Passes::over) {
    constexpr double widest = 0.1;  // rad
    const int steps = 1 + static_cast<int>((on.last - on.alpha) / widest);
    for (int i = 0; i <= steps; ++i)
      points.push_back(on.at(*wrap, on.alpha + (on.last - on.alpha) * i / steps));
  }
  for (auto point = ligament.mobile.rbegin(); point != ligament.mobile.rend(); ++point)
    points.push_back(posed(X_FM, *point));
  return points;
}

std::vector<LigamentSigma> ligament_sigmas(const Joint& joint) {
  std::vector<LigamentSigma> all;
  for (const Ligament& ligament : joint.ligaments) {
    if (!ligament.ends_at_strain) continue;
    if (ligament.slack_sigma_mm > 0)
      all.push_back({ligament.name + ".slack_length", ligament.slack_sigma_mm, 1});
    if (ligament.point_sigma_mm > 0)
      all.push_back({ligament.name + ".points", ligament.point_sigma_mm,
                     3 * (ligament.fixed.size() + ligament.mobile.size())});
  }
  return all;
}

void shift(Ligament& ligament, const Vec3& fixed_by, const Vec3& mobile_by) noexcept {
  for (Vec3& point : ligament.fixed) point += fixed_by;
  for (Vec3& point : ligament.mobile) point += mobile_by;
  if (ligament.wrap) ligament.wrap->centre += ligament.wrap->body == BodyRole::fixed ? fixed_by : mobile_by;
}

LigamentStretch stretch_of(const Ligament& ligament, const std::optional<LigamentState>& state) noexcept {
  // Less strain than this short of the end is at it: limits end there to rounding.
  constexpr double at_end = 1e-9;
  if (!state) return LigamentStretch::unknown;
  if (ligament.ends_at_strain && state->strain > *ligament.ends_at_strain - at_end)
    return LigamentStretch::at_end;
  return state->strain > 0 ? LigamentStretch::taut : LigamentStretch::slack;
}

const LigamentWrap* wrap_in_fixed(const Ligament& ligament, const Pose& X_FM,
                                  LigamentWrap& storage) noexcept {
  if (!ligament.wrap) return nullptr;
  storage = *ligament.wrap;
  if (storage.body == BodyRole::mobile) {
    storage.centre = posed(X_FM, storage.centre);
    storage.axis = X_FM.linear() * storage.axis;
    storage.axes = X_FM.linear() * storage.axes;
  }
  return &storage;
}

double constant_length_mm(const Ligament& ligament) noexcept {
  double length = 0;
  for (const auto* points : {&ligament.fixed, &ligament.mobile})
    for (std::size_t i = 1; i < points->size(); ++i) length += ((*points)[i] - (*points)[i - 1]).norm();
  return length;
}

}  // namespace kinematics

std::string_view name_of(WrapShape shape) noexcept {
  constexpr std::string_view names[] = {"sphere", "cylinder", "ellipsoid"};
  return names[static_cast<std::size_t>(shape)];
}

double tension_n(const Ligament& ligament, double strain) noexcept {
  if (!(strain > 0)) return 0;
  const double k = ligament.stiffness_n, c = ligament.transition_strain;
  return strain < c ? k * strain * strain / (2 * c) : k * (strain - c / 2);
}

double energy_nmm(const Ligament& ligament, double strain) noexcept {
  if (!(strain > 0)) return 0;
  const double k = ligament.stiffness_n, c = ligament.transition_strain, toe = std::min(strain, c);
  const double in_toe = c > 0 ? k * toe * toe * toe / (6 * c) : 0;
  const double beyond = strain > c ? k * (strain - c) * strain / 2 : 0;
  return ligament.slack_length_mm * (in_toe + beyond);
}

std::optional<LigamentState> ligament_state(const Ligament& ligament, const Pose& X_FM) noexcept {
  LigamentWrap in_fixed;
  const auto path = kinematics::crossing(ligament.fixed.back(), posed(X_FM, ligament.mobile.back()),
                                         kinematics::wrap_in_fixed(ligament, X_FM, in_fixed));
  if (!path) return std::nullopt;
  LigamentState state{.length_mm = path->length_mm + kinematics::constant_length_mm(ligament),
                      .wraps = path->wraps};
  state.strain = (state.length_mm - ligament.slack_length_mm) / ligament.slack_length_mm;
  state.tension_n = tension_n(ligament, state.strain);
  state.energy_nmm = energy_nmm(ligament, state.strain);
  state.force_n = -state.tension_n * path->direction;
  state.moment_nmm = path->on_mobile.cross(state.force_n);
  return state;
}

std::optional<Eigen::Matrix<double, 6, 6>> ligament_stiffness(const Ligament& ligament,
                                                              const Pose& X_FM) noexcept {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  // A rotation moves what lies half a joint across about as far as a translation.
  constexpr double travel_mm = 1e-4, turn_rad = travel_mm / 20;
  const auto wrench_after = [&](int motion, double by, Vector6& wrench) {
    Vector6 step = Vector6::Zero();
    step[motion] = by;
    const Pose X = core::moved_by(X_FM, step.head<3>(), step.tail<3>());
    const auto state = ligament_state(ligament, X);
    if (state) wrench << state->force_n, state->moment_nmm - X.translation().cross(state->force_n);
    return state.has_value();
  };
  Eigen::Matrix<double, 6, 6> stiffness;
  for (int motion = 0; motion < 6; ++motion) {
    const double by = motion < 3 ? travel_mm : turn_rad;
    Vector6 before, after;
    if (!wrench_after(motion, -by, before) || !wrench_after(motion, by, after)) return std::nullopt;
    stiffness.col(motion) = (before - after) / (2 * by);
  }
  return stiffness;
}

}  // namespace condyle
