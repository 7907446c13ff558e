#include "io/image/unread_image.hpp"

#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>

#include "condyle/error.hpp"
#include "io/image/byte_source.hpp"
#include "io/mesh/parse.hpp"

namespace condyle::io {
namespace {

/// A preamble of 128 bytes, then the mark.
bool has_mark_of_dicom(const std::filesystem::path& path) {
  if (entry_at(path) != EntryKind::file) return false;
  std::array<char, 132> start{};
  return ByteSource(path).read(0, start) == start.size() && std::string_view(start.data() + 128, 4) == "DICM";
}

}  // namespace

void refuse_unread_image(const std::filesystem::path& path) {
  const auto refuse = [&](std::string_view why) {
    throw FileError(fmt::format("{}: {}", path.string(), why));
  };
  const std::string name = io::lower_case(path.filename().string());
  if (name.ends_with(".mgz") || name.ends_with(".mgh"))
    refuse(
        "FreeSurfer's images are not read: its mri_convert makes .nii.gz of a label map, which condyle init "
        "and condyle surface read");
  if (name.ends_with(".dcm") || name.ends_with(".dicom") || has_mark_of_dicom(path))
    refuse(
        "DICOM is not read: open it in 3D Slicer, segment the bones and save the segmentation as .seg.nrrd, "
        "which condyle init and condyle surface read; dcm2niix makes .nii.gz of label images");
}

}  // namespace condyle::io
