#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/file/input_recorder.hpp"
#include "io/sweep/sweep_result.hpp"

/// The folder of a sweep, its shares, and what was done before. docs/sweeps.md.

namespace condyle::io {

/// Where the results of a share lie: "DIR/shards/3_of_7"; DIR itself if there is one only.
std::filesystem::path sweep_folder(const std::filesystem::path& folder, const SweepShare& share);

/// FileError if the folder is not to be written to.
void check_sweep_folder(const std::filesystem::path& folder, const Provenance* from);

/// Everything that a share's answer depends on; nothing in a program that makes its query itself.
struct SweepKey {
  std::string family;         ///< SHA-256 of options and inputs, the same for all shares
  std::vector<Input> inputs;  ///< what was read, in the order of the paths
};
SweepKey sweep_key(std::string_view options, std::vector<Input> inputs);

/// Digest of the version and of the command's words without its share; in the place of a file's name is what it had in it.
std::string sweep_options(std::span<const std::string> command, std::span<const Input> inputs);
/// What was read, in the order of the paths: designs are answered in any order.
std::vector<Input> sweep_inputs(const InputRecorder& read);

/// The share that was written with these options, if its files are whole and what it read is as it was.
std::optional<SweepResult> sweep_there(const std::filesystem::path& folder, std::string_view options,
                                       const SweepShare& share = {});

/// Writes sweep.json, designs.csv and safe.csv, and zone.vtp of two parameters or three. FileError.
std::vector<std::filesystem::path> write_sweep(const std::filesystem::path& folder, const SweepResult& result,
                                               const SweepKey& key, const Provenance* from);

/// Whether the folder has shards of a sweep.
bool has_sweep_shards(const std::filesystem::path& folder);

/// Puts the shards in the folder together and writes the whole: the bytes of a sweep that was not shared. FileError for a shard that is missing, not whole, of
/// another sweep, of another shard than its folder says, or of inputs that are others now.
struct MergedSweep {
  SweepResult result;
  std::vector<std::filesystem::path> written;
};
MergedSweep merge_sweep(const std::filesystem::path& folder);

}  // namespace condyle::io
