#pragma once

#include <array>
#include <cstdint>

#include "condyle/pose.hpp"
#include "radial/query/cube_view.hpp"

/// The passes that find penetrating points, each compiled for every instruction set and chosen at run time.
/// None of them decides what floats cannot: a point that a bound does not settle is handed on as doubtful.

namespace condyle::radial {

/// Blocks of points that go through the passes together. Few of their points are near, and those stay in
/// cache.
inline constexpr std::size_t blocks_per_batch = 512;
inline constexpr std::size_t points_per_batch = 16 * blocks_per_batch;

/// Vectors are stored whole: room for one more than can be found.
inline constexpr std::size_t vector_room = 16;
template <class T>
using BatchArray = std::array<T, points_per_batch + vector_room>;

/// Points not rejected by their cell's radii, as floats in the table's frame. Surface beyond `relevant`, a
/// code of squared radii, says nothing of a point: what lies before it is nearer.
struct NearPoints {
  std::size_t count;
  alignas(64) BatchArray<float> x, y, z;
  alignas(64) BatchArray<std::uint32_t> cell, box, relevant, point;
};

/// Points that are inside (by certain signs), with the triangle they leave through, and points in doubt.
struct FoundPoint {
  std::uint32_t point, triangle;
  std::int16_t winding;
  bool away_from_centre, doubtful;
};
struct FoundPoints {
  std::size_t count;
  std::array<FoundPoint, points_per_batch> point;
};

/// Blocks that may hold a point within the radii of the surface around them, among the sixteen blocks of each
/// of `parents`, blocks of the next level. `found` has room for all of them and a vector.
std::size_t near_blocks(const CubeView& cube, const BlockColumns& blocks, const FloatPose& pose,
                        const std::uint32_t* parents, std::size_t parent_count, std::uint32_t* found);

/// Points of those blocks within the radii of their cell.
void near_points(const CubeView& cube, const PointColumns& points, const FloatPose& pose,
                 const std::uint32_t* blocks, std::size_t block_count, NearPoints& found);

/// Triangles of one cell whose octagons hold a point with that box, in the order of the list. `found` has
/// room for the list and a vector. Returns how many.
std::size_t triangles_holding(const CubeView& cube, std::uint32_t cell, std::uint32_t box,
                              std::uint32_t* found);

/// Those of them that have crossed the surface, or may have. Returns how many listed triangles were tried.
std::size_t inside_points(const CubeView& cube, const NearPoints& points, float form_bound,
                          FoundPoints& found);

/// Some points found, with their triangles' scaled normals, and what comes of them.
struct GapColumns {
  static constexpr std::size_t size = 64;
  std::size_t count;
  alignas(64) double point[3][size], normal[3][size], gap[size];
};

/// Poses the points and finds their ways to the planes: posed() and gap_to_plane(), to the bit.
void gaps_to_planes(const Pose& X_FM, GapColumns& columns);

}  // namespace condyle::radial
