#pragma once

#include <vector>

#include "condyle/first_contact.hpp"
#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"
#include "mesh/triangle_tree.hpp"

/// Contact of a body that slides along a direction. docs/mathematics/05-contact-under-rotation.md.

namespace condyle::motion {

/// One end of an interval of contact.
struct TranslationEnd {
  double at_mm;    ///< the interval holds all contact: rounding is on its side
  double sure_mm;  ///< where contact is certain, the nearest such place to at_mm that is known
  Index fixed_triangle, mobile_triangle;  ///< whose contact it is
  Vec3 point;                             ///< of the fixed body there
};

/// Positions along a direction at which the surfaces meet, from one to the other.
struct TranslationContact {
  TranslationEnd low, high;
};

/// All positions along a direction, of any length but zero, at which the surfaces of two bodies meet: ascending and apart, in mm from
/// where they are given, both in one frame.
///
///         ____               Two triangles are convex, so they meet on one interval of positions or never. Seen along the
///        / B /|              direction, it ends where a corner of one lies on the other or two edges cross: there
///       /___/ |   A          t = z_A - z_B.
///          --->  | \ .
///            t   |_\         The set is the union over all pairs of triangles.
///
/// Whether they overlap as seen is decided exactly for coordinates rounded once into the frame of the direction (AxisFrame); each end is
/// widened by what its arithmetic rounds, some 1e-15 of the coordinates, of triangles that the direction lies in too. No contact is missed,
/// touching counts, gaps narrower than the widening are none. Triangles of zero area meet nothing. Surfaces only: a body wholly inside the
/// other without meeting its surface is free here.
std::vector<TranslationContact> translation_contacts(const Mesh& fixed, const Mesh& mobile_in_F,
                                                     const Vec3& direction);

/// A body's triangles that have an area, in the frame of a direction.
struct SlidingBody {
  std::vector<Index> kept;  ///< their numbers in the mesh
  TriMesh mesh;
  mesh::TriangleTree tree;
  double size = 0;  ///< the largest coordinate
  bool is_closed;

  SlidingBody(const Mesh& body, const AxisFrame& frame);
  Index number(Index place) const noexcept { return kept[tree.mesh_triangles()[place]]; }
};

/// The same of bodies that are placed already. With an end to the range everything beyond it is one contact without triangles, and no pair is
/// compared there.
std::vector<TranslationContact> translation_contacts(const SlidingBody& fixed, const SlidingBody& mobile,
                                                     const AxisFrame& frame, const SlideRange& range);

}  // namespace condyle::motion
