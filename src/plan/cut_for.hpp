#pragma once

#include "condyle/resection.hpp"

namespace condyle::plan {

/// What is computed of a cut: all but where targets end after it, or what a curve has of it, its reach, volume and depth.
enum class CutFacts : std::uint8_t { all_but_limits, curve };

/// As resect() of a request that was checked, its gains resolved; `before` is the joint's. From any thread.
std::optional<Resection> cut_for(const Joint& joint, const ResectionOptions& request,
                                 const motion::RangeOfMotion& before, CutFacts facts, const Control& control);

}  // namespace condyle::plan
