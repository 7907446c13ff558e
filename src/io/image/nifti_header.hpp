#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "io/image/byte_stream.hpp"

namespace condyle::io {

/// Both versions of NIfTI's header, as wide as the second has its fields. https://nifti.nimh.nih.gov
struct NiftiHeader {
  int version = 1;
  bool is_detached = false;  ///< data in a file of their own
  std::endian order = std::endian::little;
  std::array<std::int64_t, 8> dim{};
  int datatype = 0, bits_per_voxel = 0;
  std::array<double, 8> pixdim{};
  std::int64_t data_offset = 0;  ///< vox_offset, in the file of the data
  double slope = 0, intercept = 0;
  int units = 0;
  std::int64_t qform_code = 0, sform_code = 0;
  std::array<double, 3> quaternion{}, qoffset{};
  std::array<std::array<double, 4>, 3> srow{};

  std::uint64_t size() const noexcept { return version == 1 ? 348 : 540; }
};

/// The header at the start of a stream, which it takes from that. Raises FileError for one that is none of NIfTI.
NiftiHeader read_nifti_header(ByteStream& stream);

}  // namespace condyle::io
