#include <fmt/format.h>

#include <string>

#include "condyle/error.hpp"
#include "condyle/io/label_file.hpp"
#include "io/file/whole_file.hpp"
#include "io/image/label_input.hpp"
#include "io/image/unread_image.hpp"
#include "io/mesh/parse.hpp"

namespace condyle::io {
namespace {

LabelMap read(const LabelInput& input, LabelFormat format) {
  if (input.header.size() == 0) input.header.fail("the file is empty");
  switch (format) {
    case LabelFormat::nifti:
      return io::read_nifti(input);
    case LabelFormat::nrrd:
      return io::read_nrrd(input);
    case LabelFormat::metaimage:
      break;
  }
  return io::read_metaimage(input);
}

/// NIfTI in two files has its header in .hdr, whichever of both was named.
std::filesystem::path header_of(std::filesystem::path path) {
  const auto extension = path.extension().string();
  if (io::lower_case(extension) == ".img") path.replace_extension(extension == ".IMG" ? ".HDR" : ".hdr");
  return path;
}

}  // namespace

std::optional<LabelFormat> label_format_of(const std::filesystem::path& path) {
  const std::string name = io::lower_case(path.filename().string());
  const auto ends_in = [&](auto... endings) { return (name.ends_with(endings) || ...); };
  if (ends_in(".nii", ".nii.gz", ".hdr", ".img")) return LabelFormat::nifti;
  if (ends_in(".nrrd", ".nhdr")) return LabelFormat::nrrd;
  if (ends_in(".mha", ".mhd")) return LabelFormat::metaimage;
  return std::nullopt;
}

LabelMap read_labels(const std::filesystem::path& path, const LabelFileOptions& options) {
  io::check_is_file(path);
  const auto format = label_format_of(path);
  if (!format) io::refuse_unread_image(path);
  if (!format)
    throw FileError(fmt::format(
        "{}: unknown extension '{}': label maps in .nii, .nii.gz, .hdr, .nrrd, .nhdr, .mha and .mhd are read",
        path.string(), path.extension().string()));
  const auto header = header_of(path);
  const ByteSource source(header);
  return read({source, header, options}, *format);
}

LabelMap read_labels(std::string_view bytes, LabelFormat format, std::string_view name,
                     const LabelFileOptions& options) {
  const ByteSource source(bytes, name);
  return read({source, {}, options}, format);
}

std::string_view name_of(LabelNoteCode code) noexcept {
  switch (code) {
    case LabelNoteCode::two_affines:
      return "two_affines";
    case LabelNoteCode::two_voxel_sizes:
      return "two_voxel_sizes";
    case LabelNoteCode::unknown_units:
      return "unknown_units";
    case LabelNoteCode::more_bytes:
      return "more_bytes";
    case LabelNoteCode::empty_segmentation:
      return "empty_segmentation";
    case LabelNoteCode::pieces:
      return "pieces";
    case LabelNoteCode::cavities:
      return "cavities";
    case LabelNoteCode::cut_by_view:
      return "cut_by_view";
    case LabelNoteCode::simplified_away:
      return "simplified_away";
    case LabelNoteCode::touching:
      return "touching";
    case LabelNoteCode::label_tables:
      return "label_tables";
    case LabelNoteCode::axes_not_used:
      break;
  }
  return "axes_not_used";
}

}  // namespace condyle::io
