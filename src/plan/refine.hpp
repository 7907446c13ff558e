#pragma once

#include <cstdint>
#include <vector>

#include "condyle/joint.hpp"

namespace condyle::plan {

/// A body with smaller triangles where they are wanted. Its surface is where it was, up to the rounding of midpoints.
struct RefinedBody {
  Body body;
  std::vector<Index> triangle_before;  ///< of each triangle: the one of the body before that it is a piece of
};

/// Halves edges until none of a wanted triangle is longer. A triangle with a side halved also has its longest one halved, so that
/// triangles around do not become narrow; edges shared by any number of triangles stay shared. Parts of the body stay apart.
RefinedBody refined(const Body& body, const std::vector<std::uint8_t>& wanted, double longest_edge_mm);

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
/// whole. What is split off a triangle with two such edges lies between the places.
SplitBody split_at(const Body& body, const std::vector<double>& shares);

}  // namespace condyle::plan
