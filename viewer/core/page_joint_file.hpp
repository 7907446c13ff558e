#pragma once

#include <cstdint>

/// Joint files that were dropped on the page with their meshes, read by the command line's own reader: a module reads one drop. Its files are
/// known by their paths in the drop, "sample/hip.toml" in a folder and "hip.toml" without one.

extern "C" {

/// There is a file of this path.
int condyle_drop_file(const char* path);
/// Its bytes.
int condyle_fill_file(const char* path, const std::uint8_t* bytes, int count);

/// Reads the joint file: a JSON list of the paths whose bytes its meshes need. A mesh is the file where the joint file has it, else the only
/// one of its name. Null for a bad file, with the command line's own line in condyle_error().
const char* condyle_joint_meshes(const char* path, const std::uint8_t* bytes, int count);

/// The block of the joint, as the report of `condyle report JOINT` has it (docs/report-data.md) but for the poses that are stored for pages
/// without a core, and how many bytes it has. Null as above; a joint that has no limits has its reason in the block.
const std::uint8_t* condyle_joint_block();
int condyle_joint_block_bytes();
}
