#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "condyle/first_contact.hpp"
#include "condyle/fit.hpp"
#include "condyle/joint.hpp"

/// Bearing surfaces and impingement: which contacts stop a ball joint, and which only say that its centre is off.
/// docs/mathematics/06-range-of-motion.md.

namespace condyle::motion {

// Lengths of a head of usual_head_radius_mm; those of another head grow with its radius: by_head().

/// Below the joint space of nearly every hip, 2 to 4 mm between bones, and above the roughness of a segmented head.
inline constexpr double usual_bearing_margin_mm = 2;
/// Kept between the bearing surface and the rim, so that nothing that can meet the rim is called bearing.
inline constexpr double rim_reserve_mm = 0.5;
/// Segmented surfaces are as rough as this, those of label maps as a voxel's diagonal if that is more: with a narrower margin contact inside
/// the socket may be called impingement.
inline constexpr double narrow_bearing_margin_mm = 1;
/// If the head's centre is farther than this from the joint centre, no bearing surface is inferred from the head.
inline constexpr double farthest_head_centre_mm = 5;

/// The part of the mobile body that slides in the socket: the triangles with all three corners within the head's radius and
/// the margin of the head's centre. If meshes of the body are called bearing (PartContact::bearing), as a cartilage beside
/// its bone, they belong to it too, and the head is the sphere found on them. A vertex or an edge is bearing when all its
/// triangles are.
///
/// The socket of a shoulder does not close round its head, and other surface of the scapula is near: the margin ends before
/// that too, wherever a rotation about the joint centre brings the head. What touches is then in the socket as well.
///
///        ____
///      /  M   .   .  rim: farther out than the head's radius and the margin,
///     |   head .---+----  so what touches within touches inside the socket
///      .      .   /   neck
///        ----
struct BearingSurface {
  Sphere head;                          ///< in M, mm
  double head_coverage = 0;             ///< of the fit
  double margin_mm = 0;                 ///< as used
  std::vector<std::string> parts = {};  ///< the meshes called bearing
  std::optional<double> rim_gap_mm;     ///< between head and rim; empty if no rim was found
  /// Gap of a shoulder between the head, wherever a rotation brings it, and what lies beside its socket, as an acromion does. Below 0
  /// if the two can meet; empty for hips.
  std::optional<double> beside_gap_mm = {};
  std::optional<Sphere> socket;         ///< in F, fitted; empty if the fixed body has no spherical socket
  std::vector<std::uint8_t> triangles;  ///< of the mobile mesh: 1 for bearing

  [[nodiscard]] std::size_t count() const noexcept;
};

/// Role of one triangle in contact: PartContact, and where on the mobile body it slides.
enum class ContactRole : std::uint8_t {
  ends,
  bearing,  ///< On the mobile body: slides on anything that is not soft. On the fixed body: as the file names it.
  soft,
  bearing_on_bearing,  ///< On the mobile body: slides only on meshes named bearing.
};

/// The roles of both bodies' triangles, in their order; empty where all are ContactRole::ends.
struct ContactRoles {
  std::vector<ContactRole> fixed = {}, mobile = {};

  [[nodiscard]] bool has(ContactRole role) const noexcept;
  /// Whether some contact slides, which something of the mobile body must: then the rest is impingement.
  [[nodiscard]] bool distinguish_bearing() const noexcept;
};

enum class BearingRule : std::uint8_t {
  leave_out,  ///< Bearing contact does not end a motion; impingement does.
  count,      ///< Any contact ends a motion.
};

struct BearingOptions {
  BearingRule rule = BearingRule::leave_out;
  /// How far outside the head's sphere the bearing surface reaches, mm, 0 or more; default: the smaller of
  /// usual_bearing_margin_mm and the gaps at the rim and, of a shoulder, beside its socket less rim_reserve_mm. If meshes are
  /// called bearing, nothing is taken off the gaps, and the margin is at least 0: the bone under a cartilage is within its
  /// sphere.
  std::optional<double> margin_mm = {};
  /// As found before, of the same mobile mesh; else it is found, which costs more than the rest of making a joint
  /// ready.
  std::optional<BearingSurface> surface = {};
  /// As found before, of the same meshes, and then no surface is searched for; else they follow from the surface and the words of
  /// the meshes.
  std::optional<ContactRoles> roles = {};
};

/// The limit of a margin.
enum class MarginLimit : std::uint8_t { rim, beside_socket };

/// A margin that the gap at the rim limits, or that beside the socket; below 0 if the gap is smaller than rim_reserve_mm.
struct NarrowMargin {
  double gap_mm, margin_mm;
  MarginLimit by = MarginLimit::rim;
};

/// The bearing surface of a joint, or one sentence with the reason why none can be inferred; and what contact of each triangle
/// means, which the words of meshes may say without one.
struct BearingFinding {
  std::optional<BearingSurface> surface = {};
  ContactRoles roles = {};
  std::string why_none = {};
  /// If a gap makes the usual margin smaller than narrow_bearing_margin_mm, or than the diagonal of a body's voxels.
  std::optional<NarrowMargin> narrow_margin = {};

  /// Faces that close the bones where their images end, or where they were cut near the joint: contact on them is not contact of bones.
  std::vector<ImageCut> fixed_cuts = {}, mobile_cuts = {};

  [[nodiscard]] bool is_on_cut(const ContactWitness& contact) const noexcept;
  /// Kind of a contact of features of these meshes. Linear in their triangles for vertices and edges.
  [[nodiscard]] ContactKind kind_of(const TriMesh& fixed, const TriMesh& mobile,
                                    const ContactWitness& contact) const noexcept;
  /// Kind of a contact of two triangles, whatever their place.
  [[nodiscard]] ContactKind kind_of(Index fixed_triangle, Index mobile_triangle) const noexcept;
};

/// Searches for the head of a hip or shoulder around the joint centre. No surface for other joints (Joint::has_head()), if no head is
/// found, if its centre is farther than farthest_head_centre_mm from the joint centre, if the joint space or what lies beside a
/// shoulder's socket leaves no margin, and if the whole mobile body would be bearing, as a cartilage is. Throws UsageError
/// for a margin below 0 or not finite.
///
/// Some milliseconds per 10,000 triangles: both bodies are searched for spheres, once, which are kept with their meshes.
[[nodiscard]] BearingFinding find_bearing_surface(const Joint& joint, const BearingOptions& options = {});

}  // namespace condyle::motion
