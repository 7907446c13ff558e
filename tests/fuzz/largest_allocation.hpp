#pragma once

#include <cstddef>

namespace condyle::test {

/// Bytes of the largest piece of memory this program has asked operator new for since this was last set to 0.
/// For programs of one thread.
extern std::size_t largest_allocation;

}  // namespace condyle::test
