#include "io/image/write_labels.hpp"

#include <bit>
#include <cstring>
#include <string>

#include "io/file/deflate.hpp"
#include "io/file/whole_file.hpp"

namespace condyle::io {
namespace {

/// The header's 348 bytes and four that say that no extension follows; the format's own offsets.
constexpr std::size_t header_bytes = 352;

template <class T>
void put(std::string& bytes, std::size_t at, T value) {
  static_assert(std::endian::native == std::endian::little);
  std::memcpy(bytes.data() + at, &value, sizeof(T));
}

std::string header_of(const VoxelGrid& grid) {
  std::string bytes(header_bytes, '\0');
  put(bytes, 0, std::int32_t{348});
  put(bytes, 40, std::int16_t{3});
  for (std::size_t axis = 0; axis < 3; ++axis)
    put(bytes, 42 + 2 * axis, static_cast<std::int16_t>(grid.size[axis]));
  for (std::size_t axis = 3; axis < 7; ++axis) put(bytes, 42 + 2 * axis, std::int16_t{1});
  put(bytes, 70, std::int16_t{2});  // unsigned bytes
  put(bytes, 72, std::int16_t{8});
  put(bytes, 76, 1.0F);
  for (int axis = 0; axis < 3; ++axis)
    put(bytes, 80 + 4 * static_cast<std::size_t>(axis),
        static_cast<float>(grid.X_WI.linear().col(axis).norm()));
  put(bytes, 108, static_cast<float>(header_bytes));
  bytes[123] = 2;                    // mm
  put(bytes, 254, std::int16_t{1});  // sform: to the scanner's axes
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) {
      // The format's world is RAS.
      const double value = (row < 2 ? -1 : 1) * grid.X_WI(row, column);
      put(bytes, 280 + 16 * static_cast<std::size_t>(row) + 4 * static_cast<std::size_t>(column),
          static_cast<float>(value));
    }
  std::memcpy(bytes.data() + 344, "n+1", 4);
  return bytes;
}

}  // namespace

void write_labels(const std::filesystem::path& path, const VoxelGrid& grid,
                  std::span<const std::uint8_t> labels) {
  std::string bytes = header_of(grid);
  bytes.append(reinterpret_cast<const char*>(labels.data()), labels.size());
  write_whole_file(path, gzipped(bytes));
}

}  // namespace condyle::io
