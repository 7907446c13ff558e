#pragma once

#include <cstddef>

namespace condyle::test {

/// Bytes of the largest block of memory that this program has requested from operator new since this was last set to 0.
/// For programs of one thread.
extern std::size_t largest_allocation;

}  // namespace condyle::test
