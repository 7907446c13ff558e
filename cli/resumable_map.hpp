#pragma once

#include <filesystem>

#include "condyle/motion_map.hpp"

namespace condyle::cli {

/// Whose map it is.
struct MapSubject {
  const Joint& joint;
  const RangeOptions& options;
  const RangeOfMotion& range;  ///< of this joint with these options
};

/// Where a map is kept that is interrupted: in the folder for results. Nowhere without one.
std::filesystem::path checkpoint_in(const std::filesystem::path& folder);

/// Computes the map, going on from the checkpoint where there is one of the same question, and shows how far
/// it is. Interrupted, it keeps what is done and throws Interrupted.
MotionMap resumable_map(const MapGrid& grid, const MapSubject& subject,
                        const std::filesystem::path& checkpoint);

/// When the map is complete and written, the checkpoint, if there was one, has nothing to add.
void remove_checkpoint(const std::filesystem::path& checkpoint);

}  // namespace condyle::cli
