#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>
#include <string_view>

namespace condyle {

/// Reports the progress of long work, which may have several stages, and stops it: answers, maps, bands, frames, studies, meshes.
struct Control {
  /// `stage` names what is counted, such as "map points". Whichever thread finished a piece calls it, one call at a time, with
  /// growing counts.
  std::function<void(std::string_view stage, std::size_t done, std::size_t total)> progress = {};
  /// Pieces begun are finished, no others are begun.
  std::stop_token stop = {};
};

}  // namespace condyle
