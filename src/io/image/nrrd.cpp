#include <fmt/format.h>

#include <optional>
#include <string>

#include "io/file/words.hpp"
#include "io/image/image_grid.hpp"
#include "io/image/label_input.hpp"
#include "io/image/nrrd_header.hpp"
#include "io/image/voxel_data.hpp"
#include "io/mesh/parse.hpp"

namespace condyle::io {
namespace {

NumberType nrrd_type(const HeaderFields& fields) {
  const std::string type = io::lower_case(fields.need("type"));
  const auto is = [&](auto... names) { return ((type == names) || ...); };
  if (is("uchar", "unsigned char", "uint8", "uint8_t")) return NumberType::u8;
  if (is("signed char", "int8", "int8_t")) return NumberType::i8;
  if (is("ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t")) return NumberType::u16;
  if (is("short", "short int", "signed short", "signed short int", "int16", "int16_t"))
    return NumberType::i16;
  if (is("uint", "unsigned int", "uint32", "uint32_t")) return NumberType::u32;
  if (is("int", "signed int", "int32", "int32_t")) return NumberType::i32;
  if (is("ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"))
    return NumberType::u64;
  if (is("longlong", "long long", "long long int", "signed long long", "signed long long int", "int64",
         "int64_t"))
    return NumberType::i64;
  if (is("float")) return NumberType::f32;
  if (is("double")) return NumberType::f64;
  fields.fail("type", fmt::format("{} is not read", in_quotes(type)));
}

std::endian byte_order(const HeaderFields& fields, NumberType type) {
  if (bytes_of(type) == 1) return std::endian::native;
  const std::string order = io::lower_case(fields.need("endian"));
  if (order == "little") return std::endian::little;
  if (order == "big") return std::endian::big;
  fields.fail("endian", fmt::format("{} is neither 'little' nor 'big'", in_quotes(order)));
}

Packing packing(const HeaderFields& fields) {
  const std::string encoding = io::lower_case(fields.need("encoding"));
  if (encoding == "raw") return Packing::none;
  if (encoding == "gzip" || encoding == "gz") return Packing::deflated;
  fields.fail("encoding", fmt::format("{} is not read: 'raw' and 'gzip' are", in_quotes(encoding)));
}

/// The world that `space` names; nothing if it names none or does not say how that lies in the body.
std::optional<StatedAxes> world_of(const HeaderFields& fields) {
  const auto value = fields.find("space");
  if (!value) return std::nullopt;
  const std::string space = io::lower_case(*value);
  if (space == "left-posterior-superior" || space == "lps") return StatedAxes::lps;
  if (space == "right-anterior-superior" || space == "ras") return StatedAxes::ras;
  if (space == "left-anterior-superior" || space == "las") return StatedAxes::las;
  if (space == "3d-right-handed" || space == "3d-left-handed" || space == "scanner-xyz") return std::nullopt;
  fields.fail("space", fmt::format("{} is not read", in_quotes(space)));
}

double nrrd_mm_per_unit(const HeaderFields& fields) {
  const auto value = fields.find("space units");
  if (!value) return 1;
  const auto words = io::words_of(*value);
  if (words.size() != 3 || words[0] != words[1] || words[0] != words[2])
    fields.fail("space units", "are not three times the same unit");
  if (words[0] == "\"mm\"" || words[0] == "\"\"") return 1;
  if (words[0] == "\"m\"") return 1000;
  if (words[0] == "\"cm\"") return 10;
  if (words[0] == "\"um\"") return 1e-3;
  fields.fail("space units", fmt::format("{} is no unit of length that is read", in_quotes(words[0])));
}

/// The axes of the file: three of space, and at most one that counts layers.
struct Axes {
  std::vector<std::int64_t> sizes;
  std::vector<std::optional<std::array<double, 3>>> directions;  ///< none for the axis of layers
  bool are_stated = true;                                        ///< `space directions` is there
};

Axes read_axes(const HeaderFields& fields) {
  const std::int64_t dimension = fields.whole_number("dimension");
  if (dimension < 3 || dimension > 4)
    fields.fail("dimension", fmt::format("{}: 3, and 4 with an axis of layers, are read", dimension));
  Axes axes;
  axes.sizes = fields.whole_numbers("sizes", static_cast<std::size_t>(dimension));
  const auto text = fields.find("space directions");
  if (text) {
    std::string_view left = *text;
    for (std::int64_t i = 0; i < dimension; ++i)
      axes.directions.push_back(next_vector(fields, "space directions", left));
    if (!trimmed(left).empty())
      fields.fail("space directions", fmt::format("are more than the {} axes", dimension));
  } else {
    axes.are_stated = false;
    if (dimension != 3) fields.fail("space directions", "are missing");
    const auto spacings = fields.numbers("spacings", 3);
    for (std::size_t i = 0; i < 3; ++i) {
      auto& direction = axes.directions.emplace_back(std::array<double, 3>{});
      (*direction)[i] = spacings[i];
    }
  }
  std::size_t of_space = 0;
  for (const auto& direction : axes.directions) of_space += direction.has_value();
  if (of_space != 3)
    fields.fail("space directions", fmt::format("name {} axes of space instead of 3", of_space));
  return axes;
}

/// An axis that is not of space may count layers, and nothing else.
void check_kinds(const HeaderFields& fields, const Axes& axes) {
  const auto value = fields.find("kinds");
  if (!value) return;
  const auto words = io::words_of(*value);
  if (words.size() != axes.sizes.size())
    fields.fail("kinds", fmt::format("are {} instead of {}", words.size(), axes.sizes.size()));
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string kind = io::lower_case(words[i]);
    if (!axes.directions[i] && kind != "list" && kind != "vector" && kind != "none" && kind != "???")
      fields.fail("kinds", fmt::format("{} is no axis of layers: 'list' and 'vector' are", in_quotes(kind)));
  }
}

VoxelData voxel_data(const HeaderFields& fields, const Axes& axes) {
  constexpr std::int64_t most_layers = 1024;  // segmentations have some tens
  VoxelData data;
  data.type = nrrd_type(fields);
  data.order = byte_order(fields, data.type);
  std::size_t axis = 0;
  std::optional<std::size_t> axes_before_layers;
  for (std::size_t i = 0; i < axes.sizes.size(); ++i) {
    if (axes.directions[i]) {
      data.size[axis++] = axes.sizes[i];
      continue;
    }
    if (axes.sizes[i] < 1 || axes.sizes[i] > most_layers)
      fields.fail("sizes", fmt::format("{} layers: 1 to {} are read", axes.sizes[i], most_layers));
    data.layers = static_cast<std::uint64_t>(axes.sizes[i]);
    axes_before_layers = axis;
  }
  check_size(data, fields.source(), "sizes");
  for (std::size_t i = 0; i < axes_before_layers.value_or(3); ++i)
    data.run *= static_cast<std::uint64_t>(data.size[i]);
  return data;
}

VoxelGrid grid_of(const HeaderFields& fields, const Axes& axes, const VoxelData& data,
                  const LabelFileOptions& options) {
  auto world = world_of(fields);
  if (!world || !axes.are_stated) world = options.axes;
  if (!world)
    fields.fail(axes.are_stated ? "space" : "space directions",
                "missing or no named one: the file does not say how its axes lie in the body; state it");
  Eigen::Affine3d X_WI = Eigen::Affine3d::Identity();
  int axis = 0;
  for (const auto& direction : axes.directions)
    if (direction) X_WI.linear().col(axis++) = Eigen::Vector3d::Map(direction->data());
  if (const auto text = fields.find("space origin")) {
    std::string_view left = *text;
    const auto origin = next_vector(fields, "space origin", left);
    if (!origin || !trimmed(left).empty()) fields.fail("space origin", "is no single vector");
    X_WI.translation() = Eigen::Vector3d::Map(origin->data());
  }
  const double mm = nrrd_mm_per_unit(fields);
  X_WI.matrix().topRows<3>() *= mm;
  return checked_grid(data.size, X_WI, *world, fields.source(), "space directions");
}

/// Where line `count` of a file begins, its first being 0.
std::uint64_t after_lines(const ByteSource& source, std::uint64_t at, std::int64_t count,
                          const HeaderFields& fields) {
  std::array<char, 4096> block{};
  while (count > 0) {
    const std::size_t got = source.read(at, block);
    if (got == 0) fields.fail("line skip", "the file of the data has fewer lines");
    std::size_t used = 0;
    while (used < got && count > 0) count -= block[used++] == '\n';
    at += used;
  }
  return at;
}

/// Reads the voxels that begin at `at` of a file, but for the lines and bytes that the header wants left out. Bytes are left
/// out of what was inflated.
void read_data(const ByteSource& source, std::uint64_t at, const HeaderFields& fields, const VoxelData& data,
               LabelMap& map) {
  const Packing packed = packing(fields);
  const std::int64_t lines = fields.find("line skip") ? fields.whole_number("line skip") : 0;
  const std::int64_t bytes = fields.find("byte skip") ? fields.whole_number("byte skip") : 0;
  if (lines < 0) fields.fail("line skip", fmt::format("{} is no number of lines", lines));
  if (bytes < -1) fields.fail("byte skip", fmt::format("{} is no number of bytes", bytes));
  if (bytes == -1 && packed != Packing::none) fields.fail("byte skip", "-1 is for raw data only");
  at = after_lines(source, at, lines, fields);
  if (bytes == -1) {
    if (source.size() < at || source.size() - at < data.bytes())
      source.fail(
          fmt::format("data: the file is too short for the {} bytes that the header promises", data.bytes()));
    at = source.size() - data.bytes();
  }
  ByteStream stream(source, at, packed);
  const auto left_out = static_cast<std::uint64_t>(std::max<std::int64_t>(bytes, 0));
  if (!stream.may_hold(left_out) || !stream.skip(left_out))
    fields.fail("byte skip", fmt::format("the data have fewer than {} bytes", left_out));
  read_voxels(stream, data, map);
}

}  // namespace

LabelMap read_nrrd(const LabelInput& input) {
  const NrrdHeader header = read_nrrd_header(input.header);
  const HeaderFields& fields = header.fields;
  const Axes axes = read_axes(fields);
  check_kinds(fields, axes);
  const VoxelData data = voxel_data(fields, axes);
  LabelMap map;
  map.grid = grid_of(fields, axes, data, input.options);
  if (axes.are_stated && world_of(fields)) note_own_axes(input.options, map.notes);
  map.segments = slicer_segments(header, data.layers);
  const auto file = fields.find("data file");
  if (!file) {
    read_data(input.header, header.data_offset, fields, data, map);
    return map;
  }
  if (file->starts_with("LIST")) fields.fail("data file", "LIST: data in several files are not read");
  if (file->find('%') != std::string_view::npos)
    fields.fail("data file", fmt::format("{}: data in several files are not read", in_quotes(*file)));
  const ByteSource separate = input.open_data("data file", std::string(*file));
  read_data(separate, 0, fields, data, map);
  return map;
}

}  // namespace condyle::io
