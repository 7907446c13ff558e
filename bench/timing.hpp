#pragma once

#include <chrono>
#include <functional>
#include <vector>

/// How long things take, on machines that others use too.

namespace bench {

/// Seconds that the threads of this process spent computing: where other programs take the processor away,
/// the clock on the wall goes on and this one stands still.
double processor_seconds();

/// Both clocks, since its construction.
class Stopwatch {
 public:
  Stopwatch();
  double wall_seconds() const;
  double processor_seconds() const;

 private:
  double processor_start_;
  std::chrono::steady_clock::time_point wall_start_;  ///< Taken last: the other clock is slow to read.
};

/// Seconds on the wall that this takes: for what is so short that asking the system for the processor's time,
/// before, would be felt in it.
template <class Do>
double wall_seconds_of(const Do& what) {
  const auto start = std::chrono::steady_clock::now();
  what();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Seconds that this takes. Short ones by the clock on the wall, which is read in a few nanoseconds; from a
/// millisecond on, where others are likely to take the processor away meanwhile, by the processor's.
template <class Do>
double seconds_of(const Do& what) {
  constexpr double short_seconds = 1e-3;
  const Stopwatch watch;
  what();
  const double wall = watch.wall_seconds();
  return wall < short_seconds ? wall : watch.processor_seconds();
}

/// Goes through more memory than the caches hold, so that what is asked next comes from memory.
void empty_caches();

/// The same as often as takes some milliseconds, so that the clock is fine enough and caches are as warm as
/// they are for what takes that long by itself.
struct Repeated {
  std::function<void()> once;
  int times;

  explicit Repeated(std::function<void()> what);
  void operator()() const {
    for (int i = 0; i < times; ++i) once();
  }
};

/// Median of the seconds that something takes which finds nothing in the caches.
double cold_seconds(int rounds, const std::function<void()>& what);

/// Middle one of the samples, the mean of both where there are two; the samples must not be none.
double median(std::vector<double> samples);

/// Processor time in seconds of each of several ways to do something: `rounds` rounds, each way once a round,
/// so that whatever slows the machine down for a while slows all of them. A round before the first one warms
/// up and does not count. Returns the samples of each way.
std::vector<std::vector<double>> interleaved(int rounds, const std::vector<std::function<void()>>& ways);

}  // namespace bench
