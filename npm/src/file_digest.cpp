#include "io/file/file_digest.hpp"

/// SHA-256 by node (glue.js): compiled here, its one loop would stay as V8 compiles it first, and take longer than many an answer.

extern "C" {
std::uint32_t condyle_hash_begin();
void condyle_hash_add(std::uint32_t hash, const char* bytes, std::size_t size);
void condyle_hash_digits(std::uint32_t hash, char* digits);
}

namespace condyle::io {

// The first of its words is the number of node's hash.
Digester::Digester() noexcept : H_{condyle_hash_begin()} {}

void Digester::add(std::string_view part) {
  bytes_ += part.size();
  condyle_hash_add(H_.front(), part.data(), part.size());
}

FileDigest Digester::digest() const {
  FileDigest digest{bytes_, std::string(64, '0')};
  condyle_hash_digits(H_.front(), digest.sha256.data());
  return digest;
}

FileDigest digest_of(std::string_view contents) {
  Digester digester;
  digester.add(contents);
  return digester.digest();
}

}  // namespace condyle::io
