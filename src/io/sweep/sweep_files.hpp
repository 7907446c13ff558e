#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/sweep/sweep_result.hpp"

/// The folder of a sweep, its shares, and what was done before. docs/sweeps.md.

namespace condyle::io {

/// Where the results of a share lie: "DIR/shards/3_of_7"; DIR itself if there is one only.
std::filesystem::path sweep_folder(const std::filesystem::path& folder, const SweepShare& share);

/// FileError if the folder is not to be written to.
void check_sweep_folder(const std::filesystem::path& folder, const Provenance* from);

/// Key of everything that a share's answer depends on: version, joint, targets and options; `quantities` says what the query's are.
std::string sweep_key(const Provenance& from, const SweepQuery& query, std::string_view targets,
                      std::string_view quantities);

/// The sweep that was written with this key, if its files are whole.
std::optional<SweepResult> sweep_there(const std::filesystem::path& folder, std::string_view key);

/// Writes sweep.json, designs.csv and safe.csv, and zone.vtp of two parameters or three. FileError.
std::vector<std::filesystem::path> write_sweep(const std::filesystem::path& folder, const SweepResult& result,
                                               std::string_view key, const Provenance* from);

/// Whether the folder has shards of a sweep.
bool has_sweep_shards(const std::filesystem::path& folder);

/// Puts the shards in the folder together and writes the whole: the bytes of a sweep that was not shared. FileError for a shard that is missing, not whole, or of another sweep.
struct MergedSweep {
  SweepResult result;
  std::vector<std::filesystem::path> written;
};
MergedSweep merge_sweep(const std::filesystem::path& folder);

}  // namespace condyle::io
