#pragma once

#include <functional>
#include <optional>
#include <span>
#include <stop_token>

#include "condyle/answer/range.hpp"

/// The part of answer_range() that a page asks too, which links nothing of maps, bands and zones.

namespace condyle::answer {

/// Throws MeshError for a rim's clock where no rim was found.
motion::ClockFace clock_of(const Joint& joint, motion::ClockPlane plane,
                           const motion::BearingFinding& bearing);

/// Adds the limits of all motions to an answer that has its tables; false if stopped.
bool add_limits(RangeAnswer& answer, std::span<const motion::Motion> motions, const std::stop_token& stop);

/// Adds limits to an answer whose joint is held; false if stopped.
using AddLimits = std::function<bool(RangeAnswer& answer, const motion::RangeOptions& options)>;

/// The answer for a joint at the translation at which it is held. Empty if `add` was stopped.
std::optional<RangeAnswer> held_answer(const Case& of, const RangeRequest& request, const AddLimits& add);

/// Adds to an answer that has its limits, by options that have their bearing surface; false if stopped.
using AddBeyondLimits = std::function<bool(RangeAnswer& answer, const motion::RangeOptions& again)>;

/// Limits, bearing surface, clock, notes and closed forms, then what `beyond` adds; false if stopped.
bool add_exact_limits(RangeAnswer& answer, const RangeRequest& request, const motion::RangeOptions& options,
                      const std::stop_token& stop, const AddBeyondLimits& beyond = {});

/// answer_range() of a request for exact limits and nothing else.
RangeAnswer exact_limits(const Case& of, const RangeRequest& request);

}  // namespace condyle::answer
