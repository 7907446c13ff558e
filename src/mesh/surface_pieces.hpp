#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "condyle/inspect.hpp"
#include "condyle/mesh.hpp"

/// The connected pieces of a surface, and which of it faces the outside.
///
///     ________________
///    /   _______      \     outer   winding 0 outside, 1 inside: what another body can meet
///   |   / inner \      |    inner   inside another piece, whichever way it is wound: the wall of a marrow, a nucleus,
///   |   \_______/      |            a second wall that a segmentation left. Nothing can touch it, and no head, socket,
///    \________________/             axis or measure is that of the bone's surface there
///

namespace condyle::mesh {

/// Triangles that hang together over edges; those of open meshes also over vertices at the same place.
struct SurfacePiece {
  Index first_triangle = 0;
  std::size_t triangles = 0, vertices = 0;
  double area = 0;
  BoundingBox bounds{};
  bool is_closed = true;
  double signed_volume = 0;        ///< of a closed piece
  std::size_t inner_vertices = 0;  ///< that lie inside other pieces
  std::size_t around = no_piece;   ///< the smallest piece that holds one of them

  static constexpr std::size_t no_piece = static_cast<std::size_t>(-1);

  /// Most of it lies inside other pieces.
  bool is_inner() const noexcept { return 2 * inner_vertices > vertices; }
  double width() const noexcept { return bounds.diagonal(); }
};

struct SurfacePieces {
  /// By first triangle; triangles that name a vertex twice alone are none. One that is alone is not measured.
  std::vector<SurfacePiece> all;
  /// Their numbers by triangle, no_piece for those, and by vertex; empty if there is one piece.
  std::vector<std::size_t> of_triangle = {}, of_vertex = {};
  std::vector<char> is_inner = {};  ///< by vertex; empty if none is
};

/// Which pieces of a body stay.
struct PieceChoice {
  bool all_solids = false, keep_cavities = true;
  double least_part = 1;  ///< solids with more than this part of the largest stay as it does
};

/// By piece: of the solids that lie in no other the one of most volume stays (of most area if the surface is open), or all; of what lies
/// directly in a solid that stays, its cavities if they are kept; of what lies in such a cavity, solids if all are kept; and so on.
std::vector<bool> kept_pieces(const SurfacePieces& pieces, const PieceChoice& choice);

/// One of them and the cavities in it.
std::vector<bool> piece_with_cavities(const SurfacePieces& pieces, std::size_t piece);

/// The pieces of a surface. A vertex is inner if another closed piece winds round it, or if the piece is large and an open one winds round
/// more than half of the directions from it. Kept with the mesh; near linear, and a winding number for each piece that may hold another.
const SurfacePieces& pieces_of(const Mesh& mesh);

/// The first triangle of a closed piece that is inside out and lies in no other, as the wall of a cavity rightly does.
std::optional<Index> inverted_piece(const Mesh& mesh);

/// The surface without the triangles all of whose corners are inner, with the numbers of its vertices. The mesh itself if there
/// are none. Kept with the mesh.
const Mesh& outer_surface(const Mesh& mesh);

/// The triangles of some pieces, with the numbers of the mesh's vertices.
TriMesh with_pieces(const Mesh& mesh, const std::vector<bool>& kept);
/// One piece and its cavities, with their vertices only.
TriMesh piece_alone(const Mesh& mesh, std::size_t piece);

}  // namespace condyle::mesh
