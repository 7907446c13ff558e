#include "condyle/motion_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <numbers>

#include "condyle/error.hpp"
#include "core/parallel.hpp"
#include "core/trigonometry.hpp"

namespace condyle::motion {
namespace {

/// How far past the last step an axis may end and still count as stopping on it, in steps: decimal steps such as 0.1
/// are not exact in binary.
constexpr double count_slack = 1e-6;

/// Points that one thread takes at a time: neighbours share boxes in its caches and, where adduction is
/// varied, a table.
constexpr std::size_t points_per_chunk = 16;

void check_axis(const GridAxis& axis) {
  if (!std::isfinite(axis.first_deg) || !std::isfinite(axis.last_deg) || !std::isfinite(axis.step_deg))
    throw UsageError("map: grid values must be finite");
  if (!(axis.step_deg > 0)) throw UsageError("map: the step must be above 0 degrees");
  if (!(axis.last_deg >= axis.first_deg)) throw UsageError("map: an axis ends before it begins");
}

/// As many as the axis has values; a double, for it may be more than any integer.
double count_of(const GridAxis& axis) noexcept {
  return std::floor((axis.last_deg - axis.first_deg) / axis.step_deg + count_slack) + 1;
}

/// The same points with flexion changing slowest, where adduction is varied: its tables depend on flexion.
class Order {
 public:
  explicit Order(const MapGrid& grid)
      : rows_(grid.row.count()),
        columns_(grid.column.count()),
        by_columns_(grid.vary == JointAngle::adduction && grid.column.angle == JointAngle::flexion) {}
  std::size_t point(std::size_t i) const noexcept {
    return by_columns_ ? (i % rows_) * columns_ + i / rows_ : i;
  }

 private:
  std::size_t rows_, columns_;
  bool by_columns_;
};

/// |e1 x e3| over the second angle: its cosine, of a shoulder its sine.
struct HaarWeight {
  Anatomy anatomy;

  double at(Angle second) const noexcept {
    const double a = second.radians();
    return anatomy == Anatomy::shoulder ? std::abs(core::sine(a)) : core::cosine(a);
  }
  double integral(Angle from, Angle to) const noexcept {
    const double a = from.radians(), b = to.radians();
    return anatomy == Anatomy::shoulder ? integral_of_abs_sine(b) - integral_of_abs_sine(a)
                                        : core::sine(b) - core::sine(a);
  }
  static double integral_of_abs_sine(double a) noexcept {
    const double half_turns = std::floor(a / std::numbers::pi);
    return 2 * half_turns + 1 - core::cosine(a - half_turns * std::numbers::pi);
  }
};

/// Weight of point i in the integral over the axis, in degrees.
double trapezoid(const GridAxis& axis, std::size_t i) {
  const std::size_t count = axis.count();
  if (count == 1) return 0;
  return axis.step_deg * (i == 0 || i + 1 == count ? 0.5 : 1.0);
}

}  // namespace

std::size_t GridAxis::count() const {
  return static_cast<std::size_t>(count_of(*this));
}

bool GridAxis::ends_early() const {
  return (last_deg - first_deg) / step_deg - (count_of(*this) - 1) > count_slack;
}

JointAngles MapGrid::start_of(std::size_t point) const {
  JointAngles angles = turned_by({}, vary, start);
  angles = turned_by(angles, row.angle, Angle::degrees(row.value_deg(point / column.count())));
  return turned_by(angles, column.angle, Angle::degrees(column.value_deg(point % column.count())));
}

void check_grid(const MapGrid& grid, JointKind kind) {
  if (kind == JointKind::hinge) throw UsageError("map: a hinge turns only in flexion");
  if (grid.row.angle == grid.column.angle || grid.vary == grid.row.angle || grid.vary == grid.column.angle)
    throw UsageError("map: two angles are held and the third is varied; one is named twice");
  for (const GridAxis* axis : {&grid.row, &grid.column}) check_axis(*axis);
  const double low = grid.range.negative.radians(), high = grid.range.positive.radians();
  const double half_turn = Angle::degrees(180).radians();
  if (!std::isfinite(grid.start.radians())) throw UsageError("map: the start must be finite");
  if (!(low <= 0 && high >= 0 && low < high))
    throw UsageError("map: the range of the varied angle is empty or does not hold its start");
  if (!(low >= -half_turn && high <= half_turn))
    throw UsageError("map: the varied angle may turn by half a turn either way");
  const double points = count_of(grid.row) * count_of(grid.column);
  if (!(points <= static_cast<double>(most_map_points))) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), points < 1e15 ? "%.0f" : "%.3g", points);
    throw UsageError(std::string("map: ") + text.data() + " points are more than " +
                     std::to_string(most_map_points));
  }
}

SearchWork MotionMap::work() const noexcept {
  SearchWork sum;
  for (const FreeAngles& point : points) sum += point.from_start.work;
  return sum;
}

MotionMap motion_map(const MapGrid& grid, const RangeOfMotion& joint) {
  return *motion_map(grid, joint, {});
}

std::optional<MotionMap> motion_map(const MapGrid& grid, const RangeOfMotion& joint, const Control& control) {
  check_grid(grid, joint.kind());
  MotionMap map{grid, std::vector<FreeAngles>(grid.size()), joint.coordinates().anatomy};
  const Order order(grid);
  std::size_t done = 0;
  std::mutex reporting;
  const auto report = [&] {
    const std::scoped_lock lock(reporting);
    ++done;
    if (control.progress) control.progress("map points", done, map.points.size());
  };
  core::parallel_chunks(map.points.size(), points_per_chunk, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last && !control.stop.stop_requested(); ++i) {
      const std::size_t point = order.point(i);
      map.points[point] = joint.free_angles(grid.vary, grid.start_of(point), grid.range);
      report();
    }
  });
  if (done < map.points.size()) return std::nullopt;
  return map;
}

FreeVolume free_volume(const MotionMap& map) {
  const MapGrid& grid = map.grid;
  FreeVolume volume;
  const HaarWeight haar{map.anatomy};
  const std::size_t columns = grid.column.count();
  volume.row_area_deg2.resize(grid.row.count());
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    const double column_weight = trapezoid(grid.column, i % columns);
    const double weight = trapezoid(grid.row, i / columns) * column_weight;
    const JointAngles at = grid.start_of(i);
    for (const FreeInterval& free : map.points[i].intervals) {
      const double width = (free.high - free.low).degrees();
      const double weighted_width =
          grid.vary == JointAngle::adduction
              ? Angle::radians(haar.integral(at.adduction + free.low, at.adduction + free.high)).degrees()
              : haar.at(at.adduction) * width;
      volume.row_area_deg2[i / columns] += width * column_weight;
      volume.plain_deg3 += width * weight;
      volume.weighted_deg3 += weighted_width * weight;
    }
  }
  return volume;
}

}  // namespace condyle::motion
