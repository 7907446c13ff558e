#include "kinematics/surface_notes.hpp"

#include "core/formatted.hpp"
#include "mesh/doubled_triangles.hpp"
#include "mesh/edge_table.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/self_crossings.hpp"
#include "mesh/surface_pieces.hpp"

namespace condyle::kinematics {
namespace {

using core::formatted;

/// The share of the surface that may cross itself unmentioned: 5 mm by 5 on a femur. Letters engraved into a real hip
/// bone take a twentieth of it, two overlapping pieces of bone ten times as much.
constexpr double largest_crossing_share = 5e-4;

/// The note of a mesh that is not closed: it is open, or its orientation is not consistent.
JointNote not_closed(const std::string& name, const Mesh& mesh) {
  const mesh::EdgeTable& edges = mesh::edges_of(mesh);
  std::size_t unbalanced = 0;
  bool is_open = false;
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges.balance(mesh, e) != 0) ++unbalanced, is_open |= edges.half_edges(e).size() == 1;
  if (is_open)
    return {JointNoteCode::open_mesh, name + " is open: one body inside the other would not be detected"};
  const auto& first = *mesh.unbalanced_edge();
  return {
      JointNoteCode::mixed_orientation,
      name + formatted(
                 " has no boundary, but at %zu of its edges triangles are wound differently, the first from "
                 "vertex %u to %u: it has no inside, and one body inside the other would not be detected",
                 unbalanced, first.from, first.to)};
}

}  // namespace

std::vector<JointNote> surface_notes(const std::string& name, const Mesh& mesh, bool is_one_piece) {
  if (!mesh.is_closed()) return {not_closed(name, mesh)};
  const mesh::DoubledTriangles doubled = mesh::doubled_triangles(mesh);
  if (doubled.is_two_sided()) return {{JointNoteCode::two_sided, name + ": " + mesh::two_sided_text}};
  std::vector<JointNote> notes;
  if (mesh::is_inside_out(mesh))
    notes.push_back({JointNoteCode::inverted_mesh,
                     name + " has inverted orientation, its volume is negative: it is mirrored, or needs "
                            "flip_inverted"});
  else if (const auto first = is_one_piece ? std::nullopt : mesh::inverted_piece(mesh))
    notes.push_back(
        {JointNoteCode::inverted_mesh,
         name + formatted(" has a piece that is inside out, that of triangle %u: nothing counts as "
                          "inside of it",
                          *first)});
  const std::size_t count = mesh.triangles().size();
  if (doubled.count > 0)
    notes.push_back({JointNoteCode::doubled_triangles,
                     name + formatted(" has %zu of its %zu triangles on others, the first %u on %u: its "
                                      "volume counts twice there",
                                      doubled.count, count, (*doubled.first)[1], (*doubled.first)[0])});
  if (doubled.opposite > 0)
    notes.push_back(
        {JointNoteCode::two_sided,
         name + formatted(" has %zu of its %zu triangles on others in the opposite sense, the first %u on "
                          "%u: walls without thickness",
                          doubled.opposite, count, (*doubled.first_opposite)[1],
                          (*doubled.first_opposite)[0])});
  return notes;
}

std::optional<JointNote> self_crossing_note(const std::string& name, const Mesh& mesh) {
  const mesh::SelfCrossings& crossings = mesh::self_crossings_of(mesh);
  if (crossings.pairs == 0) return std::nullopt;
  double crossing = 0, area = 0;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    const Vec3 a = mesh.corner(t, 0);
    const double here = (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a).norm();
    area += here;
    if (crossings.crosses[t]) crossing += here;
  }
  if (crossing <= largest_crossing_share * area) return std::nullopt;
  return JointNote{
      JointNoteCode::self_crossings,
      name + formatted(" crosses itself: %zu pairs of triangles, the first %u and %u, on %.2g "
                       "%% of its surface; inside and outside are uncertain there",
                       crossings.pairs, (*crossings.first)[0], (*crossings.first)[1], 100 * crossing / area)};
}

bool is_solid(const Mesh& mesh) {
  return mesh.is_closed() && !mesh::is_two_sided(mesh) && !mesh::is_inside_out(mesh);
}

}  // namespace condyle::kinematics
