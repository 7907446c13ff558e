#include "resumable_map.hpp"

#include <fmt/format.h>

#include <stop_token>
#include <string>
#include <system_error>

#include "answer.hpp"
#include "condyle/io/map_checkpoint.hpp"
#include "interrupt.hpp"
#include "progress.hpp"

namespace condyle::cli {

namespace fs = std::filesystem;

fs::path checkpoint_in(const fs::path& folder) {
  return folder.empty() ? fs::path() : folder / "map.checkpoint";
}

MotionMap resumable_map(const MapGrid& grid, const MapSubject& subject, const fs::path& checkpoint) {
  MotionMap map(grid);
  const MapKey key = map_key(subject.joint, subject.options, grid);
  if (!checkpoint.empty() && read_checkpoint(checkpoint, key, map) == Resumed::other_question)
    note(checkpoint.string() + ": is of another joint, mesh, grid or option; the map starts anew");

  const InterruptWatch watch;
  std::stop_source stop;
  {
    Progress progress("map points", map.done());
    fill(map, subject.range,
         {.progress =
              [&](std::size_t done, std::size_t total) {
                progress.update(done, total);
                if (watch.interrupted()) stop.request_stop();
              },
          .stop = stop.get_token()});
  }
  if (map.complete()) return map;
  const std::string done =
      fmt::format("interrupted, {} of {} map points done", map.done(), map.points.size());
  if (checkpoint.empty()) throw Interrupted(done + "; nothing is kept without --out");
  std::error_code why_not_is_told_when_writing;
  fs::create_directories(checkpoint.parent_path(), why_not_is_told_when_writing);
  write_checkpoint(checkpoint, map, key);
  throw Interrupted(
      fmt::format("{} and kept in {}; the same command goes on from there", done, checkpoint.string()));
}

void remove_checkpoint(const fs::path& checkpoint) {
  std::error_code error;
  fs::remove(checkpoint, error);
  if (error) note(fmt::format("{}: cannot be removed: {}", checkpoint.string(), error.message()));
}

}  // namespace condyle::cli
