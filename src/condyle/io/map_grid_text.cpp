#include "condyle/io/map_grid_text.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

#include "condyle/core/error.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/io/quoted.hpp"

namespace condyle {
namespace {

[[noreturn]] void refuse(std::string_view text, std::string_view why) {
  throw UsageError(fmt::format("map: {}: {}", quoted(text), why));
}

double degrees_from(std::string_view number, std::string_view text) {
  const std::string_view digits =
      number.starts_with('+') && !number.starts_with("+-") ? number.substr(1) : number;
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value))
    refuse(text, fmt::format("{} is not a number of degrees", quoted(number)));
  return value;
}

}  // namespace

GridAxis parse_grid_axis(std::string_view text) {
  constexpr std::string_view form = "is not of the form flexion=-20:120:1 (first:last:step, degrees)";
  const std::size_t equals = text.find('=');
  if (equals == text.npos) refuse(text, form);
  std::array<double, 3> numbers{};
  std::string_view rest = text.substr(equals + 1);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::size_t colon = rest.find(':');
    if ((colon == rest.npos) != (i + 1 == numbers.size())) refuse(text, form);
    numbers[i] = degrees_from(rest.substr(0, colon), text);
    if (colon != rest.npos) rest.remove_prefix(colon + 1);
  }
  const auto [first, last, step] = numbers;
  if (last < first) refuse(text, "the range is empty: it ends before it begins");
  if (!(step > 0)) refuse(text, "the step must be above 0 degrees");
  return {joint_angle_named(text.substr(0, equals)), first, last, step};
}

std::string to_text(const GridAxis& axis) {
  return fmt::format("{}={}:{}:{}", name_of(axis.angle), axis.first_deg, axis.last_deg, axis.step_deg);
}

}  // namespace condyle
