#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <limits>
#include <stdexcept>
#include <thread>

#include "commands.hpp"
#include "condyle/limit_band.hpp"
#include "condyle/motion_map.hpp"
#include "core/thread_limit.hpp"
#include "goals.hpp"
#include "questions.hpp"
#include "timing.hpp"

namespace bench {
namespace {

const TableHead threads_head = {
    "thread_scaling",
    "The same work on 1, 2, ... threads: of each the round that took least on the wall",
    {{"what", "what"},
     {"threads", "threads"},
     {"wall_s", "s on the wall"},
     {"processor_s", "s on processors"},
     {"efficiency", "efficiency, t1 / (n tn)"},
     {"work", "work, times that of one thread"},
     {"busy", "of each thread's time, busy"}}};

constexpr double efficiency_goal = 0.8;

struct Scaled {
  std::string what;
  std::function<RunSeconds(std::size_t threads)> run;
};

/// 1, 2, 4, ... and all.
std::vector<std::size_t> thread_counts() {
  const std::size_t all = std::max(1U, std::thread::hardware_concurrency());
  std::vector<std::size_t> counts;
  for (std::size_t n = 1; n < all; n *= 2) counts.push_back(n);
  counts.push_back(all);
  return counts;
}

/// Calls it with at most so many threads.
Scaled in_process(std::string what, std::function<void()> call) {
  return {std::move(what), [call = std::move(call)](std::size_t threads) {
            const condyle::core::ThreadLimit limit(threads);
            const Stopwatch watch;
            call();
            return RunSeconds{watch.wall_seconds(), watch.processor_seconds()};
          }};
}

/// Rounds, each number of threads once a round, so that whatever slows the machine down slows all of them.
void add_rows(const Scaled& work, int rounds, Report& report) {
  const std::vector<std::size_t> counts = thread_counts();
  std::vector<RunSeconds> least(counts.size(), {std::numeric_limits<double>::infinity(), 0});
  work.run(counts.back());
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < counts.size(); ++i)
      if (const RunSeconds now = work.run(counts[i]); now.wall < least[i].wall) least[i] = now;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto n = static_cast<double>(counts[i]);
    const double efficiency = least[0].wall / (n * least[i].wall);
    report.table(threads_head)
        .add({work.what, static_cast<std::int64_t>(counts[i]), least[i].wall, least[i].processor, efficiency,
              least[i].processor / least[0].processor, least[i].processor / (n * least[i].wall)});
    if (i > 0 && i + 1 == counts.size())
      add_goal(
          {work.what + ": efficiency of all threads", "threads", Bound::at_least, efficiency_goal, "of 1"},
          efficiency, report);
  }
}

}  // namespace

void ask_threads(const Scene& scene, Effort effort, Report& report) {
  using condyle::JointAngle;
  const bool is_full = effort == Effort::full;
  const int rounds = is_full ? 3 : 1;
  const double step = is_full ? 7 : 70;
  const condyle::Joint& joint = scene.joint;
  const condyle::motion::RangeOfMotion range(
      joint, {.bearing = {.rule = condyle::motion::BearingRule::count},
              .overlap = {.reference_contact = condyle::motion::ReferenceContact::accept}});
  const condyle::motion::MapGrid grid{.row = {JointAngle::adduction, -40, 30, step},
                                      .column = {JointAngle::flexion, -20, 120, step},
                                      .vary = JointAngle::internal_rotation};
  add_rows(in_process(fmt::format("map of {} points", grid.size()), [&] { (void)motion_map(grid, range); }),
           rounds, report);

  const auto motions = condyle::motion::hip_motions();
  const condyle::motion::BandOptions options{.samples = is_full ? 100u : 20u};
  add_rows(in_process(fmt::format("bands of {} samples", options.samples),
                      [&] { (void)limit_bands(joint, motions, {}, options); }),
           rounds, report);

  const TemporaryFolder folder;
  const int hips = is_full ? 16 : 2;
  std::ofstream table(folder.file("table.csv"));
  table << "id,joint\n";
  for (int i = 0; i < hips; ++i) {
    const std::string hip = fmt::format("hip{}", i);
    if (!run_command(
            {"sample", "hip", "--neck-shaft-angle", fmt::format("{}", 120 + i), "--out", folder.file(hip)}))
      throw std::runtime_error("condyle sample hip: no answer");
    table << fmt::format("{},{}/hip.toml\n", i, hip);
  }
  table.close();
  int run = 0;
  add_rows({fmt::format("study of {} sample hips, the whole command", hips),
            [&](std::size_t threads) {
              const auto seconds =
                  run_command({"--threads", fmt::format("{}", threads), "study", folder.file("table.csv"),
                               "--out", folder.file(fmt::format("out{}", run++))});
              if (!seconds) throw std::runtime_error("condyle study: no answer");
              return *seconds;
            }},
           rounds, report);
}

}  // namespace bench
