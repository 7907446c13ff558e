#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "condyle/fit.hpp"

/// Data that the searches for spherical and cylindrical parts read from a mesh: its vertices with normals and areas.

namespace condyle::kinematics {

/// One vertex of the searched part of a surface.
struct SurfacePoint {
  Index vertex;
  Vec3 position;
  Vec3 normal;  ///< unit; mean of the triangles around it, weighted by area
  double area;  ///< a third of the triangles around it
  double flatness =
      1;  ///< length of the mean of the normals around it: 0.7 at the edge of a cube, 0.58 at its corner
};

/// The vertices of a mesh that lie inside `within` and belong to triangles with an area (and not so large a
/// one that it overflows), ascending.
std::vector<SurfacePoint> surface_points(const TriMesh& mesh, const std::optional<Sphere>& within);

/// Each normal becomes the mean, by area, of those in its cell of this side (mm) that face the same way: what fine meshes
/// have of noise goes, and the vertices of coarse ones stay alone in their cells. n log n in the points.
void average_normals(std::vector<SurfacePoint>& points, double cell);

/// Which of the points are joined by edges of the mesh, for any number of choices among them.
class PointNeighbours {
 public:
  /// Linear in the mesh. The points are those of surface_points(), ascending.
  PointNeighbours(const TriMesh& mesh, const std::vector<SurfacePoint>& points);

  /// The largest part (by area) of the chosen points that is connected by edges between chosen points.
  /// `chosen` holds positions in the points, ascending, and so does the answer. Linear in what is chosen.
  std::vector<Index> largest_connected_part(const std::vector<SurfacePoint>& points,
                                            const std::vector<Index>& chosen) const;

  /// Each normal becomes the mean, by area, of those that face the same way and are joined to it within this distance, mm: what fine meshes have
  /// of noise goes, and the vertices of coarse ones stay as they are. It does not depend on the order of the points, nor on where they lie.
  /// Linear in the points, and in how many are that near each other, up to a thousand: of more, the nearest by edges.
  void average_normals(std::vector<SurfacePoint>& points, double reach) const;
  /// Nine of ten edges between points are shorter; 0 if there is none.
  double longest_usual_edge(const std::vector<SurfacePoint>& points) const;

 private:
  /// Point i is joined to the earlier points from earlier_[end_[i]] to earlier_[end_[i + 1]], each of them once.
  std::vector<Index> end_, earlier_;
};

/// The root of a surface's area: how large a bone is, however it lies and whatever specks are about it.
double root_of_area(const TriMesh& surface);

/// find_sphere() and find_cylinder() on all of a surface, which is known to face the outside.
SphericalPatch find_sphere_on(const TriMesh& surface, const SphereSearch& search = {});
/// The best of the spherical parts that this accepts; empty if none is. `is_open`: whether the surface is, if that is known.
std::optional<SphericalPatch> find_sphere_where(const TriMesh& surface, const SphereSearch& search,
                                                const std::function<bool(const SphericalPatch&)>& fits,
                                                std::optional<bool> is_open = {});
CylinderFit find_cylinder_on(const TriMesh& surface, const CylinderSearch& search = {});

/// The mesh's numbers of some of the points.
std::vector<Index> vertices_of(const std::vector<SurfacePoint>& points, const std::vector<Index>& chosen);

/// The spherical part that these vertices are, ascending, as find_sphere() gives it once it has chosen them. Throws MeshError
/// if no sphere fits them.
SphericalPatch patch_of(const TriMesh& mesh, const std::vector<Index>& vertices);

/// find_sphere() of the socket round a head: a sphere about the head's centre is preferred to one farther off that holds little more area.
SphericalPatch find_socket_round(const TriMesh& mesh, const Sphere& head, const SphereSearch& search);

/// The part of a surface that lies on this head or in this socket, whose sphere stays as it is: what find_sphere() would take for it
/// without fitting anew. Empty if nothing does.
std::optional<SphericalPatch> patch_on(const TriMesh& mesh, const Sphere& sphere, SphericalPart of);
/// The same of a sphere that somebody states: without vertices and of no coverage if nothing lies on it.
SphericalPatch stated_patch(const TriMesh& mesh, const Sphere& sphere, SphericalPart of);

/// 1.4826 times the median magnitude: the standard deviation of a normal distribution, given by the better
/// half of the residuals and deaf to the rest.
double robust_deviation(std::vector<double> residuals);

}  // namespace condyle::kinematics
