#pragma once

#include <cstdint>
#include <filesystem>

#include "condyle/joint.hpp"
#include "condyle/motion_map.hpp"

/// A map that was interrupted, kept in a file so that the same question goes on where it stopped. Every point
/// is kept to the last bit: a map finished later has the bytes of one made in one go.

namespace condyle {

/// Tells one question from another: a hash of the joint's meshes as placed, its side and kind, the grid, and
/// all options. Names and file paths are not part of it. 64 bits of FNV-1a: made for telling apart what
/// people change, not against those who look for two questions with one key.
using MapKey = std::uint64_t;
MapKey map_key(const Joint& joint, const RangeOptions& options, const MapGrid& grid);

/// Writes the points that are known. The file appears whole or not at all. Throws FileError.
void write_checkpoint(const std::filesystem::path& path, const MotionMap& map, MapKey key);

enum class Resumed {
  nothing,         ///< there is no such file
  other_question,  ///< it is of another joint, mesh, grid or option; the map is as it was
  points,          ///< the map has the points of the file
};

/// Puts the points of the file into a map without points. Throws FileError where the file is not whole.
Resumed read_checkpoint(const std::filesystem::path& path, MapKey key, MotionMap& map);

}  // namespace condyle
