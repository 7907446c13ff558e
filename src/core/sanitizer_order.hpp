#pragma once

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define CONDYLE_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif
#endif

namespace condyle::core {

/// Reports to the thread sanitizer an order that it cannot see, because oneTBB's library is not instrumented: everything
/// before a before() happens before a later after() returns, on whichever threads. Nothing in any other build.
class SanitizerOrder {
 public:
#ifdef CONDYLE_THREAD_SANITIZER
  void before() noexcept {
    __tsan_release(this);
  }
  void after() noexcept {
    __tsan_acquire(this);
  }
#else
  void before() const noexcept {}
  void after() const noexcept {}
#endif
};

}  // namespace condyle::core
