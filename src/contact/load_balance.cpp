#include "condyle/pressure.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "condyle/error.hpp"
#include "contact/elastic_parts.hpp"
#include "core/coordinate_range.hpp"
#include "core/formatted.hpp"
#include "core/rotation_about.hpp"

namespace condyle::contact {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using contact::MobileLoad;
/// Along what is free, six motions at most: no memory is asked for.
using FreeVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
using FreeMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
/// Columns are translations and rotations about the origin of M, in F.
using FreeMotions = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6>;
/// For square matrices: they need no preconditioner.
using Svd = Eigen::JacobiSVD<FreeMatrix, Eigen::NoQRPreconditioner>;

/// A stiffness below this share of the largest one is rounding: flat and prismatic contacts have none along themselves.
constexpr double least_stiffness = 1e-9;
/// Steps longer than this leave the contact that they were computed from, mm.
constexpr double longest_step = 1;
/// Steps of the search along the load, mm: much less than cartilage is thick.
constexpr double search_step = 0.1;
/// The same if the contact already shows the distance.
constexpr double longest_search_step = 0.3;
/// The part of a step that is enough to know how far it leads: of walks on a hip's cartilages a half leaves more of the load at
/// jumps, an eighth balances fewer frames.
constexpr double least_part = 1.0 / 4;
/// If the load changes by this many times the change that the stiffness predicts, it jumps. At 4, fewer frames
/// converge; at 16, no more do and steps increase.
constexpr double steepest_change = 8;
/// How far the mobile body is moved in each sense to measure stiffness across jumps of the force, mm: some faces of a cartilage mesh
/// then pass its rim.
constexpr double measured_travel = 0.05;
/// Over shorter distances the stored energy shows nothing: a face that begins or ceases to meet the other surface
/// changes it by more than the distance does.
constexpr double least_climb = measured_travel;
/// Rotations that move the surfaces about as far, rad: half a joint across is some 20 mm.
constexpr double measured_angle = measured_travel / 20;

/// Layers that are compressed by so much of their thickness have no more to give; by all of it, the law says nothing any more.
constexpr double exhausted_strain = 0.9, whole_strain = 1;

/// Contact that carries less than this share of a force does not hold it: a corner that is grazed while leaving.
constexpr double least_carried_share = 0.05;

/// Which small motions of M are free.
FreeMotions free_motions(const BalanceOptions& options) {
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> translations = Eigen::Matrix3d::Identity();
  if (!options.free_directions.empty()) {
    const auto count = static_cast<Eigen::Index>(options.free_directions.size());
    FreeMatrix directions = FreeMatrix::Zero(3, 3);
    for (Eigen::Index i = 0; i < std::min<Eigen::Index>(count, 3); ++i)
      directions.col(i) = options.free_directions[static_cast<std::size_t>(i)];
    if (!directions.allFinite()) throw UsageError("a free direction is not finite");
    const Svd svd(directions, Eigen::ComputeFullU | Eigen::ComputeFullV);
    if (svd.rank() < count) throw UsageError("the free directions depend on each other");
    translations = svd.matrixU().leftCols(count);
  }
  const Eigen::Index rotations = options.free_rotations ? 3 : 0;
  FreeMotions motions = FreeMotions::Zero(6, translations.cols() + rotations);
  motions.topLeftCorner(3, translations.cols()) = translations;
  if (options.free_rotations) motions.bottomRightCorner(3, 3).setIdentity();
  return motions;
}

Pose moved(const Pose& X, const Vector6& by) {
  return core::moved_by(X, by.head<3>(), by.tail<3>());
}

class Search {
 public:
  Search(const ElasticContact& contact, const Pose& start, const Load& load, const BalanceOptions& options)
      : contact_(contact), options_(options), load_(load), start_(start), free_(free_motions(options)) {
    core::require_rotation(start);
    if (!load.on_mobile.force_n.allFinite() || !load.on_mobile.moment_nmm.allFinite())
      throw UsageError("the load is not finite");
    if (!(options.most_left_at_jump >= 0 && options.most_left_at_jump <= 1))
      throw UsageError("most_left_at_jump: the residual share of the load must be from 0 to 1");
    if (options.ligaments.empty() && along_free(load_at(start)).isZero(0))
      throw UsageError("the load is zero along the free directions");
    pull_n_ = pulled(start).tension_n;
    out_.X_FM = start;
  }

  BalancedPose run() {
    answers_ = contact_.parts().pool.take(), tried_ = contact_.parts().pool.take();
    out_.outcome = explained(find());
    out_.contact = contact_.parts().results_of(*answers_, contact_.parts().load_of(*answers_, out_.X_FM));
    contact_.parts().pool.put_back(std::move(answers_));
    out_.residual = {residual_.head<3>(), residual_.tail<3>()};
    return std::move(out_);
  }

 private:
  Vector6 load_at(const Pose& X) const {
    Vector6 load;
    load << load_.on_mobile.force_n, load_.on_mobile.moment_nmm;
    if (load_.frame == BodyRole::mobile)
      load << X.linear() * load_.on_mobile.force_n, X.linear() * load_.on_mobile.moment_nmm;
    return load;
  }
  Vector6 along_free(const Vector6& wrench) const { return free_ * (free_.transpose() * wrench); }
  /// Residual along the free directions, as a wrench.
  Vector6 left(const Pose& X, const MobileLoad& carried) const {
    return along_free(carried.wrench + load_at(X));
  }
  /// Rotations count by the force they take at this arm, mm: half a joint across.
  static double size_of(const Vector6& wrench) {
    return core::hypotenuse(wrench.head<3>().norm(), wrench.tail<3>().norm() / 20);
  }

  bool is_small(const Vector6& residual) const {
    return residual.head<3>().norm() <= options_.force_tolerance_n &&
           residual.tail<3>().norm() <= options_.moment_tolerance_nmm;
  }
  bool is_near(const Pose& X) const {
    return (X.translation() - start_.translation()).norm() <= options_.farthest_mm;
  }

  Motions motions() const { return options_.free_rotations ? Motions::all : Motions::translations; }

  /// What the ligaments put on the mobile body, about its origin.
  struct Pull {
    Vector6 wrench = Vector6::Zero();
    double energy = 0, tension_n = 0;
    std::size_t taut = 0;
  };
  Pull pulled(const Pose& X) const {
    Pull pull;
    for (const Ligament& ligament : options_.ligaments) {
      const auto state = ligament_state(ligament, X);
      if (!state) refuse_unknown(ligament);
      pull.wrench.head<3>() += state->force_n;
      pull.wrench.tail<3>() += state->moment_nmm - X.translation().cross(state->force_n);
      pull.energy += state->energy_nmm;
      pull.tension_n += state->tension_n;
      pull.taut += state->tension_n > 0;
    }
    return pull;
  }

  [[noreturn]] static void refuse_unknown(const Ligament& ligament) {
    throw UsageError("ligament " + ligament.name + ": its length is not known near the balance");
  }

  /// How the load of contact and ligaments changes with small motions.
  LoadChange change_of(const ElasticContact::Parts::Answers& answers, const Pose& X, Motions which) const {
    LoadChange change = contact_.parts().change_of(answers, X, which);
    for (const Ligament& ligament : options_.ligaments) {
      const auto stiffness = ligament_stiffness(ligament, X);
      if (!stiffness) refuse_unknown(ligament);
      change -= *stiffness;
    }
    return change;
  }

  /// The load at a pose that is tried, its answers kept until the next.
  MobileLoad tried(const Pose& X) {
    contact_.parts().answer(X, *tried_);
    MobileLoad load = contact_.parts().load_of(*tried_, X);
    if (!options_.ligaments.empty()) {
      const Pull pull = pulled(X);
      load.wrench += pull.wrench;
      load.energy += pull.energy;
      load.samples += pull.taut;
    }
    const Vec3 force = along_free(load_at(X)).head<3>();
    // How much of the force is carried: poses of the search are compared by it.
    const double carried = force.isZero() ? 0 : -load.wrench.head<3>().dot(force) / force.squaredNorm();
    if (load.samples > 0 && (!most_ || carried > most_->carried)) most_ = Most{X, carried, load.strain};
    if (const double size = size_of(left(X, load)); !least_ || size < least_->size) least_ = Least{X, size};
    return load;
  }
  /// The pose tried last is the one to go on from.
  void take(const Pose& X, const MobileLoad& load) {
    out_.X_FM = X;
    now_ = load;
    residual_ = left(X, now_);
    std::swap(answers_, tried_);
  }

  /// Along the load to where the contact carries that part of it, or a little more, or until it is met nowhere. From there
  /// Newton's steps lead back out: a contact grows stiffer as it deepens.
  bool approach() {
    const Vec3 force = along_free(load_at(start_)).head<3>();
    if (force.isZero()) return false;
    const Vec3 along = force.normalized();
    for (double travel = search_step; travel <= options_.farthest_mm;) {
      Vector6 by = Vector6::Zero();
      by.head<3>() = travel * along;
      const Pose X = moved(start_, by);
      const MobileLoad load = tried(X);
      const double missing = force.norm() + load.wrench.head<3>().dot(along);
      if (!(missing > 0)) {
        take(X, load);
        return true;
      }
      const LoadChange change = change_of(*tried_, X, Motions::translations);
      const double stiffness = -along.dot(change.topLeftCorner<3, 3>() * along);
      travel +=
          stiffness > 0 ? std::clamp(missing / stiffness, search_step, longest_search_step) : search_step;
    }
    return false;
  }

  /// The outcome, and for one that carries no load the pose and the reason that say most.
  BalanceOutcome explained(BalanceOutcome outcome) {
    if (outcome != BalanceOutcome::pulled_apart && outcome != BalanceOutcome::over_the_rim) return outcome;
    if (most_ && most_->carried >= 1 && most_->strain >= whole_strain) return BalanceOutcome::too_large;
    if (most_ && most_->carried > 0 && most_->carried < 1 && most_->strain >= exhausted_strain) {
      const Pose ended = out_.X_FM, most = most_->X;
      take(most, tried(most));
      // Squeezed against the load. What is pushed aside leaves over a rim.
      const Vec3 left_over = residual_.head<3>(), along = along_free(load_at(most)).head<3>().normalized();
      const double against = left_over.dot(along);
      if ((left_over - against * along).norm() <= against / 2) return BalanceOutcome::too_large;
      take(ended, tried(ended));
    }
    // A contact that pushes along with the load leaves a residual above the applied load. Further along the load it
    // may let go.
    const bool carried_some = most_ && most_->carried > least_carried_share;
    const bool leaves_less = size_of(residual_) <= size_of(along_free(load_at(out_.X_FM)));
    if (carried_some && leaves_less) return outcome;
    if (comes_apart()) return BalanceOutcome::pulled_apart;
    // A refused load leaves no more than was applied, as it does where the bodies are apart.
    if (!leaves_less && least_->size < size_of(residual_)) {
      const Pose least = least_->X;
      take(least, tried(least));
    }
    return outcome;
  }

  /// Goes along the load to where the bodies are apart, if that is near; else stays.
  bool comes_apart() {
    const Pose from = out_.X_FM;
    const Vec3 force = along_free(load_at(from)).head<3>();
    if (force.isZero()) return false;
    for (double travel = search_step; travel <= options_.farthest_mm; travel += search_step) {
      Pose X = from;
      X.translation() += travel * force.normalized();
      const MobileLoad load = tried(X);
      // Another part of the contact holds it back.
      if (load.wrench.head<3>().dot(force) < -least_carried_share * force.squaredNorm()) return false;
      if (load.samples > 0) continue;
      take(X, load);
      return true;
    }
    return false;
  }

  BalanceOutcome find() {
    take(start_, tried(start_));
    if (now_.samples == 0 && along_free(load_at(start_)).isZero(0)) {
      out_.direction = free_.col(0).head<3>();
      return BalanceOutcome::free_direction;
    }
    if (now_.samples == 0 && !approach()) {
      if (!most_) return BalanceOutcome::pulled_apart;
      resisted_ = most_->carried > 0;
      take(most_->X, tried(most_->X));
      return given_up();
    }
    while (true) {
      resisted_ = resisted_ || now_.wrench.dot(load_at(out_.X_FM)) < 0;
      // How the contact pushes back against small motions along what is free.
      const FreeMatrix stiffness = -free_.transpose() * change_of(*answers_, out_.X_FM, motions()) * free_;
      const Svd svd(stiffness, Eigen::ComputeFullU | Eigen::ComputeFullV);
      const auto& sizes = svd.singularValues();
      const Eigen::Index last = sizes.size() - 1;
      if (!(sizes[last] > least_stiffness * sizes[0])) {
        out_.direction = (free_ * svd.matrixV().col(last)).head<3>().normalized();
        return resisted_ ? BalanceOutcome::free_direction : BalanceOutcome::pulled_apart;
      }
      if (is_small(residual_)) {
        // Stiffness that pushes back along a motion: the symmetric part, whatever the units of rotations.
        const Eigen::SelfAdjointEigenSolver<FreeMatrix> pushes_back((stiffness + stiffness.transpose()) / 2);
        if (pushes_back.eigenvalues()[0] > 0) return BalanceOutcome::balanced;
        out_.direction = (free_ * pushes_back.eigenvectors().col(0)).head<3>().normalized();
        return BalanceOutcome::unstable;
      }
      if (out_.steps >= options_.most_steps) return given_up();
      const auto little_is_left = [&] { return left_share() <= options_.most_left_at_jump; };
      StepEnd end = try_step(svd.solve(free_.transpose() * residual_));
      if (!end.moved && !(end.at_jump && little_is_left()))
        end = try_step(Svd(measured_stiffness(), Eigen::ComputeFullU | Eigen::ComputeFullV)
                           .solve(free_.transpose() * residual_));
      if (!is_near(out_.X_FM)) return given_up();
      if ((end.at_jump || !end.moved) && little_is_left()) return BalanceOutcome::at_jump;
      if (!end.moved) return given_up();
      ++out_.steps;
    }
  }

  /// The same by differences of the load: with what rays at a rim add that begin or cease to meet the other surface.
  FreeMatrix measured_stiffness() {
    FreeMatrix stiffness(free_.cols(), free_.cols());
    for (Eigen::Index i = 0; i < free_.cols(); ++i) {
      const double travel = free_.col(i).head<3>().isZero() ? measured_angle : measured_travel;
      const auto carried = [&](double by) {
        return FreeVector(free_.transpose() * tried(moved(out_.X_FM, by * free_.col(i))).wrench);
      };
      const FreeVector ahead = carried(travel);
      stiffness.col(i) = (carried(-travel) - ahead) / (2 * travel);
    }
    return stiffness;
  }

  /// Residual as a share of the load, or of what the ligaments pull.
  double left_share() const {
    return size_of(residual_) / std::max(size_of(along_free(load_at(out_.X_FM))), pull_n_);
  }

  /// A contact that has pushed against the load at all was left over its rim, or at one.
  BalanceOutcome given_up() const {
    return resisted_ ? BalanceOutcome::over_the_rim : BalanceOutcome::pulled_apart;
  }

  struct StepEnd {
    bool moved;    ///< less of the load is left than before
    bool at_jump;  ///< just beyond more is left, and no stiffness explains how much
  };
  /// The step, or the part of it beyond which more of the load is left or the body climbs: what is stored beyond what the load
  /// gives grows at a saddle, where the load still falls.
  StepEnd try_step(const FreeVector& motion) {
    Vector6 step = free_ * motion;
    if (const double length = step.head<3>().norm(); length > longest_step) step *= longest_step / length;
    const Pose from = out_.X_FM;
    const double energy = now_.energy, size = size_of(residual_);
    const Vector6 given = load_at(from);
    // The force is the gradient of the energy up to the angle between the surfaces, within a tenth.
    const double travel = step.head<3>().norm() + step.tail<3>().norm() * measured_travel / measured_angle;
    const double uncertain = 0.1 * (std::max(given.head<3>().norm(), pull_n_) * step.head<3>().norm() +
                                    given.tail<3>().norm() * step.tail<3>().norm());
    Vector6 beyond = residual_;
    bool meets_beyond = false;
    double low = 0, high = 1;
    for (double part = 1; high - low > least_part; part = (low + high) / 2) {
      const Pose X = moved(from, part * step);
      const MobileLoad next = tried(X);
      const Vector6 residual = left(X, next);
      const bool climbs = part * travel > least_climb &&
                          next.energy - energy - part * given.dot(step) > part * uncertain + 1e-9 * energy;
      if (next.samples > 0 && !climbs && size_of(residual) < size_of(residual_)) {
        take(X, next);
        if (part == 1) return {true, false};
        low = part;
      } else {
        high = part;
        beyond = residual;
        meets_beyond = next.samples > 0;
      }
    }
    return {low > 0, meets_beyond && size_of(beyond - residual_) > steepest_change * (high - low) * size};
  }

  const ElasticContact& contact_;
  const BalanceOptions& options_;
  const Load& load_;
  const Pose& start_;
  const FreeMotions free_;
  std::unique_ptr<ElasticContact::Parts::Answers> answers_,
      tried_;       ///< at out_.X_FM, and at the pose tried last
  MobileLoad now_;  ///< at out_.X_FM
  Vector6 residual_ = Vector6::Zero();
  double pull_n_ = 0;  ///< of all ligaments at the start
  bool resisted_ = false;
  struct Most {
    Pose X;
    double carried;  ///< a share of the force
    double strain;
  };
  std::optional<Most> most_;  ///< the pose that carries most of all poses in contact that were tried
  struct Least {
    Pose X;
    double size;
  };
  std::optional<Least> least_;  ///< the pose that leaves least of all that were tried
  BalancedPose out_{};
};

}  // namespace

BalancedPose balance(const ElasticContact& contact, const Pose& start, const Load& load,
                     const BalanceOptions& options) {
  return Search(contact, start, load, options).run();
}

bool BalancedPose::carries_load() const noexcept {
  return outcome == BalanceOutcome::balanced || outcome == BalanceOutcome::unstable ||
         outcome == BalanceOutcome::at_jump;
}

std::string_view name_of(BalanceOutcome outcome) noexcept {
  switch (outcome) {
    case BalanceOutcome::balanced:
      return "balanced";
    case BalanceOutcome::at_jump:
      return "at_jump";
    case BalanceOutcome::pulled_apart:
      return "pulled_apart";
    case BalanceOutcome::over_the_rim:
      return "over_the_rim";
    case BalanceOutcome::too_large:
      return "too_large";
    case BalanceOutcome::unstable:
      return "unstable";
    case BalanceOutcome::free_direction:
      return "free_direction";
  }
  return "";
}

namespace {

double strain_of(const ElasticContactResults& contact) {
  return std::max(contact.fixed ? contact.fixed->max_strain : 0,
                  contact.mobile ? contact.mobile->max_strain : 0);
}

}  // namespace

std::string reason_of(const BalancedPose& pose) {
  // If rotations are held, no residual of the moment is reported.
  const auto what_is_left = [](const BalancedPose& of) {
    const double moment = of.residual.moment_nmm.norm();
    return core::formatted("%.3g N", of.residual.force_n.norm()) +
           (moment > 0 ? core::formatted(" and %.3g N mm are", moment) : std::string(" are"));
  };
  const Vec3& d = pose.direction;
  switch (pose.outcome) {
    case BalanceOutcome::balanced:
      return "";
    case BalanceOutcome::at_jump:
      return what_is_left(pose) +
             " left, and no step was found that leaves less: as where rays begin or cease to meet the other "
             "surface";
    case BalanceOutcome::pulled_apart:
      return "the load pulls the bodies apart: along it they do not meet";
    case BalanceOutcome::over_the_rim:
      return core::formatted(
          "no pose nearby in which the contact carries the load: it leads over the rim, or to where the "
          "contact's force jumps; %s left",
          what_is_left(pose).c_str());
    case BalanceOutcome::too_large:
      return core::formatted(
          "the load is too large for the layers, compressed by %.0f %% of their thickness; %s left",
          100 * strain_of(pose.contact), what_is_left(pose).c_str());
    case BalanceOutcome::unstable:
      return core::formatted(
          "the contact balances the load and does not keep it: moved along (%.3f, %.3f, %.3f) the mobile "
          "body is pushed on",
          d.x(), d.y(), d.z());
    case BalanceOutcome::free_direction:
      return core::formatted(
          "nothing holds the mobile body in one place along (%.3f, %.3f, %.3f): prescribe it", d.x(), d.y(),
          d.z());
  }
  return "";
}

bool is_zero_along(const Load& load, const Pose& X_FM, const BalanceOptions& options) {
  if (!options.ligaments.empty()) return false;
  Vec3 force = load.on_mobile.force_n;
  if (load.frame == BodyRole::mobile) force = X_FM.linear() * force;
  if (options.free_rotations && !load.on_mobile.moment_nmm.isZero(0)) return false;
  if (options.free_directions.empty()) return force.isZero(0);
  return std::all_of(options.free_directions.begin(), options.free_directions.end(),
                     [&](const Vec3& direction) { return direction.dot(force) == 0; });
}

}  // namespace condyle::contact
