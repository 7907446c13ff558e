#include "mesh/label_surface/cell_loops.hpp"

#include <cassert>
#include <cstddef>

namespace condyle::mesh {
namespace {

constexpr std::uint8_t no_edge = 255;

constexpr auto edge_between = [] {
  std::array<std::array<std::uint8_t, cell_corners>, cell_corners> edge{};
  for (auto& row : edge) row.fill(no_edge);
  for (std::size_t e = 0; e < cell_edges; ++e) {
    const auto a = static_cast<std::size_t>(edge_ends[e][0]), b = static_cast<std::size_t>(edge_ends[e][1]);
    edge[a][b] = edge[b][a] = static_cast<std::uint8_t>(e);
  }
  return edge;
}();

/// The two faces that each edge is in.
constexpr auto faces_of_edge = [] {
  std::array<unsigned, cell_edges> faces{};
  for (std::size_t f = 0; f < cell_faces; ++f) {
    for (std::size_t i = 0; i < 4; ++i) {
      const auto a = static_cast<std::size_t>(face_corners[f][i]),
                 b = static_cast<std::size_t>(face_corners[f][(i + 1) % 4]);
      faces[edge_between[a][b]] |= 1u << f;
    }
  }
  return faces;
}();

/// A face's corners in order, whether they are inside, and the edges that follow them.
struct Face {
  std::array<bool, 4> inside{};
  std::array<std::uint8_t, 4> edge{};

  Face(std::size_t number, unsigned set) {
    for (std::size_t i = 0; i < 4; ++i) {
      const auto a = static_cast<std::size_t>(face_corners[number][i]),
                 b = static_cast<std::size_t>(face_corners[number][(i + 1) % 4]);
      inside[i] = ((set >> a) & 1u) != 0;
      edge[i] = edge_between[a][b];
    }
  }
  bool is_ambiguous() const {
    return inside[0] == inside[2] && inside[1] == inside[3] && inside[0] != inside[1];
  }
};

/// Whether every diagonal from the apex joins edges that have no face in common.
bool is_apex(const CellLoop& loop, int apex) {
  const unsigned faces = faces_of_edge[loop.edge[static_cast<std::size_t>(apex)]];
  for (int step = 2; step < loop.size - 1; ++step) {
    const auto other = static_cast<std::size_t>((apex + step) % loop.size);
    if ((faces & faces_of_edge[loop.edge[other]]) != 0) return false;
  }
  return true;
}

}  // namespace

unsigned ambiguous_faces(unsigned inside) {
  unsigned faces = 0;
  for (std::size_t f = 0; f < cell_faces; ++f) {
    if (Face(f, inside).is_ambiguous()) faces |= 1u << f;
  }
  return faces;
}

CellLoops loops_of_cell(unsigned inside, unsigned joined) {
  // On each face, counter-clockwise, the boundary enters the inside along one edge and leaves it along another. A
  // segment goes from where it enters to where it leaves; the face beyond the latter edge enters there.
  std::array<std::uint8_t, cell_edges> next;
  next.fill(no_edge);
  for (std::size_t f = 0; f < cell_faces; ++f) {
    const Face face(f, inside);
    const bool joins = face.is_ambiguous() && ((joined >> f) & 1u) != 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const bool enters = !face.inside[i] && face.inside[(i + 1) % 4];
      if (!enters) continue;
      // Around the corners inside that follow, or back around the corner outside.
      std::size_t leaves = joins ? (i + 3) % 4 : (i + 1) % 4;
      while (!(face.inside[leaves] && !face.inside[(leaves + 1) % 4])) leaves = (leaves + 1) % 4;
      next[face.edge[i]] = face.edge[leaves];
    }
  }

  CellLoops found;
  for (std::size_t start = 0; start < cell_edges; ++start) {
    if (next[start] == no_edge) continue;
    assert(found.size < 4);
    CellLoop& loop = found.loop[static_cast<std::size_t>(found.size++)];
    for (std::size_t e = start; next[e] != no_edge;) {
      loop.edge[static_cast<std::size_t>(loop.size++)] = static_cast<std::uint8_t>(e);
      const std::size_t following = next[e];
      next[e] = no_edge;
      e = following;
    }
    for (int i = 0; i < loop.size; ++i) {
      if (is_apex(loop, i)) loop.apexes |= 1u << i;
    }
  }
  return found;
}

}  // namespace condyle::mesh
