#include "timing.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <ctime>
#include <utility>

namespace bench {

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Stopwatch::Stopwatch()
    : processor_start_(bench::processor_seconds()), wall_start_(std::chrono::steady_clock::now()) {}

double Stopwatch::wall_seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_start_).count();
}

double Stopwatch::processor_seconds() const {
  return bench::processor_seconds() - processor_start_;
}

void empty_caches() {
  constexpr std::size_t bytes = std::size_t{1} << 27;  // 128 MiB: more than the last level of caches in use
  static std::vector<unsigned char> memory(bytes);
  constexpr std::size_t cache_line = 64;
  for (std::size_t i = 0; i < bytes; i += cache_line) ++memory[i];
}

Repeated::Repeated(std::function<void()> what) : once(std::move(what)) {
  constexpr double some_seconds = 5e-3;
  once();
  times = std::max(1, static_cast<int>(std::ceil(some_seconds / seconds_of(once))));
}

double cold_seconds(int rounds, const std::function<void()>& what) {
  std::vector<double> seconds;
  for (int i = 0; i < rounds; ++i) {
    empty_caches();
    seconds.push_back(seconds_of(what));
  }
  return median(std::move(seconds));
}

double median(std::vector<double> samples) {
  assert(!samples.empty());
  std::sort(samples.begin(), samples.end());
  const std::size_t half = samples.size() / 2;
  return samples.size() % 2 == 1 ? samples[half] : (samples[half - 1] + samples[half]) / 2;
}

std::vector<std::vector<double>> interleaved(int rounds, const std::vector<std::function<void()>>& ways) {
  for (const auto& way : ways) way();
  std::vector<std::vector<double>> samples(ways.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < ways.size(); ++i) {
      const Stopwatch watch;
      ways[i]();
      samples[i].push_back(watch.processor_seconds());
    }
  }
  return samples;
}

}  // namespace bench
