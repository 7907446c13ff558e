#include <fmt/format.h>

#include <iterator>
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
  constexpr std::string_view names[] = {
      "two_affines",  "two_voxel_sizes", "unknown_units", "more_bytes",      "empty_segmentation",
      "pieces",       "cavities",        "cut_by_view",   "simplified_away", "touching",
      "label_tables", "axes_not_used",   "interpolated"};
  static_assert(std::size(names) == static_cast<std::size_t>(LabelNoteCode::interpolated) + 1);
  return names[static_cast<std::size_t>(code)];
}

}  // namespace condyle::io
