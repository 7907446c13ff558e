#include "mesh/vertex_triangles.hpp"

#include <bit>
#include <cstdint>

namespace condyle::mesh {

VertexTriangles::VertexTriangles(std::span<const Triangle> triangles, std::size_t vertices)
    : first_(vertices + 1, 0), triangle_(3 * triangles.size()) {
  for (const Triangle& triangle : triangles)
    for (const Index v : triangle) ++first_[v + 1];
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  std::vector<Index> next = first_;
  for (Index t = 0; t < triangles.size(); ++t)
    for (const Index v : triangles[t]) triangle_[next[v]++] = t;
}

std::vector<Index> VertexTriangles::of(std::span<const Index> vertices) const {
  constexpr Index bits = 64;
  std::vector<std::uint64_t> is_asked(triangle_.size() / 3 / bits + 1);
  std::size_t uses = 0;
  for (const Index v : vertices) {
    for (const Index t : of(v)) is_asked[t / bits] |= std::uint64_t{1} << t % bits;
    uses += of(v).size();
  }
  std::vector<Index> triangles;
  triangles.reserve(uses);
  for (Index i = 0; i < is_asked.size(); ++i) {
    for (std::uint64_t left = is_asked[i]; left != 0; left &= left - 1)
      triangles.push_back(i * bits + static_cast<Index>(std::countr_zero(left)));
  }
  return triangles;
}

}  // namespace condyle::mesh
