#pragma once

#include <compare>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "condyle/angle.hpp"
#include "condyle/joint.hpp"
#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"
#include "condyle/radial.hpp"
#include "condyle/tangential.hpp"

/// Two bodies in one pose: which vertices of each are inside the other, how deep and of which kind, and which
/// triangles meet.

namespace condyle::contact {

class JointContact;
class BodyPair;
[[nodiscard]] const BodyPair& body_pair_of(const JointContact& joint);
struct ChosenVertices;
struct MovedVertices;
struct ChosenArcs;
/// A line of F about which the mobile body rotates.
struct AxisLine {
  Vec3 direction;             ///< of any length but zero
  Vec3 point = Vec3::Zero();  ///< on it, mm; default: the joint centre
};
/// What arcs go about: the axis that an angle of the joint has at the pose, through the joint centre, or a line.
using ArcsAbout = std::variant<JointAngle, AxisLine>;

[[nodiscard]] ChosenArcs arcs_of(const JointContact& joint, const Pose& X_FM, const Vec3& axis_F,
                                 const ChosenVertices& vertices);
/// A triangle of the fixed and one of the mobile body that share a point.
struct TrianglePair {
  Index fixed, mobile;
  friend auto operator<=>(const TrianglePair&, const TrianglePair&) = default;
};

/// Results at one pose: for each vertex of each body against the other body, and for each pair of triangles.
template <class VertexResults>
struct ContactResults {
  /// Vertices of the mobile body against the fixed one; empty if the fixed mesh is open and has no inside.
  std::optional<VertexResults> mobile_in_fixed;
  /// Vertices of the fixed body against the mobile one; empty if the mobile mesh is open.
  std::optional<VertexResults> fixed_in_mobile;
  /// The exact set of intersecting triangle pairs, ascending; touching counts.
  std::vector<TrianglePair> pairs;
  /// Whether the bodies share a point: surfaces that meet, or one body wholly inside the other.
  bool in_contact = false;
};

/// The vertices that are not outside, with their radial depths in mm, >= 0.
using Contact = ContactResults<radial::Penetrations>;
/// Every vertex, with its radial gap in mm: > 0 apart, < 0 penetrating.
using RadialContact = ContactResults<radial::RadialResults>;
/// Every vertex, with its gap along its circle about an axis: > 0 apart, < 0 penetrating. A positive rotation
/// of a mobile vertex is one of the mobile body about the axis; of a fixed vertex, one of the fixed body about
/// it, which is the opposite movement.
using TangentialContact = ContactResults<tangential::TangentialResults>;

/// A fixed and a mobile body, each in its own frame with the joint centre as origin, queried at any pose.
///
/// A pose rounds coordinates: mobile vertices into F, fixed vertices into M. Every answer is the exact one for
/// the vertices so rounded, each into the frame of the body it is held against. Open meshes have no inside:
/// their pairs are found all the same, and vertices are held against a body that is closed.
///
/// Tables are built when the first question needs them and kept: direction tables for depths and gaps along
/// rays, ring tables for those about an axis (of the latest axes queried), trees for pairs. Any number of threads may
/// query; results do not depend on how many. Each query raises UsageError for a pose that is not finite or translates
/// beyond 1e30 mm.
class JointContact {
 public:
  /// The meshes of a joint, which are in the joint frame.
  explicit JointContact(const Joint& joint, radial::RadialOptions options = {});
  JointContact(Mesh fixed, Mesh mobile, radial::RadialOptions options = {});
  /// The same joint with another mesh in a body's place: what was made of the other body is shared.
  JointContact(const JointContact& before, BodyRole changed, Mesh mesh);
  ~JointContact();
  JointContact(JointContact&&) noexcept;
  JointContact& operator=(JointContact&&) noexcept;

  /// A body has deformed: new positions of all its vertices in its own frame, as many as there were. Tables and trees that were
  /// made follow; ring tables are made anew when they are next needed. Answers are those of a JointContact made anew, in whatever
  /// order vertices that are inside come: depths and sets to the bit. Other contacts that share the body keep it as it was.
  ///
  /// docs/deforming.md has the cost. UsageError if the number differs; MeshError if a coordinate
  /// is not finite or beyond 1e30 mm or the surface now holds the joint centre. A refused update changes nothing, nor does one
  /// that ends with std::bad_alloc. Not while another thread queries.
  void update(BodyRole body, PointsView vertices);
  /// The same for some vertices, each named once; UsageError also if a number is no vertex's or is there twice.
  void update(BodyRole body, std::span<const Index> moved, PointsView positions);

  /// Vertices inside either body, or on its surface, with radial depths, and intersecting pairs. The fast
  /// path: vertices that are certainly outside cost next to nothing. Raises MeshError if the joint centre
  /// lies on a surface.
  [[nodiscard]] Contact at(const Pose& X_FM) const;
  /// Only the penetrating vertices, into results that keep their capacity: nothing is allocated once they are large
  /// enough. Raises MeshError if the other body's mesh is open, too.
  void mobile_in_fixed(const Pose& X_FM, radial::Penetrations& out) const;
  void fixed_in_mobile(const Pose& X_FM, radial::Penetrations& out) const;

  /// The same and the gap of every vertex outside: the joint space along rays. Raises as at() does.
  [[nodiscard]] RadialContact radial(const Pose& X_FM) const;
  /// Gaps and depths about an axis through the joint centre, given in F, of any length but zero. Building a ring
  /// table costs much more than querying it; those of both bodies are kept for the next pose with the same axis in
  /// the body's own frame.
  [[nodiscard]] TangentialContact tangential(
      const Pose& X_FM, const Vec3& axis_F,
      tangential::TangentialRule rule = tangential::TangentialRule::alternating) const;
  /// The same about a line of F wherever it is. It stays in F whatever the pose: the mobile vertices are where the pose has put
  /// them, translated or not.
  [[nodiscard]] TangentialContact tangential(
      const Pose& X_FM, const AxisLine& axis,
      tangential::TangentialRule rule = tangential::TangentialRule::alternating) const;

  /// The exact set of intersecting triangle pairs, ascending.
  [[nodiscard]] std::vector<TrianglePair> pairs(const Pose& X_FM) const;
  /// Whether the bodies share a point; ends at the first witness found.
  [[nodiscard]] bool in_contact(const Pose& X_FM) const;

  [[nodiscard]] const Mesh& fixed() const noexcept;
  [[nodiscard]] const Mesh& mobile() const noexcept;
  /// The direction tables, for questions of one's own.
  [[nodiscard]] const radial::RadialTable& fixed_table() const;
  [[nodiscard]] const radial::RadialTable& mobile_table() const;

 private:
  struct Parts;
  void update(BodyRole body, const MovedVertices& moved);
  friend const BodyPair& contact::body_pair_of(const JointContact& joint);
  friend ChosenArcs contact::arcs_of(const JointContact& joint, const Pose& X_FM, const Vec3& axis_F,
                                     const ChosenVertices& vertices);

  std::unique_ptr<Parts> parts_;
};

/// A radial depth is a depth where the surface faces the ray: then the exit along the ray is about the
/// shortest exit. Through a flat wall at 60 degrees from the ray it is twice as long; beyond that, or where the
/// ray leaves through the far end of a neck, the radial depth is a length along the bone and the tangential
/// depth is the one to read. docs/mathematics/02-radial-method.md, has the angle; the ratio of lengths says the same
/// of curved walls too.
inline constexpr double longest_meaningful_ratio = 2;

/// A penetrating vertex and its radial depth.
struct DeepestVertex {
  Index vertex;
  double depth_mm;          ///< along its ray, > 0
  double shortest_exit_mm;  ///< to the nearest point of the other body's surface
  Angle ray_to_normal;      ///< between the ray and the normal of the surface that it leaves through

  /// Whether its radial depth means something; else the tangential one does.
  [[nodiscard]] bool radial_is_depth() const noexcept {
    return !(ray_to_normal > radial::oblique_ray || depth_mm > longest_meaningful_ratio * shortest_exit_mm);
  }
};

/// The few numbers that a person reads of one body's vertices against the other body.
struct RadialBodySummary {
  std::size_t vertices_inside = 0;
  std::size_t vertices_on_surface = 0;
  /// Number of vertices inside whose radial depth is no depth.
  std::size_t oblique_inside = 0;
  std::optional<DeepestVertex> deepest;
  /// The deepest of those whose radial depth is a depth.
  std::optional<DeepestVertex> deepest_facing;
  /// Smallest gap of a vertex outside, mm; empty if no ray meets the other body.
  std::optional<double> min_gap_mm;
};

/// `points` are the query points of `other` that gave `results`.
[[nodiscard]] RadialBodySummary summarise(const radial::RadialResults& results, PointsView points,
                                          const Mesh& other);

/// Both bodies; empty if the other mesh is open.
struct RadialSummary {
  std::optional<RadialBodySummary> mobile, fixed;
};

/// `contact` is what joint.radial(X_FM) gave.
[[nodiscard]] RadialSummary summarise(const JointContact& joint, const Pose& X_FM,
                                      const RadialContact& contact);

/// A vertex and how far it must rotate to be free.
struct DeepestRotation {
  Index vertex;
  Angle depth;
  double depth_mm;  ///< arc length at the vertex's own radius
};

/// One body's vertices against the other body.
struct TangentialBodySummary {
  std::size_t vertices_inside = 0;
  std::size_t vertices_on_surface = 0;
  /// Number of vertices inside that no rotation about the axis frees: their whole circle is solid.
  std::size_t without_exit = 0;
  /// Among the other vertices inside, the one with the longest exit in mm, and the one whose exit is the largest
  /// angle: a vertex near the axis rotates far without moving much.
  std::optional<DeepestRotation> deepest, largest_angle;
  /// Smallest angle and smallest arc between a vertex outside and the other body, not always of one vertex;
  /// empty if no circle meets it.
  std::optional<Angle> min_gap;
  std::optional<double> min_gap_mm;
};

[[nodiscard]] TangentialBodySummary summarise(const tangential::TangentialResults& results);

}  // namespace condyle::contact
