#include "kinematics/body_pieces.hpp"

#include <algorithm>

#include "core/formatted.hpp"
#include "core/rounded.hpp"
#include "kinematics/cut_parts.hpp"
#include "kinematics/hip_parts.hpp"
#include "mesh/surface_pieces.hpp"

namespace condyle::kinematics {
namespace {

using core::formatted;
using mesh::SurfacePiece;
using mesh::SurfacePieces;

/// The share of a mesh's outer surface that is most of a bone: the other one of two legs has half.
constexpr double most_of_bone = 0.6;

/// A cavity wider than this share of what is around it is no pore.
constexpr double widest_pore = 0.25;

std::string text_of(const SurfacePiece& piece) {
  return formatted("%zu triangle%s, %.3g mm across, near ", piece.triangles, piece.triangles == 1 ? "" : "s",
                   piece.width()) +
         core::rounded((piece.bounds.low + piece.bounds.high) / 2, 1);
}

/// Wound as the boundary of a cavity in what is around it.
bool is_cavity(const SurfacePieces& pieces, const SurfacePiece& piece) {
  const SurfacePiece& around = pieces.all[piece.around];
  return piece.is_closed && around.is_closed && (piece.signed_volume < 0) != (around.signed_volume < 0);
}

/// The piece of most area of those chosen.
template <class Chosen>
const SurfacePiece* largest_of(const SurfacePieces& pieces, const Chosen& is_chosen) {
  const SurfacePiece* largest = nullptr;
  for (const SurfacePiece& piece : pieces.all)
    if (is_chosen(piece) && (!largest || piece.area > largest->area)) largest = &piece;
  return largest;
}

}  // namespace

std::string piece_text(const Mesh& mesh, std::size_t piece) {
  return text_of(mesh::pieces_of(mesh).all[piece]);
}

std::vector<JointNote> piece_notes(const std::string& name, const Mesh& mesh, bool is_cut) {
  const SurfacePieces& pieces = mesh::pieces_of(mesh);
  std::vector<JointNote> notes;
  if (pieces.all.size() < 2) return notes;
  const auto is_nested = [&](const SurfacePiece& piece) {
    return piece.is_inner() && !is_cavity(pieces, piece);
  };
  if (const SurfacePiece* inner = largest_of(pieces, is_nested)) {
    const auto count = std::count_if(pieces.all.begin(), pieces.all.end(), is_nested);
    notes.push_back({JointNoteCode::nested_surfaces,
                     name +
                         (count == 1 ? std::string(" has a surface inside another: ")
                                     : formatted(" has %td surfaces inside others, the largest of ", count)) +
                         text_of(*inner) +
                         "; nothing there counts as head, socket or axis, but areas and volumes of contact "
                         "count it too"});
  }
  const auto is_hollow = [&](const SurfacePiece& piece) {
    return piece.is_inner() && is_cavity(pieces, piece) &&
           piece.width() > widest_pore * pieces.all[piece.around].width();
  };
  if (const SurfacePiece* cavity = largest_of(pieces, is_hollow))
    notes.push_back({JointNoteCode::nested_surfaces, name + " is hollow, with a cavity of " +
                                                         text_of(*cavity) +
                                                         "; what reaches through the wall around it is not "
                                                         "inside: depths and volumes count the wall only"});
  if (is_cut) return notes;
  const auto is_outer = [](const SurfacePiece& piece) { return !piece.is_inner(); };
  const SurfacePiece* main = largest_of(pieces, is_outer);
  const auto is_beside = [&](const SurfacePiece& piece) { return is_outer(piece) && &piece != main; };
  if (const SurfacePiece* beside = largest_of(pieces, is_beside)) {
    const auto count = std::count_if(pieces.all.begin(), pieces.all.end(), is_beside);
    notes.push_back({JointNoteCode::separate_pieces,
                     name + formatted(" is %td pieces: beside the largest, ", count + 1) +
                         (count == 1 ? "one of " : formatted("%td others, the largest of ", count)) +
                         text_of(*beside)});
  }
  return notes;
}

TriMesh pieces_about(const Mesh& mesh, const Sphere& head) {
  constexpr double reach = 2;
  const SurfacePieces& pieces = mesh::pieces_of(mesh);
  if (pieces.of_vertex.empty()) return mesh;
  std::vector<bool> near(pieces.all.size());
  for (std::size_t v = 0; v < pieces.of_vertex.size(); ++v)
    if (const std::size_t piece = pieces.of_vertex[v]; piece != SurfacePiece::no_piece && !near[piece])
      near[piece] =
          !pieces.all[piece].is_inner() && (mesh.vertices()[v] - head.centre).norm() < reach * head.radius;
  return mesh::with_pieces(mesh, near);
}

OwnVertices own_vertices(const Joint& joint, const std::optional<Sphere>& head) {
  OwnVertices own;
  // Bodies of one piece have no other.
  const auto is_several = [](const Body& body) { return !mesh::pieces_of(body.mesh).of_vertex.empty(); };
  if (!head) return own;
  if (is_several(joint.mobile))
    if (const auto& patch = head_near_centre(joint.mobile.mesh)) own.mobile = patch->fit.vertices;
  if (is_several(joint.fixed) && joint.is_hip())
    if (const auto socket = socket_around(uncut_surface(joint.fixed), *head); *socket)
      own.fixed = (*socket)->fit.vertices;
  return own;
}

std::optional<std::size_t> stray_piece(const Body& body, Index vertex, const std::vector<Index>& own) {
  const SurfacePieces& pieces = mesh::pieces_of(body.mesh);
  if (pieces.of_vertex.empty()) return std::nullopt;
  const std::size_t piece = pieces.of_vertex[vertex];
  if (piece == SurfacePiece::no_piece) return std::nullopt;
  if (std::any_of(own.begin(), own.end(), [&](Index v) { return pieces.of_vertex[v] == piece; }))
    return std::nullopt;
  // Parts that were cut from each other are one bone.
  const std::vector<char> cut = cut_vertices(body);
  for (std::size_t v = 0; v < cut.size(); ++v)
    if (cut[v] && pieces.of_vertex[v] == piece) return std::nullopt;
  // Meshes of one body may be as small as they like.
  const BodyPart* part = part_of_vertex(body, vertex);
  double all = 0, largest = 0;
  for (const SurfacePiece& other : pieces.all) {
    if (other.is_inner() || part_of_triangle(body, other.first_triangle) != part) continue;
    all += other.area;
    largest = std::max(largest, other.area);
  }
  const double area = pieces.all[piece].area;
  const bool is_most = area >= most_of_bone * all || (own.empty() && area >= largest);
  return is_most ? std::nullopt : std::optional(piece);
}

}  // namespace condyle::kinematics
