#include "io/image/inflate.hpp"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>
#include <string>
#include <vector>

#include "io/image/byte_stream.hpp"

namespace condyle::io {
namespace {

/// Bytes of a compressed file that are read at once.
constexpr std::size_t inflate_block_size = std::size_t{1} << 16;
/// For inflateInit2: the largest window, and either of both headers.
constexpr int zlib_or_gzip = 15 + 32;

}  // namespace

struct Inflate::State {
  const ByteSource& source;
  std::uint64_t at;                                                 ///< of the next block in the source
  std::vector<char> block = std::vector<char>(inflate_block_size);  ///< of compressed bytes
  z_stream stream{};
  bool ended = false;
  std::uint64_t given = 0;  ///< bytes, for messages

  State(const ByteSource& from, std::uint64_t first) : source(from), at(first) {
    if (inflateInit2(&stream, zlib_or_gzip) != Z_OK) throw std::bad_alloc();
  }
  ~State() { inflateEnd(&stream); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  bool refill() {
    const std::size_t got = source.read(at, block);
    at += got;
    stream.next_in = reinterpret_cast<Bytef*>(block.data());
    stream.avail_in = static_cast<uInt>(got);
    return got > 0;
  }

  /// Programs that compress in parallel write gzip in pieces. Anything else behind the end is not data.
  bool starts_another_member() {
    return is_gzip(source, at - stream.avail_in) && inflateReset(&stream) == Z_OK;
  }
};

Inflate::Inflate(const ByteSource& source, std::uint64_t at) : state_(std::make_unique<State>(source, at)) {}

Inflate::~Inflate() = default;

std::uint64_t Inflate::left() const noexcept {
  return state_->source.size() - state_->at + state_->stream.avail_in;
}

std::size_t Inflate::read(std::span<char> out) {
  State& state = *state_;
  z_stream& stream = state.stream;
  std::size_t done = 0;
  while (done < out.size() && !state.ended) {
    if (stream.avail_in == 0 && !state.refill())
      state.source.fail("the compressed data end too early, after " + std::to_string(state.given + done) +
                        " bytes");
    const auto most =
        static_cast<uInt>(std::min<std::size_t>(out.size() - done, std::numeric_limits<uInt>::max()));
    stream.next_out = reinterpret_cast<Bytef*>(out.data() + done);
    stream.avail_out = most;
    const int result = ::inflate(&stream, Z_NO_FLUSH);
    done += most - stream.avail_out;
    if (result == Z_STREAM_END) {
      state.ended = !state.starts_another_member();
    } else if (result == Z_MEM_ERROR) {
      throw std::bad_alloc();
    } else if (result != Z_OK && result != Z_BUF_ERROR) {
      state.source.fail("the compressed data are damaged after " + std::to_string(state.given + done) +
                        " bytes");
    }
  }
  state.given += done;
  return done;
}

}  // namespace condyle::io
