#include "mesh/doubled_triangles.hpp"

#include <algorithm>
#include <vector>

#include "condyle/inspect.hpp"

namespace condyle::mesh {

DoubledTriangles doubled_triangles(const TriMesh& mesh) {
  const std::vector<Index> first = first_of_same_coordinates(mesh.vertices);
  struct Entry {
    Triangle corners;
    Index number;
    auto operator<=>(const Entry&) const = default;
  };
  std::vector<Entry> entries;
  entries.reserve(mesh.triangles.size());
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    Triangle corners = mesh.triangles[t];
    for (Index& v : corners) v = first[v];
    // From the smallest on, in the triangle's own sense.
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    entries.push_back({corners, t});
  }
  std::sort(entries.begin(), entries.end());
  DoubledTriangles found;
  for (std::size_t i = 1, begin = 0; i < entries.size(); ++i) {
    if (entries[i].corners != entries[begin].corners) {
      begin = i;
      continue;
    }
    ++found.count;
    if (!found.first || entries[i].number < (*found.first)[1])
      found.first = {{entries[begin].number, entries[i].number}};
  }
  return found;
}

}  // namespace condyle::mesh
