#include "mesh/label_surface/contour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "condyle/error.hpp"
#include "core/parallel.hpp"
#include "mesh/label_surface/cell_loops.hpp"
#include "mesh/label_surface/roundness.hpp"

namespace condyle::mesh {
namespace {

struct KnownLoops {
  std::array<CellLoops, 256> separate;  ///< no corners joined over an ambiguous face
  std::array<std::uint8_t, 256> ambiguous;
};

const KnownLoops& known_loops() {
  static const KnownLoops known = [] {
    KnownLoops made{};
    for (unsigned inside = 0; inside < 256; ++inside) {
      made.separate[inside] = loops_of_cell(inside, 0);
      made.ambiguous[inside] = static_cast<std::uint8_t>(ambiguous_faces(inside));
    }
    return made;
  }();
  return known;
}

/// Where the level is crossed between two samples, as the share of the way from the first.
double crossing(float first, float second) {
  const double a = first, b = second, t = a / (a - b);
  constexpr double margin = contour_margin;
  return t < 2 * margin ? margin + t / 2 : t > 1 - 2 * margin ? 1 - (margin + (1 - t) / 2) : t;
}

/// Numbers of the vertices that belong to the samples of a layer: those on the edges from a sample along each axis, and
/// the one at the sample itself, of a cap.
class LayerNumbers {
 public:
  static constexpr std::size_t at_sample = 3;

  explicit LayerNumbers(std::size_t samples) : number_(4 * samples) {}
  Index& operator()(std::size_t sample, std::size_t which) { return number_[4 * sample + which]; }
  Index operator()(std::size_t sample, std::size_t which) const { return number_[4 * sample + which]; }

 private:
  core::UninitialisedVector<Index> number_;
};

/// Triangles of one layer of cells. Vertices within cells are numbered from `first_of_cells` on in each layer.
struct LayerTriangles {
  std::vector<Triangle> triangle;
  std::vector<std::uint8_t> cap;
  std::vector<Vec3> in_cells;
};

/// Above all numbers of vertices on edges.
constexpr Index first_of_cells = Index{1} << 31;

class Contouring {
 public:
  explicit Contouring(const SampledField& field)
      : field_(field), n_{field.axis[0].size(), field.axis[1].size(), field.axis[2].size()} {}

  std::optional<Contour> run(const std::stop_token& stop) {
    number_vertices();
    if (stop.stop_requested()) return std::nullopt;
    Contour contour;
    contour.mesh.vertices = Points(first_vertex_.back());
    std::vector<LayerTriangles> layers(n_[2] - 1);
    constexpr std::size_t layers_at_once = 16;
    core::parallel_chunks(n_[2], layers_at_once, [&](std::size_t first, std::size_t last) {
      LayerNumbers below(n_[0] * n_[1]), above(n_[0] * n_[1]);
      // Numbers of the layer above a chunk are those that the next one has, too.
      number_layer(first, below, &contour.mesh.vertices);
      for (std::size_t k = first; k < last && k + 1 < n_[2] && !stop.stop_requested(); ++k) {
        number_layer(k + 1, above, k + 1 < last ? &contour.mesh.vertices : nullptr);
        add_cells(k, below, above, layers[k]);
        std::swap(below, above);
      }
    });
    if (stop.stop_requested()) return std::nullopt;
    join(layers, contour);
    return contour;
  }

 private:
  std::size_t sample(std::size_t i, std::size_t j, std::size_t k) const {
    return (k * n_[1] + j) * n_[0] + i;
  }
  Vec3 place(std::size_t i, std::size_t j, std::size_t k) const {
    return {field_.axis[0].coordinate[i], field_.axis[1].coordinate[j], field_.axis[2].coordinate[k]};
  }

  /// visit(i, j, which) for each vertex of a layer, in order.
  template <class Visit>
  void for_each_vertex(std::size_t k, const Visit& visit) const {
    const bool is_cap_layer = field_.axis[2].is_cap(k);
    if (field_.axis[2].is_outer(k)) return;
    const bool goes_up = k + 1 < n_[2] && !field_.axis[2].is_outer(k + 1);
    for (std::size_t j = 0; j < n_[1]; ++j) {
      if (field_.axis[1].is_outer(j)) continue;
      const bool goes_back = j + 1 < n_[1] && !field_.axis[1].is_outer(j + 1);
      const bool is_cap_row = is_cap_layer || field_.axis[1].is_cap(j);
      const float* const row = field_.value.data() + sample(0, j, k);
      const float* const behind = goes_back ? row + n_[0] : row;
      const float* const upper = goes_up ? row + n_[0] * n_[1] : row;
      for (std::size_t i = 0; i < n_[0]; ++i) {
        const bool inside = row[i] >= 0;
        if (inside) {
          if (field_.axis[0].is_outer(i)) continue;
          if (is_cap_row || field_.axis[0].is_cap(i)) visit(i, j, LayerNumbers::at_sample);
        }
        if (i + 1 < n_[0] && inside != (row[i + 1] >= 0) && !field_.axis[0].is_outer(i) &&
            !field_.axis[0].is_outer(i + 1))
          visit(i, j, std::size_t{0});
        if (inside != (behind[i] >= 0)) visit(i, j, std::size_t{1});
        if (inside != (upper[i] >= 0)) visit(i, j, std::size_t{2});
      }
    }
  }

  void number_vertices() {
    std::vector<std::size_t> count(n_[2]);
    core::parallel_chunks(n_[2], 8, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k)
        for_each_vertex(k, [&](std::size_t, std::size_t, std::size_t) { ++count[k]; });
    });
    first_vertex_.assign(1, 0);
    for (const std::size_t c : count) first_vertex_.push_back(first_vertex_.back() + c);
    if (first_vertex_.back() >= first_of_cells)
      throw MeshError("the surface of the label has " + std::to_string(first_vertex_.back()) +
                      " vertices, more than a mesh may have");
  }

  /// Numbers the vertices of a layer, and places them if `vertices` are given.
  void number_layer(std::size_t k, LayerNumbers& numbers, Points* vertices) const {
    auto number = static_cast<Index>(first_vertex_[k]);
    for_each_vertex(k, [&](std::size_t i, std::size_t j, std::size_t which) {
      numbers(j * n_[0] + i, which) = number;
      if (vertices) vertices->set(number, position(i, j, k, which));
      ++number;
    });
  }

  Vec3 position(std::size_t i, std::size_t j, std::size_t k, std::size_t which) const {
    Vec3 p = place(i, j, k);
    if (which == LayerNumbers::at_sample) return p;
    const std::size_t s = sample(i, j, k);
    const std::array<std::size_t, 3> step{1, n_[0], n_[0] * n_[1]};
    const std::array<std::size_t, 3> at{i, j, k};
    const auto& coordinate = field_.axis[which].coordinate;
    const double length = coordinate[at[which] + 1] - coordinate[at[which]];
    p[static_cast<Eigen::Index>(which)] += length * crossing(field_.value[s], field_.value[s + step[which]]);
    return p;
  }

  /// One cell: its samples and the numbers of its vertices.
  struct Cell {
    std::array<std::size_t, 3> at;
    std::array<float, 8> value;
    std::uint8_t cap;
  };

  void add_cells(std::size_t k, const LayerNumbers& below, const LayerNumbers& above,
                 LayerTriangles& out) const {
    const KnownLoops& known = known_loops();
    const auto cap_of = [](const SampleAxis& axis, std::size_t i, int number) {
      return axis.is_outer(i) ? 1 + 2 * number : axis.is_outer(i + 1) ? 2 + 2 * number : 0;
    };
    const int cap_z = cap_of(field_.axis[2], k, 2);
    for (std::size_t j = 0; j + 1 < n_[1]; ++j) {
      const int cap_y = cap_of(field_.axis[1], j, 1);
      if (cap_y != 0 && cap_z != 0) continue;
      std::array<const float*, 4> row;
      for (std::size_t r = 0; r < 4; ++r) row[r] = field_.value.data() + sample(0, j + r % 2, k + r / 2);
      const auto column = [&](std::size_t i) {
        return static_cast<unsigned>(row[0][i] >= 0) | static_cast<unsigned>(row[1][i] >= 0) << 2 |
               static_cast<unsigned>(row[2][i] >= 0) << 4 | static_cast<unsigned>(row[3][i] >= 0) << 6;
      };
      unsigned left = column(0);
      for (std::size_t i = 0; i + 1 < n_[0]; ++i) {
        const unsigned right = column(i + 1), inside = left | right << 1;
        left = right;
        if (inside == 0 || inside == 255) continue;
        const int cap_x = cap_of(field_.axis[0], i, 0);
        // Beyond two caps, where they meet in an edge, there is nothing between them.
        if (cap_x != 0 && (cap_y != 0 || cap_z != 0)) continue;
        Cell cell{{i, j, k}, {}, static_cast<std::uint8_t>(cap_x + cap_y + cap_z)};
        for (std::size_t c = 0; c < 8; ++c) cell.value[c] = row[c / 2][i + c % 2];
        const unsigned joined =
            known.ambiguous[inside] == 0 ? 0 : joined_faces(cell.value, known.ambiguous[inside]);
        if (joined == 0)
          add_loops(cell, known.separate[inside], below, above, out);
        else
          add_loops(cell, loops_of_cell(inside, joined), below, above, out);
      }
    }
  }

  /// The ambiguous faces in whose middle the bilinear interpolation of the corners joins the two inside. Products of
  /// two floats are exact in double.
  static unsigned joined_faces(const std::array<float, 8>& value, unsigned ambiguous) {
    unsigned joined = 0;
    for (std::size_t f = 0; f < cell_faces; ++f) {
      if (((ambiguous >> f) & 1u) == 0) continue;
      const auto at = [&](std::size_t i) {
        return static_cast<double>(value[static_cast<std::size_t>(face_corners[f][i])]);
      };
      const double even = at(0) * at(2), odd = at(1) * at(3);
      if (at(0) >= 0 ? even > odd : odd > even) joined |= 1u << f;
    }
    return joined;
  }

  Index vertex_on(const Cell& cell, std::size_t edge, const LayerNumbers& below,
                  const LayerNumbers& above) const {
    const auto end = [&](int corner) {
      return std::array<std::size_t, 3>{cell.at[0] + (static_cast<std::size_t>(corner) & 1),
                                        cell.at[1] + (static_cast<std::size_t>(corner) >> 1 & 1),
                                        cell.at[2] + (static_cast<std::size_t>(corner) >> 2)};
    };
    const auto number = [&](const std::array<std::size_t, 3>& p, std::size_t which) {
      return (p[2] == cell.at[2] ? below : above)(p[1] * n_[0] + p[0], which);
    };
    const std::size_t axis = edge / 4;
    const auto low = end(edge_ends[edge][0]), high = end(edge_ends[edge][1]);
    if (field_.axis[axis].is_outer(low[axis])) return number(high, LayerNumbers::at_sample);
    if (field_.axis[axis].is_outer(high[axis])) return number(low, LayerNumbers::at_sample);
    return number(low, axis);
  }

  void add_loops(const Cell& cell, const CellLoops& loops, const LayerNumbers& below,
                 const LayerNumbers& above, LayerTriangles& out) const {
    for (int l = 0; l < loops.size; ++l) {
      const CellLoop& loop = loops.loop[static_cast<std::size_t>(l)];
      const auto size = static_cast<std::size_t>(loop.size);
      std::array<Index, cell_edges> number;
      for (std::size_t i = 0; i < size; ++i) number[i] = vertex_on(cell, loop.edge[i], below, above);
      const auto add = [&](Index a, Index b, Index c) {
        out.triangle.push_back({a, b, c});
        out.cap.push_back(cell.cap);
      };
      if (size == 3) {
        add(number[0], number[1], number[2]);
        continue;
      }
      std::array<Vec3, cell_edges> p;
      for (std::size_t i = 0; i < size; ++i) p[i] = vertex_in(cell, loop.edge[i]);
      if (loop.apexes == 0) {
        Vec3 middle = Vec3::Zero();
        for (std::size_t i = 0; i < size; ++i) middle += p[i];
        const auto centre = static_cast<Index>(first_of_cells + out.in_cells.size());
        out.in_cells.push_back(middle / static_cast<double>(size));
        for (std::size_t i = 0; i < size; ++i) add(number[i], number[(i + 1) % size], centre);
        continue;
      }
      const std::size_t apex = best_apex(loop, p);
      for (std::size_t step = 1; step + 1 < size; ++step)
        add(number[apex], number[(apex + step) % size], number[(apex + step + 1) % size]);
    }
  }

  /// Where the vertex on an edge of the cell is.
  Vec3 vertex_in(const Cell& cell, std::size_t edge) const {
    const auto low = static_cast<std::size_t>(edge_ends[edge][0]),
               high = static_cast<std::size_t>(edge_ends[edge][1]);
    Vec3 p = place(cell.at[0] + (low & 1), cell.at[1] + (low >> 1 & 1), cell.at[2] + (low >> 2));
    const std::size_t axis = edge / 4, at = cell.at[axis];
    const auto& coordinate = field_.axis[axis].coordinate;
    p[static_cast<Eigen::Index>(axis)] +=
        (coordinate[at + 1] - coordinate[at]) * crossing(cell.value[low], cell.value[high]);
    return p;
  }

  /// The place from which the least round triangle is the roundest; the first of equals.
  static std::size_t best_apex(const CellLoop& loop, const std::array<Vec3, cell_edges>& p) {
    const auto size = static_cast<std::size_t>(loop.size);
    // Opposite corners of a quadrilateral have one diagonal.
    const std::size_t different = size == 4 ? 2 : size;
    std::size_t best = size;
    double best_roundness = -1;
    for (std::size_t apex = 0; apex < different; ++apex) {
      if (((loop.apexes >> apex) & 1u) == 0) continue;
      double least = 1;
      for (std::size_t step = 1; step + 1 < size; ++step)
        least = std::min(least, roundness(p[apex], p[(apex + step) % size], p[(apex + step + 1) % size]));
      if (least > best_roundness) best_roundness = least, best = apex;
    }
    return best;
  }

  void join(const std::vector<LayerTriangles>& layers, Contour& contour) const {
    TriMesh& mesh = contour.mesh;
    std::size_t triangles = 0;
    for (const LayerTriangles& layer : layers) triangles += layer.triangle.size();
    mesh.triangles.reserve(triangles);
    contour.cap.reserve(triangles);
    for (const LayerTriangles& layer : layers) {
      const auto shift = static_cast<Index>(mesh.vertices.size());
      for (const Vec3& p : layer.in_cells) mesh.vertices.push_back(p);
      for (Triangle t : layer.triangle) {
        for (Index& v : t)
          if (v >= first_of_cells) v = v - first_of_cells + shift;
        mesh.triangles.push_back(t);
      }
      contour.cap.insert(contour.cap.end(), layer.cap.begin(), layer.cap.end());
    }
  }

  const SampledField& field_;
  std::array<std::size_t, 3> n_;
  std::vector<std::size_t> first_vertex_;
};

}  // namespace

std::optional<Contour> contour_of(const SampledField& field, const std::stop_token& stop) {
  return Contouring(field).run(stop);
}

}  // namespace condyle::mesh
