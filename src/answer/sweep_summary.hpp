#pragma once

#include <cstddef>
#include <span>

#include "condyle/answer.hpp"

namespace condyle::answer {

/// Smallest margin of a design's limits over the targets' reach; NaN if there are no limits.
double least_margin(std::span<const plan::SweepTarget> targets, std::span<const plan::DesignLimit> limits);

/// The target that has that.
std::size_t least_target(std::span<const plan::SweepTarget> targets,
                         std::span<const plan::DesignLimit> limits);

/// Fills in what follows from limits, margins and safe intervals: measures, the best design, and the notes on the zone.
void summarise_sweep(SweepAnswer& answer);

}  // namespace condyle::answer
