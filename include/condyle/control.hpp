#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>

namespace condyle {

/// Reports the progress of long work and stops it: maps, bands, frames, studies, meshes.
struct Control {
  /// Called by whichever thread finished a piece, one call at a time, with growing counts.
  std::function<void(std::size_t done, std::size_t total)> progress = {};
  /// Pieces begun are finished, no others are begun.
  std::stop_token stop = {};
};

}  // namespace condyle
