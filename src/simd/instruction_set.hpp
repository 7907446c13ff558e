#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace condyle::simd {

/// One of the instruction sets that the library's vector code is compiled for.
struct InstructionSet {
  std::string name;
  std::int64_t target;
};

/// The sets of this processor, the best first: the first one runs unless another one is chosen. The
/// last one is what every processor of the family has.
std::vector<InstructionSet> instruction_sets();

/// As long as it lives, vector code everywhere in the program runs on the given instruction set. For tests
/// and measurements: answers do not depend on it.
class InstructionSetInUse {
 public:
  explicit InstructionSetInUse(const InstructionSet& set);
  ~InstructionSetInUse();
  InstructionSetInUse(const InstructionSetInUse&) = delete;
  InstructionSetInUse& operator=(const InstructionSetInUse&) = delete;
};

}  // namespace condyle::simd
