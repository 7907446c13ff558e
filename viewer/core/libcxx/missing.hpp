#pragma once

/// Parts of the C++20 library that emscripten 3.1.6 (libc++ 13) lacks and the core uses. Read before every source of
/// the core.

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <compare>
#include <cstdlib>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

// Eigen sums in the order of x86-64, by SSE2, of which emscripten makes WebAssembly's instructions. The compiler must not look like
// GCC, whose faults Eigen gets round by assembly.
#include <complex>
#define EIGEN_ARCH_DEFAULT_NUMBER_OF_REGISTERS 16
#pragma push_macro("__GNUC__")
#undef __GNUC__
#include <Eigen/src/Core/util/Macros.h>
#pragma pop_macro("__GNUC__")

namespace std {

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}

template <class T>
requires(!is_array_v<T>) unique_ptr<T> make_unique_for_overwrite() {
  return unique_ptr<T>(new T);
}
template <class T>
requires is_unbounded_array_v<T> unique_ptr<T> make_unique_for_overwrite(size_t count) {
  return unique_ptr<T>(new remove_extent_t<T>[count]);
}

template <class T, size_t N>
constexpr auto operator<=>(const array<T, N>& a, const array<T, N>& b) -> decltype(a[0] <=> b[0]) {
  for (size_t i = 0; i < N; ++i)
    if (const auto order = a[i] <=> b[i]; order != 0) return order;
  return strong_ordering::equal;
}
template <class A, class B>
constexpr auto operator<=>(const pair<A, B>& a, const pair<A, B>& b)
    -> common_comparison_category_t<decltype(a.first <=> b.first), decltype(a.second <=> b.second)> {
  if (const auto first = a.first <=> b.first; first != 0) return first;
  return a.second <=> b.second;
}

/// Decimal numbers, infinities and NaN, as strtod() of this library reads them: rounded to nearest. What it takes beyond those is
/// refused: blanks, a plus, hexadecimal digits.
template <class T>
requires is_floating_point_v<T> from_chars_result from_chars(const char* first, const char* last, T& value) {
  const string word(first, last);
  if (word.empty() || word.find_first_of("xX \t\n\v\f\r+") == 0 || word.find_first_of("xX") != string::npos)
    return {first, errc::invalid_argument};
  char* end = nullptr;
  errno = 0;
  const T read = is_same_v<T, float> ? static_cast<T>(strtof(word.c_str(), &end))
                                     : static_cast<T>(strtod(word.c_str(), &end));
  if (end == word.c_str()) return {first, errc::invalid_argument};
  const char* after = first + (end - word.c_str());
  // Numbers that are merely denormal are numbers.
  if (errno == ERANGE && (read == 0 || isinf(read))) return {after, errc::result_out_of_range};
  value = read;
  return {after, errc()};
}

}  // namespace std
