#include "io/mesh/vtk_array.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "io/mesh/uncompress.hpp"

namespace condyle::io {
namespace {

/// Deflate shortens at most 1032 times, LZ4 255 times: a block that claims to have been more is not believed,
/// and no memory is allocated.
constexpr std::uint64_t largest_ratio = 1032;

[[noreturn]] void fail(const Source& source, const VtkArray& array, std::string_view what) {
  source.fail(fmt::format("array {}: {}", in_quotes(array.label), what));
}

/// The six bits a base64 character stands for; nothing for any other character.
std::optional<unsigned> sextet(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  if (c == '/') return 63;
  return std::nullopt;
}

/// Hands out an array's bytes from base64 or raw data. Base64 is decoded by groups of four, each with its own
/// padding: the lengths before an array may be padded on their own or run on into the data, and both read the
/// same.
class Bytes {
 public:
  Bytes(const VtkArray& array, const Source& source) : array_(array), source_(source), rest_(array.data) {
    if (array.format == VtkArray::Format::base64) {
      while (!rest_.empty() && is_space(rest_.front())) rest_.remove_prefix(1);
    }
  }

  /// No more than this many bytes can follow.
  std::uint64_t at_most() const {
    return decoded_.size() + (array_.format == VtkArray::Format::raw ? rest_.size() : rest_.size() / 4 * 3);
  }

  std::string take(std::uint64_t count) {
    if (count > at_most()) end_within();
    if (array_.format == VtkArray::Format::raw) {
      std::string bytes(rest_.substr(0, count));
      rest_.remove_prefix(count);
      return bytes;
    }
    while (decoded_.size() < count) decode_group();
    std::string bytes = decoded_.substr(0, count);
    decoded_.erase(0, count);
    return bytes;
  }

  std::uint64_t word(const VtkEncoding& encoding) {
    const std::string bytes = take(encoding.header_word);
    ByteCursor cursor({bytes, source_.name});
    if (encoding.header_word == sizeof(std::uint32_t)) return cursor.value<std::uint32_t>(encoding.order);
    return cursor.value<std::uint64_t>(encoding.order);
  }

 private:
  [[noreturn]] void end_within() const { fail(source_, array_, "its data ends within it"); }

  void decode_group() {
    if (rest_.size() < 4) end_within();
    unsigned bits = 0;
    int characters = 0;
    for (; characters < 4 && rest_[characters] != '='; ++characters) {
      const auto six = sextet(rest_[characters]);
      if (!six) fail(source_, array_, in_quotes(rest_.substr(characters, 1)) + " is no base64 character");
      bits |= *six << (18 - 6 * characters);
    }
    if (characters < 2) end_within();
    for (int byte = 0; byte < characters - 1; ++byte)
      decoded_ += static_cast<char>(bits >> (16 - 8 * byte) & 0xffu);
    rest_.remove_prefix(4);
  }

  const VtkArray& array_;
  Source source_;
  std::string_view rest_;
  std::string decoded_;
};

/// Lengths first: number of blocks, size of a block and of the last one if that is smaller, compressed size
/// of each.
std::string uncompressed_bytes(Bytes& bytes, const VtkArray& array, const VtkEncoding& encoding,
                               std::uint64_t size, const Source& source) {
  const auto blocks = bytes.word(encoding), block_size = bytes.word(encoding),
             last_size = bytes.word(encoding);
  if (blocks > bytes.at_most() / encoding.header_word)
    fail(source, array, "more blocks announced than the file can hold");
  const auto full_blocks = last_size > 0 && blocks > 0 ? blocks - 1 : blocks;
  const bool fits = full_blocks == 0 || block_size <= size / full_blocks;
  if (!fits || full_blocks * block_size + (blocks > full_blocks ? last_size : 0) != size) {
    fail(source, array, fmt::format("its blocks do not add up to the {} bytes it needs", size));
  }
  std::vector<std::uint64_t> compressed(blocks);
  std::uint64_t possible = 0;
  for (auto& length : compressed) {
    length = bytes.word(encoding);
    if (length > bytes.at_most()) fail(source, array, "its data ends within it");
    possible += length * largest_ratio;
  }
  if (size > possible) fail(source, array, fmt::format("{} bytes cannot come out of its blocks", size));
  std::string out(size, '\0');
  std::size_t at = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t expected = b < full_blocks ? block_size : last_size;
    if (!uncompress(encoding.compressor, bytes.take(compressed[b]), std::span(out).subspan(at, expected))) {
      fail(source, array, fmt::format("block {} cannot be uncompressed", b));
    }
    at += expected;
  }
  return out;
}

std::string plain_bytes(Bytes& bytes, const VtkArray& array, const VtkEncoding& encoding, std::uint64_t size,
                        const Source& source) {
  const auto stated = bytes.word(encoding);
  if (stated != size) fail(source, array, fmt::format("has {} bytes where {} are needed", stated, size));
  return bytes.take(size);
}

template <class T, class Out>
std::vector<Out> read_text(const VtkArray& array, std::uint64_t count, const Source& source) {
  if (count > (array.data.size() + 1) / 2) {
    fail(source, array, fmt::format("has not the {} numbers that its piece announces", count));
  }
  std::vector<Out> values;
  values.reserve(count);
  // Within the whole file, so that the line is the file's.
  const auto first = static_cast<std::size_t>(array.data.data() - source.bytes.data());
  TextCursor text({source.bytes.substr(0, first + array.data.size()), source.name}, first);
  const std::string what = "a number of array " + array.label;
  for (std::uint64_t i = 0; i < count; ++i) {
    using Parsed =
        std::conditional_t<sizeof(T) == 1, int, T>;  // from_chars takes a type of one byte for a letter
    values.push_back(as<Out>(text.number<Parsed>(what)));
  }
  if (!text.word().empty())
    fail(source, array, fmt::format("has more than the {} numbers that its piece announces", count));
  return values;
}

template <class T, class Out>
std::vector<Out> read_binary(const VtkArray& array, const VtkEncoding& encoding, std::uint64_t count,
                             const Source& source) {
  if (count > std::numeric_limits<std::uint64_t>::max() / sizeof(T))
    fail(source, array, "too many numbers announced");
  Bytes bytes(array, source);
  const std::string data = encoding.compressor == Compressor::none
                               ? plain_bytes(bytes, array, encoding, count * sizeof(T), source)
                               : uncompressed_bytes(bytes, array, encoding, count * sizeof(T), source);
  ByteCursor cursor({data, source.name});
  std::vector<Out> values;
  values.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    values.push_back(as<Out>(cursor.value<T>(encoding.order)));
  }
  return values;
}

template <class T, class Out>
std::vector<Out> read(const VtkArray& array, const VtkEncoding& encoding, std::uint64_t count,
                      const Source& source) {
  if (array.format == VtkArray::Format::text) return read_text<T, Out>(array, count, source);
  return read_binary<T, Out>(array, encoding, count, source);
}

}  // namespace

std::vector<double> read_coordinates(const VtkArray& array, const VtkEncoding& encoding, std::uint64_t count,
                                     const Source& source) {
  if (array.type == NumberType::f32) return read<float, double>(array, encoding, count, source);
  if (array.type == NumberType::f64) return read<double, double>(array, encoding, count, source);
  fail(source, array, "coordinates should be Float32 or Float64");
}

std::vector<std::int64_t> read_integers(const VtkArray& array, const VtkEncoding& encoding,
                                        std::uint64_t count, const Source& source) {
  return with_number_type(array.type, [&](auto zero) -> std::vector<std::int64_t> {
    if constexpr (std::is_floating_point_v<decltype(zero)>) {
      fail(source, array, "should be of an integer type");
    } else {
      return read<decltype(zero), std::int64_t>(array, encoding, count, source);
    }
  });
}

}  // namespace condyle::io
