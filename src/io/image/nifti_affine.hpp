#pragma once

#include "condyle/io/label_file.hpp"
#include "io/image/byte_source.hpp"
#include "io/image/nifti_header.hpp"

namespace condyle::io {

/// The grid by the affine that the options choose among those the header has, in mm, and notes on it.
VoxelGrid nifti_grid(const NiftiHeader& header, const std::array<std::int64_t, 3>& size,
                     const LabelFileOptions& options, const ByteSource& source,
                     std::vector<LabelNote>& notes);

}  // namespace condyle::io
