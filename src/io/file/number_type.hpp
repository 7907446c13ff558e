#pragma once

#include <cstddef>
#include <cstdint>

namespace condyle::io {

/// Numbers as meshes and images hold them.
enum class NumberType { u8, i8, u16, i16, u32, i32, u64, i64, f32, f64 };

constexpr bool is_floating(NumberType type) noexcept {
  return type == NumberType::f32 || type == NumberType::f64;
}

/// Calls with a zero of the C++ type.
template <class Call>
constexpr auto with_number_type(NumberType type, const Call& call) {
  switch (type) {
    case NumberType::u8:
      return call(std::uint8_t{});
    case NumberType::i8:
      return call(std::int8_t{});
    case NumberType::u16:
      return call(std::uint16_t{});
    case NumberType::i16:
      return call(std::int16_t{});
    case NumberType::u32:
      return call(std::uint32_t{});
    case NumberType::i32:
      return call(std::int32_t{});
    case NumberType::u64:
      return call(std::uint64_t{});
    case NumberType::i64:
      return call(std::int64_t{});
    case NumberType::f32:
      return call(float{});
    case NumberType::f64:
      break;
  }
  return call(double{});
}

constexpr std::size_t bytes_of(NumberType type) noexcept {
  return with_number_type(type, [](auto zero) { return sizeof zero; });
}

}  // namespace condyle::io
