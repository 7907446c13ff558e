#pragma once

#include <string>

#include "io/report/block_arrays.hpp"
#include "io/report/report.hpp"

namespace condyle::io {

/// The part of a block that every joint has: the joint with its bodies, parts and limits, and null or nothing for all else. A page that
/// reads a joint file shows this.
Json joint_object(const Report& report, BlockArrays& arrays);

/// The block of such an object, to which more may have been added: data_block.hpp has its form.
std::string block_of(Json json, const BlockArrays& arrays);

}  // namespace condyle::io
