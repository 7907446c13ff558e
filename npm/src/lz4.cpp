#include <lz4.h>

#include <algorithm>
#include <cstdint>
#include <span>

namespace {

constexpr int damaged = -1;
constexpr std::size_t least_copy = 4, continued = 15;

/// What is left of a block.
class Block {
 public:
  explicit Block(std::span<const char> bytes) : left_(bytes) {}

  bool is_empty() const { return left_.empty(); }

  /// -1 past the end.
  int byte() {
    if (left_.empty()) return -1;
    const int value = static_cast<unsigned char>(left_.front());
    left_ = left_.subspan(1);
    return value;
  }

  /// A length that begins in four bits of a token, as far as `most`; false past either end.
  bool read_length(std::size_t& length, std::size_t most) {
    for (int more = length == continued ? 255 : 0; more == 255; length += static_cast<std::size_t>(more))
      if ((more = byte()) < 0 || length > most) return false;
    return length <= most;
  }

  bool take(std::size_t count, char* out) {
    if (count > left_.size()) return false;
    std::copy_n(left_.begin(), count, out);
    left_ = left_.subspan(count);
    return true;
  }

 private:
  std::span<const char> left_;
};

}  // namespace

int LZ4_decompress_safe(const char* bytes, char* out, int block_bytes, int out_bytes) {
  Block block({bytes, static_cast<std::size_t>(block_bytes)});
  const auto size = static_cast<std::size_t>(out_bytes);
  std::size_t at = 0;
  for (;;) {
    const int token = block.byte();
    if (token < 0) return damaged;
    std::size_t literals = static_cast<std::size_t>(token >> 4),
                copied = static_cast<std::size_t>(token & 15);
    if (!block.read_length(literals, size - at) || !block.take(literals, out + at)) return damaged;
    at += literals;
    if (block.is_empty()) return static_cast<int>(at);
    const int low = block.byte(), high = block.byte();
    if (high < 0) return damaged;
    const auto back = static_cast<std::size_t>(low | high << 8);
    if (back == 0 || back > at || !block.read_length(copied, size) || copied + least_copy > size - at)
      return damaged;
    // Where it reaches into itself, what it has just written is what it copies.
    for (copied += least_copy; copied > 0; --copied, ++at) out[at] = out[at - back];
  }
}
