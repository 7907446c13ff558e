#include "core/thread_pool.hpp"

#ifdef __linux__
#include <sched.h>
#endif

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace condyle::core::pool {
namespace {

/// A loop that runs. Its links and counters belong to the pool, but for what is atomic.
struct Loop {
  /// Chunks shrink with what is left, to an eighth of a thread's part of it: few while there is much, and small ones for the
  /// end, when threads wait for the last of them.
  static constexpr std::size_t chunks_per_thread = 8;

  const ChunkBody body;
  const std::size_t count, grain;
  Arena& arena;
  Loop* const outer;  ///< of the chunk in which it was opened

  std::atomic<std::size_t> next = 0;
  std::atomic<std::size_t> inside = 0;  ///< threads at its chunks, besides its caller
  bool has_waiting_caller = false;
  std::condition_variable changed{};  ///< for its caller
  std::size_t failed_at = SIZE_MAX;
  std::exception_ptr error{};  ///< of the chunk at failed_at
  Loop *older = nullptr, *newer = nullptr;

  bool has_chunks() const noexcept { return next.load(std::memory_order_relaxed) < count; }

  bool take(std::size_t& first, std::size_t& last) noexcept {
    first = next.load(std::memory_order_relaxed);
    do {
      if (first >= count) return false;
      last = first +
             std::min(count - first, std::max(grain, (count - first) / (chunks_per_thread * arena.limit)));
    } while (!next.compare_exchange_weak(first, last, std::memory_order_relaxed));
    return true;
  }

  /// Chunks before one that failed were taken before it, and go on.
  void take_no_more() noexcept { next.store(count, std::memory_order_relaxed); }

  bool is_below(const Loop& other) const noexcept {
    for (const Loop* above = outer; above != nullptr; above = above->outer)
      if (above == &other) return true;
    return false;
  }
};

/// What the thread is at.
struct Place {
  Arena* arena = nullptr;
  Loop* loop = nullptr;
};
thread_local Place here;

/// 0: none is set.
std::atomic<std::size_t> least_limit = 0;

std::size_t processors() noexcept {
#ifdef __linux__
  // Those that a scheduler gave to the process; the C++ library counts all.
  cpu_set_t set;
  if (::sched_getaffinity(0, sizeof set, &set) == 0) return static_cast<std::size_t>(CPU_COUNT(&set));
#endif
  return std::max(1u, std::thread::hardware_concurrency());
}

class Pool {
 public:
  /// Never destroyed, and its threads end with the process: to wait for them would hang a forked child, which has none.
  static Pool& shared() {
    static Pool& pool = *new Pool;
    return pool;
  }

  void run(Loop& loop) {
    open(loop);
    work_at(loop);
    std::unique_lock lock(mutex_);
    close(loop);
    while (loop.inside.load(std::memory_order_relaxed) > 0) {
      if (Loop* const below = loop_below(loop)) {
        join(lock, *below, &below->arena != &loop.arena);
        continue;
      }
      const std::size_t seen = openings_.load(std::memory_order_relaxed);
      lock.unlock();
      yield_until([&] {
        return loop.inside.load(std::memory_order_relaxed) == 0 ||
               openings_.load(std::memory_order_relaxed) != seen;
      });
      lock.lock();
      if (loop.inside.load(std::memory_order_relaxed) == 0 ||
          openings_.load(std::memory_order_relaxed) != seen)
        continue;
      loop.has_waiting_caller = true;
      loop.changed.wait(lock);
      loop.has_waiting_caller = false;
    }
    lock.unlock();
    if (loop.error) std::rethrow_exception(loop.error);
  }

 private:
  /// For some 50 microseconds: a thread that sleeps takes as long to be woken, and the next loop, or the last chunk of this one,
  /// is often nearer.
  template <class Predicate>
  static void yield_until(const Predicate& is_so) noexcept {
    for (int i = 0; i < 100 && !is_so(); ++i) std::this_thread::yield();
  }

  void open(Loop& loop) {
    const std::lock_guard lock(mutex_);
    hire(loop.arena.limit - 1);
    loop.older = newest_;
    (newest_ != nullptr ? newest_->newer : oldest_) = &loop;
    newest_ = &loop;
    openings_.fetch_add(1, std::memory_order_relaxed);
    for (Loop* above = loop.outer; above != nullptr; above = above->outer)
      if (above->has_waiting_caller) above->changed.notify_one();
    if (sleeping_ == 0 || loop.arena.active >= loop.arena.limit) return;
    if (loop.arena.limit - loop.arena.active >= sleeping_)
      opened_.notify_all();
    else
      for (std::size_t i = loop.arena.active; i < loop.arena.limit; ++i) opened_.notify_one();
  }

  void close(Loop& loop) noexcept {
    (loop.older != nullptr ? loop.older->newer : oldest_) = loop.newer;
    (loop.newer != nullptr ? loop.newer->older : newest_) = loop.older;
  }

  /// As many threads as the system gives: without any, callers do all.
  void hire(std::size_t wanted) noexcept {
    while (threads_.size() < wanted) try {
        threads_.emplace_back([this] { serve(); });
      } catch (...) {
        return;
      }
  }

  /// The oldest one: its chunks are the largest pieces of work.
  Loop* loop_for_idle() const noexcept {
    for (Loop* loop = oldest_; loop != nullptr; loop = loop->newer)
      if (loop->has_chunks() && loop->arena.active < loop->arena.limit) return loop;
    return nullptr;
  }

  /// For a caller that waits for the chunks of its own: in its arena it counts already.
  Loop* loop_below(const Loop& own) const noexcept {
    for (Loop* loop = oldest_; loop != nullptr; loop = loop->newer)
      if (loop->has_chunks() && loop->is_below(own) &&
          (&loop->arena == &own.arena || loop->arena.active < loop->arena.limit))
        return loop;
    return nullptr;
  }

  void join(std::unique_lock<std::mutex>& lock, Loop& loop, bool counts) {
    loop.inside.fetch_add(1, std::memory_order_relaxed);
    if (counts) ++loop.arena.active;
    lock.unlock();
    work_at(loop);
    lock.lock();
    if (counts) --loop.arena.active;
    if (loop.inside.fetch_sub(1, std::memory_order_relaxed) == 1 && loop.has_waiting_caller)
      loop.changed.notify_one();
  }

  void work_at(Loop& loop) noexcept {
    const Place before = std::exchange(here, {&loop.arena, &loop});
    for (std::size_t first = 0, last = 0; loop.take(first, last);) try {
        loop.body.call(loop.body.body, first, last);
      } catch (...) {
        loop.take_no_more();
        const std::lock_guard lock(mutex_);
        if (first < loop.failed_at) loop.failed_at = first, loop.error = std::current_exception();
      }
    here = before;
  }

  void serve() {
    std::unique_lock lock(mutex_);
    while (true) {
      if (Loop* const loop = loop_for_idle()) {
        join(lock, *loop, true);
        continue;
      }
      const std::size_t seen = openings_.load(std::memory_order_relaxed);
      const auto is_called = [&] { return openings_.load(std::memory_order_relaxed) != seen; };
      lock.unlock();
      yield_until(is_called);
      lock.lock();
      ++sleeping_;
      opened_.wait(lock, is_called);
      --sleeping_;
    }
  }

  std::mutex mutex_;
  std::condition_variable opened_;
  Loop *oldest_ = nullptr, *newest_ = nullptr;  ///< that their callers have not left
  std::atomic<std::size_t> openings_ = 0;
  std::size_t sleeping_ = 0;
  std::vector<std::jthread> threads_;
};

}  // namespace

std::size_t threads_allowed() noexcept {
  if (here.arena != nullptr) return here.arena->limit;
  static const std::size_t all = processors();
  const std::size_t limit = least_limit.load(std::memory_order_relaxed);
  return limit != 0 ? limit : all;
}

ThreadLimit::ThreadLimit(std::size_t threads) noexcept
    : before_(least_limit.load(std::memory_order_relaxed)) {
  const std::size_t wanted = std::max(threads, std::size_t{1});
  least_limit.store(before_ != 0 ? std::min(before_, wanted) : wanted, std::memory_order_relaxed);
}

ThreadLimit::~ThreadLimit() {
  least_limit.store(before_, std::memory_order_relaxed);
}

ThreadShare::ThreadShare(std::size_t threads) noexcept
    : own_{std::max(threads, std::size_t{1})}, before_(std::exchange(here.arena, &own_)) {}

ThreadShare::~ThreadShare() {
  here.arena = before_;
}

void run_chunks(std::size_t count, std::size_t grain, ChunkBody body) {
  if (count == 0) return;
  grain = std::max(grain, std::size_t{1});
  const std::size_t threads = threads_allowed();
  if (threads == 1 || count <= grain) return body.call(body.body, 0, count);
  Arena own{threads};
  Loop loop{body, count, grain, here.arena != nullptr ? *here.arena : own, here.loop};
  Pool::shared().run(loop);
}

const void* thread_key() noexcept {
  static thread_local char key;
  return &key;
}

}  // namespace condyle::core::pool
