#include "io/file/file_digest.hpp"

#include <algorithm>
#include <bit>

namespace condyle::io {
namespace {

/// SHA-256 of FIPS 180-4; its section numbers and letters.
constexpr std::size_t block_bytes = 64;

/// Section 4.2.2: the first 32 bits of the fractional parts of the cube roots of the first 64 primes.
constexpr std::array<std::uint32_t, 64> K = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

using HashWords = std::array<std::uint32_t, 8>;

/// Section 5.3.3: of the square roots of the first 8 primes.
constexpr HashWords first_hash = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                  0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};

/// Section 6.2.2: one block of 64 bytes.
void add_block(HashWords& H, const char* block) noexcept {
  std::array<std::uint32_t, 64> W;
  for (std::size_t t = 0; t < 16; ++t) {
    W[t] = 0;
    for (std::size_t k = 0; k < 4; ++k) W[t] = W[t] << 8 | static_cast<unsigned char>(block[4 * t + k]);
  }
  for (std::size_t t = 16; t < 64; ++t) {
    const std::uint32_t s0 = std::rotr(W[t - 15], 7) ^ std::rotr(W[t - 15], 18) ^ W[t - 15] >> 3;
    const std::uint32_t s1 = std::rotr(W[t - 2], 17) ^ std::rotr(W[t - 2], 19) ^ W[t - 2] >> 10;
    W[t] = s1 + W[t - 7] + s0 + W[t - 16];
  }
  auto [a, b, c, d, e, f, g, h] = H;
  for (std::size_t t = 0; t < 64; ++t) {
    const std::uint32_t S1 = std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25);
    const std::uint32_t T1 = h + S1 + ((e & f) ^ (~e & g)) + K[t] + W[t];
    const std::uint32_t S0 = std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22);
    const std::uint32_t T2 = S0 + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + T1, d = c, c = b, b = a, a = T1 + T2;
  }
  H = {H[0] + a, H[1] + b, H[2] + c, H[3] + d, H[4] + e, H[5] + f, H[6] + g, H[7] + h};
}

/// Whole blocks.
void add_blocks(HashWords& H, std::string_view blocks) noexcept {
  for (std::size_t at = 0; at < blocks.size(); at += block_bytes) add_block(H, blocks.data() + at);
}

}  // namespace

Digester::Digester() noexcept : H_(first_hash) {}

void Digester::add(std::string_view part) {
  bytes_ += part.size();
  if (!rest_.empty()) {
    const std::size_t more = std::min(part.size(), block_bytes - rest_.size());
    rest_ += part.substr(0, more);
    part.remove_prefix(more);
    if (rest_.size() < block_bytes) return;
    add_blocks(H_, rest_);
    rest_.clear();
  }
  const std::size_t whole = part.size() / block_bytes * block_bytes;
  add_blocks(H_, part.substr(0, whole));
  rest_ += part.substr(whole);
}

/// Section 5.1.1: what follows the last whole block is a bit 1, noughts, and the number of bits in eight bytes.
FileDigest Digester::digest() const {
  std::string end = rest_ + '\x80';
  while (end.size() % block_bytes != block_bytes - 8) end += '\0';
  for (int shift = 56; shift >= 0; shift -= 8) end += static_cast<char>(8 * bytes_ >> shift & 0xff);
  HashWords H = H_;
  add_blocks(H, end);
  FileDigest digest{bytes_, {}};
  for (const std::uint32_t word : H)
    for (int shift = 28; shift >= 0; shift -= 4) digest.sha256 += "0123456789abcdef"[word >> shift & 0xf];
  return digest;
}

FileDigest digest_of(std::string_view contents) {
  Digester digester;
  digester.add(contents);
  return digester.digest();
}

}  // namespace condyle::io
