#include "measure/shaft_axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/formatted.hpp"
#include "core/symmetric.hpp"
#include "core/trigonometry.hpp"
#include "kinematics/corners.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "kinematics/surface_points.hpp"
#include "measure/degree.hpp"

namespace condyle::measure {
namespace {

// Lengths in mm are those of a head of the usual size, and grow with it.

/// The shaft begins below the lesser trochanter, in radii of the head below its centre, and curves beyond this length, mm.
constexpr double shaft_begins = 2.6, longest_mm = 83;
/// Between sections, and before the end of the bone, where the face that closes it is rounded off, mm.
constexpr double step_mm = 4.6, end_mm = 5.5;
constexpr double shortest_mm = 23, largest_bound_deg = 8;
/// A contour whose ends miss each other by more, mm, is open.
constexpr double closed_mm = 1e-6;
/// A section with less of the usual area than this is one that a cut goes through.
constexpr double least_shaft_area = 0.5;
/// A section farther than so many robust deviations from the line of the others has no weight; distances below the other, mm, are none.
constexpr double shaft_deviations_kept = 4.7, narrowest_shaft_mm = 0.05;
/// Change of a direction that counts as none, and rounds after which any remaining change does.
constexpr double shaft_settled = 1e-12;
constexpr int most_shaft_rounds = 50, most_weightings = 200;

struct Section {
  double area = 0;
  Vec3 moment = Vec3::Zero(), open = Vec3::Zero();
  bool has_end = false;
};

/// Heights of the vertices along a direction, and the sections across it.
class Sections {
 public:
  Sections(const TriMesh& femur, const Sphere& head, const std::vector<char>& ends, const Vec3& along)
      : femur_(femur),
        centre_(head.centre),
        ends_(ends),
        along_(along),
        step_(by_head(step_mm, head)),
        closed_(by_head(closed_mm, head)),
        height_(femur.vertices.size()) {
    for (std::size_t v = 0; v < height_.size(); ++v) height_[v] = (femur.vertices[v] - centre_).dot(along);
    double reach = 0;
    for (const Triangle& t : femur.triangles)
      for (const Index v : t) reach = std::max(reach, height_[v]);
    first_ = shaft_begins * head.radius + step_ / 2;
    const double length =
        std::min(reach - by_head(end_mm, head) - shaft_begins * head.radius, by_head(longest_mm, head));
    if (length > 0) sections_.resize(static_cast<std::size_t>(length / step_));
    for (std::size_t t = 0; t < femur.triangles.size(); ++t) cut(t);
  }

  /// From the head's centre.
  std::vector<Vec3> centroids() const {
    std::vector<double> areas;
    for (const Section& section : sections_)
      if (is_whole(section)) areas.push_back(std::abs(section.area));
    if (areas.empty()) return {};
    std::nth_element(areas.begin(), areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2),
                     areas.end());
    const double usual = areas[areas.size() / 2];
    std::vector<Vec3> out;
    for (const Section& section : sections_)
      if (is_whole(section) && std::abs(section.area) >= least_shaft_area * usual)
        out.push_back(section.moment / section.area);
    return out;
  }

 private:
  bool is_whole(const Section& section) const {
    return section.area != 0 && !section.has_end && section.open.norm() < closed_;
  }

  void cut(std::size_t t) {
    const auto [i, j, k] = femur_.triangles[t];
    const auto [low, high] = std::minmax({height_[i], height_[j], height_[k]});
    const double next = std::max(0.0, std::ceil((low - first_) / step_));
    for (auto n = static_cast<std::size_t>(next); n < sections_.size(); ++n) {
      const double at = first_ + step_ * static_cast<double>(n);
      if (at > high) break;
      add(femur_.triangles[t], at, sections_[n]);
    }
  }

  void add(const Triangle& t, double at, Section& section) const {
    std::array<Vec3, 2> ends;  // where the border goes down through the plane, and up
    std::size_t found = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = t[k], b = t[(k + 1) % 3];
      const bool below = height_[a] < at;
      if (below == (height_[b] < at)) continue;
      ends[below ? 1 : 0] = crossing(a, b, at), ++found;
    }
    if (found != 2) return;
    const double area = ends[0].cross(ends[1]).dot(along_) / 2;
    // The plane's own height makes no area: it is along the direction, as is the part of the moment that it adds.
    section.area += area;
    section.moment += area * (ends[0] + ends[1] + at * along_) / 3;
    section.open += ends[1] - ends[0];
    section.has_end |= ends_[t[0]] && ends_[t[1]] && ends_[t[2]];
  }

  /// The same bits in both triangles of an edge.
  Vec3 crossing(Index a, Index b, double at) const {
    if (a > b) std::swap(a, b);
    const Vec3 p = femur_.vertices[a] - centre_, q = femur_.vertices[b] - centre_;
    return p + (at - height_[a]) / (height_[b] - height_[a]) * (q - p);
  }

  const TriMesh& femur_;
  Vec3 centre_;
  const std::vector<char>& ends_;
  Vec3 along_;
  double step_, closed_;
  std::vector<double> height_;
  double first_ = 0;
  std::vector<Section> sections_;
};

ShaftAxis line_through(const std::vector<Vec3>& points, const std::vector<double>& weights,
                       const Vec3& direction) {
  Vec3 mean = Vec3::Zero();
  double n = 0;
  for (std::size_t i = 0; i < points.size(); ++i) mean += weights[i] * points[i], n += weights[i];
  mean /= n;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i)
    spread += weights[i] * (points[i] - mean) * (points[i] - mean).transpose();
  const auto [squares, axes] = core::axes_of(spread);
  Vec3 along = axes.col(2);
  if (along.dot(direction) < 0) along = -along;
  // Least squares: the variance of the slope is that of the residuals over the sum of squared abscissae.
  const double residual = std::max(0.0, squares[1]) / std::max(1.0, n - 2);
  return {mean, along, 0, 0, 2 * core::arctangent(std::sqrt(residual / squares[2]), 1) / degree};
}

double distance(const ShaftAxis& line, const Vec3& p) {
  return (p - line.point).cross(line.direction).norm();
}

/// Least squares again and again, each point with the weight of its distance from the line before.
template <class Weight>
ShaftAxis reweighted(const std::vector<Vec3>& points, ShaftAxis line, std::vector<double>& weights,
                     const Weight& weight) {
  for (int round = 0; round < most_weightings; ++round) {
    for (std::size_t i = 0; i < points.size(); ++i) weights[i] = weight(distance(line, points[i]));
    const ShaftAxis next = line_through(points, weights, line.direction);
    const double change = (next.direction - line.direction).norm();
    line = next;
    if (change < shaft_settled) break;
  }
  return line;
}

ShaftAxis line_of(const std::vector<Vec3>& points, const Vec3& direction, const Sphere& head) {
  const double narrowest = by_head(narrowest_shaft_mm, head), step = by_head(step_mm, head);
  std::vector<double> weights(points.size(), 1);
  ShaftAxis line = line_through(points, weights, direction);
  line = reweighted(points, line, weights, [&](double d) { return 1 / std::max(d, narrowest); });
  std::vector<double> off;
  for (const Vec3& p : points) off.push_back(distance(line, p));
  const double reach =
      std::max(shaft_deviations_kept * kinematics::robust_deviation(std::move(off)), narrowest);
  line = reweighted(points, line, weights, [&](double d) {
    const double rest = 1 - d * d / (reach * reach);
    return rest > 0 ? rest * rest : 0;
  });
  line.first_mm = HUGE_VAL, line.last_mm = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(weights[i] > 0)) continue;
    const double at = points[i].dot(line.direction);
    line.first_mm = std::min(line.first_mm, at - step / 2);
    line.last_mm = std::max(line.last_mm, at + step / 2);
  }
  return line;
}

}  // namespace

ShaftFinding find_shaft(const TriMesh& femur, const Sphere& head, const std::vector<char>& ends) {
  const double shortest = by_head(shortest_mm, head);
  const std::string none =
      core::formatted("no straight shaft of %.0f mm begins %.0f mm from the head's centre", shortest,
                      shaft_begins * head.radius);
  Vec3 along = (kinematics::area_centroid(femur) - head.centre).normalized();
  std::optional<ShaftAxis> line;
  for (int round = 0; round < most_shaft_rounds; ++round) {
    const std::vector<Vec3> points = Sections(femur, head, ends, along).centroids();
    if (static_cast<double>(points.size()) * by_head(step_mm, head) < shortest) return {{}, none};
    line = line_of(points, along, head);
    const double change = (line->direction - along).norm();
    along = line->direction;
    if (change < shaft_settled) break;
  }
  if (!(line->last_mm - line->first_mm >= shortest) || !(line->bound_deg <= largest_bound_deg))
    return {{}, none};
  line->point += head.centre;
  return {line, {}};
}

}  // namespace condyle::measure
