#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"

namespace condyle::test {

/// Numbers and shapes drawn from the bytes of an input, zeros once those are used up. The first two bytes choose the unit of
/// the coordinates and how far from the origin they are.
///
/// Most coordinates are small whole numbers of the unit, so that corners coincide, edges meet and faces are coplanar; some are
/// the next double to one, and some any double at all.
class FuzzInput {
 public:
  explicit FuzzInput(std::string_view bytes);

  bool is_used_up() const noexcept { return bytes_.empty(); }
  std::uint8_t byte() noexcept;
  /// 0 to bound - 1; bound is at most 256.
  std::size_t below(std::size_t bound) noexcept { return byte() % bound; }
  /// Any eight bytes as a double.
  double any_double() noexcept;

  double coordinate() noexcept;
  Vec3 point() noexcept;
  Points points(std::size_t most) noexcept;
  /// At most 56 triangles: a soup; tetrahedra; or a known shape with some of its vertices elsewhere.
  TriMesh mesh();
  /// Mostly the z axis through the origin, to which nothing rounds.
  AxisFrame axis();
  /// Mostly the identity; or a translation, a rotation, or both.
  Pose pose();

 private:
  std::string_view bytes_;
  double unit_ = 1;
  Vec3 from_origin_ = Vec3::Zero();
};

/// Whether the triangle has an area of exactly zero.
bool is_degenerate(const TriMesh& mesh, std::size_t triangle);

}  // namespace condyle::test
