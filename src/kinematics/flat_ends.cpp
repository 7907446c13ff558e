#include "kinematics/flat_ends.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "core/lazy.hpp"
#include "kinematics/hip_parts.hpp"
#include "mesh/disjoint_sets.hpp"
#include "mesh/findings.hpp"
#include "mesh/triangle_distance.hpp"
#include "mesh/vertex_triangles.hpp"

namespace condyle::kinematics {
namespace {

// Sizes are of a bone 220 mm across, as a hip bone is, and go with it.
constexpr double usual_size = 220;
/// mm^2: the shaft of a small femur has 150, and a face that cuts off less of a rim moves no measure.
constexpr double least_end_area = 60;
/// The face of a coarse mesh may be one triangle or two.
constexpr std::size_t fewest_corners = 8;
/// ... in faces of which each has as much: triangles that lie in one plane and share edges.
constexpr double least_face = 15;
/// Cosine of the 0.3 degrees between neighbours of one face: vertices in floats turn triangles a tenth of a millimetre high by less.
constexpr double one_plane = 1 - 1.4e-5;

Vec3 twice_area(const TriMesh& mesh, std::size_t t) {
  const Vec3 a = mesh.corner(t, 0);
  return (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a);
}

struct Face {
  Vec3 area = Vec3::Zero(), point = Vec3::Zero();
};

/// The farthest corners of triangles along the diagonals of a cube, numbered by the signs of x, y and z; and those along its sides.
struct Farthest {
  std::array<Vec3, 8> diagonal;
  std::vector<char> is_used = {};  ///< vertices that are corners
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
};

std::size_t octant(const Vec3& direction) noexcept {
  return (direction.x() < 0 ? 1U : 0U) + (direction.y() < 0 ? 2U : 0U) + (direction.z() < 0 ? 4U : 0U);
}

Farthest farthest_corners(const TriMesh& bone) {
  Farthest farthest;
  std::vector<char>& is_used = farthest.is_used;
  is_used.resize(bone.vertices.size());
  for (const Triangle& t : bone.triangles)
    for (const Index v : t) is_used[v] = 1;
  std::array<double, 8> reach;
  reach.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t v = 0; v < is_used.size(); ++v) {
    if (!is_used[v]) continue;
    const Vec3 p = bone.vertices[v];
    farthest.low = farthest.low.cwiseMin(p), farthest.high = farthest.high.cwiseMax(p);
    for (std::size_t d = 0; d < reach.size(); ++d) {
      const double at = (d & 1U ? -p.x() : p.x()) + (d & 2U ? -p.y() : p.y()) + (d & 4U ? -p.z() : p.z());
      if (at > reach[d]) reach[d] = at, farthest.diagonal[d] = p;
    }
  }
  return farthest;
}

/// Triangles that may lie in a plane with all of the bone behind it, which few of them do: theirs may be tilted against it as above.
std::vector<Index> outermost(const TriMesh& bone, const Farthest& farthest) {
  constexpr double tilt = 0.006, slack = 1 + 1e-9;
  const double rise = on_cut_mm + tilt * (farthest.high - farthest.low).norm();
  std::vector<Index> found;
  for (std::size_t t = 0; t < bone.triangles.size(); ++t) {
    const Vec3 p = bone.corner(t, 0), area = (bone.corner(t, 1) - p).cross(bone.corner(t, 2) - p);
    // Most are ruled out, without a root, by the corner that is farthest along the diagonal next to their normal.
    const double ahead = area.dot(farthest.diagonal[octant(area)] - p);
    if (ahead > 0 && ahead * ahead > slack * area.squaredNorm() * rise * rise) continue;
    const double offset = area.dot(p) + area.norm() * rise;
    if (area.squaredNorm() > 0 && std::all_of(farthest.diagonal.begin(), farthest.diagonal.end(),
                                              [&](const Vec3& q) { return area.dot(q) <= offset; }))
      found.push_back(static_cast<Index>(t));
  }
  return found;
}

/// Those of them around one vertex that face one way are of one face. More ways than these are no flat face's.
void join_around(std::span<const Index> around, const std::vector<Vec3>& areas,
                 const std::vector<double>& sizes, mesh::DisjointSets& sets) {
  constexpr std::size_t most_ways = 8;
  std::array<Index, most_ways> ways;
  std::size_t known = 0;
  for (const Index number : around) {
    const auto end = ways.begin() + known;
    const auto way = std::find_if(ways.begin(), end, [&](Index other) {
      return areas[number].dot(areas[other]) > one_plane * sizes[number] * sizes[other];
    });
    if (way != end)
      sets.join(*way, number);
    else if (known < most_ways)
      ways[known++] = number;
  }
}

/// Outermost triangles that hang together and face one way, those with an area that counts.
std::vector<Face> flat_faces(const TriMesh& bone, const Farthest& farthest, double least) {
  const std::vector<Index> outer = outermost(bone, farthest);
  std::vector<Triangle> triangles;
  std::vector<Vec3> areas;
  std::vector<double> sizes;
  for (const Index t : outer) {
    triangles.push_back(bone.triangles[t]);
    areas.push_back(twice_area(bone, t));
    sizes.push_back(areas.back().norm());
  }
  const mesh::VertexTriangles at_vertices(triangles, bone.vertices.size());
  mesh::DisjointSets sets(outer.size());
  for (Index v = 0; v < bone.vertices.size(); ++v) join_around(at_vertices.of(v), areas, sizes, sets);
  std::vector<Face> faces(outer.size());
  for (std::size_t n = 0; n < outer.size(); ++n) {
    Face& face = faces[sets.find(static_cast<Index>(n))];
    face.area += areas[n] / 2;
    face.point = bone.corner(outer[n], 0);
  }
  std::erase_if(faces, [&](const Face& face) { return face.area.norm() < least; });
  return faces;
}

bool lies_behind(const Farthest& farthest, const TriMesh& bone, const ImageCut& plane) {
  for (std::size_t v = 0; v < farthest.is_used.size(); ++v)
    if (farthest.is_used[v] && !(plane.normal.dot(bone.vertices[v]) - plane.offset_mm < on_cut_mm))
      return false;
  return true;
}

/// Area of the section at a depth behind the plane, of a closed surface.
double section_area(const TriMesh& bone, const ImageCut& plane, double depth) {
  const auto height = [&](const Vec3& p) { return plane.normal.dot(p) - plane.offset_mm + depth; };
  double twice = 0;
  for (std::size_t t = 0; t < bone.triangles.size(); ++t) {
    std::array<Vec3, 2> crossing;  // where the border goes down through the section, and up
    int found = 0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = bone.corner(t, k), q = bone.corner(t, (k + 1) % 3);
      const double a = height(p), b = height(q);
      if ((a < 0) == (b < 0)) continue;
      crossing[a < 0 ? 1 : 0] = p + a / (a - b) * (q - p);
      ++found;
    }
    if (found == 2) twice += crossing[0].cross(crossing[1]).dot(plane.normal);
  }
  return std::abs(twice) / 2;
}

/// Whether the face is one of some size that the bone was cut off in.
bool is_cut_off(const TriMesh& bone, const ImageCut& plane, double least) {
  const std::vector<ImageCut> cut{plane};
  std::vector<char> is_on(bone.vertices.size());
  for (std::size_t v = 0; v < is_on.size(); ++v) is_on[v] = is_on_cut(cut, bone.vertices[v]);
  double area = 0;
  std::vector<Index> corners;
  for (std::size_t t = 0; t < bone.triangles.size(); ++t) {
    const Triangle& triangle = bone.triangles[t];
    if (!is_on[triangle[0]] || !is_on[triangle[1]] || !is_on[triangle[2]]) continue;
    area += twice_area(bone, t).norm() / 2;
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return area >= least && corners.size() >= fewest_corners && goes_on_behind(bone, plane, area);
}

std::vector<ImageCut> found_ends(const TriMesh& bone) {
  if (bone.triangles.empty()) return {};
  const Farthest farthest = farthest_corners(bone);
  const double size = (farthest.high - farthest.low).norm() / usual_size, square = size * size;
  std::vector<ImageCut> ends;
  for (const Face& face : flat_faces(bone, farthest, square * least_face)) {
    const Vec3 normal = face.area.normalized();
    const ImageCut plane{normal, normal.dot(face.point)};
    const bool is_known = std::any_of(
        ends.begin(), ends.end(), [&](const ImageCut& end) { return end.normal.dot(normal) > one_plane; });
    if (!is_known && lies_behind(farthest, bone, plane) && is_cut_off(bone, plane, square * least_end_area))
      ends.push_back(plane);
  }
  return ends;
}

struct KeptEnds {
  core::Lazy<std::vector<ImageCut>> ends;
};

/// Whether the plane is one of those where the image ends.
bool is_of_image(const Body& body, const ImageCut& plane) {
  return body.image &&
         std::any_of(body.image->cuts.begin(), body.image->cuts.end(), [&](const ImageCut& cut) {
           return cut.normal.dot(plane.normal) > one_plane &&
                  std::abs(cut.offset_mm - plane.offset_mm) <= on_cut_mm;
         });
}

/// Whether the plane is that of a terrace of voxels on the head, which a slice through the bone leaves where the head ends.
bool is_terrace(const Body& mobile, const Sphere& head, const ImageCut& plane) {
  return mobile.image && std::abs(plane.offset_mm - plane.normal.dot(head.centre) - head.radius) <=
                             mobile.image->voxel_width_mm(plane.normal);
}

/// Whether the plane is that of the rim of a socket, as of a cup: the socket opens through it.
bool is_of_rim(const Body& fixed, const Sphere& head, const ImageCut& plane) {
  constexpr double least_cosine = 0.966;  // 15 degrees
  if (std::abs(plane.offset_mm - plane.normal.dot(head.centre)) > head.radius) return false;
  const auto rim = rim_around(fixed.mesh, head);
  return *rim && (*rim)->opening.dot(plane.normal) > least_cosine;
}

}  // namespace

bool goes_on_behind(const TriMesh& bone, const ImageCut& plane, double face_area) {
  constexpr double depth_in_radii = 0.4, most_wider = 2.5;
  return section_area(bone, plane, depth_in_radii * std::sqrt(face_area / std::numbers::pi)) <=
         most_wider * face_area;
}

const std::vector<ImageCut>& flat_ends(const Mesh& bone) {
  return mesh::findings_of(bone).get<KeptEnds>().ends.get(
      [&](std::vector<ImageCut>& ends) { ends = found_ends(bone); });
}

FlatFace face_in(const TriMesh& bone, const ImageCut& plane) {
  const std::vector<ImageCut> cut{plane};
  FlatFace face{std::numeric_limits<double>::infinity(), 0};
  for (std::size_t t = 0; t < bone.triangles.size(); ++t) {
    const std::array<Vec3, 3> corners{bone.corner(t, 0), bone.corner(t, 1), bone.corner(t, 2)};
    if (!std::all_of(corners.begin(), corners.end(), [&](const Vec3& p) { return is_on_cut(cut, p); }))
      continue;
    face.area_mm2 += twice_area(bone, t).norm() / 2;
    face.distance_mm = std::min(face.distance_mm, mesh::nearest_on_triangle(Vec3::Zero(), corners).norm());
  }
  return face;
}

std::vector<ImageCut> flat_ends_near_joint(const Joint& joint, BodyRole role) {
  if (!joint.is_hip() || !joint.has_head() || joint.implant) return {};
  const Body& body = role == BodyRole::fixed ? joint.fixed : joint.mobile;
  const auto ends_motions = [](const BodyPart& part) { return part.contact == PartContact::ends; };
  if (std::count_if(body.parts.begin(), body.parts.end(), ends_motions) > 1 || is_cut(body)) return {};
  if (flat_ends(body.mesh).empty()) return {};
  const std::optional<SphericalPatch>& head = head_near_centre(joint.mobile.mesh);
  if (!head) return {};
  std::vector<ImageCut> near;
  for (const ImageCut& plane : flat_ends(body.mesh))
    if (!is_of_image(body, plane) &&
        face_in(body.mesh, plane).distance_mm <= farthest_flat_end * head->fit.sphere.radius &&
        !(role == BodyRole::fixed ? is_of_rim(body, head->fit.sphere, plane)
                                  : is_terrace(body, head->fit.sphere, plane)))
      near.push_back(plane);
  return near;
}

}  // namespace condyle::kinematics
