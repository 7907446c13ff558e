#include "kinematics/surface_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace condyle::kinematics {
namespace {

/// So many neighbours give a mean, and no further ones are looked for; nor are those beyond a point that is joined to so many, the hub of a
/// fan. A hip's fine meshes have some tens; without bounds the work would be the square of a hub's degree.
constexpr std::size_t most_near = 1000, most_joined = 1000;

}  // namespace

double root_of_area(const TriMesh& surface) {
  double area = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Vec3 a = surface.corner(t, 0);
    area += (surface.corner(t, 1) - a).cross(surface.corner(t, 2) - a).norm() / 2;
  }
  return std::sqrt(area);
}

std::vector<SurfacePoint> surface_points(const TriMesh& mesh, const std::optional<Sphere>& within) {
  std::vector<Vec3> doubled_area(mesh.vertices.size(), Vec3::Zero());
  std::vector<double> area(mesh.vertices.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0);
    const Vec3 n = (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a);
    for (const Index v : mesh.triangles[t]) {
      doubled_area[v] += n;
      area[v] += n.norm() / 6;
    }
  }
  std::vector<SurfacePoint> points;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3 p = mesh.vertices[v];
    const double length = doubled_area[v].norm();
    if (!(length > 0 && std::isfinite(length))) continue;
    if (within && (p - within->centre).norm() > within->radius) continue;
    points.push_back({static_cast<Index>(v), p, doubled_area[v] / length, area[v], length / (6 * area[v])});
  }
  return points;
}

void average_normals(std::vector<SurfacePoint>& points, double cell) {
  if (points.empty()) return;
  // Sorted by cell, in a cell as they were.
  struct Place {
    std::array<double, 3> cell;
    std::size_t point;
    auto operator<=>(const Place&) const = default;
  };
  const Vec3 origin = points.front().position;
  std::vector<Place> places;
  places.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 at = (points[i].position - origin) / cell;
    places.push_back({{std::floor(at.x()), std::floor(at.y()), std::floor(at.z())}, i});
  }
  std::sort(places.begin(), places.end());
  for (auto first = places.begin(); first != places.end();) {
    const auto last =
        std::find_if(first, places.end(), [&](const Place& place) { return place.cell != first->cell; });
    // The largest of the cell has one side, and what faces the other way is another surface: a wall is thin.
    const Vec3 front = points[std::max_element(first, last,
                                               [&](const Place& a, const Place& b) {
                                                 return points[a.point].area < points[b.point].area;
                                               })
                                  ->point]
                           .normal;
    Vec3 sums[2] = {Vec3::Zero(), Vec3::Zero()};
    std::size_t counts[2] = {0, 0};
    for (auto place = first; place != last; ++place) {
      const SurfacePoint& point = points[place->point];
      const bool back = point.normal.dot(front) < 0;
      sums[back] += point.area * point.normal;
      ++counts[back];
    }
    for (; first != last; ++first) {
      SurfacePoint& point = points[first->point];
      const bool back = point.normal.dot(front) < 0;
      if (counts[back] > 1 && sums[back].norm() > 0) point.normal = sums[back].normalized();
    }
  }
}

PointNeighbours::PointNeighbours(const TriMesh& mesh, const std::vector<SurfacePoint>& points)
    : end_(points.size() + 1, 0) {
  std::vector<Index> position(mesh.vertices.size(), no_index);
  for (std::size_t i = 0; i < points.size(); ++i) position[points[i].vertex] = static_cast<Index>(i);
  // visit(the later point, the earlier one) for each side between two.
  const auto each_side = [&](const auto& visit) {
    for (const Triangle& t : mesh.triangles) {
      const std::array<Index, 3> at{position[t[0]], position[t[1]], position[t[2]]};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [earlier, later] = std::minmax(at[k], at[(k + 1) % 3]);
        if (later != no_index && earlier != later) visit(later, earlier);
      }
    }
  };
  each_side([&](Index later, Index) { ++end_[later + 1]; });
  std::inclusive_scan(end_.begin(), end_.end(), end_.begin());
  std::vector<Index> all(end_.back()), next(end_.begin(), end_.end() - 1);
  each_side([&](Index later, Index earlier) { all[next[later]++] = earlier; });
  earlier_.reserve(all.size() / 2);
  for (std::size_t i = 0, first = 0; i < points.size(); ++i) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first),
               end = all.begin() + static_cast<std::ptrdiff_t>(end_[i + 1]);
    first = end_[i + 1];
    std::sort(begin, end);
    earlier_.insert(earlier_.end(), begin, std::unique(begin, end));
    end_[i + 1] = static_cast<Index>(earlier_.size());
  }
}

std::vector<Index> PointNeighbours::largest_connected_part(const std::vector<SurfacePoint>& points,
                                                           const std::vector<Index>& chosen) const {
  // Union-find over positions in `chosen`; every root is the smallest of its part, so that no order decides.
  std::vector<Index> position(points.size(), no_index), parent(chosen.size());
  const auto root = [&](Index p) {
    while (parent[p] != p) p = parent[p] = parent[parent[p]];
    return p;
  };
  for (Index p = 0; p < chosen.size(); ++p) {
    const Index i = chosen[p];
    position[i] = p;
    Index own = parent[p] = p;
    for (Index k = end_[i]; k < end_[i + 1]; ++k) {
      const Index neighbour = position[earlier_[k]];
      if (neighbour == no_index) continue;
      const Index other = root(neighbour);
      if (other == own) continue;
      const auto [low, high] = std::minmax(own, other);
      own = parent[high] = low;
    }
  }
  std::vector<double> area(chosen.size(), 0.0);
  for (Index p = 0; p < chosen.size(); ++p) area[root(p)] += points[chosen[p]].area;
  const auto largest = static_cast<Index>(std::max_element(area.begin(), area.end()) - area.begin());
  std::vector<Index> part;
  part.reserve(chosen.size());
  for (Index p = 0; p < chosen.size(); ++p)
    if (parent[p] == largest || root(p) == largest) part.push_back(chosen[p]);
  return part;
}

void PointNeighbours::average_normals(std::vector<SurfacePoint>& points, double reach) const {
  // All neighbours of each point, the later ones too.
  std::vector<Index> end(points.size() + 1, 0);
  const auto each_side = [&](const auto& visit) {
    for (Index i = 0; i < points.size(); ++i)
      for (Index k = end_[i]; k < end_[i + 1]; ++k) visit(i, earlier_[k]), visit(earlier_[k], i);
  };
  each_side([&](Index of, Index) { ++end[of + 1]; });
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<Index> next(end.begin(), end.end() - 1), beside(end.back());
  each_side([&](Index of, Index other) { beside[next[of]++] = other; });

  std::vector<Vec3> mean(points.size());
  std::vector<Index> seen_from(points.size(), no_index), near;
  for (Index i = 0; i < points.size(); ++i) {
    near.assign(1, i);
    seen_from[i] = i;
    Vec3 sum = Vec3::Zero();
    // In whole rings around the point, so that no order of the points decides.
    bool looks_on = true;
    for (std::size_t at = 0, ring_end = 1; at < near.size(); ++at) {
      if (at == ring_end) looks_on = near.size() <= most_near, ring_end = near.size();
      const SurfacePoint& point = points[near[at]];
      sum += point.area * point.normal;
      if (!looks_on || (at > 0 && end[near[at] + 1] - end[near[at]] > most_joined)) continue;
      for (Index k = end[near[at]]; k < end[near[at] + 1]; ++k) {
        const Index other = beside[k];
        if (seen_from[other] == i) continue;
        seen_from[other] = i;
        // What faces the other way is beyond an edge: a wall is thin.
        if ((points[other].position - points[i].position).squaredNorm() <= reach * reach &&
            points[other].normal.dot(points[i].normal) > 0)
          near.push_back(other);
      }
    }
    mean[i] = near.size() > 1 && sum.norm() > 0 ? sum.normalized() : points[i].normal;
  }
  for (std::size_t i = 0; i < points.size(); ++i) points[i].normal = mean[i];
}

double PointNeighbours::longest_usual_edge(const std::vector<SurfacePoint>& points) const {
  std::vector<double> lengths;
  lengths.reserve(earlier_.size());
  for (Index i = 0; i < points.size(); ++i)
    for (Index k = end_[i]; k < end_[i + 1]; ++k)
      lengths.push_back((points[earlier_[k]].position - points[i].position).norm());
  if (lengths.empty()) return 0;
  const auto at = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() * 9 / 10);
  std::nth_element(lengths.begin(), at, lengths.end());
  return *at;
}

std::vector<Index> vertices_of(const std::vector<SurfacePoint>& points, const std::vector<Index>& chosen) {
  std::vector<Index> vertices;
  vertices.reserve(chosen.size());
  for (const Index i : chosen) vertices.push_back(points[i].vertex);
  return vertices;
}

double robust_deviation(std::vector<double> residuals) {
  if (residuals.empty()) return 0;
  for (double& r : residuals) r = std::abs(r);
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  return 1.4826 * *middle;
}

}  // namespace condyle::kinematics
