#pragma once

#include <filesystem>
#include <string_view>

#include "condyle/io/label_file.hpp"
#include "io/image/byte_source.hpp"

namespace condyle::io {

/// Input of a reader of label maps: the file with the header, and the place of its neighbours.
struct LabelInput {
  const ByteSource& header;
  std::filesystem::path path = {};  ///< of the header; empty if it comes from memory
  const LabelFileOptions& options;

  /// Opens the file that the header names for its data, relative to the header's folder. Raises FileError if that is outside
  /// the folder and the options do not allow it. `key` is where the header names it.
  ByteSource open_data(std::string_view key, const std::filesystem::path& named) const;
};

// One reader per format; each raises FileError only.
LabelMap read_nifti(const LabelInput& input);
LabelMap read_nrrd(const LabelInput& input);
LabelMap read_metaimage(const LabelInput& input);

}  // namespace condyle::io
