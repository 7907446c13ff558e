#include "io/image/label_files.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <random>
#include <stdexcept>

namespace condyle::test {
namespace {

std::string deflate_as(std::string_view bytes, int window_bits) {
  z_stream stream{};
  if (deflateInit2(&stream, 6, Z_DEFLATED, window_bits, 8, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("deflateInit2");
  std::string out(deflateBound(&stream, static_cast<uLong>(bytes.size())) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const int result = deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  if (result != Z_STREAM_END) throw std::runtime_error("deflate");
  return out;
}

template <class T>
std::string as_type(const std::vector<std::uint32_t>& values, std::endian order) {
  std::string bytes;
  for (const auto value : values) bytes += bytes_of(static_cast<T>(value), order);
  return bytes;
}

/// To and from a world in which x and y, or y only, point the other way.
Eigen::Affine3d in_world(const Eigen::Affine3d& X_WI, double x, double y) {
  Eigen::Affine3d out = X_WI;
  out.matrix().row(0) *= x;
  out.matrix().row(1) *= y;
  return out;
}

std::string numbers(const Eigen::Vector3d& v, std::string_view separator) {
  return fmt::format("{}{}{}{}{}", v.x(), separator, v.y(), separator, v.z());
}

template <class T>
void put_all(std::string& bytes, std::size_t at, const std::vector<double>& values, std::endian order) {
  for (std::size_t i = 0; i < values.size(); ++i)
    put(bytes, at + i * sizeof(T), static_cast<T>(values[i]), order);
}

int bits_of(int type) {
  return 8 * static_cast<int>(voxels_as(type, {0}, std::endian::little).size());
}

}  // namespace

LabelImage label_image(const Eigen::Affine3d& X_WI, std::size_t layers) {
  constexpr std::array<std::uint32_t, 5> labels = {0, 3, 75, 76, 120};
  LabelImage image{{5, 4, 3}, X_WI, {}};
  std::mt19937 random(7);
  image.layers.resize(layers);
  for (auto& layer : image.layers)
    for (int i = 0; i < 60; ++i) layer.push_back(labels[random() % labels.size()]);
  return image;
}

std::string gzipped(std::string_view bytes) {
  return deflate_as(bytes, 15 + 16);
}

std::string as_zlib(std::string_view bytes) {
  return deflate_as(bytes, 15);
}

std::string voxels_as(int type, const std::vector<std::uint32_t>& values, std::endian order) {
  if (type == 2) return as_type<std::uint8_t>(values, order);
  if (type == 256) return as_type<std::int8_t>(values, order);
  if (type == 4) return as_type<std::int16_t>(values, order);
  if (type == 512) return as_type<std::uint16_t>(values, order);
  if (type == 8) return as_type<std::int32_t>(values, order);
  if (type == 768) return as_type<std::uint32_t>(values, order);
  if (type == 1024) return as_type<std::int64_t>(values, order);
  if (type == 1280) return as_type<std::uint64_t>(values, order);
  if (type == 16) return as_type<float>(values, order);
  if (type == 64) return as_type<double>(values, order);
  throw std::runtime_error("no type");
}

std::string nifti_extension(int code, std::string text, std::endian order) {
  text.resize((text.size() + 8 + 15) / 16 * 16 - 8);
  return bytes_of(static_cast<std::int32_t>(text.size() + 8), order) +
         bytes_of(static_cast<std::int32_t>(code), order) + text;
}

std::string nifti_header(const LabelImage& image, const NiftiWriting& how) {
  const bool is_1 = how.version == 1;
  const std::size_t size = is_1 ? 348 : 540;
  const Eigen::Matrix<double, 3, 4> X =
      in_world(image.X_WI, -1, -1).matrix().topRows<3>() / how.unit_mm;  // RAS
  const std::string extensions = how.extensions.empty() ? std::string(4, '\0') : how.extensions;
  const auto offset = how.is_detached ? 0 : size + extensions.size();

  Eigen::Matrix3d R = X.leftCols<3>();
  Eigen::Vector3d extent = R.colwise().norm();
  for (int i = 0; i < 3; ++i) R.col(i) /= extent[i];
  const double qfac = R.determinant() < 0 ? -1 : 1;
  R.col(2) *= qfac;
  Eigen::Quaterniond q(R);
  if (q.w() < 0) q.coeffs() = -q.coeffs();

  std::vector<double> dim = {3, 0, 0, 0, 1, 1, 1, 1};
  for (std::size_t i = 0; i < 3; ++i) dim[i + 1] = static_cast<double>(image.size[i]);
  if (image.layers.size() > 1) {
    dim[0] = 4;
    dim[4] = static_cast<double>(image.layers.size());
  }
  const std::vector<double> pixdim = {qfac, extent.x(), extent.y(), extent.z(), 1, 1, 1, 1};
  std::vector<double> quaternion = {q.x(), q.y(), q.z(), X(0, 3), X(1, 3), X(2, 3)}, srow;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) srow.push_back(X(row, column));

  std::string header(size, '\0');
  const auto order = how.order;
  put<std::int32_t>(header, 0, static_cast<std::int32_t>(size), order);
  const std::string magic = how.is_detached ? "ni" : "n+";
  if (is_1) {
    put_all<std::int16_t>(header, 40, dim, order);
    put_all<std::int16_t>(header, 70, {static_cast<double>(how.type), static_cast<double>(bits_of(how.type))},
                          order);
    put_all<float>(header, 76, pixdim, order);
    put_all<float>(header, 108, {static_cast<double>(offset), how.slope, how.intercept}, order);
    header[123] = static_cast<char>(how.units | 8);
    put_all<std::int16_t>(header, 252, {how.qform ? 1.0 : 0.0, how.sform ? 1.0 : 0.0}, order);
    put_all<float>(header, 256, quaternion, order);
    put_all<float>(header, 280, srow, order);
    header.replace(344, 3, magic + "1");
  } else {
    header.replace(4, 8, magic + std::string("2\0\r\n\x1a\n", 6));
    put_all<std::int16_t>(header, 12, {static_cast<double>(how.type), static_cast<double>(bits_of(how.type))},
                          order);
    put_all<std::int64_t>(header, 16, dim, order);
    put_all<double>(header, 104, pixdim, order);
    put<std::int64_t>(header, 168, static_cast<std::int64_t>(offset), order);
    put_all<double>(header, 176, {how.slope, how.intercept}, order);
    put_all<std::int32_t>(header, 344, {how.qform ? 1.0 : 0.0, how.sform ? 1.0 : 0.0}, order);
    put_all<double>(header, 352, quaternion, order);
    put_all<double>(header, 400, srow, order);
    put<std::int32_t>(header, 500, how.units | 8, order);
  }
  return header + extensions;
}

std::string nifti(const LabelImage& image, const NiftiWriting& how) {
  std::string bytes = nifti_header(image, how);
  for (const auto& layer : image.layers) bytes += voxels_as(how.type, layer, how.order);
  return bytes;
}

std::string nrrd_header(const LabelImage& image, const NrrdWriting& how) {
  static const std::vector<std::pair<int, std::string>> types = {
      {2, "unsigned char"}, {256, "int8"},   {4, "short"},    {512, "uint16_t"},
      {8, "int"},           {768, "uint32"}, {1024, "int64"}, {1280, "unsigned long long"},
      {16, "float"},        {64, "double"}};
  std::string type;
  for (const auto& [code, name] : types)
    if (code == how.type) type = name;
  const std::string low = how.space;
  const bool is_ras = low == "RAS" || low == "right-anterior-superior";
  const bool is_las = low == "LAS" || low == "left-anterior-superior";
  const auto X = in_world(image.X_WI, is_ras ? -1 : 1, is_ras || is_las ? -1 : 1);
  const bool is_layered = image.layers.size() > 1;
  std::vector<std::string> sizes, directions, kinds;
  for (std::size_t i = 0; i < 3; ++i) {
    sizes.push_back(fmt::format("{}", image.size[i]));
    directions.push_back("(" + numbers(X.linear().col(static_cast<int>(i)), ",") + ")");
    kinds.push_back("domain");
  }
  if (is_layered) {
    const auto at = static_cast<std::ptrdiff_t>(how.layer_axis);
    sizes.insert(sizes.begin() + at, fmt::format("{}", image.layers.size()));
    directions.insert(directions.begin() + at, "none");
    kinds.insert(kinds.begin() + at, "list");
  }
  std::string text = "NRRD0004\n# written for a test\n";
  text += fmt::format("type: {}\ndimension: {}\n", type, sizes.size());
  if (!how.space.empty()) text += fmt::format("space: {}\n", how.space);
  text += fmt::format("sizes: {}\nspace directions: {}\nkinds: {}\n", fmt::join(sizes, " "),
                      fmt::join(directions, " "), fmt::join(kinds, " "));
  text += fmt::format("encoding: {}\n", how.is_gzip ? "gzip" : "raw");
  if (bits_of(how.type) > 8)
    text += fmt::format("endian: {}\n", how.order == std::endian::little ? "little" : "big");
  text += fmt::format("space origin: ({})\n", numbers(X.translation(), ","));
  text += how.more_lines;
  if (!how.data_file.empty()) text += fmt::format("data file: {}\n", how.data_file);
  return text + "\n";
}

std::string nrrd_data(const LabelImage& image, const NrrdWriting& how) {
  // Positions along the axes of the file, the first of which runs fastest.
  std::vector<std::size_t> sizes(image.size.begin(), image.size.end());
  const std::size_t axis = image.layers.size() > 1 ? how.layer_axis : 3;
  sizes.insert(sizes.begin() + static_cast<std::ptrdiff_t>(axis), image.layers.size());
  std::vector<std::uint32_t> values;
  std::array<std::size_t, 4> at{};
  for (at[3] = 0; at[3] < sizes[3]; ++at[3])
    for (at[2] = 0; at[2] < sizes[2]; ++at[2])
      for (at[1] = 0; at[1] < sizes[1]; ++at[1])
        for (at[0] = 0; at[0] < sizes[0]; ++at[0]) {
          std::vector<std::size_t> voxel(at.begin(), at.end());
          voxel.erase(voxel.begin() + static_cast<std::ptrdiff_t>(axis));
          const auto ni = static_cast<std::size_t>(image.size[0]),
                     nj = static_cast<std::size_t>(image.size[1]);
          values.push_back(image.layers[at[axis]][voxel[0] + ni * (voxel[1] + nj * voxel[2])]);
        }
  const std::string bytes = voxels_as(how.type, values, how.order);
  return how.is_gzip ? gzipped(bytes) : bytes;
}

std::string nrrd(const LabelImage& image, const NrrdWriting& how) {
  return nrrd_header(image, how) + nrrd_data(image, how);
}

std::string meta_header(const LabelImage& image, const MetaWriting& how) {
  static const std::vector<std::pair<int, std::string>> types = {
      {2, "MET_UCHAR"},  {256, "MET_CHAR"}, {4, "MET_SHORT"},        {512, "MET_USHORT"},
      {8, "MET_INT"},    {768, "MET_UINT"}, {1024, "MET_LONG_LONG"}, {1280, "MET_ULONG_LONG"},
      {16, "MET_FLOAT"}, {64, "MET_DOUBLE"}};
  std::string type;
  for (const auto& [code, name] : types)
    if (code == how.type) type = name;
  std::string rows;
  Eigen::Vector3d spacing = image.X_WI.linear().colwise().norm();
  for (int i = 0; i < 3; ++i) rows += (i ? " " : "") + numbers(image.X_WI.linear().col(i) / spacing[i], " ");
  return fmt::format(
      "ObjectType = Image\nNDims = 3\nBinaryData = True\n{} = {}\nCompressedData = {}\n{} = {}\n{} = {}\n"
      "CenterOfRotation = 1 2 3\nAnatomicalOrientation = RAI\nElementSpacing = {}\nDimSize = {} {} {}\n{}"
      "ElementType = {}\nElementDataFile = {}\n",
      how.order_key, how.order == std::endian::big ? "True" : "False", how.is_compressed ? "True" : "False",
      how.matrix_key, rows, how.offset_key, numbers(image.X_WI.translation(), " "), numbers(spacing, " "),
      image.size[0], image.size[1], image.size[2], how.more_lines, type, how.data_file);
}

std::string meta_data(const LabelImage& image, const MetaWriting& how) {
  const std::string bytes = voxels_as(how.type, image.layers[0], how.order);
  return how.is_compressed ? as_zlib(bytes) : bytes;
}

std::string meta(const LabelImage& image, const MetaWriting& how) {
  return meta_header(image, how) + meta_data(image, how);
}

}  // namespace condyle::test
