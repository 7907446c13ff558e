#include "io/image/nifti_header.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <string>
#include <utility>

namespace condyle::io {
namespace {

constexpr std::size_t size_1 = 348, size_2 = 540;

/// Fields at their places.
class Fields {
 public:
  Fields(std::string_view bytes, std::endian order) : bytes_(bytes), order_(order) {}

  template <class T>
  T at(std::size_t place) const noexcept {
    std::array<char, sizeof(T)> value;
    std::memcpy(value.data(), bytes_.data() + place, sizeof(T));
    if (order_ != std::endian::native)
      for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(value[i], value[sizeof(T) - 1 - i]);
    return std::bit_cast<T>(value);
  }
  template <class T, class Out, std::size_t count>
  void copy(std::size_t place, std::array<Out, count>& out) const noexcept {
    for (std::size_t i = 0; i < count; ++i) out[i] = static_cast<Out>(at<T>(place + i * sizeof(T)));
  }

 private:
  std::string_view bytes_;
  std::endian order_;
};

/// A float that counts bytes.
std::int64_t whole_offset(double offset, const ByteStream& stream) {
  constexpr double largest = 9007199254740992;  // 2^53
  if (!(offset >= 0 && offset <= largest && offset == std::floor(offset)))
    stream.fail(fmt::format("vox_offset: {} is no number of bytes", offset));
  return static_cast<std::int64_t>(offset);
}

NiftiHeader header_1(const Fields& fields, const ByteStream& stream) {
  NiftiHeader header;
  fields.copy<std::int16_t>(40, header.dim);
  header.datatype = fields.at<std::int16_t>(70);
  header.bits_per_voxel = fields.at<std::int16_t>(72);
  fields.copy<float>(76, header.pixdim);
  header.data_offset = whole_offset(static_cast<double>(fields.at<float>(108)), stream);
  header.slope = static_cast<double>(fields.at<float>(112));
  header.intercept = static_cast<double>(fields.at<float>(116));
  header.units = fields.at<std::uint8_t>(123);
  header.qform_code = fields.at<std::int16_t>(252);
  header.sform_code = fields.at<std::int16_t>(254);
  fields.copy<float>(256, header.quaternion);
  fields.copy<float>(268, header.qoffset);
  for (std::size_t row = 0; row < 3; ++row) fields.copy<float>(280 + 16 * row, header.srow[row]);
  return header;
}

NiftiHeader header_2(const Fields& fields, const ByteStream& stream) {
  NiftiHeader header;
  header.version = 2;
  header.datatype = fields.at<std::int16_t>(12);
  header.bits_per_voxel = fields.at<std::int16_t>(14);
  fields.copy<std::int64_t>(16, header.dim);
  fields.copy<double>(104, header.pixdim);
  header.data_offset = fields.at<std::int64_t>(168);
  if (header.data_offset < 0)
    stream.fail(fmt::format("vox_offset: {} is no number of bytes", header.data_offset));
  header.slope = fields.at<double>(176);
  header.intercept = fields.at<double>(184);
  header.qform_code = fields.at<std::int32_t>(344);
  header.sform_code = fields.at<std::int32_t>(348);
  fields.copy<double>(352, header.quaternion);
  fields.copy<double>(376, header.qoffset);
  for (std::size_t row = 0; row < 3; ++row) fields.copy<double>(400 + 32 * row, header.srow[row]);
  header.units = fields.at<std::int32_t>(500) & 0xFF;
  return header;
}

}  // namespace

NiftiHeader read_nifti_header(ByteStream& stream) {
  std::string bytes(size_2, '\0');
  const auto read = [&](std::size_t from, std::size_t to) {
    if (stream.read(std::span(bytes).subspan(from, to - from)) < to - from)
      stream.fail(fmt::format("the file ends within the header of {} bytes", to));
  };
  read(0, size_1);
  auto order = std::endian::little;
  auto size = Fields(bytes, order).at<std::uint32_t>(0);
  if (size != size_1 && size != size_2) {
    order = std::endian::big;
    size = Fields(bytes, order).at<std::uint32_t>(0);
  }
  if (size != size_1 && size != size_2) stream.fail("sizeof_hdr: neither 348 nor 540: no NIfTI file");

  if (size == size_2) read(size_1, size_2);
  const auto magic = std::string_view(bytes).substr(size == size_1 ? 344 : 4, size == size_1 ? 4 : 8);
  using namespace std::string_view_literals;
  const bool is_attached = size == size_1 ? magic == "n+1\0"sv : magic == "n+2\0\r\n\x1a\n"sv;
  const bool is_detached = size == size_1 ? magic == "ni1\0"sv : magic == "ni2\0\r\n\x1a\n"sv;
  if (!is_attached && !is_detached)
    stream.fail(size == size_1 ? "magic: neither 'n+1' nor 'ni1': no NIfTI-1 file (Analyze 7.5 is not read)"
                               : "magic: neither 'n+2' nor 'ni2': no NIfTI-2 file");

  const Fields fields(bytes, order);
  auto header = size == size_1 ? header_1(fields, stream) : header_2(fields, stream);
  header.is_detached = is_detached;
  header.order = order;
  return header;
}

}  // namespace condyle::io
