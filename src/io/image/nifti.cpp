#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>

#include "io/image/caret_names.hpp"
#include "io/image/label_input.hpp"
#include "io/image/nifti_affine.hpp"
#include "io/image/nifti_header.hpp"
#include "io/image/voxel_data.hpp"

namespace condyle::io {
namespace {

struct DataType {
  int code;
  NumberType type;
};
constexpr DataType data_types[] = {{2, NumberType::u8},     {256, NumberType::i8},   {4, NumberType::i16},
                                   {512, NumberType::u16},  {8, NumberType::i32},    {768, NumberType::u32},
                                   {1024, NumberType::i64}, {1280, NumberType::u64}, {16, NumberType::f32},
                                   {64, NumberType::f64}};

std::string_view refused_type(int code) {
  switch (code) {
    case 32:
    case 1792:
    case 2048:
      return "complex numbers";
    case 128:
    case 2304:
      return "colours";
    case 1536:
      return "floats of 128 bits";
    case 1:
      return "single bits";
    default:
      return "no type of NIfTI";
  }
}

NumberType checked_type(const NiftiHeader& header, const ByteSource& source) {
  const auto* known = std::find_if(std::begin(data_types), std::end(data_types),
                                   [&](const DataType& each) { return each.code == header.datatype; });
  if (known == std::end(data_types))
    source.fail(fmt::format("datatype: {} ({}) is not read", header.datatype, refused_type(header.datatype)));
  if (const auto bits = 8 * static_cast<int>(bytes_of(known->type)); header.bits_per_voxel != bits)
    source.fail(fmt::format("bitpix: {} instead of the {} of datatype {}", header.bits_per_voxel, bits,
                            header.datatype));
  return known->type;
}

VoxelData voxel_data(const NiftiHeader& header, const ByteSource& source) {
  VoxelData data;
  data.type = checked_type(header, source);
  data.order = header.order;
  if (header.dim[0] < 3 || header.dim[0] > 7)
    source.fail(fmt::format("dim[0]: {} dimensions: only images of 3 are read", header.dim[0]));
  data.size = {header.dim[1], header.dim[2], header.dim[3]};
  check_size(data, source, "dim");
  if (std::isfinite(header.slope) && header.slope != 0) {
    if (!std::isfinite(header.intercept))
      source.fail(fmt::format("scl_inter: {} is not finite", header.intercept));
    data.slope = header.slope;
    data.intercept = header.intercept;
  }
  return data;
}

/// How many volumes lie before the one that is read.
std::uint64_t volumes_before(const NiftiHeader& header, const LabelFileOptions& options,
                             const ByteSource& source) {
  for (std::size_t i = 5; i <= static_cast<std::size_t>(header.dim[0]); ++i)
    if (header.dim[i] != 1) source.fail(fmt::format("dim[{}]: a size of {} is not read", i, header.dim[i]));
  const std::int64_t volumes = header.dim[0] > 3 ? header.dim[4] : 1;
  constexpr std::int64_t most = std::int64_t{1} << 20;  // with 2^40 voxels and 8 bytes: no product overflows
  if (volumes < 1 || volumes > most) source.fail(fmt::format("dim[4]: a size of {}", volumes));
  if (volumes > 1 && !options.volume)
    source.fail(fmt::format("dim[4]: {} volumes: choose one of them", volumes));
  const std::int64_t volume = options.volume.value_or(0);
  if (volume < 0 || volume >= volumes)
    source.fail(fmt::format("dim[4]: no volume {}: there are {}, counted from 0", volume, volumes));
  return static_cast<std::uint64_t>(volume);
}

std::uint32_t four_bytes(const char* bytes, std::endian order) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i)
    value |= std::uint32_t{static_cast<unsigned char>(bytes[i])}
             << 8 * (order == std::endian::little ? i : 3 - i);
  return value;
}

/// Passes over the extensions between the header and `end`, and takes names from them. Each has its size, its code, and bytes.
void read_extensions(ByteStream& stream, const NiftiHeader& header, std::optional<std::uint64_t> end,
                     LabelMap& map, const ByteSource& source) {
  constexpr std::uint32_t code_of_any = 0, code_of_caret = 30;
  constexpr std::uint64_t largest_with_names = std::uint64_t{1} << 24;  // bytes: a label's line has 100
  std::uint64_t at = header.size();
  const auto left = [&] { return end ? *end - at : ~std::uint64_t{0}; };
  std::array<char, 8> start{};
  if (left() < 4) return;
  if (stream.read(std::span(start).first(4)) < 4) {
    if (end) source.fail("the file ends before its voxels");
    return;
  }
  at += 4;
  for (bool has_more = start[0] != 0; has_more && left() >= start.size();) {
    const std::size_t got = stream.read(start);
    if (got < start.size()) {
      if (end) source.fail("the file ends before its voxels");
      break;
    }
    at += got;
    const std::uint64_t size = four_bytes(start.data(), header.order);
    const std::uint32_t code = four_bytes(start.data() + 4, header.order);
    if (size < start.size() || size - start.size() > left())
      source.fail(fmt::format("extension at byte {}: a size of {}", at - got, size));
    const std::uint64_t bytes = size - start.size();
    if (!stream.may_hold(bytes))
      source.fail(fmt::format("extension at byte {}: {} bytes are more than the file holds", at - got, size));
    if ((code == code_of_any || code == code_of_caret) && bytes <= largest_with_names &&
        map.segments.empty()) {
      std::string text(static_cast<std::size_t>(bytes), '\0');
      if (stream.read(text) < text.size()) source.fail("the file ends within an extension");
      map.segments = caret_names(text, source.name());
    } else if (!stream.skip(bytes)) {
      source.fail("the file ends within an extension");
    }
    at += bytes;
  }
  if (end && !stream.skip(*end - at)) source.fail("the file ends before its voxels");
}

/// The voxels from the place of the first volume on.
void read_volume(ByteStream& stream, const VoxelData& data, std::uint64_t before, std::int64_t volumes,
                 const ByteSource& source, LabelMap& map) {
  const std::uint64_t promised = static_cast<std::uint64_t>(volumes) * data.bytes();
  if (!stream.may_hold(promised))
    source.fail(
        fmt::format("data: the file is too short for the {} bytes that the header promises", promised));
  if (!stream.skip(before * data.bytes()))
    source.fail(fmt::format("data: the file ends before volume {}", before));
  read_voxels(stream, data, map);
  const bool has_volume_behind = before + 1 < static_cast<std::uint64_t>(volumes);
  if (has_volume_behind)
    std::erase_if(map.notes, [](const LabelNote& note) { return note.code == LabelNoteCode::more_bytes; });
}

}  // namespace

LabelMap read_nifti(const LabelInput& input) {
  const ByteSource& source = input.header;
  ByteStream stream(source, 0, is_gzip(source) ? Packing::deflated : Packing::none);
  const NiftiHeader header = read_nifti_header(stream);
  const VoxelData data = voxel_data(header, source);
  const std::uint64_t before = volumes_before(header, input.options, source);
  const std::int64_t volumes = header.dim[0] > 3 ? header.dim[4] : 1;
  LabelMap map;
  map.grid = nifti_grid(header, data.size, input.options, source, map.notes);
  const auto offset = static_cast<std::uint64_t>(header.data_offset);
  if (!header.is_detached) {
    if (offset < header.size() + 4)
      source.fail(
          fmt::format("vox_offset: {} lies within the header of {} bytes", offset, header.size() + 4));
    if (!stream.may_hold(offset - header.size()))
      source.fail(fmt::format("vox_offset: {} lies behind the end of the file", offset));
    read_extensions(stream, header, offset, map, source);
    read_volume(stream, data, before, volumes, source, map);
    return map;
  }
  read_extensions(stream, header, std::nullopt, map, source);
  auto named = input.path.filename();
  named.replace_extension(named.extension() == ".HDR" ? ".IMG" : ".img");
  const ByteSource voxels = input.open_data("magic", named);
  ByteStream voxel_stream(voxels, 0, is_gzip(voxels) ? Packing::deflated : Packing::none);
  if (!voxel_stream.may_hold(offset) || !voxel_stream.skip(offset))
    source.fail(fmt::format("vox_offset: {} lies behind the end of the voxels' file", offset));
  read_volume(voxel_stream, data, before, volumes, voxels, map);
  return map;
}

}  // namespace condyle::io
