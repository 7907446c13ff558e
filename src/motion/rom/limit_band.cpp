#include "condyle/limit_band.hpp"

#include <algorithm>
#include <array>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <mutex>
#include <numbers>
#include <random>

#include "condyle/error.hpp"
#include "core/parallel.hpp"
#include "mesh/vertex_normals.hpp"
#include "motion/rom/overlap.hpp"
#include "motion/search/first_contact.hpp"

namespace condyle {
namespace {

constexpr std::size_t fewest_samples = 20;

/// One joint of a band: how far it is from the one given.
struct Displacement {
  Vec3 centre = Vec3::Zero();                    ///< mm
  Vec3 axes = Vec3::Zero();                      ///< rotation vector, rad
  double fixed_surface = 0, mobile_surface = 0;  ///< along normals, mm
};
constexpr std::size_t dimensions = 8;

enum class Source { all, centre, axes, surface };

/// What is to be computed: all of it together, and each source alone where it is not the only one.
std::vector<Source> sources_of(const Uncertainty& sigma) {
  std::vector<Source> moving;
  if (sigma.centre_mm > 0) moving.push_back(Source::centre);
  if (sigma.axes > Angle()) moving.push_back(Source::axes);
  if (sigma.surface_mm > 0) moving.push_back(Source::surface);
  if (moving.size() < 2) return {Source::all};
  moving.insert(moving.begin(), Source::all);
  return moving;
}

bool moves(const Uncertainty& sigma, Source source) {
  return source == Source::centre ? sigma.centre_mm > 0
         : source == Source::axes ? sigma.axes > Angle()
                                  : sigma.surface_mm > 0;
}

/// Of the displacement only what one source moves.
Displacement only(Source source, Displacement d) {
  if (source == Source::all) return d;
  if (source != Source::centre) d.centre.setZero();
  if (source != Source::axes) d.axes.setZero();
  if (source != Source::surface) d.fixed_surface = d.mobile_surface = 0;
  return d;
}

/// Numbers in [0, 1) of the generator's upper 53 bits: std::uniform_real_distribution may differ between libraries.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : bits_(seed) {}
  double operator()() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
  std::size_t below(std::size_t count) {
    return std::min(static_cast<std::size_t>((*this)() * static_cast<double>(count)), count - 1);
  }

 private:
  std::mt19937_64 bits_;
};

/// A Latin hypercube: of every coordinate one value in each of `count` strata of equal probability.
std::vector<Displacement> displacements(const BandOptions& options) {
  const std::size_t count = options.samples;
  Uniform uniform(options.seed);
  std::vector<std::array<double, dimensions>> standard(count);
  std::vector<std::size_t> stratum(count);
  for (std::size_t k = 0; k < dimensions; ++k) {
    for (std::size_t i = 0; i < count; ++i) stratum[i] = i;
    for (std::size_t i = count; i-- > 1;) std::swap(stratum[i], stratum[uniform.below(i + 1)]);
    for (std::size_t i = 0; i < count; ++i) {
      // Within the stratum, clear of 0 and 1.
      const double u =
          (static_cast<double>(stratum[i]) + 0.005 + 0.99 * uniform()) / static_cast<double>(count);
      standard[i][k] = -std::numbers::sqrt2 * boost::math::erfc_inv(2 * u);
    }
  }
  const Uncertainty& sigma = options.sigma;
  std::vector<Displacement> out;
  for (const auto& z : standard)
    out.push_back({sigma.centre_mm * Vec3(z[0], z[1], z[2]), sigma.axes.radians() * Vec3(z[3], z[4], z[5]),
                   sigma.surface_mm * z[6], sigma.surface_mm * z[7]});
  return out;
}

/// Motions that one search about one axis answers: those with the same start that vary the same angle.
struct Group {
  JointAngle vary;
  JointAngles start;
  RotationRange range{Angle(), Angle()};
  std::vector<std::size_t> motions;

  /// Whether the axis is the same in the body that rests.
  bool shares_axis(const Group& other) const noexcept {
    return vary == other.vary && (vary != JointAngle::adduction || start.flexion == other.start.flexion);
  }
};

/// Groups about one axis follow each other.
std::vector<Group> grouped(std::span<const Motion> motions) {
  std::vector<Group> groups;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const Motion& motion = motions[i];
    auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& g) {
      return g.vary == motion.vary && g.start == motion.start;
    });
    if (group == groups.end())
      group = groups.insert(group, {motion.vary, motion.start, {Angle(), Angle()}, {}});
    Angle& end = motion.sense == RotationSense::positive ? group->range.positive : group->range.negative;
    const Angle asked = motion.range * sign_of(motion.sense);
    if (std::abs(asked.radians()) > std::abs(end.radians())) end = asked;
    group->motions.push_back(i);
  }
  std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
    return std::pair(a.vary, a.start.flexion) < std::pair(b.vary, b.start.flexion);
  });
  return groups;
}

/// Mean of the triangles around each vertex weighted by area; zero where no triangle uses it.
Points unit_normals(const TriMesh& mesh) {
  Points normals = mesh::area_normals(mesh);
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const Vec3 normal = normals[v];
    if (normal.squaredNorm() > 0) normals.set(v, normal.normalized());
  }
  return normals;
}

/// A body as its search reads it, its surface movable along its normals.
class Surface {
 public:
  Surface(const Mesh& whole, const Mesh& part)
      : vertices_(whole.vertices()), normals_(unit_normals(whole)), tree_(part) {}

  const motion::FeatureTree& tree() const noexcept { return tree_; }
  motion::FeatureTree moved_by(double mm) const {
    Points moved(vertices_.size());
    for (std::size_t v = 0; v < moved.size(); ++v) moved.set(v, vertices_[v] + mm * normals_[v]);
    return tree_.moved_to(moved);
  }

 private:
  Points vertices_, normals_;
  motion::FeatureTree tree_;
};

/// The joint that all samples are displaced from.
class BandJoint {
 public:
  BandJoint(const Joint& joint, const motion::PartsOfJoint& parts, const JointAngles& reference,
            std::span<const Motion> motions)
      : system_(joint.coordinates()),
        X_ref_(pose_at(joint.coordinates(), reference)),
        motions_(motions),
        groups_(grouped(motions)),
        fixed_(joint.fixed.mesh, parts.fixed.mesh),
        mobile_(joint.mobile.mesh, parts.mobile.mesh) {}

  /// Writes one outcome per motion. The frame G of the displaced joint lies at X_FG in F; with both bodies where the
  /// reference pose q0 has them, the mobile body at the angles q is at
  ///
  ///     X_FM = X_FG R(q) A^-1,   A = R(q0)^-1 X_FG R(q0), where G's mobile frame lies in M
  void limits(const Displacement& d, std::span<DisplacedLimit> out) const {
    std::optional<motion::FeatureTree> moved_fixed, moved_mobile;
    if (d.fixed_surface != 0) moved_fixed.emplace(fixed_.moved_by(d.fixed_surface));
    if (d.mobile_surface != 0) moved_mobile.emplace(mobile_.moved_by(d.mobile_surface));
    const auto &fixed = moved_fixed ? *moved_fixed : fixed_.tree(),
               &mobile = moved_mobile ? *moved_mobile : mobile_.tree();
    motion::TurningBody resting_fixed(fixed), resting_mobile(mobile), turning_fixed(fixed),
        turning_mobile(mobile);

    Pose X_FG = Pose::Identity();
    X_FG.translation() = d.centre;
    if (const double angle = d.axes.norm(); angle > 0)
      X_FG.linear() = Eigen::AngleAxisd(angle, d.axes / angle).toRotationMatrix();
    const Pose A = inverted(X_ref_) * X_FG * X_ref_;

    const Group* before = nullptr;
    for (const Group& group : groups_) {
      const Pose X_FM = X_FG * pose_at(system_, group.start) * inverted(A);
      const bool turns_fixed = group.vary == JointAngle::internal_rotation;
      motion::TurningBody& resting = turns_fixed ? resting_mobile : resting_fixed;
      motion::TurningBody& turning = turns_fixed ? turning_fixed : turning_mobile;
      const AxisFrame axis =
          turns_fixed
              ? AxisFrame(A.translation(), A.linear() * -axis_of(group.vary, system_, {}))
              : AxisFrame(X_FG.translation(), X_FG.linear() * axis_of(group.vary, system_, group.start));
      if (!before || !before->shares_axis(group)) resting.start_at(axis, Pose::Identity());
      before = &group;
      turning.start_at(axis, turns_fixed ? inverted(X_FM) : X_FM);
      const RotationLimits both = motion::first_contact(resting, turning, group.range);
      for (const std::size_t i : group.motions) {
        const Limit& end = motions_[i].sense == RotationSense::positive ? both.positive : both.negative;
        const bool reaches_end = end.turned >= motions_[i].range;
        out[i] = {reaches_end ? motions_[i].range : end.turned,
                  reaches_end ? LimitReason::end_of_range : end.reason};
      }
    }
  }

 private:
  CoordinateSystem system_;
  Pose X_ref_;
  std::span<const Motion> motions_;
  std::vector<Group> groups_;
  Surface fixed_, mobile_;
};

/// Of sorted values, linear between neighbours (type 7 of Hyndman and Fan 1996).
double quantile(const std::vector<double>& sorted, double q) {
  const double at = q * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (at - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

void check(const BandOptions& options, std::span<const Motion> motions, JointKind kind) {
  if (options.samples < fewest_samples)
    throw UsageError("band: " + std::to_string(fewest_samples) + " samples or more are needed");
  const auto bad = [](double sigma) { return !(sigma >= 0) || !std::isfinite(sigma); };
  const Uncertainty& sigma = options.sigma;
  if (bad(sigma.centre_mm) || bad(sigma.axes.radians()) || bad(sigma.surface_mm))
    throw UsageError("band: standard deviations must be 0 or more");
  for (const Motion& motion : motions) check_motion(motion, kind);
}

BandJoint band_joint(const Joint& joint, std::span<const Motion> motions, const RangeOptions& range) {
  const auto bearing = find_bearing_surface(joint, range.bearing).surface;
  return BandJoint(joint, motion::parts_that_count(joint, range.overlap, bearing, range.bearing.rule),
                   range.overlap.reference_pose, motions);
}

}  // namespace

std::optional<std::vector<LimitBand>> limit_bands(const Joint& joint, std::span<const Motion> motions,
                                                  const RangeOptions& range, const BandOptions& options,
                                                  const BandControl& control) {
  check(options, motions, joint.kind);
  const BandJoint displaced = band_joint(joint, motions, range);
  const std::vector<Displacement> samples = displacements(options);

  // Outcomes by source, sample and motion.
  const std::vector<Source> sources = sources_of(options.sigma);
  const std::size_t count = samples.size(), width = motions.size(), total = sources.size() * count;
  std::vector<DisplacedLimit> outcomes(total * width);
  std::size_t done = 0;
  std::mutex reporting;
  core::parallel_chunks(total, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last && !control.stop.stop_requested(); ++i) {
      displaced.limits(only(sources[i / count], samples[i % count]),
                       std::span(outcomes).subspan(i * width, width));
      const std::scoped_lock lock(reporting);
      ++done;
      if (control.progress) control.progress(done, total);
    }
  });
  if (done < total) return std::nullopt;

  std::vector<LimitBand> bands;
  for (std::size_t m = 0; m < width; ++m) {
    const auto sorted = [&](std::size_t source) {
      std::vector<double> values;
      for (std::size_t i = 0; i < count; ++i)
        values.push_back(outcomes[(source * count + i) * width + m].turned.radians());
      std::sort(values.begin(), values.end());
      return values;
    };
    const auto width_of = [&](Source source) {
      if (!moves(options.sigma, source)) return Angle();
      // Where it is the only one, all of it is its own.
      const auto at = std::find(sources.begin(), sources.end(), source);
      const auto values = sorted(at == sources.end() ? 0 : static_cast<std::size_t>(at - sources.begin()));
      return Angle::radians(quantile(values, 0.95) - quantile(values, 0.05));
    };
    const auto share = [&](LimitReason reason) {
      std::size_t with = 0;
      for (std::size_t i = 0; i < count; ++i) with += outcomes[i * width + m].reason == reason;
      return static_cast<double>(with) / static_cast<double>(count);
    };
    const auto all = sorted(0);
    bands.push_back({Angle::radians(quantile(all, 0.05)),
                     Angle::radians(quantile(all, 0.5)),
                     Angle::radians(quantile(all, 0.95)),
                     {width_of(Source::centre), width_of(Source::axes), width_of(Source::surface)},
                     share(LimitReason::end_of_range),
                     share(LimitReason::contact_at_start)});
  }
  return bands;
}

std::vector<LimitBand> limit_bands(const Joint& joint, std::span<const Motion> motions,
                                   const RangeOptions& range, const BandOptions& options) {
  return *limit_bands(joint, motions, range, options, {});
}

std::vector<DisplacedLimit> limits_about(const Joint& joint, std::span<const Motion> motions,
                                         const RangeOptions& range, std::span<const Vec3> centres) {
  for (const Motion& motion : motions) check_motion(motion, joint.kind);
  const BandJoint displaced = band_joint(joint, motions, range);
  std::vector<DisplacedLimit> limits(centres.size() * motions.size());
  core::parallel_chunks(centres.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      displaced.limits({.centre = centres[i]}, std::span(limits).subspan(i * motions.size(), motions.size()));
  });
  return limits;
}

}  // namespace condyle
