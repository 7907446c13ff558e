#pragma once

#include <functional>
#include <string>
#include <vector>

#include "condyle/fit.hpp"

namespace condyle::measure {

/// A bone without pieces that are not its own.
struct OwnPieces {
  Mesh mesh;
  std::string left_out;  ///< one sentence; empty if nothing is
};

/// How much a triangle says for its piece.
using PieceVote = std::function<double(std::size_t triangle)>;

/// Leaves out every connected piece that comes into a ball but the one with most votes: a bone's mesh may have the wall of its marrow,
/// another bone, or splinters. Pieces outside the ball stay. The mesh as it is if no other piece comes into the ball. `cut` marks vertices in
/// which a part was cut off: pieces that have such are one; empty if nothing was. Near linear.
OwnPieces own_pieces(const Mesh& bone, const std::string& name, const Sphere& ball,
                     const std::vector<char>& cut, const PieceVote& vote);

}  // namespace condyle::measure
