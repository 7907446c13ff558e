#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>

#include "io/file/words.hpp"
#include "io/image/image_grid.hpp"
#include "io/image/label_input.hpp"
#include "io/image/text_header.hpp"
#include "io/image/voxel_data.hpp"
#include "io/mesh/parse.hpp"

namespace condyle::io {
namespace {

/// The header up to ElementDataFile, which is the last key, and where it ends.
struct MetaHeader {
  HeaderFields fields;
  std::uint64_t end = 0;
};

MetaHeader read_header(const ByteSource& source) {
  MetaHeader header{HeaderFields(source), 0};
  HeaderLines lines(source);
  while (true) {
    const auto line = lines.next();
    if (!line) source.fail("ElementDataFile: is missing");
    if (trimmed(*line).empty()) continue;
    const auto equals = line->find('=');
    if (equals == std::string::npos) lines.fail(fmt::format("{} is no 'key = value'", in_quotes(*line)));
    const std::string key(trimmed(std::string_view(*line).substr(0, equals)));
    if (!header.fields.add(key, std::string(trimmed(std::string_view(*line).substr(equals + 1)))))
      lines.fail(fmt::format("the key {} is given twice", in_quotes(key)));
    if (key != "ElementDataFile") continue;
    header.end = lines.offset();
    return header;
  }
}

/// The first of several names of one key that the header has.
template <std::size_t count>
std::optional<std::string> given(const HeaderFields& fields, const std::array<const char*, count>& keys) {
  std::optional<std::string> found;
  for (const char* key : keys) {
    if (!fields.find(key)) continue;
    if (found) fields.fail(key, fmt::format("{} says the same already", *found));
    found = key;
  }
  return found;
}

bool flag(const HeaderFields& fields, const std::string& key, bool otherwise) {
  const auto value = fields.find(key);
  if (!value) return otherwise;
  const std::string word = io::lower_case(*value);
  if (word == "true" || word == "t" || word == "1") return true;
  if (word == "false" || word == "f" || word == "0") return false;
  fields.fail(key, fmt::format("{} is neither True nor False", in_quotes(*value)));
}

/// Refuses what would be read wrongly.
void check_is_image(const HeaderFields& fields) {
  if (const auto type = fields.find("ObjectType"); type && *type != "Image")
    fields.fail("ObjectType", fmt::format("{} is no Image", in_quotes(*type)));
  if (const auto dimensions = fields.whole_number("NDims"); dimensions != 3)
    fields.fail("NDims", fmt::format("{} dimensions: only images of 3 are read", dimensions));
  if (!flag(fields, "BinaryData", true)) fields.fail("BinaryData", "voxels written as text are not read");
  if (fields.find("ElementNumberOfChannels") && fields.whole_number("ElementNumberOfChannels") != 1)
    fields.fail("ElementNumberOfChannels", "several values in a voxel are not read");
  if (fields.find("ElementToIntensityFunctionSlope") &&
      fields.numbers("ElementToIntensityFunctionSlope", 1).front() != 1)
    fields.fail("ElementToIntensityFunctionSlope", "a slope other than 1 is not read");
  if (fields.find("ElementToIntensityFunctionOffset") &&
      fields.numbers("ElementToIntensityFunctionOffset", 1).front() != 0)
    fields.fail("ElementToIntensityFunctionOffset", "an offset other than 0 is not read");
}

NumberType element_type(const HeaderFields& fields) {
  const auto type = fields.need("ElementType");
  if (type == "MET_UCHAR") return NumberType::u8;
  if (type == "MET_CHAR") return NumberType::i8;
  if (type == "MET_USHORT") return NumberType::u16;
  if (type == "MET_SHORT") return NumberType::i16;
  if (type == "MET_UINT") return NumberType::u32;
  if (type == "MET_INT") return NumberType::i32;
  if (type == "MET_ULONG_LONG") return NumberType::u64;
  if (type == "MET_LONG_LONG") return NumberType::i64;
  if (type == "MET_FLOAT") return NumberType::f32;
  if (type == "MET_DOUBLE") return NumberType::f64;
  if (type == "MET_LONG" || type == "MET_ULONG")
    fields.fail("ElementType",
                fmt::format("{} has 4 bytes in some programs and 8 in others: is not read", type));
  fields.fail("ElementType", fmt::format("{} is not read", in_quotes(type)));
}

VoxelData voxel_data(const HeaderFields& fields) {
  VoxelData data;
  data.type = element_type(fields);
  const auto order = given(fields, std::array{"BinaryDataByteOrderMSB", "ElementByteOrderMSB"});
  data.order = order && flag(fields, *order, false) ? std::endian::big : std::endian::little;
  const auto sizes = fields.whole_numbers("DimSize", 3);
  data.size = {sizes[0], sizes[1], sizes[2]};
  check_size(data, fields.source(), "DimSize");
  data.run = data.voxels();
  return data;
}

double element_mm_per_unit(const HeaderFields& fields) {
  const auto unit = fields.find("DistanceUnits");
  if (!unit || *unit == "mm" || *unit == "?") return 1;
  if (*unit == "cm") return 10;
  if (*unit == "um") return 1e-3;
  fields.fail("DistanceUnits", fmt::format("{} is no unit of length that is read", in_quotes(*unit)));
}

/// The key of the matrix of directions; empty if there is none.
auto matrix_key(const HeaderFields& fields) {
  return given(fields, std::array{"TransformMatrix", "Rotation", "Orientation"});
}

/// Rows of the matrix are the directions of the axes; without one the axes are those of the world that is stated, and so is the
/// place of the first voxel. CenterOfRotation and AnatomicalOrientation change nothing.
VoxelGrid grid_of(const HeaderFields& fields, const VoxelData& data, const std::optional<StatedAxes>& axes) {
  Eigen::Matrix3d directions = Eigen::Matrix3d::Identity();
  const auto matrix = matrix_key(fields);
  if (matrix) {
    const auto numbers = fields.numbers(*matrix, 9);
    directions = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(numbers.data()).transpose();
  } else if (!axes) {
    fields.fail(
        "TransformMatrix",
        "is missing: the file does not say how its axes lie in the body; state it (ITK takes them for LPS)");
  }
  const auto spacing = fields.numbers("ElementSpacing", 3);
  Eigen::Affine3d X_WI = Eigen::Affine3d::Identity();
  for (int axis = 0; axis < 3; ++axis)
    X_WI.linear().col(axis) = directions.col(axis) * spacing[static_cast<std::size_t>(axis)];
  if (const auto offset = given(fields, std::array{"Offset", "Position", "Origin"}))
    X_WI.translation() = Eigen::Vector3d::Map(fields.numbers(*offset, 3).data());
  X_WI.matrix().topRows<3>() *= element_mm_per_unit(fields);
  return checked_grid(data.size, X_WI, matrix ? StatedAxes::lps : *axes, fields.source(),
                      matrix ? *matrix : std::string("ElementSpacing"));
}

/// Where the voxels begin in their file, whose first byte that counts is at `at`.
std::uint64_t data_offset(const HeaderFields& fields, const ByteSource& source, std::uint64_t at,
                          const VoxelData& data, bool is_compressed) {
  if (is_compressed && fields.find("CompressedDataSize")) {
    const std::int64_t size = fields.whole_number("CompressedDataSize");
    if (size < 0 || static_cast<std::uint64_t>(size) > source.size() - std::min(at, source.size()))
      fields.fail("CompressedDataSize", fmt::format("the file holds fewer than {} bytes of data", size));
  }
  const std::int64_t header_size = fields.find("HeaderSize") ? fields.whole_number("HeaderSize") : 0;
  if (header_size < -1) fields.fail("HeaderSize", fmt::format("{} is no number of bytes", header_size));
  if (header_size == -1 && is_compressed) fields.fail("HeaderSize", "-1 is for data without compression");
  const std::uint64_t left = source.size() - std::min(at, source.size());
  if (header_size == -1) {
    if (left < data.bytes())
      source.fail(
          fmt::format("data: the file is too short for the {} bytes that the header promises", data.bytes()));
    return source.size() - data.bytes();
  }
  if (static_cast<std::uint64_t>(header_size) > left)
    fields.fail("HeaderSize", fmt::format("the file holds fewer than {} bytes", header_size));
  return at + static_cast<std::uint64_t>(header_size);
}

}  // namespace

LabelMap read_metaimage(const LabelInput& input) {
  const MetaHeader header = read_header(input.header);
  const HeaderFields& fields = header.fields;
  check_is_image(fields);
  const VoxelData data = voxel_data(fields);
  LabelMap map;
  map.grid = grid_of(fields, data, input.options.axes);
  if (matrix_key(fields)) note_own_axes(input.options, map.notes);
  const bool is_compressed = flag(fields, "CompressedData", false);
  const auto read = [&](const ByteSource& source, std::uint64_t at) {
    ByteStream stream(source, data_offset(fields, source, at, data, is_compressed),
                      is_compressed ? Packing::deflated : Packing::none);
    read_voxels(stream, data, map);
  };
  const auto file = fields.need("ElementDataFile");
  if (file == "LOCAL" || file == "Local" || file == "local") {
    read(input.header, header.end);
    return map;
  }
  if (file.starts_with("LIST") || file.find('%') != std::string_view::npos)
    fields.fail("ElementDataFile", fmt::format("{}: data in several files are not read", in_quotes(file)));
  const ByteSource separate = input.open_data("ElementDataFile", std::string(file));
  read(separate, 0);
  return map;
}

}  // namespace condyle::io
