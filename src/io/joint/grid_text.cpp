#include "io/joint/grid_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <vector>

#include "condyle/error.hpp"
#include "condyle/io/pose_text.hpp"
#include "io/file/in_quotes.hpp"

namespace condyle::io {
namespace {

[[noreturn]] void fail(std::string_view text) {
  throw UsageError(fmt::format(
      "map: {} is not of the form flexion=-20:120:1 (first, last and step in degrees)", io::in_quotes(text)));
}

double number(std::string_view digits, std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value)) fail(text);
  return value;
}

}  // namespace

motion::GridAxis parse_grid_axis(std::string_view text, Anatomy joint) {
  const std::size_t equals = text.find('=');
  if (equals == text.npos) fail(text);
  std::vector<double> values;
  for (std::size_t at = equals; at != text.npos;) {
    const std::size_t end = text.find(':', at + 1);
    values.push_back(number(text.substr(at + 1, end == text.npos ? end : end - at - 1), text));
    at = end;
  }
  if (values.size() > 3) fail(text);
  motion::GridAxis axis{joint_angle_named(text.substr(0, equals), joint), values.front(), values.front(), 1};
  if (values.size() > 1) axis.last_deg = values[1];
  if (values.size() > 2) axis.step_deg = values[2];
  return axis;
}

std::string to_text(const motion::GridAxis& axis, Anatomy joint) {
  return fmt::format("{}={}:{}:{}", name_of(axis.angle, joint), axis.first_deg, axis.last_deg, axis.step_deg);
}

}  // namespace condyle::io
