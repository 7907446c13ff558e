#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "condyle/joint.hpp"

namespace condyle::plan {

/// A body with smaller triangles where they are wanted. Its surface is where it was, up to the rounding of midpoints.
struct RefinedBody {
  Body body;
  std::vector<Index> triangle_before;  ///< of each triangle: the one of the body before that it is a piece of
};

/// Which triangles shall be small: marks of an intermediate mesh, given which triangle of the body each is a part of, and which are requested.
/// Triangles that are not requested stay unchanged.
using ToRefine =
    std::function<std::vector<std::uint8_t>(const TriMesh& pieces, const std::vector<Index>& triangle_before,
                                            const std::vector<std::uint8_t>& asked)>;

/// Halves edges until none of a triangle that shall be small is longer. Pieces of those that shall be are asked for again after each
/// halving, so that of a large triangle only what is meant becomes small. A triangle with a side halved also has its longest one halved, so
/// that triangles around do not become narrow; edges shared by any number of triangles stay shared. Parts of the body stay apart.
/// Empty if that would make more than `most_added` triangles beyond those of the body: they are counted before they are made.
std::optional<RefinedBody> refined(const Body& body, const ToRefine& to_refine, double longest_edge_mm,
                                   std::size_t most_added);

/// A vertex on an edge of the body before: a share of the way from one end to the other. One that was there already is both ends.
struct Between {
  Index from, to;
  double share;
};

struct SplitBody {
  RefinedBody refined;
  std::vector<Between> vertices;
};

/// Splits edges where it is said: the share of the way from the first end of each edge of `mesh::EdgeTable(body.mesh)`; 0 where it stays
/// whole. What is split off a triangle with two such edges lies between the places. Empty if that would make more than `most` triangles.
std::optional<SplitBody> split_at(const Body& body, const std::vector<double>& shares, std::size_t most);

}  // namespace condyle::plan
