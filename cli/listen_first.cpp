#include "interrupt.hpp"

/// Signals are heard from the first moment of the command. A file of its own, so that a program of tests does not link it.

namespace condyle::cli {

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define CONDYLE_SANITIZER_STARTS_FIRST
#endif
#endif
#ifndef CONDYLE_SANITIZER_STARTS_FIRST
/// Libraries take some milliseconds to start: their constructors come after this.
[[gnu::used,
  gnu::section(".preinit_array")]] static void (*const before_libraries_start)() = say_when_interrupted;
#endif
#endif

}  // namespace condyle::cli
