#pragma once

#include <optional>
#include <vector>

#include "radial/radial_table.hpp"

namespace condyle::radial {

/// Penetrations along a motion in small steps, each pose asked after the one before: what was learnt at one
/// pose is not asked again at the next. A block of points that keeps off the surface by some angle stays free
/// until the motion has turned by that angle, and costs nothing until then.
///
/// Answers are those of RadialTable::penetrations, byte for byte, for any poses in any order. What is carried
/// over holds for rotations about the joint centre; at other poses, and after a jump, all is asked anew.
class PenetrationTrack {
 public:
  /// Both have to outlive the track and stay as they are. Raises MeshError for an open mesh.
  PenetrationTrack(const RadialTable& table, const SortedPoints& points);

  void penetrations(const Pose& X_FM, Penetrations& out, PenetrationWork* work = nullptr);

 private:
  void turn_to(const Pose& X_FM);
  void forget();

  const RadialTable& table_;
  const SortedPoints& points_;
  Pose last_;
  double turned_ = 0;               // way of the motion since all was forgotten, as chords of the unit sphere
  std::vector<float> free_until_;   // for each block, in the same measure
  std::vector<std::uint8_t> step_;  // of the pyramid, at which a block is asked next
  std::vector<float> reach_;        // of each step: chord that its entries have room for
};

}  // namespace condyle::radial
