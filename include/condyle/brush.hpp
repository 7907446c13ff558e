#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "condyle/bearing.hpp"
#include "condyle/joint.hpp"
#include "condyle/range_of_motion.hpp"

/// Resection by hand: strokes of a brush that lower the surface of a bone, and the limits of the joint without the removed bone.
/// docs/planning.md, "By hand".

namespace condyle::plan {

enum class BrushAction : std::uint8_t {
  lower,    ///< The surface goes down.
  restore,  ///< Removed bone comes back.
};

/// A path of the brush over a bone's surface. At the distance d of a vertex from the nearest vertex of the path, both on the surface before, the
/// brush works with the weight
///
///     w = 1 up to half of the radius r; from there 1 - s(2 d / r - 1), s(t) = 3 t^2 - 2 t^3, which is 0 from r on
///
/// and by s(2 c) less where the way inwards makes an angle of cosine c < 1/2 with that at the vertex of the path. It reaches only what hangs
/// together with the path within the radius: not the other side of a thin bone.
///
/// `lower` puts a vertex at the depth w depth_mm below the surface before, if it is not deeper already; `restore` leaves 1 - w of its depth.
struct BrushStroke {
  BrushAction action = BrushAction::lower;
  std::vector<Index> along = {};  ///< vertices of the bone's mesh
  double radius_mm = 5;
  double depth_mm = 2;
};

/// The largest radius and depth of a stroke, mm.
inline constexpr double largest_brush_radius_mm = 30, largest_brush_depth_mm = 20;

struct StrokeOutcome {
  std::size_t moved = 0;  ///< vertices that are elsewhere now
  std::size_t kept = 0;   ///< vertices in reach that must stay
  /// Vertices that are less deep than asked for, so that no triangle turns over and nothing is crossed.
  std::size_t limited = 0;
};

/// Bone that strokes removed.
struct BrushedBone {
  /// Between the surface before and the surface now: signed tetrahedra, never depth times area.
  double volume_mm3 = 0;
  /// The largest distance of a vertex from the surface before, and that vertex.
  double deepest_mm = 0;
  std::optional<Index> deepest_vertex = {};
};

/// A bone under a brush. The triangles stay those of its mesh, and so does how fine a cut can be: a brush narrower than they are
/// moves one vertex.
///
/// Each vertex moves along one line: inwards against the normal of the surface before, smoothed over 3 mm. After every stroke the mesh is closed
/// and has the triangles that it had, none faces away from how it lay, and none runs through another that it did not run through
/// before. Same strokes, same bits.
class Brush {
 public:
  /// `stays`: of the vertices, 1 for those that must not move; or none. Throws MeshError for a bone that is open or inside out, and UsageError for
  /// another number of marks.
  explicit Brush(const Body& bone, std::vector<std::uint8_t> stays = {});
  /// A bone that was cut before: `before` has the same vertices where the surface was. A vertex that is elsewhere goes on along its own way.
  Brush(const Body& bone, const Points& before, std::vector<std::uint8_t> stays = {});
  ~Brush();
  Brush(Brush&&) noexcept;
  Brush& operator=(Brush&&) noexcept;

  /// Throws UsageError for a path without vertices, a vertex that the mesh does not have, a radius or a depth that is not above 0 or beyond the
  /// largest.
  StrokeOutcome stroke(const BrushStroke& stroke);
  /// Takes the last stroke back, bit by bit; then, of a bone that was cut before, the cut. False if there is none.
  bool undo();
  /// How often undo() can be called.
  [[nodiscard]] std::size_t steps() const noexcept;

  /// Where the vertices are now, and where they were.
  [[nodiscard]] const Points& vertices() const noexcept;
  [[nodiscard]] const Points& before() const noexcept;
  /// Distance of each vertex from the surface before, mm.
  [[nodiscard]] const std::vector<double>& depth_mm() const noexcept;
  [[nodiscard]] BrushedBone removed() const;
  /// Mean length of the edges, mm: a cut is no finer.
  [[nodiscard]] double edge_mm() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Marks of the vertices of a body that belong to its bearing surface or to a soft mesh: corners of triangles whose contact does not end a
/// motion. Of a fixed body that is one mesh none.
[[nodiscard]] std::vector<std::uint8_t> protected_vertices(const Joint& joint, BodyRole body,
                                                           const motion::ContactRoles& roles);

struct BrushRequest {
  BodyRole body = BodyRole::mobile;
  std::vector<BrushStroke> strokes = {};
  std::vector<std::uint8_t> stays = {};  ///< vertices that stay beside the bearing surface; or none
  motion::RangeOptions range = {};
};

/// A joint after strokes.
struct BrushedJoint {
  /// With the brushed bone. Its head, socket and bearing margin stay those of the joint before.
  Joint joint;
  std::vector<StrokeOutcome> strokes;
  BrushedBone removed;
  std::vector<double> depth_mm;  ///< of each vertex of the bone
  std::vector<motion::MotionLimit> before, after;
};

/// The joint without what these strokes take, and the limits of motions before and after: exact ones. What contact of each triangle means
/// stays as it was: bone that a stroke brings into the bearing ball ends motions all the same, where a joint made anew calls it bearing surface.
///
/// Throws as Brush and RangeOfMotion do, and UsageError for a bone that a part is cut from and for a joint with an implant.
[[nodiscard]] BrushedJoint brush_joint(const Joint& joint, const BrushRequest& request,
                                       std::span<const motion::Motion> motions);

}  // namespace condyle::plan
