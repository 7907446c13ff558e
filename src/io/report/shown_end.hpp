#pragma once

#include "condyle/motion_map.hpp"

namespace condyle::io {

/// What makes the end of a free interval, as the page is told: 0 the range, 1 contact, 2 a ligament.
template <class End>
int shown_end(const End& end) noexcept {
  return end.ligament ? 2 : end.reason == motion::LimitReason::end_of_range ? 0 : 1;
}

}  // namespace condyle::io
