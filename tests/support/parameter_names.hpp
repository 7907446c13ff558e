#pragma once

#include <ostream>

#include "condyle/radial.hpp"
#include "simd/instruction_set.hpp"

/// Parameters of tests as GoogleTest prints them: by name, not as the bytes of the object.

namespace condyle {

inline void PrintTo(radial::DirectionMapKind kind, std::ostream* out) {
  *out << (kind == radial::DirectionMapKind::cube ? "cube" : "cartesian");
}

}  // namespace condyle

namespace condyle::simd {

inline void PrintTo(const InstructionSet& set, std::ostream* out) {
  *out << set.name;
}

}  // namespace condyle::simd
