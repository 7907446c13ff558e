// The functions of Highway's library that its headers and the core call, for programs and shared libraries, which start sooner without it, and for
// CONDYLE_STATIC: Debian has the library as a shared one only.
// Results are the same on every instruction set, so that a wrong choice costs time and nothing else.

#include <hwy/highway.h>

#include <atomic>

#if HWY_ARCH_X86
#include <cpuid.h>
#endif

namespace hwy {
namespace {

/// 0: those of the processor.
std::atomic<int64_t> chosen_for_test = 0;

#if HWY_ARCH_X86
/// Those of AVX2's set that clang's __builtin_cpu_supports() has no names for.
bool has_half_floats_and_leading_zeros() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid(1, &a, &b, &c, &d) && (c & bit_F16C) && __get_cpuid(0x80000001, &a, &b, &c, &d) &&
         (c & bit_LZCNT);
}
#endif

}  // namespace

int64_t SupportedTargets() {
  if (const int64_t chosen = chosen_for_test) return chosen;
  // The fallback: the compiler may assume that every processor has it.
  int64_t targets = HWY_STATIC_TARGET;
#if HWY_ARCH_X86
  // What Highway's headers compile each for, wholly: a processor that lacks one of these instructions gets the set before.
  __builtin_cpu_init();
  if (!__builtin_cpu_supports("ssse3")) return targets;
  targets |= HWY_SSSE3;
  if (!__builtin_cpu_supports("sse4.1") || !__builtin_cpu_supports("sse4.2") ||
      !__builtin_cpu_supports("pclmul") || !__builtin_cpu_supports("aes"))
    return targets;
  targets |= HWY_SSE4;
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma") || !__builtin_cpu_supports("bmi") ||
      !__builtin_cpu_supports("bmi2") || !has_half_floats_and_leading_zeros())
    return targets;
  targets |= HWY_AVX2;
  if (!__builtin_cpu_supports("avx512f") || !__builtin_cpu_supports("avx512vl") ||
      !__builtin_cpu_supports("avx512dq") || !__builtin_cpu_supports("avx512bw") ||
      !__builtin_cpu_supports("avx512cd"))
    return targets;
  targets |= HWY_AVX3;
#endif
  return targets;
}

void SetSupportedTargetsForTest(int64_t targets) {
  chosen_for_test = targets;
  GetChosenTarget().DeInit();
}

ChosenTarget& GetChosenTarget() {
  static ChosenTarget chosen;
  return chosen;
}

}  // namespace hwy
