#include "mesh/doubled_triangles.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "condyle/inspect.hpp"

namespace condyle::mesh {
namespace {

/// The last step of splitmix64: close values come far apart.
constexpr std::uint64_t mixed(std::uint64_t x) noexcept {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

/// Equal for equal places: 0 and -0 are one.
std::uint64_t digest_of_place(const Vec3& p) noexcept {
  std::uint64_t digest = 1;
  for (int k = 0; k < 3; ++k) digest = mixed(digest + std::bit_cast<std::uint64_t>(p[k] + 0.0));
  return digest;
}

/// Whether two triangles may have their corners at the same three places. Of most meshes none do, and that costs a look at each.
bool may_hold_doubles(const TriMesh& mesh) {
  std::vector<std::uint64_t> of_vertex(mesh.vertices.size());
  for (std::size_t v = 0; v < of_vertex.size(); ++v) of_vertex[v] = digest_of_place(mesh.vertices[v]);
  // Open addressing, at most half full; 0 is an empty place.
  const std::size_t size = std::bit_ceil(2 * mesh.triangles.size() + 1);
  std::vector<std::uint64_t> seen(size);
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint64_t digest = mixed(of_vertex[a] + of_vertex[b] + of_vertex[c]) | 1;
    std::size_t at = static_cast<std::size_t>(digest >> 1) & (size - 1);
    for (; seen[at] != 0; at = (at + 1) & (size - 1))
      if (seen[at] == digest) return true;
    seen[at] = digest;
  }
  return false;
}

}  // namespace

DoubledTriangles doubled_triangles(const TriMesh& mesh) {
  if (!may_hold_doubles(mesh)) return {};
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
