#pragma once

#include <filesystem>

namespace condyle::io {

/// Raises FileError that says what converts it for an image that no reader of Condyle reads: FreeSurfer's .mgh and .mgz by their names,
/// DICOM by its name or, if the file is there, by its mark.
void refuse_unread_image(const std::filesystem::path& path);

}  // namespace condyle::io
