#include <algorithm>
#include <charconv>
#include <cmath>

#include "condyle/error.hpp"
#include "condyle/sweep.hpp"
#include "core/formatted.hpp"
#include "core/one_line.hpp"

namespace condyle::plan {
namespace {

/// A number of steps is whole within this.
constexpr double whole = 1e-6;

/// A number at the front of the text, which is taken off it; NaN if there is none.
double number_of(std::string_view& text) {
  double value = 0;
  const auto [stopped, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return NAN;
  text.remove_prefix(static_cast<std::size_t>(stopped - text.data()));
  return value;
}

bool take(std::string_view& text, char wanted) {
  if (text.empty() || text.front() != wanted) return false;
  text.remove_prefix(1);
  return true;
}

SweptParameter swept_of(std::string_view item) {
  const auto equals = item.find('=');
  SweptParameter swept{std::string(item.substr(0, equals))};
  std::string_view rest = equals == item.npos ? std::string_view() : item.substr(equals + 1);
  swept.first = number_of(rest);
  const bool has_last = take(rest, ':');
  swept.last = number_of(rest);
  const bool has_step = take(rest, ':');
  swept.step = number_of(rest);
  if (swept.name.empty() || !has_last || !has_step || !rest.empty() ||
      !std::isfinite(swept.first + swept.last + swept.step))
    throw UsageError(
        "\"" + core::one_line(item) +
        "\" is not a parameter with its first and last value and a step, as in cup.inclination=30:50:1");
  const std::string named = core::one_line(swept.name) + ": ";
  if (swept.step <= 0) throw UsageError(named + "the step must be above 0");
  if (swept.last < swept.first)
    throw UsageError(named + core::formatted("the last value, %.10g, lies below the first, %.10g", swept.last,
                                             swept.first));
  if ((swept.last - swept.first) / swept.step > static_cast<double>(most_designs))
    throw UsageError(named + "the step is too small for so wide a range");
  return swept;
}

}  // namespace

std::size_t SweptParameter::count() const {
  return static_cast<std::size_t>(std::floor((last - first) / step + whole)) + 1;
}

bool SweptParameter::ends_early() const {
  return (last - first) / step - static_cast<double>(count() - 1) > whole;
}

std::vector<SweptParameter> parse_sweep(std::string_view text) {
  std::vector<SweptParameter> swept;
  while (true) {
    const auto begin = text.find_first_not_of(" \t,");
    if (begin == text.npos) break;
    text.remove_prefix(begin);
    const std::string_view item = text.substr(0, text.find_first_of(" \t,"));
    text.remove_prefix(item.size());
    swept.push_back(swept_of(item));
    for (std::size_t i = 0; i + 1 < swept.size(); ++i)
      if (swept[i].name == swept.back().name)
        throw UsageError(core::one_line(swept.back().name) + " is given twice");
  }
  if (swept.empty()) throw UsageError("no parameter is given, as in cup.inclination=30:50:1");
  return swept;
}

motion::Motion SweepTarget::without_tilt() const noexcept {
  motion::Motion seen = motion;
  seen.start.flexion = seen.start.flexion + pelvic_tilt;
  return seen;
}

std::string_view name_of(LimitKnownBy by) noexcept {
  return by == LimitKnownBy::meshes ? "meshes" : "closed_form";
}

}  // namespace condyle::plan
