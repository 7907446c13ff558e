#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "condyle/angle.hpp"
#include "tangential/build/profile_boxes.hpp"
#include "tangential/build/profile_grid.hpp"

namespace condyle::tangential {

/// Directions about the axis in which a ring holds no surface, and the winding number there. The winding
/// number of any other point of that ring then follows from the crossings in between.
///
///            surface
///       \    ~~~ |   /            Eight half-planes from the axis, an eighth of a turn apart. In a cell of the
///         \    ~~|~/              profile that no triangle meets near such a half-plane, the winding number
///           \    | /              over the cell's part of the half-plane is one number; and the same number
///     -------- axis ----- free    as in the next cell, where that is free in this direction too. So one number
///           /    |  \             holds for each connected patch of free cells, and it is 0 for a patch that
///         /      |    \           reaches the border of the profile.
class FreeDirections {
 public:
  /// One bit per direction.
  using Directions = std::uint8_t;
  static constexpr int count = 8;

  /// Sine of the angle that a free direction keeps from all surface in its cell.
  static constexpr double clearance = 0x1p-12;

  static constexpr Angle angle_of(int direction) noexcept { return Angle::radians(two_pi / 8 * direction); }

  /// Directions near the triangle: it may come within the clearance of them.
  static Directions near(const Vec3& a, const Vec3& b, const Vec3& c) noexcept;

  /// Eighths of a turn between the directions, sector k from direction k to the next: one bit each.
  using Sectors = std::uint8_t;
  /// The same, of a triangle whose corners keep the clearance from all directions and lie in these sectors:
  /// those inside the narrowest angle around them. None if that is half a turn or more, for the triangle
  /// may then go round the axis on either side.
  static std::optional<Directions> between(Sectors sectors) noexcept;

  struct Anchor {
    /// `none` where each is taken, or the winding number does not fit.
    std::int8_t direction = none;
    std::int8_t winding = 0;
  };
  static constexpr std::int8_t none = -1;

  /// Winding number at a radius and height, in mm, in a direction that is free there.
  using WindingAt = std::function<int(int direction, double rho, double z)>;

  FreeDirections() = default;
  /// `taken` has for each cell the directions that its triangles come near. A winding number costs about as
  /// much as visiting `cells_per_winding` cells.
  FreeDirections(const ProfileGrid& grid, const std::vector<Directions>& taken, const WindingAt& winding_at,
                 std::size_t cells_per_winding);

  Anchor of(std::size_t cell) const noexcept { return anchor_[cell]; }
  void prefetch(std::size_t cell) const noexcept { __builtin_prefetch(&anchor_[cell]); }
  std::size_t bytes() const noexcept { return anchor_.size() * sizeof(Anchor); }

 private:
  std::vector<Anchor> anchor_;
};

/// The free directions of a mesh. `scale` is at least every |x|, |y| of its triangles, in mm.
FreeDirections find_free_directions(const AxisVertices& vertices, std::span<const Triangle> triangles,
                                    const ProfileBoxes& boxes, const ProfileGrid& grid, double scale);

}  // namespace condyle::tangential
