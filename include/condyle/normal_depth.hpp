#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"

/// Depth along the normals of one surface: for sheets that bound nothing, as segmented cartilage does, and for closed bodies
/// beside the radial and the tangential depth. docs/mathematics/07-contact-pressure.md.
///
/// From a point of the casting surface C a ray runs along the negative normal, into the casting body; the nearest triangle
/// of the target surface T that it meets within the reach is at the overlap depth:
///
///        n
///        ^   ....................  T, overlapping
///     ---o------------------------ C, the casting surface
///        |
///     ...v......................   T met: o's depth is the length of the ray
///
/// Casting and target exchanged give another answer, so results say which surface was cast.

namespace condyle::contact {

class OverlapSampler;
/// Contribution of a face of the casting surface.
enum class FaceRule {
  /// The whole face, with the depth of the ray from its centre along its normal: the rule of OpenSim-JAM.
  face_centre,
  /// The part where the depth, linear between rays from the corners along vertex normals, is above 0: areas and forces
  /// converge with the square of the edge length. Rays that meet the target more than 60 degrees off its normal have no depth.
  cut_faces,
};

struct NormalDepthOptions {
  FaceRule rule = FaceRule::cut_faces;
  double reach_mm = 20;  ///< how far rays go
};

/// A face of the casting surface in contact. Integrals are over the part in contact, in the frame of the casting body.
struct FaceContact {
  Index face;
  double area_mm2;  ///< of the part in contact
  double max_depth_mm;
  double overlap_mm3;               ///< integral of the depth
  Vec3 overlap_moment;              ///< integral of depth times place, mm^4
  double max_pressure_mpa = 0;      ///< 0 if no pressure was requested, as the next members
  double load_n = 0;                ///< integral of the pressure
  Vec3 load_moment = Vec3::Zero();  ///< integral of pressure times place, N mm

  [[nodiscard]] double mean_depth_mm() const noexcept { return overlap_mm3 / area_mm2; }
  [[nodiscard]] double mean_pressure_mpa() const noexcept { return load_n / area_mm2; }
};

/// Sums over the faces in contact, in the frame of the casting body.
struct ContactTotals {
  std::size_t triangles = 0;
  double area_mm2 = 0;
  /// Means are over the triangles in contact with the rule face_centre, over the area with cut_faces; 0 without contact.
  double mean_depth_mm = 0, max_depth_mm = 0;
  std::optional<Vec3> centre_of_depth;  ///< weighted by depth times area; empty without contact
  double mean_pressure_mpa = 0, max_pressure_mpa = 0;
  std::optional<Vec3> centre_of_pressure;  ///< weighted by pressure times area; empty without pressure
  /// On the casting body: the sum of -p A n, and of place times it about the origin.
  Vec3 force_n = Vec3::Zero(), moment_nmm = Vec3::Zero();
};

/// Results for the casting surface at one pose.
struct SurfaceContact {
  std::vector<FaceContact> faces;  ///< in contact, ascending
  ContactTotals totals;

  /// Rays that met the front of an open target, which faces the ray's origin: the casting point is outside the
  /// target's body if it has one. Counted as depths all the same, as the target has no inside that would decide. With
  /// a closed target such rays are no contact.
  std::size_t met_from_front = 0;
  /// With cut faces: those at the rim of the target, where a corner's ray meets nothing or another part of it. They are cut where
  /// their edges leave a closed target, else decided by the centres of 16 parts.
  std::size_t rim_faces = 0;
  /// Overlapping area whose rays meet the target more than 60 degrees off its normal (`oblique_ray`), as rays from a rim's face run
  /// lengthwise through what lies beside it: their length is no depth. With cut faces it counts for nothing else and is no part of
  /// `faces`; with face_centre, the published rule, it is a part of them, and of the totals.
  double oblique_area_mm2 = 0;
  /// With face_centre: the largest depth or the largest pressure comes from such a ray.
  bool peak_is_oblique = false;
  /// The largest depth over the thickness of both layers at that place; 0 if no pressure was requested.
  double max_strain = 0;
};

/// Sums over some of the faces in contact: a compartment, say.
[[nodiscard]] ContactTotals totals_of(std::span<const FaceContact> faces, const Mesh& casting, FaceRule rule);

/// The points p with normal.p > offset_mm, in the frame of the casting body.
struct HalfSpace {
  Vec3 normal;
  double offset_mm = 0;
};
/// The faces whose centre is in all of the half-spaces.
[[nodiscard]] std::vector<FaceContact> faces_within(std::span<const FaceContact> faces, const Mesh& casting,
                                                    std::span<const HalfSpace> region);

/// Two surfaces made ready for rays from one to the other, in any pose. Both meshes may be open. Any number of threads
/// may ask.
class NormalDepth {
 public:
  /// UsageError if the reach is not above 0.
  NormalDepth(Mesh casting, Mesh target, NormalDepthOptions options = {});
  ~NormalDepth();
  NormalDepth(NormalDepth&&) noexcept;
  NormalDepth& operator=(NormalDepth&&) noexcept;

  /// The casting surface or the target has deformed: new positions of all vertices, or of some, each named once. Answers are those
  /// of a NormalDepth made anew, to the bit. UsageError if numbers of vertices differ, a number is no vertex's or is there twice;
  /// MeshError as Mesh::moved_to(). A refused update changes nothing. Not while another thread queries. After std::bad_alloc it may have
  /// ended halfway: queries and updates then raise UsageError, and the object has to be made anew.
  void update_casting(PointsView vertices);
  void update_casting(std::span<const Index> moved, PointsView positions);
  void update_target(PointsView vertices);
  void update_target(std::span<const Index> moved, PointsView positions);

  /// X_CT is the pose of the target in the casting body: X_FM with the fixed body casting, its inverse with the mobile one.
  /// UsageError if it is not finite or translates beyond 1e30 mm. Some 0.1 microseconds a ray.
  [[nodiscard]] SurfaceContact at(const Pose& X_CT) const;
  void at(const Pose& X_CT, SurfaceContact& out) const;

  /// Rays of this pose that meet the target's inner side only beyond the reach, up to twice of it, and have a depth there: contact
  /// that the reach cuts off.
  [[nodiscard]] std::size_t cut_off_by_reach(const Pose& X_CT) const;

  [[nodiscard]] const Mesh& casting() const noexcept;
  [[nodiscard]] const Mesh& target() const noexcept;
  [[nodiscard]] const NormalDepthOptions& options() const noexcept;

 private:
  std::unique_ptr<OverlapSampler> sampler_;
};

/// For each vertex of a layer's surface, the distance along its negative normal to a surface behind it: the thickness
/// of a cartilage on its bone, mm. NaN if nothing lies within the reach.
[[nodiscard]] std::vector<double> thickness_to(const Mesh& layer, const Mesh& behind, double reach_mm = 20);

}  // namespace condyle::contact
