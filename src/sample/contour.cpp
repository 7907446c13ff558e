#include "sample/contour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "condyle/error.hpp"
#include "core/parallel.hpp"

namespace condyle::sample {
namespace {

/// Lattice points per block edge: blocks the surface cannot reach are skipped.
constexpr std::size_t block_edge = 4;

/// No field here is steeper: pieces taper by less than their length, and blends are no steeper than their
/// pieces.
constexpr double steepest_slope = std::numbers::sqrt2;

/// Points of a regular lattice, x running fastest.
struct Lattice {
  Vec3 low;
  double spacing;
  std::array<std::size_t, 3> count;

  Lattice(const Box& box, double step) : low(box.low), spacing(step) {
    for (int k = 0; k < 3; ++k) {
      count[k] = static_cast<std::size_t>(std::ceil((box.high[k] - box.low[k]) / step)) + 1;
    }
  }
  std::size_t size() const noexcept { return count[0] * count[1] * count[2]; }
  std::array<std::size_t, 3> block_count() const noexcept {
    const auto blocks = [](std::size_t points) { return (points + block_edge - 1) / block_edge; };
    return {blocks(count[0]), blocks(count[1]), blocks(count[2])};
  }
  std::array<std::size_t, 3> cell(std::size_t i) const noexcept {
    return {i % count[0], i / count[0] % count[1], i / count[0] / count[1]};
  }
  std::size_t number(const std::array<std::size_t, 3>& c) const noexcept {
    return c[0] + count[0] * (c[1] + count[1] * c[2]);
  }
  Vec3 point(const std::array<std::size_t, 3>& c) const noexcept {
    return low +
           spacing * Vec3(static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2]));
  }
  bool on_border(std::size_t i) const noexcept {
    const auto c = cell(i);
    for (int k = 0; k < 3; ++k) {
      if (c[k] == 0 || c[k] + 1 == count[k]) return true;
    }
    return false;
  }
  /// Corner of a cube by three bits, x lowest.
  std::size_t corner(std::size_t cube, unsigned bits) const noexcept {
    return cube + (bits & 1) + (bits >> 1 & 1) * count[0] + (bits >> 2 & 1) * count[0] * count[1];
  }
};

/// The six tetrahedra of a cube about the diagonal from corner 0 to corner 7, each with positive volume.
constexpr std::array<std::array<unsigned, 4>, 6> tetrahedra = {
    {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 3, 2, 7}, {0, 6, 4, 7}, {0, 5, 1, 7}}};

/// For each set of inside corners (one bit each), the corners in an even order that puts the inside ones
/// first, or, where three are inside, the outside one.
constexpr std::array<std::array<unsigned, 4>, 16> corner_order = {{{0, 1, 2, 3},
                                                                   {0, 1, 2, 3},
                                                                   {1, 0, 3, 2},
                                                                   {0, 1, 2, 3},
                                                                   {2, 3, 0, 1},
                                                                   {0, 2, 3, 1},
                                                                   {1, 2, 0, 3},
                                                                   {3, 2, 1, 0},
                                                                   {3, 2, 1, 0},
                                                                   {0, 3, 1, 2},
                                                                   {3, 1, 0, 2},
                                                                   {2, 3, 0, 1},
                                                                   {2, 3, 0, 1},
                                                                   {1, 0, 3, 2},
                                                                   {0, 1, 2, 3},
                                                                   {0, 1, 2, 3}}};

class Contouring {
 public:
  Contouring(const Solid& solid, double spacing)
      : lattice_(solid.box, spacing), value_(lattice_.size()), vertex_on_(7 * lattice_.size(), no_index) {
    constexpr std::size_t grain = 16;
    const auto blocks = lattice_.block_count();
    core::parallel_chunks(blocks[0] * blocks[1] * blocks[2], grain, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        sample(solid.field, {i % blocks[0], i / blocks[0] % blocks[1], i / blocks[0] / blocks[1]});
      }
    });
  }

  TriMesh run() && {
    for (std::size_t i = 0; i < lattice_.size(); ++i) {
      const auto c = lattice_.cell(i);
      if (value_[i] < 0 && lattice_.on_border(i)) throw MeshError("sample: the surface leaves its box");
      if (c[0] + 1 < lattice_.count[0] && c[1] + 1 < lattice_.count[1] && c[2] + 1 < lattice_.count[2])
        cut_cube(i);
    }
    return std::move(mesh_);
  }

 private:
  /// Fills one block of lattice points. Where the value at its middle is too large for the surface to reach
  /// into the block, that value stands for all: only its sign is ever used.
  void sample(const Field& solid, const std::array<std::size_t, 3>& block) {
    std::array<std::size_t, 3> first, last;
    for (int k = 0; k < 3; ++k) {
      first[k] = block[k] * block_edge;
      last[k] = std::min(first[k] + block_edge, lattice_.count[k]);
    }
    const Vec3 low = lattice_.point(first), high = lattice_.point({last[0] - 1, last[1] - 1, last[2] - 1});
    const double middle = solid((low + high) / 2).value;
    const bool is_near = std::abs(middle) <= steepest_slope * (high - low).norm() / 2;
    for (std::size_t z = first[2]; z < last[2]; ++z) {
      for (std::size_t y = first[1]; y < last[1]; ++y) {
        for (std::size_t x = first[0]; x < last[0]; ++x) {
          value_[lattice_.number({x, y, z})] = is_near ? solid(lattice_.point({x, y, z})).value : middle;
        }
      }
    }
  }

  void cut_cube(std::size_t cube) {
    unsigned inside = 0;
    for (unsigned k = 0; k < 8; ++k) inside |= unsigned{value_[lattice_.corner(cube, k)] < 0} << k;
    if (inside == 0 || inside == 255) return;
    for (const auto& tetrahedron : tetrahedra) cut(cube, tetrahedron, inside);
  }

  void cut(std::size_t cube, const std::array<unsigned, 4>& tetrahedron, unsigned inside_cube) {
    unsigned inside = 0, count = 0;
    for (unsigned k = 0; k < 4; ++k) {
      const unsigned in = inside_cube >> tetrahedron[k] & 1;
      inside |= in << k;
      count += in;
    }
    if (count == 0 || count == 4) return;
    const auto& order = corner_order[inside];
    const auto on = [&](unsigned i, unsigned j) {
      return vertex_between(cube, tetrahedron[order[i]], tetrahedron[order[j]]);
    };
    if (count == 2) {
      const Index a = on(0, 2), b = on(0, 3), c = on(1, 3), d = on(1, 2);
      mesh_.triangles.push_back({a, b, c});
      mesh_.triangles.push_back({a, c, d});
    } else {
      Triangle t = {on(0, 1), on(0, 2), on(0, 3)};
      if (count == 3) std::swap(t[1], t[2]);
      mesh_.triangles.push_back(t);
    }
  }

  /// The vertex on a tetrahedron's edge. Corner numbers grow along every such edge, whose direction is one of
  /// seven.
  Index vertex_between(std::size_t cube, unsigned i, unsigned j) {
    const unsigned from = std::min(i, j), to = std::max(i, j);
    const std::size_t a = lattice_.corner(cube, from), b = lattice_.corner(cube, to);
    Index& vertex = vertex_on_[7 * a + (to - from - 1)];
    if (vertex == no_index) {
      vertex = static_cast<Index>(mesh_.vertices.size());
      // Kept off the lattice points: where the surface passes through one, the vertices on its edges stay
      // apart.
      constexpr double margin = 0.1;
      const double t = std::clamp(value_[a] / (value_[a] - value_[b]), margin, 1 - margin);
      const Vec3 from_point = lattice_.point(lattice_.cell(a)), to_point = lattice_.point(lattice_.cell(b));
      mesh_.vertices.push_back(from_point + t * (to_point - from_point));
    }
    return vertex;
  }

  Lattice lattice_;
  std::vector<double> value_;
  std::vector<Index> vertex_on_;  ///< 7 per lattice point: the edge towards + its direction bits
  TriMesh mesh_;
};

}  // namespace

TriMesh contoured(const Solid& solid, double spacing) {
  return Contouring(solid, spacing).run();
}

}  // namespace condyle::sample
