#pragma once

#include <functional>
#include <string>

#include "condyle/fit.hpp"

namespace condyle::measure {

/// A bone without pieces that are not its own.
struct OwnPieces {
  Mesh mesh;
  std::string left_out;  ///< one sentence; empty if nothing is
};

/// How much a triangle says for its piece.
using PieceVote = std::function<double(std::size_t triangle)>;

/// Of the connected pieces that come into a ball only the one with most votes stays, and so does what lies outside the ball: in a bone's
/// mesh there may be the wall of its marrow, another bone, or splinters. The mesh as it is if no other piece comes into the ball. Near
/// linear.
OwnPieces own_pieces(const Mesh& bone, const std::string& name, const Sphere& ball, const PieceVote& vote);

}  // namespace condyle::measure
