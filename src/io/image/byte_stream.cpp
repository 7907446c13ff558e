#include "io/image/byte_stream.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>
#include <new>

namespace condyle::io {
namespace {

/// Bytes of a compressed file that are read at once.
constexpr std::size_t stream_block_size = std::size_t{1} << 16;
/// Deflate needs at least two bits for 258 bytes.
constexpr std::uint64_t largest_deflate_ratio = 1032;
/// For inflateInit2: the largest window, and either of both headers.
constexpr int zlib_or_gzip = 15 + 32;

constexpr std::array<unsigned char, 2> gzip_magic = {0x1f, 0x8b};

}  // namespace

struct ByteStream::Inflate {
  z_stream stream{};
  bool ended = false;
  std::uint64_t given = 0;  ///< bytes, for messages

  Inflate() {
    if (inflateInit2(&stream, zlib_or_gzip) != Z_OK) throw std::bad_alloc();
  }
  ~Inflate() { inflateEnd(&stream); }
  Inflate(const Inflate&) = delete;
  Inflate& operator=(const Inflate&) = delete;
};

ByteStream::ByteStream(const ByteSource& source, std::uint64_t at, Packing packing)
    : source_(source), at_(std::min(at, source.size())) {
  if (packing == Packing::none) return;
  block_.resize(stream_block_size);
  inflate_ = std::make_unique<Inflate>();
}

ByteStream::~ByteStream() = default;

std::size_t ByteStream::read(std::span<char> out) {
  if (inflate_) return inflate(out);
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
  std::vector<char> passed(static_cast<std::size_t>(std::min<std::uint64_t>(bytes, stream_block_size)));
  while (bytes > 0) {
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(bytes, passed.size()));
    if (inflate(std::span(passed).first(wanted)) < wanted) return false;
    bytes -= wanted;
  }
  return true;
}

bool ByteStream::has_more(std::uint64_t read_at_most) {
  if (!inflate_) return at_ < source_.size();
  char first = 0;
  if (inflate({&first, 1}) == 0) return false;
  skip(read_at_most);
  return true;
}

bool ByteStream::may_hold(std::uint64_t bytes) const noexcept {
  const std::uint64_t left = source_.size() - at_;
  if (!inflate_) return bytes <= left;
  const std::uint64_t compressed = left + inflate_->stream.avail_in;
  // Zlib may still hold a window of bytes and a match back.
  constexpr std::uint64_t in_flight = (std::uint64_t{1} << 15) + 258;
  return bytes <= in_flight || (bytes - in_flight) / largest_deflate_ratio <= compressed;
}

bool ByteStream::refill() {
  auto& stream = inflate_->stream;
  const std::size_t got = source_.read(at_, block_);
  at_ += got;
  stream.next_in = reinterpret_cast<Bytef*>(block_.data());
  stream.avail_in = static_cast<uInt>(got);
  return got > 0;
}

/// Programs that compress in parallel write gzip in pieces. Anything else behind the end is not data.
bool ByteStream::starts_another_member() {
  auto& stream = inflate_->stream;
  std::array<char, 2> next{};
  const std::uint64_t place = at_ - stream.avail_in;
  if (source_.read(place, next) < next.size()) return false;
  for (std::size_t i = 0; i < next.size(); ++i)
    if (static_cast<unsigned char>(next[i]) != gzip_magic[i]) return false;
  return inflateReset(&stream) == Z_OK;
}

std::size_t ByteStream::inflate(std::span<char> out) {
  auto& stream = inflate_->stream;
  std::size_t done = 0;
  while (done < out.size() && !inflate_->ended) {
    if (stream.avail_in == 0 && !refill())
      fail("the compressed data end too early, after " + std::to_string(inflate_->given + done) + " bytes");
    const auto most =
        static_cast<uInt>(std::min<std::size_t>(out.size() - done, std::numeric_limits<uInt>::max()));
    stream.next_out = reinterpret_cast<Bytef*>(out.data() + done);
    stream.avail_out = most;
    const int result = ::inflate(&stream, Z_NO_FLUSH);
    done += most - stream.avail_out;
    if (result == Z_STREAM_END) {
      inflate_->ended = !starts_another_member();
    } else if (result == Z_MEM_ERROR) {
      throw std::bad_alloc();
    } else if (result != Z_OK && result != Z_BUF_ERROR) {
      fail("the compressed data are damaged after " + std::to_string(inflate_->given + done) + " bytes");
    }
  }
  inflate_->given += done;
  return done;
}

bool is_gzip(const ByteSource& source) {
  std::array<char, 2> first{};
  return source.read(0, first) == first.size() &&
         std::equal(first.begin(), first.end(), gzip_magic.begin(),
                    [](char a, unsigned char b) { return static_cast<unsigned char>(a) == b; });
}

}  // namespace condyle::io
