#include "io/file/compressed.hpp"

namespace condyle::io {

std::string_view packed_by(std::string_view bytes) noexcept {
  struct Packer {
    std::string_view begins_with, name;
  };
  using namespace std::string_view_literals;
  static constexpr Packer packers[] = {{"\x1F\x8B\x08"sv, "gzip"},
                                       {"PK\3\4"sv, "zip"},
                                       {"BZh"sv, "bzip2"},
                                       {"\xFD"
                                        "7zXZ\0"sv,
                                        "xz"},
                                       {"\x28\xB5\x2F\xFD"sv, "zstd"}};
  for (const auto& packer : packers)
    if (bytes.starts_with(packer.begins_with)) return packer.name;
  return {};
}

}  // namespace condyle::io
