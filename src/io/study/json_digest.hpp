#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/io/mesh_file.hpp"

namespace condyle::io {

/// SHA-256 of a value, byte for byte: as CBOR (RFC 8949), which keeps texts that are no UTF-8 apart.
inline std::string sha256_of(const nlohmann::json& json) {
  const std::vector<std::uint8_t> bytes = nlohmann::json::to_cbor(json);
  return digest_of(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size())).sha256;
}

}  // namespace condyle::io
