#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "condyle/io/label_file.hpp"
#include "io/file/number_type.hpp"
#include "io/image/byte_stream.hpp"

namespace condyle::io {

/// How the voxels of an image lie in its data.
///
///   layers = 3, run = 1:   a0 b0 c0 a1 b1 c1 a2 ...     run = 2:   a0 a1 b0 b1 c0 c1 a2 a3 ...
struct VoxelData {
  NumberType type = NumberType::u8;
  std::endian order = std::endian::little;
  std::array<std::int64_t, 3> size{};
  std::uint64_t layers = 1;
  std::uint64_t run = 1;  ///< voxels of one layer that follow each other
  /// A value is slope * stored + intercept, computed only if that changes something.
  double slope = 1, intercept = 0;

  std::uint64_t voxels() const noexcept {  ///< of one layer
    return static_cast<std::uint64_t>(size[0]) * static_cast<std::uint64_t>(size[1]) *
           static_cast<std::uint64_t>(size[2]);
  }
  std::uint64_t bytes() const noexcept { return voxels() * layers * bytes_of(type); }
};

/// Holds that a size is at least 1 along each axis, and that all layers have at most 2^40 voxels. `element` is where the file
/// gives it.
void check_size(const VoxelData& data, const ByteSource& source, std::string_view element);

/// Fills labels and layers of the map, and notes bytes that follow.
void read_voxels(ByteStream& stream, const VoxelData& data, LabelMap& map);

}  // namespace condyle::io
