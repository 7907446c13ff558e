#pragma once

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define CONDYLE_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif
#endif

namespace condyle::core {

/// Tells the thread sanitizer what it cannot see, because it happens in oneTBB's library, which is not instrumented: what was done
/// in front of a before() is done when a later after() returns, on whichever threads. Nothing in any other build.
class ToldOrder {
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
