#include "motion/rom/even_joint_space.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "condyle/error.hpp"
#include "kinematics/surface_points.hpp"

namespace condyle::motion {
namespace {

/// Four unknowns; three times as many vertices are the least that average anything.
constexpr std::size_t fewest_vertices = 12;
/// Smallest eigenvalue of the mean of u u^T less its mean part: below it the rays are nearly on one cone and
/// a direction is left undetermined. A hemisphere has 1/12 along its axis.
constexpr double smallest_spread = 0.005;
/// A shift of less than this is no movement any more, in mm; reached in three or four rounds.
constexpr double settled = 1e-6;
constexpr int most_rounds = 20;

/// Residual from which a vertex pulls with a constant force instead of a growing one, in mm: about the
/// roughness of a segmented joint surface.
constexpr double rough_mm = 0.3;
/// Pull of a gap that is too wide, relative to one that is too narrow.
constexpr double pull_of_wide = 1.0 / 3;
/// Of the weights at each pose, until they settle.
constexpr int weight_rounds = 30;

/// The rays and gaps of the head's vertices that face the socket.
struct JointSpace {
  std::vector<Vec3> rays;
  std::vector<double> gaps;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

JointSpace joint_space(const RadialTable& socket, const Points& head, const Pose& X_FM, double largest_gap) {
  const Points placed = posed(X_FM, head.view());
  const RadialResults hits = socket.query(placed);
  JointSpace space;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (!(std::abs(hits.radial_gap_mm[i]) <= largest_gap)) continue;
    space.rays.push_back(placed[i].normalized());
    space.gaps.push_back(hits.radial_gap_mm[i]);
  }
  if (space.gaps.size() < fewest_vertices)
    throw MeshError("joint space: fewer than " + std::to_string(fewest_vertices) +
                    " vertices of the head face a socket");
  return space;
}

/// What makes the joint space even: a step of the centre and the gap it leads to.
struct Evened {
  Vec3 step = Vec3::Zero();
  double gap = 0;
  double spread = 0;  ///< of the gaps about it
};

std::vector<double> residuals(const JointSpace& space, const Evened& evened) {
  std::vector<double> out(space.gaps.size());
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = space.gaps[i] - space.rays[i].dot(evened.step) - evened.gap;
  return out;
}

/// Before any step: the median gap.
Evened as_it_is(const JointSpace& space) {
  Evened now{Vec3::Zero(), median(space.gaps), 0};
  now.spread = kinematics::robust_deviation(residuals(space, now));
  return now;
}

Evened even(const JointSpace& space) {
  Evened best = as_it_is(space);
  for (int round = 0; round < weight_rounds; ++round) {
    const std::vector<double> r = residuals(space, best);
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    for (std::size_t i = 0; i < r.size(); ++i) {
      const double weight =
          (r[i] > 0 ? pull_of_wide : 1) * std::min(1.0, rough_mm / std::max(std::abs(r[i]), rough_mm));
      const Vec3& u = space.rays[i];
      const Eigen::Vector4d row(u.x(), u.y(), u.z(), 1);
      normal += weight * row * row.transpose();
      right += weight * space.gaps[i] * row;
    }
    // Of the rays' spread about their weighted mean, without the gap.
    const Vec3 mean = normal.block<3, 1>(0, 3) / normal(3, 3);
    const Eigen::Matrix3d spread = normal.topLeftCorner<3, 3>() / normal(3, 3) - mean * mean.transpose();
    if (Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvalues()[0] < smallest_spread)
      throw MeshError("joint space: the socket covers too little of the head to determine a centre");
    const Eigen::Vector4d solution = normal.ldlt().solve(right);
    best.step = solution.head<3>(), best.gap = solution[3];
  }
  best.spread = kinematics::robust_deviation(residuals(space, best));
  return best;
}

}  // namespace

CentreShift even_joint_space(const JointContact& joint, const ArticularRegion& region, const Pose& X_FM,
                             const CentreRule& rule) {
  Points head;
  for (std::size_t v = 0; v < joint.mobile().vertices().size(); ++v) {
    const Vec3 p = joint.mobile().vertices()[v];
    if (p.norm() <= region.radius_mm) head.push_back(p);
  }
  CentreShift shift;
  const auto space_now = [&] {
    Pose X = X_FM;
    X.pretranslate(shift.translation_mm);
    return joint_space(joint.fixed_table(), head, X, rule.largest_gap_mm);
  };
  JointSpace space = space_now();
  shift.spread_before_mm = as_it_is(space).spread;
  for (int round = 0; round < most_rounds; ++round) {
    const Evened evened = even(space);
    shift.translation_mm += evened.step;
    shift.gap_mm = evened.gap, shift.spread_after_mm = evened.spread;
    const double length = shift.translation_mm.norm();
    shift.cut_back = length > rule.largest_shift_mm;
    if (shift.cut_back) shift.translation_mm *= rule.largest_shift_mm / length;
    space = space_now();
    if (shift.cut_back || evened.step.norm() < settled) break;
  }
  shift.vertices = space.gaps.size();
  return shift;
}

}  // namespace condyle::motion
