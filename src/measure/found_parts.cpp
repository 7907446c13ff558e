#include "measure/found_parts.hpp"

#include <cmath>
#include <utility>

#include "core/trigonometry.hpp"

namespace condyle::measure {

BodyAxes body_axes(Side side, Angle tilt) {
  // A pelvis that tilts forwards turns by -tilt about Z in its frame; its frame turns by tilt about it.
  const double c = core::cosine(tilt.radians()), s = core::sine(tilt.radians());
  return {{c, s, 0}, {-s, c, 0}, {0, 0, side == Side::right ? 1.0 : -1.0}};
}

Measure measured(double value) {
  return {value, {}, {}};
}

Measure not_measured(std::string why) {
  return {{}, std::move(why), {}};
}

void add_note(Measure& measure, const std::string& note) {
  if (!measure.value || note.empty()) return;
  if (!measure.note.empty()) measure.note += "; ";
  measure.note += note;
}

Measure measured_or(const std::optional<double>& value, const std::string& why) {
  return value ? measured(*value) : not_measured(why);
}

}  // namespace condyle::measure
