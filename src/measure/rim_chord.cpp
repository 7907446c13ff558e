#include "measure/rim_chord.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "core/formatted.hpp"
#include "core/trigonometry.hpp"

namespace condyle::measure {

ChordFinding chord_at(const std::vector<RimHour>& rim, const Sphere& head, const BodyAxes& axes,
                      double height_mm) {
  const std::size_t count = rim.size();
  const auto height = [&](std::size_t i) { return (*rim[i].point - head.centre).dot(axes.superior); };
  std::optional<std::size_t> top;
  for (std::size_t i = 0; i < count; ++i)
    if (rim[i].point && (!top || height(i) > height(*top))) top = i;
  if (!top || !(height(*top) > height_mm))
    return {{}, core::formatted("no rim is %.0f mm above the head's centre", height_mm)};
  const auto passes = [&](std::size_t step) -> std::optional<Vec3> {
    std::size_t i = *top;
    for (std::size_t k = 0; k < count / 2; ++k) {
      const std::size_t next = (i + step) % count;
      if (!rim[next].point) return std::nullopt;
      if (height(next) <= height_mm) {
        const double part = (height(i) - height_mm) / (height(i) - height(next));
        return Vec3(*rim[i].point + part * (*rim[next].point - *rim[i].point));
      }
      i = next;
    }
    return std::nullopt;
  };
  auto a = passes(1), b = passes(count - 1);
  if (!a || !b)
    return {{},
            core::formatted("the rim is not in the mesh %.0f mm above the head's centre in front and behind",
                            height_mm)};
  if ((*a - *b).dot(axes.anterior) < 0) std::swap(a, b);
  if ((*a - *b).norm() < head.radius)
    return {{},
            core::formatted("%.0f mm above the head's centre the roof begins: front and back of the rim are "
                            "%.0f mm apart (needs %.0f)",
                            height_mm, (*a - *b).norm(), head.radius)};
  return {RimChord{height_mm, *a, *b}, {}};
}

double chord_version_deg(const RimChord& chord, const BodyAxes& axes) {
  const Vec3 along = chord.front - chord.back;
  return core::arctangent(-along.dot(axes.lateral), along.dot(axes.anterior)) * 180 / std::numbers::pi;
}

}  // namespace condyle::measure
