#include "kinematics/shaft_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/symmetric.hpp"
#include "core/trigonometry.hpp"
#include "kinematics/corners.hpp"

namespace condyle::kinematics {
namespace {

/// Thickness of a slice, mm: several triangles of a fine mesh.
constexpr double slice_mm = 5;
/// The last slices are those of a cut, or of another joint.
constexpr double end_mm = 6;
/// No bone is longer; a stray vertex may be farther.
constexpr double longest_mm = 700;
constexpr int most_line_rounds = 12;
/// A slice with less of the usual area than this is one that the cut goes through.
constexpr double least_slice = 0.5;
constexpr std::size_t fewest_slices = 5;

struct Slices {
  std::vector<Vec3> centroids;
  double first, last, reach;
};

/// The height to which the bone goes on all around: short of it a cut may take one side away.
double whole_reach(const TriMesh& bone, const Vec3& joint, const ShaftLine& line, double begins) {
  constexpr int sectors = 8;
  const Vec3 e1 = line.direction.unitOrthogonal(), e2 = line.direction.cross(e1);
  std::array<double, sectors> reach{};
  for_each_corner(bone, [&](const Vec3& p) {
    const double height = (p - joint).dot(line.direction);
    if (height < begins) return;
    const Vec3 q = p - line.point;
    const double turn = core::arctangent(q.dot(e2), q.dot(e1)) / two_pi + 0.5;
    double& of_sector = reach[std::min(static_cast<std::size_t>(turn * sectors), std::size_t{sectors - 1})];
    of_sector = std::max(of_sector, height);
  });
  return *std::min_element(reach.begin(), reach.end());
}

/// Across the line of the round before, or a direction only.
std::optional<Slices> slices_of(const TriMesh& bone, const Vec3& joint, const Vec3& direction,
                                const std::optional<ShaftLine>& line, double begins, double most) {
  double reach = 0;
  for_each_corner(bone, [&](const Vec3& p) { reach = std::max(reach, (p - joint).dot(direction)); });
  const double ends =
      std::min((line ? whole_reach(bone, joint, *line, begins) : reach) - end_mm, std::min(most, longest_mm));
  if (ends - begins < shortest_shaft_mm) return std::nullopt;
  const auto count = static_cast<std::size_t>((ends - begins) / slice_mm);
  std::vector<Vec3> moment(count, Vec3::Zero());
  std::vector<double> area(count, 0);
  for (std::size_t t = 0; t < bone.triangles.size(); ++t) {
    const Vec3 a = bone.corner(t, 0), b = bone.corner(t, 1), c = bone.corner(t, 2),
               middle = (a + b + c) / 3 - joint;
    const double at = (middle.dot(direction) - begins) / slice_mm;
    if (!(at >= 0 && at < static_cast<double>(count))) continue;
    const double size = (b - a).cross(c - a).norm() / 2;
    area[static_cast<std::size_t>(at)] += size;
    moment[static_cast<std::size_t>(at)] += size * middle;
  }
  std::vector<double> sorted = area;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count / 2), sorted.end());
  const double usual = sorted[count / 2];
  Slices slices{{}, begins, begins + slice_mm * static_cast<double>(count), reach};
  for (std::size_t i = 0; i < count; ++i)
    if (area[i] > 0 && area[i] >= least_slice * usual)
      slices.centroids.push_back(joint + moment[i] / area[i]);
  if (slices.centroids.size() < fewest_slices) return std::nullopt;
  return slices;
}

ShaftLine line_through(const Slices& slices, const Vec3& direction) {
  Vec3 mean = Vec3::Zero();
  const auto n = static_cast<double>(slices.centroids.size());
  for (const Vec3& c : slices.centroids) mean += c / n;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vec3& c : slices.centroids) spread += (c - mean) * (c - mean).transpose();
  const auto [squares, axes] = core::axes_of(spread);
  Vec3 along = axes.col(2);
  if (along.dot(direction) < 0) along = -along;
  // Least squares: the variance of the slope is that of the residuals over the sum of squared abscissae.
  const double residual = std::max(0.0, squares[1]) / std::max(1.0, n - 2);
  const double slope = std::sqrt(residual / squares[2]);
  return {mean,        along,        slices.first,
          slices.last, slices.reach, 2 * core::arctangent(slope, 1) * 180 / std::numbers::pi};
}

}  // namespace

std::optional<ShaftLine> shaft_line(const TriMesh& bone, const Vec3& joint, const Vec3& direction,
                                    double begins_mm, double most_mm) {
  Vec3 along = direction;
  std::optional<ShaftLine> line;
  for (int round = 0; round < most_line_rounds; ++round) {
    const auto slices = slices_of(bone, joint, along, line, begins_mm, most_mm);
    if (!slices) return std::nullopt;
    const ShaftLine next = line_through(*slices, along);
    const bool is_settled = line && line->point == next.point && line->direction == next.direction;
    line = next;
    along = line->direction;
    if (is_settled) break;
  }
  if (!(line->bound_deg <= largest_shaft_bound_deg)) return std::nullopt;
  return line;
}

}  // namespace condyle::kinematics
