#include "mesh/editable_mesh.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace condyle::mesh {
namespace {

int corner_of(const Triangle& t, Index v) noexcept {
  return t[0] == v ? 0 : t[1] == v ? 1 : t[2] == v ? 2 : -1;
}

}  // namespace

EditableMesh::EditableMesh(const TriMesh& mesh) : triangle_(mesh.triangles), around_(mesh.vertices.size()) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) position_.push_back(mesh.vertices[i]);
  for (Index t = 0; t < triangle_.size(); ++t) {
    for (const Index v : triangle_[t]) around_[v].push_back(t);
  }
  vertex_count_ = position_.size();
}

Index EditableMesh::next_around(Index t, Index v) const noexcept {
  return triangle_[t][(corner_of(triangle_[t], v) + 1) % 3];
}

std::vector<Index> EditableMesh::neighbours(Index v) const {
  std::vector<Index> found;
  for (const Index t : around_[v]) found.push_back(next_around(t, v));
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::pair<Index, Index>> EditableMesh::edges() const {
  std::vector<std::pair<Index, Index>> found;
  found.reserve(3 * vertex_count_);
  for (Index a = 0; a < vertex_end(); ++a) {
    const auto first = static_cast<std::ptrdiff_t>(found.size());
    for (const Index t : around_[a]) {
      if (const Index b = next_around(t, a); a < b) found.emplace_back(a, b);
    }
    std::sort(found.begin() + first, found.end());
  }
  return found;
}

Index EditableMesh::triangle_with(Index a, Index b) const noexcept {
  for (const Index t : around_[a]) {
    if (next_around(t, a) == b) return t;
  }
  return no_index;
}

std::optional<EdgeStar> EditableMesh::star(Index a, Index b) const noexcept {
  const Index left = triangle_with(a, b), right = triangle_with(b, a);
  if (left == no_index || right == no_index) return std::nullopt;
  const auto opposite = [&](Index t, Index from) {
    return triangle_[t][(corner_of(triangle_[t], from) + 2) % 3];
  };
  return EdgeStar{a, b, opposite(left, a), opposite(right, b)};
}

bool EditableMesh::can_collapse(const EdgeStar& edge) const {
  if (around_[edge.left].size() <= 3 || around_[edge.right].size() <= 3) return false;
  int shared = 0;
  for (const Index s : around_[edge.a]) {
    for (const Index t : around_[edge.b]) shared += next_around(s, edge.a) == next_around(t, edge.b);
  }
  return shared == 2;
}

void EditableMesh::replace_corner(Index t, Index from, Index to) noexcept {
  triangle_[t][corner_of(triangle_[t], from)] = to;
}

void EditableMesh::detach(Index v, Index t) noexcept {
  auto& list = around_[v];
  list.erase(std::find(list.begin(), list.end(), t));
}

void EditableMesh::collapse(const EdgeStar& edge, const Vec3& p) {
  assert(can_collapse(edge));
  for (const Index t : {triangle_with(edge.a, edge.b), triangle_with(edge.b, edge.a)}) {
    for (const Index v : triangle_[t]) detach(v, t);
    triangle_[t][0] = no_index;
  }
  for (const Index t : around_[edge.b]) {
    replace_corner(t, edge.b, edge.a);
    around_[edge.a].push_back(t);
  }
  around_[edge.b].clear();
  position_[edge.a] = p;
  --vertex_count_;
}

bool EditableMesh::can_flip(const EdgeStar& edge) const noexcept {
  return around_[edge.a].size() > 3 && around_[edge.b].size() > 3 &&
         triangle_with(edge.left, edge.right) == no_index;
}

void EditableMesh::flip(const EdgeStar& edge) {
  assert(can_flip(edge));
  const Index first = triangle_with(edge.a, edge.b), second = triangle_with(edge.b, edge.a);
  // (a, b, left) and (b, a, right) become (a, right, left) and (b, left, right).
  replace_corner(first, edge.b, edge.right);
  replace_corner(second, edge.a, edge.left);
  detach(edge.b, first);
  detach(edge.a, second);
  around_[edge.right].push_back(first);
  around_[edge.left].push_back(second);
}

Index EditableMesh::split(const EdgeStar& edge, const Vec3& p) {
  const Index middle = vertex_end();
  const Index first = triangle_with(edge.a, edge.b), second = triangle_with(edge.b, edge.a);
  const auto third = static_cast<Index>(triangle_.size()), fourth = third + 1;
  // The triangles at a keep their numbers, those at b are new.
  replace_corner(first, edge.b, middle);
  replace_corner(second, edge.b, middle);
  triangle_.push_back({middle, edge.b, edge.left});
  triangle_.push_back({edge.b, middle, edge.right});
  position_.push_back(p);
  around_.push_back({first, second, third, fourth});
  detach(edge.b, first);
  detach(edge.b, second);
  around_[edge.b].insert(around_[edge.b].end(), {third, fourth});
  around_[edge.left].push_back(third);
  around_[edge.right].push_back(fourth);
  ++vertex_count_;
  return middle;
}

TriMesh EditableMesh::packed() const {
  TriMesh mesh;
  std::vector<Index> number(position_.size(), no_index);
  for (Index v = 0; v < vertex_end(); ++v) {
    if (!has_vertex(v)) continue;
    number[v] = static_cast<Index>(mesh.vertices.size());
    mesh.vertices.push_back(position_[v]);
  }
  for (const auto& [a, b, c] : triangle_) {
    if (a != no_index) mesh.triangles.push_back({number[a], number[b], number[c]});
  }
  return mesh;
}

}  // namespace condyle::mesh
