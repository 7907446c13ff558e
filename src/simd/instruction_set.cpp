#include "simd/instruction_set.hpp"

#include <hwy/highway.h>

namespace condyle::simd {
namespace {

void use(std::int64_t targets) {
  hwy::SetSupportedTargetsForTest(targets);
  // Functions ask again which of them to call.
  hwy::GetChosenTarget().DeInit();
}

}  // namespace

std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> sets;
  // Better ones have lower bits.
  std::int64_t targets = (hwy::SupportedTargets() & HWY_TARGETS) | HWY_STATIC_TARGET;
  for (; targets != 0; targets &= targets - 1) {
    const std::int64_t target = targets & -targets;
    sets.push_back({hwy::TargetName(target), target});
  }
  return sets;
}

InstructionSetInUse::InstructionSetInUse(const InstructionSet& set) {
  use(set.target);
}

InstructionSetInUse::~InstructionSetInUse() {
  use(0);
}

}  // namespace condyle::simd
