#include <tbb/task_arena.h>

#include <algorithm>

#include "condyle/limit_band.hpp"
#include "goals.hpp"
#include "questions.hpp"
#include "timing.hpp"

namespace bench {
namespace {

const TableHead band_head = {
    "limit_bands",
    "Bands: all motions of the hip at displaced centres, turned axes and moved surfaces; all threads",
    {{"scene", "scene"},
     {"samples", "samples"},
     {"motions", "motions"},
     {"threads", "threads"},
     {"wall_s", "s on the wall"},
     {"processor_s", "s on processors"},
     {"widest_deg", "widest band, °"}}};

}  // namespace

void ask_limit_bands(const Scene& scene, Effort effort, Report& report) {
  const condyle::Joint& joint = scene.joint;
  const auto motions = condyle::motion::hip_motions();
  const condyle::motion::BandOptions options{.samples = effort == Effort::full ? 200u : 20u};
  const Stopwatch watch;
  const auto bands = limit_bands(joint, motions, {}, options);
  const double wall = watch.wall_seconds(), processor = watch.processor_seconds();

  double widest = 0;
  for (const condyle::motion::LimitBand& band : bands)
    widest = std::max(widest, (band.p95 - band.p5).degrees());
  report.table(band_head).add(
      {joint.name, static_cast<std::int64_t>(options.samples), static_cast<std::int64_t>(motions.size()),
       std::int64_t{tbb::this_task_arena::max_concurrency()}, wall, processor, widest});
  if (effort == Effort::full)
    add_goal(
        {"bands, 200 samples of 12 limits, all threads", joint.name, Bound::at_most, 10, "s on the wall"},
        wall, report);
}

}  // namespace bench
