#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"
#include "core/uninitialised.hpp"
#include "radial/exact/direction_map.hpp"
#include "radial/query/cube_view.hpp"

/// The passes that find penetrating points, each compiled for every instruction set and chosen at run time.
/// None of them decides what floats cannot: a point that a bound does not settle is handed on as uncertain.

namespace condyle::radial {

/// Blocks of points that go through the passes together. Few of their points are near, and those stay in
/// cache.
inline constexpr std::size_t blocks_per_batch = 128;
inline constexpr std::size_t points_per_batch = 16 * blocks_per_batch;

/// Vectors are stored whole: capacity for one more than can be found.
inline constexpr std::size_t vector_padding = 16;
template <class T>
using BatchArray = std::array<T, points_per_batch + vector_padding>;

/// Points not rejected by their cell's radii, as floats in the table's frame. Surface beyond `relevant`, a
/// code of squared radii, says nothing of a point: what lies before it is nearer.
struct NearPoints {
  std::size_t count;
  alignas(64) BatchArray<float> x, y, z;
  alignas(64) BatchArray<std::uint32_t> cell, box, relevant, point;
};

/// Points that are inside (by certain signs), with the triangle they leave through, and uncertain points.
struct PointResult {
  std::uint32_t point, triangle;
  std::int16_t winding;
  bool away_from_centre, uncertain;

  /// One that is left to exact arithmetic.
  static constexpr PointResult left_open(std::uint32_t point) noexcept {
    return {.point = point, .triangle = no_index, .winding = 0, .away_from_centre = false, .uncertain = true};
  }
};
struct PointResults {
  std::size_t count;
  std::array<PointResult, points_per_batch> point;
};

/// Blocks that may hold a point within the radii of the surface around them, among the sixteen blocks of each
/// of `parents`, blocks of the next level. `found` has capacity for all of them and a vector.
std::size_t near_blocks(const CubeView& cube, const BlockColumns& blocks, const FloatPose& pose,
                        const std::uint32_t* parents, std::size_t parent_count, std::uint32_t* found);

/// Points of those blocks within the radii of their cell.
void near_points(const CubeView& cube, const PointColumns& points, const FloatPose& pose,
                 const std::uint32_t* blocks, std::size_t block_count, NearPoints& found);

/// Triangles of each place's cell whose 8-DOPs hold the place, in the order of the rows, place after place;
/// end[i] is behind the last one of place i. `found` has capacity for all rows and a vector.
void find_candidates(const EntryView& entries, std::span<const CellPlace> places, std::uint32_t* end,
                     std::uint32_t* found);

/// Most pairs of a near point and a triangle that are evaluated together.
inline constexpr std::size_t most_pairs = 4096;

/// Triangles whose 8-DOPs hold a point, with the number of the point among the near ones.
struct Pairs {
  static constexpr std::size_t most = most_pairs, padding = 3 * vector_padding;
  std::array<std::uint32_t, most + padding> triangle, point;
  std::size_t count;
};

/// Query constants of rows and edge functions, the same for all near points.
struct QueryConstants {
  alignas(64) BatchArray<std::uint32_t> diagonal;
  alignas(64) BatchArray<float> bound;  ///< error of a form over the sum of its coefficients' magnitudes
};

/// Crossings of near points' rays, those of a point side by side. `s` is |v| over the crossing's radius,
/// positive where the ray leaves the solid and negative where it enters; NaN where floats do not say whether
/// there is one.
struct Crossings {
  /// Start of the first: a vector of crossings can be read before it too, as behind the last, of no point.
  static constexpr std::size_t begin = vector_padding;
  template <class T>
  using Array = std::array<T, begin + most_pairs + vector_padding>;
  alignas(64) Array<float> s, error;
  alignas(64) Array<std::uint32_t> triangle, point;
  std::size_t end;

  Crossings() {
    std::fill_n(s.begin(), begin, 0.0f), std::fill_n(error.begin(), begin, 0.0f);
    std::fill_n(point.begin(), begin, no_index);
  }
  void close(std::size_t last_end) {
    end = last_end;
    point[end] = no_index;
  }
};

/// The sum of a near point's crossings.
struct CrossingSum {
  std::int16_t winding;
  std::uint16_t crossings;
  std::uint32_t end;  ///< behind the last of them
  std::uint8_t uncertain;
};

/// Decisions for points that may be inside.
struct Decisions {
  std::array<CrossingSum, points_per_batch> sum;
  std::array<std::uint32_t, points_per_batch + vector_padding> kept;
};

/// Forms of triangles of a table that has none: measured where they are needed, each time.
class FormsOnDemand {
 public:
  /// Returns the forms of the triangles, in their order; they stay until the next call.
  const EdgeFunctions* measure(const CubeView& cube, std::span<const std::uint32_t> triangles);
  /// How many were measured since this was last asked.
  std::size_t take_count() noexcept { return std::exchange(count_, 0); }

 private:
  std::size_t count_ = 0;
  core::UninitialisedVector<Triangle> corners_;
  core::UninitialisedVector<EdgeFunctions> forms_;
  std::vector<std::uint32_t> uncertain_;
};

/// Scratch of inside_points(), 150 kB; 450 kB with forms.
struct CrossingScratch {
  FormsOnDemand forms;
  Pairs pairs;
  QueryConstants constants;
  Crossings crossings;
  Decisions decisions;
};

/// The points that have crossed the surface, or may have. Returns how many triangles were tried.
std::size_t inside_points(const CubeView& cube, const NearPoints& points, float form_bound,
                          CrossingScratch& scratch, PointResults& found);

/// Some points found, with their triangles' scaled normals, and what comes of them.
struct GapColumns {
  static constexpr std::size_t size = 64;
  std::size_t count;
  alignas(64) double point[3][size], normal[3][size], gap[size];
};

/// Poses the points and finds their ways to the planes: posed() and gap_to_plane(), to the bit.
void gaps_to_planes(const Pose& X_FM, GapColumns& columns);

}  // namespace condyle::radial
