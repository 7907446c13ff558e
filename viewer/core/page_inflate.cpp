#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "io/image/byte_stream.hpp"

/// DEFLATE (RFC 1951) in zlib (RFC 1950) or gzip (RFC 1952) for the page, for which there is no zlib: it gives the bytes that zlib
/// gives and refuses what zlib refuses, after as many bytes. In JavaScript nothing that a worker can wait for checks sums, reads
/// several members and says where a stream ends.

namespace condyle::io {
namespace {

constexpr std::size_t read_size = std::size_t{1} << 16;  // bytes of compressed data at once
constexpr std::size_t window_size = std::size_t{1} << 15;
constexpr int longest_code = 15;

/// Thrown where the compressed data end.
struct EndsEarly {};
/// Thrown where they are none.
struct Damaged {};

/// The bits of a source, the lowest of each byte first.
class Bits {
 public:
  Bits(const ByteSource& source, std::uint64_t at) : source_(source), at_(at) {}

  /// The next bits without taking them, with zeros behind the end; at most 32.
  std::uint32_t peek(int count) {
    while (held_ < count && refill())
      for (; held_ <= 56 && used_ < block_.size(); held_ += 8)
        bits_ |= std::uint64_t{static_cast<unsigned char>(block_[used_++])} << held_;
    return static_cast<std::uint32_t>(bits_ & ((std::uint64_t{1} << count) - 1));
  }
  void drop(int count) {
    if (count > held_) throw EndsEarly();
    bits_ >>= count;
    held_ -= count;
  }
  std::uint32_t take(int count) {
    const std::uint32_t bits = peek(count);
    drop(count);
    return bits;
  }
  void to_next_byte() { drop(held_ % 8); }
  /// Of the next byte that holds no bit that was taken.
  std::uint64_t place() const noexcept {
    return at_ - (block_.size() - used_) - static_cast<std::uint64_t>(held_ / 8);
  }

 private:
  bool refill() {
    if (used_ < block_.size()) return true;
    block_.resize(read_size);
    block_.resize(source_.read(at_, block_));
    at_ += block_.size();
    used_ = 0;
    return !block_.empty();
  }

  const ByteSource& source_;
  std::uint64_t at_;  ///< of the next block
  std::vector<char> block_ = {};
  std::size_t used_ = 0;
  std::uint64_t bits_ = 0;
  int held_ = 0;
};

/// A Huffman code, its symbols by the bits that follow in the stream.
class Code {
 public:
  /// By the length of each symbol's code, 0 for symbols without one. `may_be_single`: a code of one symbol, of one bit, may leave the
  /// other bit unused.
  Code(std::span<const std::uint8_t> lengths, bool may_be_single) {
    std::array<unsigned, longest_code + 1> count{}, next{};
    for (const std::uint8_t length : lengths) ++count[length];
    count[0] = 0;
    for (int length = 1; length <= longest_code; ++length)
      if (count[static_cast<std::size_t>(length)] > 0) longest_ = length;
    check(count, may_be_single);
    for (std::size_t length = 1; length < longest_code; ++length)
      next[length + 1] = (next[length] + count[length]) << 1;
    entries_.assign(std::size_t{1} << longest_, 0);
    for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol)
      if (const std::uint8_t length = lengths[symbol]; length > 0) enter(symbol, next[length]++, length);
  }

  unsigned symbol(Bits& bits) const {
    const std::uint16_t entry = entries_[bits.peek(longest_)];
    if (entry == 0) {
      bits.drop(1);  // where nothing follows, that is what is wrong
      throw Damaged();
    }
    bits.drop(entry & 15);
    return entry >> 4;
  }

 private:
  /// Codes of all lengths have to fill the tree, unless there are none: then it is the first use that is refused.
  void check(const std::array<unsigned, longest_code + 1>& count, bool may_be_single) const {
    int left = 1;
    for (std::size_t length = 1; length <= longest_code; ++length)
      if (left = 2 * left - static_cast<int>(count[length]); left < 0) throw Damaged();
    if (left > 0 && longest_ > 0 && !(may_be_single && longest_ == 1)) throw Damaged();
  }
  /// The stream has the highest bit of a code first.
  void enter(std::size_t symbol, unsigned code, int length) {
    std::size_t reversed = 0;
    for (int bit = 0; bit < length; ++bit) reversed |= ((code >> bit) & 1U) << (length - 1 - bit);
    for (; reversed < entries_.size(); reversed += std::size_t{1} << length)
      entries_[reversed] = static_cast<std::uint16_t>(symbol << 4 | static_cast<unsigned>(length));
  }

  int longest_ = 0;
  std::vector<std::uint16_t> entries_;  ///< symbol and length of its code; 0 for bits that are none
};

/// The sum that ends a member.
class Sum {
 public:
  void restart(bool is_gzip) { is_gzip_ = is_gzip, low_ = is_gzip ? ~0U : 1, high_ = 0; }
  void add(std::span<const std::uint8_t> bytes) {
    if (!is_gzip_) return add_adler(bytes);
    for (const std::uint8_t byte : bytes) low_ = table()[(low_ ^ byte) & 255] ^ low_ >> 8;
  }
  std::uint32_t value() const noexcept { return is_gzip_ ? ~low_ : high_ << 16 | low_; }

 private:
  void add_adler(std::span<const std::uint8_t> bytes) {
    constexpr std::size_t before_overflow = 5552;
    constexpr std::uint32_t prime = 65521;
    while (!bytes.empty()) {
      const auto some = bytes.first(std::min(bytes.size(), before_overflow));
      for (const std::uint8_t byte : some) high_ += low_ += byte;
      low_ %= prime, high_ %= prime;
      bytes = bytes.subspan(some.size());
    }
  }
  static const std::array<std::uint32_t, 256>& table() {
    static const auto made = [] {
      std::array<std::uint32_t, 256> sums{};
      for (std::uint32_t byte = 0; byte < 256; ++byte) {
        std::uint32_t sum = byte;
        for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ (sum & 1U ? 0xedb88320U : 0U);
        sums[byte] = sum;
      }
      return sums;
    }();
    return made;
  }

  bool is_gzip_ = false;
  std::uint32_t low_ = 1, high_ = 0;
};

/// What a symbol of a length or of a distance stands for: its least value, and how many bits are added to it.
struct Range {
  std::uint16_t least;
  std::uint8_t bits;
};

/// Symbols 257 to 285.
constexpr std::array<Range, 29> lengths_of = [] {
  std::array<Range, 29> ranges{};
  std::uint16_t least = 3;
  for (std::size_t i = 0; i < 28; ++i) {
    const auto bits = static_cast<std::uint8_t>(i < 8 ? 0 : i / 4 - 1);
    ranges[i] = {least, bits};
    least = static_cast<std::uint16_t>(least + (1 << bits));
  }
  ranges[28] = {258, 0};
  return ranges;
}();

constexpr std::array<Range, 30> distances_of = [] {
  std::array<Range, 30> ranges{};
  std::uint16_t least = 1;
  for (std::size_t i = 0; i < 30; ++i) {
    const auto bits = static_cast<std::uint8_t>(i < 4 ? 0 : i / 2 - 1);
    ranges[i] = {least, bits};
    least = static_cast<std::uint16_t>(least + (1 << bits));
  }
  return ranges;
}();

}  // namespace

struct Inflate::State {
  enum class Part { header, block, stored, coded, trailer, end };

  const ByteSource& source;
  Bits bits;
  Part part = Part::header;
  bool is_gzip_member = false, is_last_block = false;
  std::size_t stored_left = 0;
  std::vector<Code> codes = {};  ///< of lengths and literals, and of distances
  Sum sum = {};
  /// Bytes that were made: some that were read, for matches to reach back to, then those to read.
  std::vector<std::uint8_t> made = {};
  std::size_t taken = 0, summed = 0;  ///< of those
  std::uint64_t trimmed = 0;          ///< bytes made before those
  std::uint64_t member_begins = 0;    ///< among all bytes

  State(const ByteSource& from, std::uint64_t at) : source(from), bits(from, at) {}

  std::uint64_t all_made() const noexcept { return trimmed + made.size(); }

  void add_to_sum() {
    sum.add(std::span(made).subspan(summed));
    summed = made.size();
  }

  /// Forgets what no match can reach any more.
  void trim() {
    if (taken < 8 * window_size) return;
    add_to_sum();
    const std::size_t old = taken - window_size;
    made.erase(made.begin(), made.begin() + static_cast<std::ptrdiff_t>(old));
    taken -= old, summed -= old, trimmed += old;
  }

  /// Makes bytes until so many are there to read, or all are.
  void make(std::size_t wanted) {
    while (made.size() - taken < wanted && part != Part::end) {
      switch (part) {
        case Part::header:
          read_header();
          break;
        case Part::block:
          begin_block();
          break;
        case Part::stored:
          copy_stored(wanted);
          break;
        case Part::coded:
          decode(wanted);
          break;
        case Part::trailer:
          check_trailer();
          break;
        case Part::end:
          break;
      }
    }
  }

  void read_header() {
    is_gzip_member = bits.peek(16) == 0x8b1f;
    sum.restart(is_gzip_member);
    member_begins = all_made();
    if (is_gzip_member)
      read_gzip_header();
    else
      read_zlib_header();
    part = Part::block;
  }

  void read_zlib_header() {
    const std::uint32_t method = bits.take(8), flags = bits.take(8);
    constexpr std::uint32_t with_dictionary = 0x20;
    if ((method << 8 | flags) % 31 != 0 || (method & 15) != 8 || method >> 4 > 7 || flags & with_dictionary)
      throw Damaged();
  }

  void read_gzip_header() {
    Sum of_header;
    of_header.restart(true);
    const auto next = [&] {
      const auto byte = static_cast<std::uint8_t>(bits.take(8));
      of_header.add({&byte, 1});
      return byte;
    };
    next(), next();
    if (next() != 8) throw Damaged();
    const std::uint8_t flags = next();
    if (flags & 0xe0) throw Damaged();
    for (int i = 0; i < 6; ++i) next();  // time, level and system
    if (flags & 4) {
      std::size_t extra = next();
      extra |= static_cast<std::size_t>(next()) << 8;
      while (extra-- > 0) next();
    }
    for (const int text : {8, 16})
      if (flags & text)
        while (next() != 0) {
        }
    if (flags & 2 && bits.take(16) != (of_header.value() & 0xffff)) throw Damaged();
  }

  void begin_block() {
    is_last_block = bits.take(1) == 1;
    switch (bits.take(2)) {
      case 0:
        bits.to_next_byte();
        stored_left = bits.take(16);
        if ((bits.take(16) ^ stored_left) != 0xffff) throw Damaged();
        part = Part::stored;
        return;
      case 1:
        use_fixed_codes();
        break;
      case 2:
        read_codes();
        break;
      default:
        throw Damaged();
    }
    part = Part::coded;
  }

  void use_fixed_codes() {
    std::array<std::uint8_t, 288> lengths;
    for (std::size_t i = 0; i < lengths.size(); ++i) lengths[i] = i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8;
    std::array<std::uint8_t, 32> of_distances;
    of_distances.fill(5);
    codes.clear();
    codes.emplace_back(lengths, false);
    codes.emplace_back(of_distances, false);
  }

  void read_codes() {
    const std::size_t literals = bits.take(5) + 257, distances = bits.take(5) + 1, meta = bits.take(4) + 4;
    if (literals > 286 || distances > 30) throw Damaged();
    constexpr std::uint8_t order[] = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};
    std::array<std::uint8_t, 19> of_lengths{};
    for (std::size_t i = 0; i < meta; ++i) of_lengths[order[i]] = static_cast<std::uint8_t>(bits.take(3));
    const std::vector<std::uint8_t> lengths = read_lengths(Code(of_lengths, false), literals + distances);
    if (lengths[256] == 0) throw Damaged();  // without it no block ends
    codes.clear();
    codes.emplace_back(std::span(lengths).first(literals), true);
    codes.emplace_back(std::span(lengths).subspan(literals), true);
  }

  std::vector<std::uint8_t> read_lengths(const Code& code, std::size_t count) {
    std::vector<std::uint8_t> lengths;
    while (lengths.size() < count) {
      const unsigned symbol = code.symbol(bits);
      if (symbol < 16) {
        lengths.push_back(static_cast<std::uint8_t>(symbol));
        continue;
      }
      const std::size_t times = symbol == 16   ? 3 + bits.take(2)
                                : symbol == 17 ? 3 + bits.take(3)
                                               : 11 + bits.take(7);
      if (times > count - lengths.size() || (symbol == 16 && lengths.empty())) throw Damaged();
      lengths.insert(lengths.end(), times, symbol == 16 ? lengths.back() : std::uint8_t{0});
    }
    return lengths;
  }

  void end_block() { part = is_last_block ? Part::trailer : Part::block; }

  void copy_stored(std::size_t wanted) {
    for (; stored_left > 0 && made.size() - taken < wanted; --stored_left)
      made.push_back(static_cast<std::uint8_t>(bits.take(8)));
    if (stored_left == 0) end_block();
  }

  void decode(std::size_t wanted) {
    while (made.size() - taken < wanted) {
      const unsigned symbol = codes[0].symbol(bits);
      if (symbol == 256) return end_block();
      if (symbol < 256)
        made.push_back(static_cast<std::uint8_t>(symbol));
      else
        copy_match(symbol - 257);
    }
  }

  void copy_match(std::size_t symbol) {
    if (symbol >= lengths_of.size()) throw Damaged();
    const std::size_t length = lengths_of[symbol].least + bits.take(lengths_of[symbol].bits);
    const unsigned far = codes[1].symbol(bits);
    if (far >= distances_of.size()) throw Damaged();
    const std::size_t distance = distances_of[far].least + bits.take(distances_of[far].bits);
    if (distance > all_made() - member_begins) throw Damaged();
    made.resize(made.size() + length);
    std::uint8_t* to = made.data() + made.size() - length;
    const std::uint8_t* from = to - distance;
    if (distance == 1)
      std::memset(to, *from, length);
    else if (distance >= length)
      std::memcpy(to, from, length);
    else  // What was copied is copied again.
      for (std::size_t i = 0; i < length; ++i) to[i] = from[i];
  }

  /// Programs that compress in parallel write gzip in pieces. Anything else behind the end is not data.
  void check_trailer() {
    add_to_sum();
    bits.to_next_byte();
    std::uint32_t said = 0;
    for (int i = 0; i < 4; ++i) said |= bits.take(8) << 8 * (is_gzip_member ? i : 3 - i);
    if (said != sum.value()) throw Damaged();
    if (is_gzip_member && bits.take(32) != static_cast<std::uint32_t>(all_made() - member_begins))
      throw Damaged();
    part = is_gzip(source, bits.place()) ? Part::header : Part::end;
  }
};

Inflate::Inflate(const ByteSource& source, std::uint64_t at) : state_(std::make_unique<State>(source, at)) {}

Inflate::~Inflate() = default;

std::uint64_t Inflate::left() const noexcept {
  return state_->source.size() - state_->bits.place();
}

std::size_t Inflate::read(std::span<char> out) {
  State& state = *state_;
  std::size_t done = 0;
  while (done < out.size()) {
    try {
      state.make(std::min(out.size() - done, window_size));
    } catch (const EndsEarly&) {
      state.source.fail("the compressed data end too early, after " + std::to_string(state.all_made()) +
                        " bytes");
    } catch (const Damaged&) {
      state.source.fail("the compressed data are damaged after " + std::to_string(state.all_made()) +
                        " bytes");
    }
    const std::size_t some = std::min(out.size() - done, state.made.size() - state.taken);
    if (some == 0) break;
    std::copy_n(state.made.data() + state.taken, some, out.data() + done);
    state.taken += some, done += some;
    state.trim();
  }
  return done;
}

}  // namespace condyle::io
