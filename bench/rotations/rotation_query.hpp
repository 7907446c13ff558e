#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "motion/events/rotation_function.hpp"

/// Queries of bench/rotation_queries, as programs in double see them.

namespace bench {

using Point = condyle::motion::Triple<double>;

/// One feature turns about z, through the origin, from angle 0; the other one rests.
struct RotationQuery {
  enum class Features { vertex_face, edge_edge } features;
  /// The vertex, then the face's corners; or the edge that turns, then the other one. Where the motion starts.
  std::array<Point, 4> points;
  double angle;  ///< how far it turns, in [0, 2 pi]
  bool is_whole_turn;

  std::size_t turning() const noexcept { return features == Features::vertex_face ? 1 : 2; }
};

/// Throws std::runtime_error, with the row, for what is no file of queries.
///
/// Placed about the axis as the library places bodies: exact where the axis is one of the coordinates', and else rounded. What turns is
/// turned to its start, exact where doubles hold where it starts.
std::vector<RotationQuery> read_rotation_queries(const std::filesystem::path& path);

}  // namespace bench
