#include "mesh/surface_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "core/lazy.hpp"
#include "core/trigonometry.hpp"
#include "mesh/disjoint_sets.hpp"
#include "mesh/edge_table.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/findings.hpp"
#include "mesh/triangle_distance.hpp"
#include "mesh/triangle_tree.hpp"
#include "mesh/winding_number.hpp"

namespace condyle::mesh {
namespace {

constexpr std::size_t no_piece = SurfacePiece::no_piece;

/// A flat piece has no more volume than this share of its area times its width: rounding.
constexpr double flat_share = 1e-9;

/// A piece inside an open one is judged by so many of its vertices, and only if it has this share of the other's area: specks mislead no fit,
/// and each costs the whole of the open piece.
constexpr std::size_t vertices_judged = 5;
constexpr double least_judged_share = 0.01;

/// Component numbers of the triangles.
ConnectedComponents connected(const Mesh& mesh) {
  if (mesh.is_closed()) return edges_of(mesh).components();
  // The vertices of some files are those of each triangle, written again.
  const std::vector<Index> first = first_of_same_coordinates(mesh.vertices());
  DisjointSets sets(mesh.vertices().size());
  for (const auto& [a, b, c] : mesh.triangles()) sets.join(first[a], first[b]), sets.join(first[b], first[c]);
  ConnectedComponents components;
  std::vector<Index> number(mesh.vertices().size(), no_index);
  for (Index t = 0; t < mesh.triangles().size(); ++t) {
    Index& own = number[sets.find(first[mesh.triangles()[t][0]])];
    if (own == no_index) {
      own = static_cast<Index>(components.first_triangle.size());
      components.first_triangle.push_back(t);
    }
    components.of_triangle.push_back(own);
  }
  return components;
}

/// Fills in everything but what is inner; false if there is one piece only.
bool measure_pieces(const Mesh& mesh, SurfacePieces& out) {
  const ConnectedComponents components = connected(mesh);
  // Nobody asks for the size of a piece that is alone.
  if (components.first_triangle.size() == 1) {
    out.all.push_back({.triangles = mesh.triangles().size(), .is_closed = mesh.is_closed()});
    return false;
  }
  std::vector<std::size_t> number(components.first_triangle.size(), no_piece);
  const BoundingBox bounds = bounds_of_surface(mesh);
  const Vec3 centre = (bounds.low + bounds.high) / 2;
  std::vector<CompensatedSum> volumes;
  for (Index t = 0; t < mesh.triangles().size(); ++t) {
    if (names_a_vertex_twice(mesh.triangles()[t])) continue;
    std::size_t& own = number[components.of_triangle[t]];
    const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
    if (own == no_piece) {
      own = out.all.size();
      out.all.push_back({.first_triangle = t, .bounds = {a, a}});
      volumes.emplace_back();
    }
    SurfacePiece& piece = out.all[own];
    ++piece.triangles;
    piece.area += (b - a).cross(c - a).norm() / 2;
    for (const Vec3& p : {a, b, c}) {
      piece.bounds.low = piece.bounds.low.cwiseMin(p);
      piece.bounds.high = piece.bounds.high.cwiseMax(p);
    }
    volumes[own].add(volume_below(mesh, t, centre));
  }
  for (std::size_t i = 0; i < volumes.size(); ++i) out.all[i].signed_volume = volumes[i].value();
  if (out.all.size() < 2) {
    for (SurfacePiece& piece : out.all) piece.is_closed = mesh.is_closed();
    return false;
  }
  out.of_triangle.resize(mesh.triangles().size());
  for (std::size_t t = 0; t < out.of_triangle.size(); ++t)
    out.of_triangle[t] =
        names_a_vertex_twice(mesh.triangles()[t]) ? no_piece : number[components.of_triangle[t]];
  if (!mesh.is_closed()) {
    const EdgeTable& edges = edges_of(mesh);
    for (std::size_t e = 0; e < edges.size(); ++e)
      if (edges.balance(mesh, e) != 0)
        if (const std::size_t piece = out.of_triangle[edges.half_edges(e)[0] / 3]; piece != no_piece)
          out.all[piece].is_closed = false;
  }
  return true;
}

/// The share of directions from p, signed by the winding, that meet a surface: van Oosterom and Strackee (1983).
double winding_share(const TriMesh& mesh, const Vec3& p) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0) - p, b = mesh.corner(t, 1) - p, c = mesh.corner(t, 2) - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum +=
        2 * core::arctangent(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

/// The vertices of all pieces, and which of them lie where.
class InnerVertices {
 public:
  InnerVertices(const Mesh& mesh, SurfacePieces& pieces)
      : mesh_(mesh), pieces_(pieces), tree_(tree_of(mesh)) {
    pieces.of_vertex.assign(mesh.vertices().size(), no_piece);
    const auto& piece_ = pieces.of_vertex;
    for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
      const std::size_t piece = pieces.of_triangle[t];
      if (piece == no_piece) continue;
      for (const Index v : mesh.triangles()[t]) {
        // A vertex that two pieces share lies on both, inside neither.
        if (piece_[v] == no_piece) ++pieces.all[piece].vertices;
        pieces.of_vertex[v] = piece;
      }
    }
    for (std::size_t i = 0; i < pieces.all.size(); ++i) by_volume_.push_back(i);
    for (const SurfacePiece& piece : pieces.all) first_.push_back(first_.back() + piece.triangles);
    triangles_.resize(first_.back());
    std::vector<std::size_t> next(first_);
    for (Index t = 0; t < mesh.triangles().size(); ++t)
      if (pieces.of_triangle[t] != no_piece) triangles_[next[pieces.of_triangle[t]]++] = t;
    number_.assign(mesh.vertices().size(), no_index);
    std::stable_sort(by_volume_.begin(), by_volume_.end(), [&](std::size_t a, std::size_t b) {
      return box_volume(pieces.all[a]) < box_volume(pieces.all[b]);
    });
  }

  /// The smallest pieces first, so that the first that holds a vertex is the smallest around it.
  void find() {
    for (const std::size_t piece : by_volume_) {
      const std::vector<Index> candidates = within_bounds(piece);
      if (candidates.empty()) continue;
      const TriMesh alone = piece_alone(piece);
      if (pieces_.all[piece].is_closed)
        find_in_closed(piece, alone, candidates);
      else
        find_in_open(piece, alone, candidates);
    }
  }

 private:
  static double box_volume(const SurfacePiece& piece) {
    return (piece.bounds.high - piece.bounds.low).prod();
  }

  /// One piece with vertices of its own.
  TriMesh piece_alone(std::size_t piece) {
    TriMesh alone;
    std::vector<Index> used;
    for (std::size_t i = first_[piece]; i < first_[piece + 1]; ++i) {
      Triangle own = mesh_.triangles()[triangles_[i]];
      for (Index& v : own) {
        if (number_[v] == no_index) {
          number_[v] = static_cast<Index>(used.size());
          used.push_back(v);
          alone.vertices.push_back(mesh_.vertices()[v]);
        }
        v = number_[v];
      }
      alone.triangles.push_back(own);
    }
    for (const Index v : used) number_[v] = no_index;
    return alone;
  }

  /// Vertices of other pieces, ascending.
  std::vector<Index> within_bounds(std::size_t piece) const {
    const Vec3 &low = pieces_.all[piece].bounds.low, &high = pieces_.all[piece].bounds.high;
    const auto may_hold_any = [&](const TriangleTree::Node& node) {
      for (int k = 0; k < 3; ++k)
        if (double{node.centre[k]} - double{node.half[k]} > high[k] ||
            double{node.centre[k]} + double{node.half[k]} < low[k])
          return false;
      return true;
    };
    std::vector<Index> found, waiting{0};
    while (!waiting.empty()) {
      const TriangleTree::Node& node = tree_->nodes()[waiting.back()];
      waiting.pop_back();
      if (!may_hold_any(node)) continue;
      if (!node.is_leaf()) {
        waiting.insert(waiting.end(), {node.child, node.child + 1});
        continue;
      }
      for (Index i = node.first; i < node.last; ++i)
        for (const Index place : tree_->triangles()[i]) {
          const Index v = tree_->mesh_vertices()[place];
          const Vec3& p = tree_->vertices()[place];
          if (pieces_.of_vertex[v] != piece && pieces_.of_vertex[v] != no_piece &&
              (p.array() >= low.array()).all() && (p.array() <= high.array()).all())
            found.push_back(v);
        }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  void mark(Index v, std::size_t around) {
    if (pieces_.is_inner.empty()) pieces_.is_inner.assign(pieces_.of_vertex.size(), 0);
    SurfacePiece& own = pieces_.all[pieces_.of_vertex[v]];
    if (!std::exchange(pieces_.is_inner[v], char{1})) ++own.inner_vertices;
    if (own.around == no_piece) own.around = around;
  }

  void find_in_closed(std::size_t piece, const TriMesh& alone, const std::vector<Index>& candidates) {
    const WindingNumber winding{Mesh(alone)};
    Points points;
    for (const Index v : candidates) points.push_back(mesh_.vertices()[v]);
    const std::vector<PointWinding> found = winding.at(points.view());
    for (std::size_t i = 0; i < candidates.size(); ++i)
      if (found[i].winding != 0) mark(candidates[i], piece);
  }

  void find_in_open(std::size_t piece, const TriMesh& alone, std::vector<Index> candidates) {
    const SurfacePiece& around = pieces_.all[piece];
    const auto piece_of = [&](Index v) { return pieces_.of_vertex[v]; };
    std::stable_sort(candidates.begin(), candidates.end(),
                     [&](Index a, Index b) { return piece_of(a) < piece_of(b); });
    for (std::size_t first = 0, last = 0; first < candidates.size(); first = last) {
      const std::size_t other = piece_of(candidates[first]);
      while (last < candidates.size() && piece_of(candidates[last]) == other) ++last;
      const std::span own = std::span(candidates).subspan(first, last - first);
      const SurfacePiece& inside = pieces_.all[other];
      if (own.size() < inside.vertices || !(inside.area >= least_judged_share * around.area) ||
          !(inside.area <= around.area))
        continue;
      bool is_inside = true;
      for (std::size_t k = 0; is_inside && k < vertices_judged; ++k) {
        const Index v = own[k * (own.size() - 1) / (vertices_judged - 1)];
        is_inside = std::abs(winding_share(alone, mesh_.vertices()[v])) > 0.5;
      }
      if (is_inside)
        for (const Index v : own) mark(v, piece);
    }
  }

  const Mesh& mesh_;
  SurfacePieces& pieces_;
  std::shared_ptr<const TriangleTree> tree_;
  std::vector<std::size_t> by_volume_;
  /// Piece i has the triangles [first_[i], first_[i + 1]) of `triangles_`.
  std::vector<std::size_t> first_{0};
  std::vector<Index> triangles_, number_;
};

/// How much of a body a piece is.
double amount(const SurfacePiece& piece, bool by_volume) noexcept {
  return by_volume ? std::abs(piece.signed_volume) : piece.area;
}

struct KeptPieces {
  core::Lazy<SurfacePieces> pieces;
  core::Lazy<std::optional<Mesh>> outer;
};

const KeptPieces& kept_with(const Mesh& mesh) {
  return findings_of(mesh).get<KeptPieces>();
}

}  // namespace

const SurfacePieces& pieces_of(const Mesh& mesh) {
  return kept_with(mesh).pieces.get([&](SurfacePieces& pieces) {
    SurfacePieces made;
    if (measure_pieces(mesh, made)) InnerVertices(mesh, made).find();
    pieces = std::move(made);
  });
}

std::vector<bool> kept_pieces(const SurfacePieces& pieces, const PieceChoice& choice) {
  const bool by_volume = std::all_of(pieces.all.begin(), pieces.all.end(),
                                     [](const SurfacePiece& piece) { return piece.is_closed; });
  std::vector<std::size_t> largest_first(pieces.all.size());
  std::iota(largest_first.begin(), largest_first.end(), std::size_t{0});
  std::stable_sort(largest_first.begin(), largest_first.end(), [&](std::size_t a, std::size_t b) {
    return amount(pieces.all[a], by_volume) > amount(pieces.all[b], by_volume);
  });
  std::vector<bool> kept(pieces.all.size());
  std::optional<double> most;  // of the first solid
  for (const std::size_t i : largest_first) {
    const SurfacePiece& piece = pieces.all[i];
    const bool is_solid = !piece.is_closed || piece.signed_volume > 0;
    if (!piece.is_inner()) {
      const double here = amount(piece, by_volume);
      kept[i] = is_solid && (choice.all_solids || !most || here > choice.least_part * *most);
      if (is_solid && !most) most = here;
    } else {
      kept[i] = kept[piece.around] && (is_solid ? choice.all_solids : choice.keep_cavities);
    }
  }
  return kept;
}

std::vector<bool> piece_with_cavities(const SurfacePieces& pieces, std::size_t piece) {
  std::vector<bool> kept(pieces.all.size());
  kept[piece] = true;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const SurfacePiece& other = pieces.all[i];
    kept[i] =
        kept[i] || (other.around == piece && other.is_inner() && other.is_closed && other.signed_volume < 0);
  }
  return kept;
}

TriMesh with_pieces(const Mesh& mesh, const std::vector<bool>& kept) {
  const SurfacePieces& pieces = pieces_of(mesh);
  TriMesh part{mesh.vertices(), {}};
  if (pieces.of_triangle.empty()) return mesh;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t)
    if (const std::size_t piece = pieces.of_triangle[t]; piece != no_piece && kept[piece])
      part.triangles.push_back(mesh.triangles()[t]);
  return part;
}

TriMesh piece_alone(const Mesh& mesh, std::size_t piece) {
  TriMesh part = with_pieces(mesh, piece_with_cavities(pieces_of(mesh), piece));
  drop_unreferenced_vertices(part);
  return part;
}

std::optional<Index> inverted_piece(const Mesh& mesh) {
  for (const SurfacePiece& piece : pieces_of(mesh).all)
    if (piece.is_closed && !piece.is_inner() &&
        piece.signed_volume < -flat_share * piece.area * piece.width())
      return piece.first_triangle;
  return std::nullopt;
}

const Mesh& outer_surface(const Mesh& mesh) {
  const std::vector<char>& inner = pieces_of(mesh).is_inner;
  if (inner.empty()) return mesh;
  const auto& kept = kept_with(mesh).outer.get([&](std::optional<Mesh>& made) {
    TriMesh surface{mesh.vertices(), {}};
    for (const Triangle& t : mesh.triangles())
      if (!(inner[t[0]] && inner[t[1]] && inner[t[2]])) surface.triangles.push_back(t);
    made.emplace(std::move(surface));
  });
  return *kept;
}

}  // namespace condyle::mesh

namespace condyle {
namespace {

TriMesh without_others(const Mesh& mesh, const std::vector<bool>& kept) {
  TriMesh part = mesh::with_pieces(mesh, kept);
  drop_unreferenced_vertices(part);
  return part;
}

}  // namespace

TriMesh largest_piece(const Mesh& mesh) {
  const mesh::SurfacePieces& pieces = mesh::pieces_of(mesh);
  return pieces.all.size() < 2 ? mesh.arrays() : without_others(mesh, mesh::kept_pieces(pieces, {}));
}

TriMesh piece_at(const Mesh& mesh, const Vec3& point) {
  constexpr double as_near = 0.1;
  const mesh::SurfacePieces& pieces = mesh::pieces_of(mesh);
  if (pieces.all.size() < 2) return mesh;
  std::vector<double> squared(pieces.all.size(), HUGE_VAL);
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    const std::size_t piece = pieces.of_triangle[t];
    if (piece == mesh::SurfacePiece::no_piece || pieces.all[piece].is_inner()) continue;
    const Vec3 foot =
        mesh::nearest_on_triangle(point, {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)});
    squared[piece] = std::min(squared[piece], (foot - point).squaredNorm());
  }
  double area = 0;
  for (const mesh::SurfacePiece& piece : pieces.all) area += piece.area;
  const double farthest =
      std::sqrt(*std::min_element(squared.begin(), squared.end())) + as_near * std::sqrt(area);
  std::vector<bool> kept(squared.size());
  for (std::size_t p = 0; p < squared.size(); ++p) {
    if (!(std::sqrt(squared[p]) <= farthest)) continue;
    const std::vector<bool> with_cavities = mesh::piece_with_cavities(pieces, p);
    std::transform(kept.begin(), kept.end(), with_cavities.begin(), kept.begin(), std::logical_or<>());
  }
  return without_others(mesh, kept);
}

}  // namespace condyle
