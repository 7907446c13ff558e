#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <utility>

/// Parallel loops on threads of our own, which CONDYLE_THREADS=std has in place of oneTBB: for a command in one static file, and for
/// compilers that oneTBB does not come with. docs/decisions/0031-thread-pool.md
///
/// A loop lies on its caller's stack, with a counter of the chunks that are taken. Idle threads join the oldest loop that has chunks
/// left. The caller takes chunks too, then waits for whoever is still at one, and until then works at loops that these chunks
/// have opened, never at others. So nobody waits for work that waits for him, a thread in the middle of one task never begins
/// another, and a loop ends even if no other thread can be had.
namespace condyle::core::pool {

/// How many threads a loop called here may use, the calling one among them: the processors that the process may run on, unless
/// a ThreadLimit or a ThreadShare says less or a ThreadLimit more.
[[nodiscard]] std::size_t threads_allowed() noexcept;

/// While it lives, loops of the process that are no part of another one use at most so many threads, and of several limits the
/// least one. They end in the reverse order of their beginning.
class ThreadLimit {
 public:
  explicit ThreadLimit(std::size_t threads) noexcept;
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  std::size_t before_;
};

/// Threads that may work at a time at loops of one task. Its counter belongs to the pool.
struct Arena {
  std::size_t limit;
  std::size_t active = 1;  ///< the calling one
};

/// While it lives, loops of this thread use at most so many threads.
class ThreadShare {
 public:
  explicit ThreadShare(std::size_t threads) noexcept;
  ~ThreadShare();
  ThreadShare(const ThreadShare&) = delete;
  ThreadShare& operator=(const ThreadShare&) = delete;

 private:
  Arena own_;
  Arena* before_;
};

/// body(first, last), without its type.
struct ChunkBody {
  const void* body;
  void (*call)(const void* body, std::size_t first, std::size_t last);
};

void run_chunks(std::size_t count, std::size_t grain, ChunkBody body);

/// Calls body(first, last) over [0, count) in chunks of at least `grain`, but for the last. Of several exceptions the one of the first
/// chunk is thrown, which is what one thread would meet, when every chunk that was begun is done; no others are begun.
template <class Body>
void parallel_chunks(std::size_t count, std::size_t grain, const Body& body) {
  run_chunks(count, grain, {&body, [](const void* erased, std::size_t first, std::size_t last) {
                              (*static_cast<const Body*>(erased))(first, last);
                            }});
}

/// Calls both, the second also if the first throws. If both throw, the first one's exception is thrown.
template <class First, class Second>
void parallel_pair(const First& first, const Second& second) {
  std::exception_ptr errors[2];
  parallel_chunks(2, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) try {
        if (i == 0)
          first();
        else
          second();
      } catch (...) {
        errors[i] = std::current_exception();
      }
  });
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

/// Calls body(i) for every i of [0, count), begun in ascending order, each with its share of the threads.
template <class Body>
void parallel_tasks(std::size_t count, const Body& body) {
  if (count == 0) return;
  const std::size_t threads = threads_allowed();
  const std::size_t workers = count < threads ? count : threads;
  std::atomic<std::size_t> next = 0;
  parallel_chunks(workers, 1, [&](std::size_t, std::size_t) {
    const ThreadShare share(threads / workers);
    for (std::size_t i = next++; i < count; i = next++) body(i);
  });
}

/// The same for one thread and different for two that live.
[[nodiscard]] const void* thread_key() noexcept;

/// A value for each thread that asks for its own, made when it first does. Threads are few and ask seldom: their values are a list.
template <class T>
class PerThread {
 public:
  explicit PerThread(std::function<T()> make) : make_(std::move(make)) {}
  PerThread(const PerThread&) = delete;
  PerThread& operator=(const PerThread&) = delete;
  ~PerThread() {
    for (const Node* node = newest_.load(std::memory_order_acquire); node != nullptr;)
      delete std::exchange(node, node->older);
  }

  T& local() {
    const void* const key = thread_key();
    for (Node* node = newest_.load(std::memory_order_acquire); node != nullptr; node = node->older)
      if (node->key == key) return node->value;
    Node* const made = new Node{key, nullptr, make_()};
    made->older = newest_.load(std::memory_order_relaxed);
    while (!newest_.compare_exchange_weak(made->older, made, std::memory_order_acq_rel)) {
    }
    return made->value;
  }

 private:
  struct Node {
    const void* key;
    Node* older;
    T value;
  };

  std::function<T()> make_;
  std::atomic<Node*> newest_ = nullptr;
};

}  // namespace condyle::core::pool
