#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <optional>
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

const TableHead threads_head = {"thread_scaling",
                                "The same work on 1, 2, ... threads: of each the round that took least on "
                                "the wall; the last two columns leave out for how long "
                                "threads were ready and other programs had the processors",
                                {{"what", "what"},
                                 {"threads", "threads"},
                                 {"wall_s", "s on the wall"},
                                 {"processor_s", "s on processors"},
                                 {"work", "work, times that of one thread"},
                                 {"efficiency", "efficiency, t1 / (n tn)"},
                                 {"busy", "busy, of the time left"},
                                 {"own_efficiency", "efficiency in the time left"}}};

constexpr double efficiency_goal = 0.8;

struct ScaledSeconds {
  double wall, processor;
  /// For which threads were ready, all together, while other programs ran; empty if the work was another process.
  std::optional<double> kept_waiting;

  /// The share of the time of n threads, less what others took of it.
  double busy(double n) const { return processor / (n * wall - *kept_waiting); }
};

struct Scaled {
  std::string what;
  std::function<ScaledSeconds(std::size_t threads)> run;
};

/// Sums over all threads of this process, since they began, the second number that Linux reports of each.
double kept_waiting_seconds() {
  double seconds = 0;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    std::ifstream file(task.path() / "schedstat");
    double running_ns = 0, waiting_ns = 0;
    if (file >> running_ns >> waiting_ns) seconds += 1e-9 * waiting_ns;
  }
  return seconds;
}

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
            const double waited = kept_waiting_seconds();
            const Stopwatch watch;
            call();
            const double wall = watch.wall_seconds(), processor = watch.processor_seconds();
            return ScaledSeconds{wall, processor, kept_waiting_seconds() - waited};
          }};
}

/// Rounds, each number of threads once a round, so that whatever slows the machine down slows all of them.
void add_rows(const Scaled& work, int rounds, Report& report) {
  const std::vector<std::size_t> counts = thread_counts();
  std::vector<ScaledSeconds> least(counts.size(), {std::numeric_limits<double>::infinity(), 0, {}});
  work.run(counts.back());
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < counts.size(); ++i)
      if (const ScaledSeconds now = work.run(counts[i]); now.wall < least[i].wall) least[i] = now;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto n = static_cast<double>(counts[i]);
    const double growth = least[i].processor / least[0].processor;
    const double efficiency = least[0].wall / (n * least[i].wall);
    const bool is_known = least[i].kept_waiting.has_value();
    const double own = is_known ? least[i].busy(n) / (least[0].busy(1) * growth) : efficiency;
    const Cell none = std::string("-");
    report.table(threads_head)
        .add({work.what, static_cast<std::int64_t>(counts[i]), least[i].wall, least[i].processor, growth,
              efficiency, is_known ? Cell(least[i].busy(n)) : none, is_known ? Cell(own) : none});
    if (i > 0 && i + 1 == counts.size())
      add_goal(
          {work.what + ": efficiency of all threads", "threads", Bound::at_least, efficiency_goal, "of 1"},
          own, report);
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
              return ScaledSeconds{seconds->wall, seconds->processor, {}};
            }},
           rounds, report);
}

}  // namespace bench
