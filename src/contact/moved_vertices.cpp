#include "contact/moved_vertices.hpp"

#include <string>
#include <utility>

#include "condyle/error.hpp"

namespace condyle::contact {

MovedVertices moved_vertices(const Mesh& before, PointsView vertices) {
  if (vertices.size() != before.vertices().size())
    throw UsageError("an update of " + std::to_string(before.vertices().size()) + " vertices gives " +
                     std::to_string(vertices.size()));
  Points points;
  points.x.assign(vertices.x.begin(), vertices.x.end());
  points.y.assign(vertices.y.begin(), vertices.y.end());
  points.z.assign(vertices.z.begin(), vertices.z.end());
  return {before.moved_to(std::move(points)), {}, vertices, {}};
}

MovedVertices moved_vertices(const Mesh& before, std::span<const Index> moved, PointsView positions) {
  const std::size_t count = before.vertices().size();
  if (moved.size() != positions.size())
    throw UsageError("an update moves " + std::to_string(moved.size()) + " vertices and gives " +
                     std::to_string(positions.size()) + " positions");
  if (moved.size() > count)
    throw UsageError("an update moves " + std::to_string(moved.size()) + " vertices of " +
                     std::to_string(count));
  Points points = before.vertices();
  std::vector<char> is_moved(count);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const Index v = moved[i];
    if (v >= count)
      throw UsageError("an update moves vertex " + std::to_string(v) + " of " + std::to_string(count));
    if (is_moved[v]) throw UsageError("an update moves vertex " + std::to_string(v) + " twice");
    is_moved[v] = true;
    points.set(v, positions[i]);
  }
  return {before.moved_to(std::move(points)), moved, positions, std::move(is_moved)};
}

}  // namespace condyle::contact
