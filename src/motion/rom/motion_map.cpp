#include "condyle/motion_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <mutex>
#include <numbers>

#include "condyle/error.hpp"
#include "core/latest_few.hpp"
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

/// Joints shifted to a translation that are kept for the points that have it.
constexpr std::size_t shifted_joints_kept = 4;

void check_axis(const GridAxis& axis) {
  if (!std::isfinite(axis.first) || !std::isfinite(axis.last) || !std::isfinite(axis.step))
    throw UsageError("map: grid values must be finite");
  if (!(axis.step > 0)) throw UsageError("map: the step must be above 0");
  if (!(axis.last >= axis.first)) throw UsageError("map: an axis ends before it begins");
}

/// As many as the axis has values; a double, for it may be more than any integer.
double count_of(const GridAxis& axis) noexcept {
  return std::floor((axis.last - axis.first) / axis.step + count_slack) + 1;
}

/// The same points with the column changing slowest: with flexion there if adduction is varied, whose tables depend on it, and with a
/// translation there, to which the joint is shifted.
class Order {
 public:
  explicit Order(const MapGrid& grid)
      : rows_(grid.row.count()),
        columns_(grid.column.count()),
        by_columns_(!grid.column.coordinate.is_angle() ||
                    (grid.vary == JointAngle::adduction && grid.column.coordinate == JointAngle::flexion)) {}
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
  return axis.step * (i == 0 || i + 1 == count ? 0.5 : 1.0);
}

void set(JointCoordinates& at, MapCoordinate coordinate, double value) {
  if (coordinate.is_angle())
    at.angles = turned_by(at.angles, coordinate.angle(), Angle::degrees(value));
  else
    at.translation_mm[coordinate.axis()] = value;
}

/// How both bodies are shifted in their frames so that the axis about which an angle turns goes through both origins.
///
///     p_F = R p_M + t,   c on the axis, in F:   p_F - c = R (p_M + R^T (t - c))
///
/// With t in the axes of F the mobile origin is on every axis: c = t. Along the joint's axes t = x e2 + y e3 + z e1: flexion carries all
/// of it along, c = 0, and adduction what is along e3, c = t - y e3.
struct Shift {
  Vec3 fixed_by = Vec3::Zero(), mobile_by = Vec3::Zero();

  Shift() = default;
  Shift(const RangeOfMotion& joint, const MapGrid& grid, const JointCoordinates& at) {
    const auto translation = [&](const Vec3& t) -> Vec3 {
      return pose_at(joint.coordinates(), {at.angles, t}, joint.translation_frame()).translation();
    };
    Vec3 carried = Vec3::Zero();
    if (joint.translation_frame() == TranslationFrame::joint_axes) {
      if (grid.vary == JointAngle::flexion) carried = translation(at.translation_mm);
      if (grid.vary == JointAngle::adduction) carried = translation({0, at.translation_mm.y(), 0});
    }
    fixed_by = grid.held.translation_mm - (translation(at.translation_mm) - carried);
    mobile_by = pose_at(joint.coordinates(), at.angles).linear().transpose() * carried;
  }
  bool operator==(const Shift& other) const {
    return fixed_by == other.fixed_by && mobile_by == other.mobile_by;
  }
  bool is_none() const { return *this == Shift(); }

  /// A contact of the shifted joint as that of the joint.
  void undo(std::optional<ContactWitness>& contact) const {
    if (contact) contact->fixed_point -= fixed_by, contact->mobile_point -= mobile_by;
  }
  void undo(Limit& limit) const {
    undo(limit.contact);
    for (std::optional<EarlierContact>* earlier : {&limit.bearing_contact, &limit.soft_contact})
      if (*earlier) undo((*earlier)->contact);
  }
  void undo(FreeAngles& free) const {
    undo(free.from_start.negative), undo(free.from_start.positive);
    for (FreeInterval& interval : free.intervals) undo(interval.at_low), undo(interval.at_high);
  }
};

/// Answers at the points of one grid.
class PointFinder {
 public:
  PointFinder(const MapGrid& grid, const RangeOfMotion& joint) : grid_(grid), joint_(joint) {}

  FreeAngles angles(std::size_t point) const {
    const JointCoordinates at = grid_.start_of(point);
    const Shift shift = grid_.translates() ? Shift(joint_, grid_, at) : Shift();
    if (shift.is_none()) return joint_.free_angles(grid_.vary.angle(), at.angles, grid_.range);
    const auto shifted = shifted_.get(shift, [&](std::unique_ptr<const RangeOfMotion>& made) {
      made = std::make_unique<const RangeOfMotion>(joint_, shift.fixed_by, shift.mobile_by);
    });
    FreeAngles free = (*shifted)->free_angles(grid_.vary.angle(), at.angles, grid_.range);
    shift.undo(free);
    return free;
  }

  FreeSlides slides(std::size_t point) const {
    const JointCoordinates at = grid_.start_of(point);
    const TranslationFrame frame = joint_.translation_frame();
    const JointCoordinates unit{at.angles, Vec3::Unit(grid_.vary.axis())};
    Pose X_FM = pose_at(joint_.coordinates(), at, frame);
    X_FM.translation() -= grid_.held.translation_mm;
    return joint_.free_slides(pose_at(joint_.coordinates(), unit, frame).translation(), X_FM,
                              grid_.slide_range);
  }

 private:
  const MapGrid& grid_;
  const RangeOfMotion& joint_;
  core::LatestFew<Shift, std::unique_ptr<const RangeOfMotion>, shifted_joints_kept> shifted_ = {};
};

MapEnd end_of(const Limit& limit, Angle start, Angle from_start) {
  MapEnd end{(start + from_start).degrees(),
             from_start.degrees(),
             limit.reason,
             limit.error_bound.degrees(),
             {},
             limit.contact,
             limit.ligament};
  if (limit.bearing_contact) end.bearing_contact = limit.bearing_contact->turned.degrees();
  return end;
}

MapEnd end_of(const SlideEnd& slide, double start) {
  return {start + *slide.at_mm,
          *slide.at_mm,
          slide.contact ? LimitReason::contact : LimitReason::end_of_range,
          slide.error_bound_mm,
          {},
          slide.contact,
          {}};
}

}  // namespace

std::string_view name_of(MapCoordinate coordinate, Anatomy joint) noexcept {
  static constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
  return coordinate.is_angle() ? name_of(coordinate.angle(), joint)
                               : axes[static_cast<std::size_t>(coordinate.axis())];
}

std::size_t GridAxis::count() const {
  return static_cast<std::size_t>(count_of(*this));
}

bool GridAxis::ends_early() const {
  return (last - first) / step - (count_of(*this) - 1) > count_slack;
}

JointCoordinates MapGrid::start_of(std::size_t point) const {
  JointCoordinates at = held;
  if (vary.is_angle()) at.angles = turned_by(at.angles, vary.angle(), start);
  set(at, row.coordinate, row.value(point / column.count()));
  set(at, column.coordinate, column.value(point % column.count()));
  return at;
}

bool MapGrid::translates() const noexcept {
  return !(row.coordinate.is_angle() && column.coordinate.is_angle() && vary.is_angle());
}

void check_grid(const MapGrid& grid, JointKind kind) {
  if (kind == JointKind::hinge) throw UsageError("map: a hinge turns only in flexion");
  if (grid.row.coordinate == grid.column.coordinate || grid.vary == grid.row.coordinate ||
      grid.vary == grid.column.coordinate)
    throw UsageError("map: two coordinates are held and a third is varied; one is named twice");
  if (grid.translates() && kind != JointKind::free)
    throw UsageError("map: only a free joint translates (kind = \"free\" in its joint file)");
  for (const MapCoordinate each : {grid.row.coordinate, grid.column.coordinate, grid.vary})
    if (each.is_angle() && angle_of(grid.held.angles, each.angle()) != Angle())
      throw UsageError("map: an angle that is held is on an axis, or varies");
  for (const GridAxis* axis : {&grid.row, &grid.column}) check_axis(*axis);
  const double low = grid.range.negative.radians(), high = grid.range.positive.radians();
  const double half_turn = Angle::degrees(180).radians();
  if (!std::isfinite(grid.start.radians())) throw UsageError("map: the start must be finite");
  if (!(low <= 0 && high >= 0 && low < high))
    throw UsageError("map: the range of the varied angle is empty or does not hold its start");
  if (!(low >= -half_turn && high <= half_turn))
    throw UsageError("map: the varied angle may turn by half a turn either way");
  const auto [back, on] = grid.slide_range;
  if (!(back < 0 && on > 0 && std::isfinite(on - back)))
    throw UsageError("map: a translation varies from below its start to above it, and not without end");
  const double points = count_of(grid.row) * count_of(grid.column);
  if (!(points <= static_cast<double>(most_map_points))) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), points < 1e15 ? "%.0f" : "%.3g", points);
    throw UsageError(std::string("map: ") + text.data() + " points are more than " +
                     std::to_string(most_map_points));
  }
}

const MapInterval* MapPoint::nearest_to_start() const noexcept {
  const auto distance = [](const MapInterval& interval) {
    return std::max({interval.low.from_start, -interval.high.from_start, 0.0});
  };
  const auto nearest =
      std::min_element(intervals.begin(), intervals.end(),
                       [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  return nearest == intervals.end() ? nullptr : &*nearest;
}

MapPoint MotionMap::point(std::size_t i) const {
  MapPoint point;
  if (grid.vary.is_angle()) {
    const FreeAngles& free = points[i];
    point.negative = end_of(free.from_start.negative, grid.start, -free.from_start.negative.turned);
    point.positive = end_of(free.from_start.positive, grid.start, free.from_start.positive.turned);
    for (const FreeInterval& each : free.intervals)
      point.intervals.push_back({end_of(each.at_low, grid.start, each.low),
                                 end_of(each.at_high, grid.start, each.high),
                                 (each.high - each.low).degrees()});
    return point;
  }
  const FreeSlides& free = slides[i];
  const double start = grid.held.translation_mm[grid.vary.axis()];
  point.negative = end_of(free.negative, start);
  point.positive = end_of(free.positive, start);
  if (!free.free_at_start) point.negative.reason = point.positive.reason = LimitReason::contact_at_start;
  for (const FreeSlide& each : free.intervals)
    point.intervals.push_back(
        {end_of(each.low, start), end_of(each.high, start), *each.high.at_mm - *each.low.at_mm});
  return point;
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
  const bool turns = grid.vary.is_angle();
  MotionMap map{grid, std::vector<FreeAngles>(turns ? grid.size() : 0), joint.coordinates().anatomy,
                std::vector<FreeSlides>(turns ? 0 : grid.size())};
  const PointFinder finder(grid, joint);
  const Order order(grid);
  std::size_t done = 0;
  std::mutex reporting;
  const auto report = [&] {
    const std::scoped_lock lock(reporting);
    ++done;
    if (control.progress) control.progress("map points", done, grid.size());
  };
  core::parallel_chunks(grid.size(), points_per_chunk, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last && !control.stop.stop_requested(); ++i) {
      const std::size_t point = order.point(i);
      if (turns)
        map.points[point] = finder.angles(point);
      else
        map.slides[point] = finder.slides(point);
      report();
    }
  });
  if (done < grid.size()) return std::nullopt;
  return map;
}

FreeVolume free_volume(const MotionMap& map) {
  const MapGrid& grid = map.grid;
  FreeVolume volume;
  const HaarWeight haar{map.anatomy};
  const std::size_t columns = grid.column.count();
  volume.row_area_deg2.resize(grid.row.count());
  if (grid.translates()) return volume;
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    const double column_weight = trapezoid(grid.column, i % columns);
    const double weight = trapezoid(grid.row, i / columns) * column_weight;
    const JointAngles at = grid.start_of(i).angles;
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
