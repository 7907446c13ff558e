#include <zlib.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "io/file/deflate.hpp"
#include "io/file/output_file.hpp"
#include "io/picture/png.hpp"
#include "io/result/provenance_forms.hpp"

namespace condyle::io {
namespace {

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(value >> shift & 255);
  return bytes;
}

/// Length, type, data, and the check sum of the last two.
std::string chunk(std::string_view type, std::string_view data) {
  const std::string checked = std::string(type) + std::string(data);
  const uLong sum = crc32_z(0, reinterpret_cast<const Bytef*>(checked.data()), checked.size());
  return big_endian(static_cast<std::uint32_t>(data.size())) + checked +
         big_endian(static_cast<std::uint32_t>(sum));
}

/// Eight bits of red, green and blue, not interlaced.
std::string header(const Picture& picture) {
  constexpr char bits = 8, rgb = 2, deflate = 0, usual_filters = 0, not_interlaced = 0;
  return big_endian(static_cast<std::uint32_t>(picture.width)) +
         big_endian(static_cast<std::uint32_t>(picture.height)) +
         std::string{bits, rgb, deflate, usual_filters, not_interlaced};
}

/// Rows from the top, each as its differences from the row above: shaded surfaces change little from row to row.
std::string filtered_rows(const Picture& picture) {
  constexpr char up = 2;
  const std::size_t row = 3 * picture.width;
  std::string bytes;
  bytes.reserve(picture.height * (row + 1));
  for (std::size_t y = 0; y < picture.height; ++y) {
    bytes += up;
    for (std::size_t i = y * row; i < (y + 1) * row; ++i)
      bytes += static_cast<char>(picture.rgb[i] - (y > 0 ? picture.rgb[i - row] : 0));
  }
  return bytes;
}

/// PNG 1.2, sections 3 to 6.
std::string png_bytes(const Picture& picture, std::span<const VtpField> fields) {
  std::string bytes = "\x89PNG\r\n\x1a\n" + chunk("IHDR", header(picture));
  for (const VtpField& field : fields)
    if (const auto* text = std::get_if<std::string>(&field.value))
      bytes += chunk("tEXt", field.name + std::string(1, '\0') + *text);
  return bytes + chunk("IDAT", io::deflated(filtered_rows(picture))) + chunk("IEND", "");
}

}  // namespace

void write_png(const std::filesystem::path& path, const Picture& picture, std::span<const VtpField> fields,
               std::span<const std::filesystem::path> read) {
  io::check_output_file(path, read);
  io::write_output_file(path, png_bytes(picture, fields));
}

void write_png(const std::filesystem::path& path, const Picture& picture, const Provenance* from) {
  write_png(path, picture, io::provenance_fields(from), io::files_read(from));
}

}  // namespace condyle::io
