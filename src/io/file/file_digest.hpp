#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "condyle/io/mesh_file.hpp"

namespace condyle::io {

/// SHA-256 (FIPS 180-4) of bytes that come part by part; digest_of() of all at once.
class Digester {
 public:
  Digester() noexcept;
  void add(std::string_view part);
  FileDigest digest() const;

 private:
  std::array<std::uint32_t, 8> H_;
  std::string rest_;  ///< less than a block
  std::uint64_t bytes_ = 0;
};

}  // namespace condyle::io
