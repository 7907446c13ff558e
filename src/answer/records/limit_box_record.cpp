#include "answer/records/limit_box_record.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "answer/limit_facts.hpp"
#include "answer/living_limit.hpp"
#include "condyle/error.hpp"

namespace condyle {
namespace {

/// Between the points of the map that is computed if the answer has none.
constexpr double step_deg = 10;

/// One value for each joint angle, in degrees.
using Degrees = std::array<double, all_joint_angles.size()>;

std::size_t number_of(JointAngle angle) noexcept {
  return static_cast<std::size_t>(angle);
}

double coordinate_at(const TurningCoordinate& coordinate, double angle_deg) noexcept {
  return coordinate.sign * (angle_deg - coordinate.offset_deg) + 0.0;  // no -0
}

/// The built-in motion of an angle from zero, so far as such motions go.
motion::Motion motion_of(const Joint& joint, JointAngle angle, RotationSense sense) {
  for (motion::Motion& built_in : motion::built_in_motions(joint.kind, joint.anatomy))
    if (built_in.vary == angle && built_in.sense == sense && built_in.start == JointAngles{}) return built_in;
  throw UsageError("no motion turns the joint from zero in each angle by itself");
}

void check_coordinates(const Joint& joint, std::span<const TurningCoordinate> coordinates) {
  if (joint.anatomy == Anatomy::shoulder)
    throw UsageError(
        "the angles of a shoulder turn about one axis at zero: they have no limits each by itself");
  for (const JointAngle angle : all_joint_angles) {
    if (joint.kind == JointKind::hinge && angle != JointAngle::flexion) break;
    if (std::none_of(coordinates.begin(), coordinates.end(),
                     [&](const TurningCoordinate& coordinate) { return coordinate.angle == angle; }))
      throw UsageError("no coordinate turns the joint in " + std::string(name_of(angle, joint.anatomy)));
  }
}

/// Cartilage and the like, on either body.
bool is_on_bearing(const Joint& joint, const motion::ContactWitness& contact) {
  const auto slides = [](const BodyPart* part) { return part && part->contact == PartContact::bearing; };
  return contact.kind == motion::ContactKind::bearing ||
         slides(part_of(joint.fixed, contact.fixed_feature)) ||
         slides(part_of(joint.mobile, contact.mobile_feature));
}

LimitSource source_of(const Joint& joint, const motion::Limit& end) {
  if (end.ligament) return LimitSource::ligament;
  if (end.kind() == motion::ContactKind::cut) return LimitSource::cut;
  return end.contact && is_on_bearing(joint, *end.contact) ? LimitSource::bearing : LimitSource::bony;
}

BoxEndRecord end_record(const RangeAnswer& answer, std::size_t i, const TurningCoordinate& coordinate,
                        LimitSource source) {
  const motion::MotionLimit& limit = answer.limits[i];
  const auto value = [&](Angle turned) {
    return coordinate_at(coordinate, sign_of(limit.motion.sense) * turned.degrees());
  };
  BoxEndRecord end{.limit_deg = value(limit.end.turned),
                   .source = source_of(answer.joint, limit.end),
                   .reason = limit.end.reason,
                   .bony_deg = value(limit.end.turned)};
  if (const auto living = living_limit(answer, i);
      source == LimitSource::living && living && living->expected) {
    end.limit_deg = value(*living->expected);
    end.source = LimitSource::living;
  }
  return end;
}

/// Multiples of the step in the box.
motion::GridAxis axis_over(JointAngle angle, const Degrees& low, const Degrees& high) {
  const std::size_t i = number_of(angle);
  return {angle, step_deg * std::ceil(low[i] / step_deg), step_deg * std::floor(high[i] / step_deg),
          step_deg};
}

BoxErrorRecord box_error(const motion::MotionMap& map, const Degrees& low, const Degrees& high,
                         std::span<const TurningCoordinate> coordinates) {
  const motion::MapGrid& grid = map.grid;
  const std::size_t column = number_of(grid.column.coordinate.angle()),
                    row = number_of(grid.row.coordinate.angle()), varied = number_of(grid.vary.angle());
  const auto past = [&](std::size_t i, double at) { return std::max({low[i] - at, at - high[i], 0.0}); };
  const auto in_coordinates = [&](const Degrees& at) {
    std::vector<double> values;
    for (const TurningCoordinate& coordinate : coordinates)
      values.push_back(coordinate_at(coordinate, at[number_of(coordinate.angle)]));
    return values;
  };
  BoxErrorRecord error{.points = map.points.size(),
                       .points_in_box = 0,
                       .points_without_free = 0,
                       .beyond_deg = 0,
                       .beyond_at_deg = {},
                       .forbidden_deg = 0,
                       .forbidden_at_deg = {}};
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    Degrees at{};
    at[column] = grid.column.value(i % grid.column.count());
    at[row] = grid.row.value(i / grid.column.count());
    const double held_past = std::max(past(column, at[column]), past(row, at[row]));
    const motion::FreeInterval* free = map.points[i].nearest_to_start();
    if (held_past == 0) ++error.points_in_box;
    if (!free) {
      if (held_past == 0) ++error.points_without_free;
      continue;
    }
    const double from = (grid.start + free->low).degrees(), to = (grid.start + free->high).degrees();
    for (const double end : {low[varied], high[varied]}) {
      const double beyond = std::max(from - end, end - to);
      at[varied] = end;
      if (held_past == 0 && beyond > error.beyond_deg)
        error.beyond_deg = beyond, error.beyond_at_deg = in_coordinates(at);
    }
    for (const double end : {from, to}) {
      const double forbidden = std::max(held_past, past(varied, end));
      at[varied] = end;
      if (forbidden > error.forbidden_deg)
        error.forbidden_deg = forbidden, error.forbidden_at_deg = in_coordinates(at);
    }
  }
  return error;
}

}  // namespace

std::optional<LimitBoxRecord> limit_box_record(const Case& of, const RangeAnswer& answer,
                                               const RangeRequest& request,
                                               std::span<const TurningCoordinate> coordinates,
                                               LimitSource source, const Control& control) {
  if (!answer.range) throw UsageError("limits for other programs are exact ones, with the centre held");
  if (answer.map && answer.map->grid.translates())
    throw UsageError("limits for other programs are held against a map of angles");
  check_coordinates(answer.joint, coordinates);
  RangeRequest asked{.range = request.range};
  for (const TurningCoordinate& coordinate : coordinates)
    for (const RotationSense sense : {RotationSense::negative, RotationSense::positive})
      asked.motions.push_back(motion_of(answer.joint, coordinate.angle, sense));
  const auto limits = further_answer(of, answer, asked, control);
  if (!limits) return std::nullopt;
  LimitBoxRecord box{.coordinates = {}, .held_translation_mm = answer.held_translation_mm, .error = {}};
  Degrees low{}, high{};
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const TurningCoordinate& coordinate = coordinates[i];
    BoxEndRecord lower = end_record(*limits, 2 * i, coordinate, source),
                 upper = end_record(*limits, 2 * i + 1, coordinate, source);
    const auto angle_at = [&](const BoxEndRecord& end) {
      return coordinate.sign * end.limit_deg + coordinate.offset_deg;
    };
    low[number_of(coordinate.angle)] = angle_at(lower), high[number_of(coordinate.angle)] = angle_at(upper);
    if (!(lower.limit_deg != upper.limit_deg))
      throw UsageError("coordinate " + coordinate.name +
                       " moves nothing: contact or a ligament holds it on either side of zero");
    if (coordinate.sign < 0) std::swap(lower, upper);
    box.coordinates.push_back({coordinate.name, coordinate.angle, coordinate.sign, coordinate.offset_deg,
                               std::move(lower), std::move(upper), coordinate.other_stop});
  }
  if (answer.joint.kind == JointKind::hinge) return box;
  std::optional<motion::MotionMap> map = answer.map;
  if (!map) {
    const motion::MapGrid grid{.row = axis_over(JointAngle::adduction, low, high),
                               .column = axis_over(JointAngle::flexion, low, high)};
    map = motion::motion_map(grid, *answer.range, control);
    if (!map) return std::nullopt;
  }
  box.error = box_error(*map, low, high, coordinates);
  box.map = std::make_shared<const motion::MotionMap>(std::move(*map));
  return box;
}

}  // namespace condyle
