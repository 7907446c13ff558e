#include "io/image/byte_stream.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace condyle::io {
namespace {

/// Bytes of inflated data that are passed over at once.
constexpr std::size_t skip_block_size = std::size_t{1} << 16;
/// Deflate needs at least two bits for 258 bytes.
constexpr std::uint64_t largest_deflate_ratio = 1032;

constexpr std::array<unsigned char, 2> gzip_magic = {0x1f, 0x8b};

}  // namespace

ByteStream::ByteStream(const ByteSource& source, std::uint64_t at, Packing packing)
    : source_(source), at_(std::min(at, source.size())) {
  if (packing == Packing::deflated) inflate_.emplace(source_, at_);
}

std::size_t ByteStream::read(std::span<char> out) {
  if (inflate_) return inflate_->read(out);
  const std::size_t got = source_.read(at_, out);
  at_ += got;
  return got;
}

bool ByteStream::skip(std::uint64_t bytes) {
  if (!inflate_) {
    const bool there = bytes <= source_.size() - at_;
    at_ = there ? at_ + bytes : source_.size();
    return there;
  }
  std::vector<char> passed(static_cast<std::size_t>(std::min<std::uint64_t>(bytes, skip_block_size)));
  while (bytes > 0) {
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(bytes, passed.size()));
    if (inflate_->read(std::span(passed).first(wanted)) < wanted) return false;
    bytes -= wanted;
  }
  return true;
}

bool ByteStream::has_more(std::uint64_t read_at_most) {
  if (!inflate_) return at_ < source_.size();
  char first = 0;
  if (inflate_->read({&first, 1}) == 0) return false;
  skip(read_at_most);
  return true;
}

bool ByteStream::may_hold(std::uint64_t bytes) const noexcept {
  if (!inflate_) return bytes <= source_.size() - at_;
  // Zlib may still hold a window of bytes and a match back.
  constexpr std::uint64_t in_flight = (std::uint64_t{1} << 15) + 258;
  return bytes <= in_flight || (bytes - in_flight) / largest_deflate_ratio <= inflate_->left();
}

bool is_gzip(const ByteSource& source, std::uint64_t at) {
  std::array<char, 2> first{};
  return source.read(at, first) == first.size() &&
         std::equal(first.begin(), first.end(), gzip_magic.begin(),
                    [](char a, unsigned char b) { return static_cast<unsigned char>(a) == b; });
}

}  // namespace condyle::io
