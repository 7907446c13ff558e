#include "mesh/doubled_triangles.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "condyle/inspect.hpp"
#include "mesh/enclosed_volume.hpp"

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
    Triangle corners;  // ascending
    bool is_odd;       // and the sense in which the triangle goes round them
    Index number;
    auto operator<=>(const Entry&) const = default;
  };
  std::vector<Entry> entries;
  entries.reserve(mesh.triangles.size());
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    Triangle corners = mesh.triangles[t];
    for (Index& v : corners) v = first[v];
    if (names_a_vertex_twice(corners)) continue;
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    const bool is_odd = corners[1] > corners[2];
    if (is_odd) std::swap(corners[1], corners[2]);
    entries.push_back({corners, is_odd, t});
  }
  std::sort(entries.begin(), entries.end());
  DoubledTriangles found;
  const auto add = [](std::size_t& count, std::optional<std::array<Index, 2>>& first_pair, std::size_t by,
                      Index earlier, Index later) {
    count += by;
    if (!first_pair || later < (*first_pair)[1]) first_pair = {{earlier, later}};
  };
  for (std::size_t begin = 0, end = 0; begin < entries.size(); begin = end) {
    std::size_t odd = 0;  // those in the other sense follow
    for (end = begin; end < entries.size() && entries[end].corners == entries[begin].corners; ++end) {
      odd += entries[end].is_odd;
      if (end > begin && entries[end].is_odd == entries[end - 1].is_odd)
        add(found.count, found.first, 1, entries[end - 1].number, entries[end].number);
    }
    const std::size_t even = end - begin - odd;
    found.single += std::max(odd, even) - std::min(odd, even);
    if (odd == 0 || even == 0) continue;
    const auto [earlier, later] = std::minmax(entries[begin].number, entries[begin + even].number);
    add(found.opposite, found.first_opposite, std::min(odd, even), earlier, later);
  }
  return found;
}

bool is_two_sided(const TriMesh& mesh) {
  const BoundingBox box = bounds_of_surface(mesh);
  return std::abs(enclosed_volume(mesh)) <= 1e-12 * box.diagonal() * box.diagonal() * box.diagonal() &&
         doubled_triangles(mesh).is_two_sided();
}

}  // namespace condyle::mesh
