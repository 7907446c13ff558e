#include "core/parallel.hpp"

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "core/parallel_tasks.hpp"
#include "core/per_thread.hpp"
#include "core/thread_limit.hpp"
#include "core/thread_pool.hpp"
#include "support/test.hpp"

namespace condyle::core {
namespace {

/// What this build's loops run on.
struct AsBuilt {
  using Limit = ThreadLimit;
  template <class T>
  using PerThread = core::PerThread<T>;
  static std::size_t allowed() { return threads_allowed(); }
  template <class... Arguments>
  static void chunks(const Arguments&... arguments) {
    parallel_chunks(arguments...);
  }
  template <class... Arguments>
  static void pair(const Arguments&... arguments) {
    parallel_pair(arguments...);
  }
  template <class... Arguments>
  static void tasks(const Arguments&... arguments) {
    parallel_tasks(arguments...);
  }
};

/// Our own pool, whatever the build has.
struct OwnPool {
  using Limit = pool::ThreadLimit;
  template <class T>
  using PerThread = pool::PerThread<T>;
  static std::size_t allowed() { return pool::threads_allowed(); }
  template <class... Arguments>
  static void chunks(const Arguments&... arguments) {
    pool::parallel_chunks(arguments...);
  }
  template <class... Arguments>
  static void pair(const Arguments&... arguments) {
    pool::parallel_pair(arguments...);
  }
  template <class... Arguments>
  static void tasks(const Arguments&... arguments) {
    pool::parallel_tasks(arguments...);
  }
};

template <class Threads>
class Parallel : public testing::Test {};
using Both = testing::Types<AsBuilt, OwnPool>;
TYPED_TEST_SUITE(Parallel, Both);

/// The most that were inside at a time.
class Crowd {
 public:
  class Visit {
   public:
    explicit Visit(Crowd& crowd) : crowd_(crowd) {
      const int now = ++crowd_.inside_;
      for (int most = crowd_.most_; now > most && !crowd_.most_.compare_exchange_weak(most, now);) {
      }
    }
    ~Visit() { --crowd_.inside_; }

   private:
    Crowd& crowd_;
  };
  int most() const { return most_; }

 private:
  std::atomic<int> inside_ = 0, most_ = 0;
};

void pause() {
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

constexpr auto long_enough = std::chrono::seconds(20);

TYPED_TEST(Parallel, ALoopVisitsEveryElementOnce) {
  for (const std::size_t threads : {1u, 2u, 3u, 8u}) {
    const typename TypeParam::Limit limit(threads);
    for (const std::size_t count : {0u, 1u, 6u, 7u, 8u, 15u, 1000u})
      for (const std::size_t grain : {1u, 7u, 2000u}) {
        std::vector<std::atomic<int>> visits(count);
        TypeParam::chunks(count, grain, [&](std::size_t first, std::size_t last) {
          ASSERT_LT(first, last);
          ASSERT_LE(last, count);
          for (std::size_t i = first; i < last; ++i) ++visits[i];
        });
        for (const auto& of_one : visits) EXPECT_EQ(of_one, 1) << count << " by " << grain;
      }
  }
}

TYPED_TEST(Parallel, LoopsInLoopsInLoopsEndOnMoreThreadsThanProcessors) {
  const typename TypeParam::Limit limit(8);
  std::atomic<std::size_t> sum = 0;
  for (int again = 0; again < 20; ++again) {
    sum = 0;
    TypeParam::chunks(std::size_t{12}, 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        TypeParam::chunks(i, 1, [&](std::size_t first_inner, std::size_t last_inner) {
          for (std::size_t j = first_inner; j < last_inner; ++j)
            TypeParam::chunks(j, 1, [&](std::size_t a, std::size_t b) { sum += b - a; });
        });
    });
    // The sum of j below i below 12.
    ASSERT_EQ(sum, 220u);
  }
}

TYPED_TEST(Parallel, AnExceptionOfAnyChunkReachesTheCallerAndTheNextLoopRuns) {
  for (const std::size_t threads : {1u, 2u, 8u}) {
    const typename TypeParam::Limit limit(threads);
    for (const std::size_t bad : {0u, 1u, 50u, 99u}) {
      const auto run = [&] {
        TypeParam::chunks(std::size_t{100}, 1, [&](std::size_t first, std::size_t last) {
          for (std::size_t i = first; i < last; ++i)
            TypeParam::chunks(std::size_t{3}, 1, [&](std::size_t a, std::size_t b) {
              if (i == bad && a <= 1 && 1 < b) throw std::runtime_error("at " + std::to_string(i));
            });
        });
      };
      try {
        run();
        FAIL() << "nothing thrown";
      } catch (const std::runtime_error& error) {
        EXPECT_EQ(error.what(), "at " + std::to_string(bad));
      }
      std::atomic<int> visits = 0;
      TypeParam::chunks(std::size_t{100}, 1,
                        [&](std::size_t a, std::size_t b) { visits += static_cast<int>(b - a); });
      EXPECT_EQ(visits, 100);
    }
  }
}

TYPED_TEST(Parallel, AfterAnExceptionNoChunkBegins) {
  const typename TypeParam::Limit limit(2);
  std::atomic<std::size_t> begun = 0;
  EXPECT_THROW(TypeParam::chunks(std::size_t{100'000}, 1,
                                 [&](std::size_t, std::size_t) {
                                   ++begun;
                                   throw std::runtime_error("at once");
                                 }),
               std::runtime_error);
  // What the other thread has begun before it could know, once or, where a loop is divided as oneTBB does it, a few times.
  EXPECT_LE(begun, 8u);
}

TYPED_TEST(Parallel, NoMoreThreadsThanAllowedWorkAtATime) {
  for (const std::size_t threads : {1u, 2u, 3u}) {
    const typename TypeParam::Limit limit(threads);
    Crowd crowd;
    TypeParam::chunks(std::size_t{6}, 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        TypeParam::chunks(std::size_t{6}, 1, [&](std::size_t, std::size_t) {
          const Crowd::Visit visit(crowd);
          pause();
        });
    });
    EXPECT_LE(crowd.most(), static_cast<int>(threads));
  }
}

TYPED_TEST(Parallel, OfSeveralLimitsTheLeastOneHoldsAndNoneOutlivesItsScope) {
  const std::size_t before = TypeParam::allowed();
  {
    const typename TypeParam::Limit one(1);
    EXPECT_EQ(TypeParam::allowed(), 1u);
    {
      const typename TypeParam::Limit many(8);
      EXPECT_EQ(TypeParam::allowed(), 1u);
    }
    EXPECT_EQ(TypeParam::allowed(), 1u);
  }
  EXPECT_EQ(TypeParam::allowed(), before);
}

TYPED_TEST(Parallel, TasksBeginInOrderEachWithItsShareOfTheThreads) {
  struct Case {
    std::size_t threads, tasks, share;
  };
  for (const auto& [threads, tasks, share] : {Case{1, 5, 1}, Case{2, 5, 1}, Case{4, 2, 2}, Case{4, 3, 1}}) {
    const typename TypeParam::Limit limit(threads);
    Crowd all;
    std::vector<Crowd> of_task(tasks);
    std::atomic<std::size_t> done = 0, next = 0;
    TypeParam::tasks(tasks, [&, share = share, threads = threads](std::size_t i) {
      // No task is more than the other threads' ones ahead of those that have begun.
      EXPECT_LT(i, next++ + threads);
      TypeParam::chunks(std::size_t{8}, 1, [&](std::size_t, std::size_t) {
        const Crowd::Visit visit(all), own(of_task[i]);
        pause();
      });
      EXPECT_LE(of_task[i].most(), static_cast<int>(share));
      ++done;
    });
    EXPECT_EQ(done, tasks);
    EXPECT_LE(all.most(), static_cast<int>(threads));
  }
}

TYPED_TEST(Parallel, OfAPairBothAreCalledAndTheFirstExceptionIsThrown) {
  for (const std::size_t threads : {1u, 2u}) {
    const typename TypeParam::Limit limit(threads);
    for (const bool first_fails : {false, true})
      for (const bool second_fails : {false, true}) {
        int first = 0, second = 0;
        std::string thrown;
        try {
          TypeParam::pair(
              [&] {
                ++first;
                if (first_fails) throw std::runtime_error("first");
              },
              [&] {
                ++second;
                if (second_fails) throw std::runtime_error("second");
              });
        } catch (const std::runtime_error& error) {
          thrown = error.what();
        }
        EXPECT_EQ(first, 1);
        EXPECT_EQ(second, 1);
        EXPECT_EQ(thrown, first_fails ? "first" : second_fails ? "second" : "");
      }
  }
}

TYPED_TEST(Parallel, EachThreadHasAValueOfItsOwnThatEndsWithItsOwner) {
  const typename TypeParam::Limit limit(8);
  const auto held = std::make_shared<int>(0);
  struct Value {
    std::shared_ptr<int> held;
    std::thread::id maker = std::this_thread::get_id();
    Crowd crowd;
    explicit Value(std::shared_ptr<int> given) : held(std::move(given)) {}
    Value(Value&& other) noexcept : held(std::move(other.held)), maker(other.maker) {}
  };
  {
    typename TypeParam::template PerThread<Value> values([&] { return Value(held); });
    typename TypeParam::template PerThread<int> others([] { return 7; });
    TypeParam::chunks(std::size_t{64}, 1, [&](std::size_t, std::size_t) {
      Value& own = values.local();
      const Crowd::Visit visit(own.crowd);
      EXPECT_EQ(own.maker, std::this_thread::get_id());
      EXPECT_EQ(&own, &values.local());
      EXPECT_EQ(own.crowd.most(), 1);
      EXPECT_EQ(others.local(), 7);
      std::this_thread::yield();
    });
    EXPECT_GT(held.use_count(), 1);
    EXPECT_LE(held.use_count(), 1 + 8);
  }
  EXPECT_EQ(held.use_count(), 1);
}

TYPED_TEST(Parallel, ManyThreadsOfACallerRunLoopsAtATime) {
  std::vector<std::size_t> sums(6);
  {
    std::vector<std::jthread> callers;
    for (std::size_t& sum : sums)
      callers.emplace_back([&sum] {
        for (int again = 0; again < 200; ++again) {
          std::atomic<std::size_t> own = 0;
          TypeParam::chunks(std::size_t{50}, 1, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) own += i;
          });
          sum += own;
        }
      });
  }
  EXPECT_EQ(sums, std::vector<std::size_t>(6, 200 * 49 * 50 / 2));
}

TEST(ThreadPool, ChunksAreAtLeastTheGrainButForTheLast) {
  const pool::ThreadLimit limit(3);
  std::mutex mutex;
  std::vector<std::pair<std::size_t, std::size_t>> chunks;
  pool::parallel_chunks(1000, 7, [&](std::size_t first, std::size_t last) {
    const std::lock_guard lock(mutex);
    chunks.emplace_back(first, last);
  });
  std::sort(chunks.begin(), chunks.end());
  EXPECT_GT(chunks.size(), 3u);
  EXPECT_EQ(chunks.front().first, 0u);
  EXPECT_EQ(chunks.back().second, 1000u);
  for (std::size_t i = 0; i + 1 < chunks.size(); ++i) {
    EXPECT_EQ(chunks[i].second, chunks[i + 1].first);
    EXPECT_GE(chunks[i].second - chunks[i].first, 7u);
  }
}

TEST(ThreadPool, OfSeveralExceptionsTheFirstElementsIsThrown) {
  for (const std::size_t threads : {1u, 2u, 8u}) {
    const pool::ThreadLimit limit(threads);
    for (int again = 0; again < 10; ++again) {
      const bool is_thrown_last = again % 2 == 0;
      std::atomic<bool> later_begun = threads == 1;
      try {
        pool::parallel_chunks(200, 1, [&](std::size_t first, std::size_t last) {
          for (std::size_t i = first; i < last; ++i) {
            if (i < 40) continue;
            if (i > 40) later_begun = true;
            for (int tries = 0; i == 40 && !later_begun && tries < 100; ++tries) pause();
            if ((i == 40) == is_thrown_last)
              for (int waits = 0; waits < 5; ++waits) pause();
            throw i;
          }
        });
        FAIL();
      } catch (std::size_t i) {
        EXPECT_EQ(i, 40u);
      }
    }
  }
}

TEST(ThreadPool, ACallerThatWaitsForItsLoopBeginsNothingOfAnotherOne) {
  const pool::ThreadLimit limit(16);
  std::promise<void> other_begun, other_done;
  const auto begun = other_begun.get_future().share();
  const auto done = other_done.get_future().share();
  std::atomic<std::thread::id> waiting;
  std::promise<void> both_begun;
  std::atomic<int> chunks_begun = 0;
  const std::jthread caller([&] {
    waiting = std::this_thread::get_id();
    pool::parallel_chunks(2, 1, [&](std::size_t, std::size_t) {
      if (++chunks_begun == 2) both_begun.set_value();
      // The caller leaves its chunk while the other loop has many left; the other thread stays to its end.
      const bool is_caller = std::this_thread::get_id() == waiting.load();
      EXPECT_EQ((is_caller ? begun : done).wait_for(long_enough), std::future_status::ready);
    });
  });
  ASSERT_EQ(both_begun.get_future().wait_for(long_enough), std::future_status::ready);
  std::atomic<bool> is_first = true;
  pool::parallel_chunks(400, 1, [&](std::size_t first, std::size_t last) {
    EXPECT_NE(std::this_thread::get_id(), waiting.load());
    if (is_first.exchange(false)) other_begun.set_value();
    for (std::size_t i = first; i < last; ++i) pause();
  });
  other_done.set_value();
}

TEST(ThreadPool, ACallerThatWaitsWorksAtLoopsOfItsChunks) {
  const pool::ThreadLimit limit(2);
  std::promise<void> second_begun, inner_met;
  const auto begun = second_begun.get_future().share();
  const auto met = inner_met.get_future().share();
  pool::parallel_chunks(2, 1, [&](std::size_t first, std::size_t) {
    if (first == 0) {
      // The thread of this chunk is done early and has to be the other one of the inner loop.
      ASSERT_EQ(begun.wait_for(long_enough), std::future_status::ready);
      return;
    }
    second_begun.set_value();
    pool::parallel_chunks(2, 1, [&](std::size_t inner, std::size_t) {
      if (inner == 0)
        EXPECT_EQ(met.wait_for(long_enough), std::future_status::ready);
      else
        inner_met.set_value();
    });
  });
}

TEST(ThreadPool, LoopsOfATaskUseNoMoreThanItsShare) {
  const pool::ThreadLimit limit(6);
  pool::parallel_tasks(2, [](std::size_t) { EXPECT_EQ(pool::threads_allowed(), 3u); });
  pool::parallel_tasks(6, [](std::size_t) { EXPECT_EQ(pool::threads_allowed(), 1u); });
  EXPECT_EQ(pool::threads_allowed(), 6u);
}

}  // namespace
}  // namespace condyle::core
