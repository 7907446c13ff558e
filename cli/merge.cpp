#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <optional>
#include <string>

#include "answer.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "condyle/error.hpp"
#include "condyle/io/study.hpp"
#include "io/sweep/sweep_files.hpp"
#include "notes.hpp"

namespace condyle::cli {
namespace {

void merge_shares(const std::string& folder) {
  const io::MergedSweep merged = io::merge_sweep(folder);
  note_all(merged.result.answer.notes);
  say_written(merged.written);
  print(io::sweep_text(merged.result));
}

}  // namespace

void add_merge(CLI::App& app) {
  auto* command = app.add_subcommand("merge", "Put the shards of a study or of a sweep together");
  command->footer(
      "Example: condyle sample cohort --n 4 --out cohort\n"
      "         condyle study cohort/cohort.csv --out study --shard 1/2\n"
      "         condyle study cohort/cohort.csv --out study --shard 2/2\n"
      "         condyle merge study\n"
      "The tables are those of a run of the whole table, byte for byte.\n"
      "Exit code 3: a shard is missing or not whole, or is of another table, other options or another "
      "version. If no joint was answered: that of the first failure.");
  auto folder = std::make_shared<std::string>();
  command->add_option("DIR", *folder, "The folder that condyle study --shard or sweep --shard had as --out")
      ->required();
  auto crate_date = std::make_shared<std::optional<std::string>>();
  add_crate(*command, *crate_date);
  command->callback([folder, crate_date] {
    if (io::has_sweep_shards(*folder)) {
      if (*crate_date) throw UsageError("--crate: is of a study, and this is a sweep");
      return merge_shares(*folder);
    }
    const io::StudyDone done = io::merge_study(*folder, *crate_date);
    for (const io::NotedJoint& joint : done.noted) note(joint.id + ": " + joint.codes);
    say_written(done.written);
    print(fmt::format("{} answered, {} failed\n", done.joints, done.failures));
    io::require_answered(done, *folder);
  });
}

}  // namespace condyle::cli
