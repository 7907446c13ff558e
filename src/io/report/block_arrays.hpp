#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/result/json.hpp"

namespace condyle::io {

template <class Element>
inline constexpr std::string_view type_name = "";
template <>
inline constexpr std::string_view type_name<double> = "f64";
template <>
inline constexpr std::string_view type_name<std::uint32_t> = "u32";
template <>
inline constexpr std::string_view type_name<std::int16_t> = "i16";
template <>
inline constexpr std::string_view type_name<std::uint8_t> = "u8";

/// BlockArrays back to back, and what the JSON says of them.
class BlockArrays {
 public:
  /// Where an array may begin, at `bytes` or behind.
  static std::size_t aligned(std::size_t bytes) noexcept {
    constexpr std::size_t alignment = 8;
    return (bytes + alignment - 1) / alignment * alignment;
  }

  /// Returns the name.
  template <class Element>
  std::string add(std::string name, const std::vector<Element>& elements) {
    bytes_.resize(aligned(bytes_.size()), '\0');
    directory_[name] = {{"type", type_name<Element>}, {"offset", bytes_.size()}, {"length", elements.size()}};
    bytes_.append(reinterpret_cast<const char*>(elements.data()), elements.size() * sizeof(Element));
    return name;
  }

  const Json& directory() const noexcept { return directory_; }
  const std::string& bytes() const noexcept { return bytes_; }

 private:
  Json directory_ = Json::object();
  std::string bytes_;
};

}  // namespace condyle::io
