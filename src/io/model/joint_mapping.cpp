#include "io/model/joint_mapping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>

#include "io/mesh/parse.hpp"
#include "io/model/spatial_transform.hpp"

namespace condyle::io {
namespace {

constexpr double degrees_per_radian = 180 / std::numbers::pi;

/// An axis that one coordinate drives by its own value, plain or negated.
struct Drive {
  std::size_t coordinate;
  double slope, offset;
};

/// `motion`: what the coordinate must do, for the unit of its column.
std::optional<Drive> drive_of(const ModelJoint& joint, std::size_t i, CoordinateMotion motion) {
  const TransformAxis& axis = joint.transform->axes[i];
  const auto line = straight_line(axis.function);
  if (!line || axis.coordinates.size() != 1 || std::abs(line->slope) != 1) return std::nullopt;
  if (joint.coordinates[axis.coordinates[0]].motion != motion) return std::nullopt;
  return Drive{axis.coordinates[0], line->slope, line->offset};
}

bool is_constant(const TransformAxis& axis) {
  const auto line = straight_line(axis.function);
  return line && (line->slope == 0 || axis.coordinates.empty());
}

/// 1 or -1 for an axis along that unit vector; 0 for every other one.
double along(const Vec3& axis, const Vec3& unit) {
  return axis == unit ? 1 : axis == -unit ? -1 : 0;
}

/// The sense in which a joint's angle grows, about Z, X and Y of its frame: docs/joint-frame.md, "Signs".
std::array<double, 3> senses_of(Anatomy anatomy, Side side) {
  const double sideways = side == Side::right ? 1 : -1;
  return {anatomy == Anatomy::knee ? -1.0 : 1.0, sideways, sideways};
}

ColumnOfCoordinate column(const std::string& joint, const ModelCoordinate& coordinate, std::string_view name,
                          CoordinateKind kind, double sign, double offset) {
  const double unit = kind == CoordinateKind::angle ? degrees_per_radian : mm_per(LengthUnit::metres);
  ColumnOfCoordinate out{
      .coordinate = std::string(name), .kind = kind, .column = joint + "/" + coordinate.name};
  if (kind == CoordinateKind::length) out.unit = ColumnUnit::metres;
  out.sign = sign;
  out.offset = unit * offset + 0.0;
  out.otherwise = unit * coordinate.default_value + 0.0;
  // "No range" is written as a huge one.
  const auto end = [&](double value) { return std::clamp(unit * value, -1e9, 1e9) + 0.0; };
  if (coordinate.range) out.range = {end(coordinate.range->front()), end(coordinate.range->back())};
  out.is_locked = coordinate.is_locked;
  return out;
}

/// Columns of the three angles, where the rotations are about Z, X and Y by three coordinates.
std::optional<std::vector<ColumnOfCoordinate>> angle_columns(const ModelJoint& joint, Anatomy anatomy,
                                                             Side side) {
  if (anatomy == Anatomy::shoulder) return std::nullopt;
  const SpatialTransform& axes = joint.transform->axes;
  const Vec3 units[] = {Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()};
  const auto senses = senses_of(anatomy, side);
  const auto& names = coordinate_names(anatomy);
  std::vector<ColumnOfCoordinate> columns;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto drive = drive_of(joint, i, CoordinateMotion::rotational);
    const double direction = along(axes[i].axis, units[i]);
    if (!drive || direction == 0) return std::nullopt;
    const double sense = direction * senses[i];
    columns.push_back(column(joint.name, joint.coordinates[drive->coordinate], names[i].positive,
                             CoordinateKind::angle, drive->slope * sense, drive->offset * sense));
  }
  return columns;
}

std::optional<std::vector<ColumnOfCoordinate>> length_columns(const ModelJoint& joint) {
  const SpatialTransform& axes = joint.transform->axes;
  const Vec3 units[] = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  constexpr std::string_view names[] = {"x", "y", "z"};
  std::vector<ColumnOfCoordinate> columns;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto drive = drive_of(joint, 3 + i, CoordinateMotion::translational);
    const double direction = along(axes[3 + i].axis, units[i]);
    if (!drive || direction == 0) return std::nullopt;
    columns.push_back(column(joint.name, joint.coordinates[drive->coordinate], names[i],
                             CoordinateKind::length, drive->slope * direction, drive->offset * direction));
  }
  return columns;
}

bool are_different(const std::vector<ColumnOfCoordinate>& columns) {
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (std::size_t k = i + 1; k < columns.size(); ++k)
      if (columns[i].column == columns[k].column) return false;
  return true;
}

/// Maps a joint with one rotation about an axis at rest: Z along the axis, to the right, X as near to the model's as can be.
JointMapping hinge(const ModelJoint& joint, std::size_t turning, JointMapping mapping,
                   std::optional<Anatomy> anatomy, Side side) {
  const SpatialTransform& axes = joint.transform->axes;
  Eigen::Matrix3d before = Eigen::Matrix3d::Identity();
  for (std::size_t i = 0; i < turning; ++i)
    before = before * rotation_about(axes[i].axis, straight_line(axes[i].function)->offset);
  const Vec3 axis = before * axes[turning].axis;
  const double direction = axis.z() < 0 ? -1 : 1;
  const Vec3 z = direction * axis;
  // Where the model's X lies along the axis its Y takes its place.
  const Vec3 near = std::abs(z.x()) < 0.9 ? Vec3::UnitX() : Vec3(-Vec3::UnitY());
  const Vec3 x = (near - near.dot(z) * z).normalized();
  Eigen::Matrix3d R;
  R << x, z.cross(x), z;
  mapping.X_WF.linear() = mapping.X_WF.linear() * R;
  const Anatomy named = anatomy.value_or(Anatomy::hip);
  const std::string_view angle = coordinate_names(named)[0].positive;
  mapping.kind = JointKind::hinge;
  mapping.why = "one rotation about an axis at rest";
  if (const auto drive = drive_of(joint, turning, CoordinateMotion::rotational)) {
    const double sense = direction * senses_of(named, side)[0];
    mapping.columns = {column(joint.name, joint.coordinates[drive->coordinate], angle, CoordinateKind::angle,
                              drive->slope * sense, drive->offset * sense)};
  } else {
    mapping.why += ", by a function of its coordinates";
  }
  const double off = std::acos(std::clamp(z.z(), -1.0, 1.0)) * degrees_per_radian;
  if (off > 45)
    mapping.caveat = fmt::format(
        "the axis is {:.0f} degrees from the way to the right: the angle is called {} "
        "nevertheless, positive about the axis",
        off, angle);
  return mapping;
}

}  // namespace

JointMapping mapping_of(const ModelJoint& joint, std::optional<Anatomy> anatomy, Side side) {
  const SpatialTransform& axes = joint.transform->axes;
  const std::vector<double> zeros(joint.coordinates.size());
  JointMapping mapping{.kind = JointKind::free};
  mapping.X_WF.linear() = joint.X_PF.linear();
  mapping.X_WF.translation() = joint.X_PF * pose_of(axes, zeros).translation();

  const bool stays = std::all_of(axes.begin() + 3, axes.end(), is_constant);
  std::vector<std::size_t> turning;
  for (std::size_t i = 0; i < 3; ++i)
    if (!is_constant(axes[i])) turning.push_back(i);

  const bool may_be_hinge = anatomy != Anatomy::hip && anatomy != Anatomy::shoulder;
  if (stays && turning.size() == 1 && may_be_hinge) return hinge(joint, turning[0], mapping, anatomy, side);

  if (auto angles = anatomy ? angle_columns(joint, *anatomy, side) : std::nullopt;
      angles && are_different(*angles)) {
    if (stays) {
      mapping.kind = JointKind::ball;
      mapping.columns = std::move(*angles);
      mapping.why = "three rotations about Z, X and Y, and a centre at rest";
      return mapping;
    }
    if (auto lengths = length_columns(joint); lengths && are_different(*lengths)) {
      mapping.columns = std::move(*angles);
      mapping.columns.insert(mapping.columns.end(), lengths->begin(), lengths->end());
      mapping.X_WF.translation() = joint.X_PF.translation();  // offsets of x, y and z are in the columns
      mapping.why = "three rotations about Z, X and Y, and translations along X, Y and Z";
      return mapping;
    }
  }
  mapping.kind = stays ? JointKind::ball : JointKind::free;
  mapping.why = stays ? "a centre at rest; its angles are those of another order, or functions of coordinates"
                      : "its place is a function of its coordinates";
  return mapping;
}

bool has_any(const std::string& text, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return text.find(word) != text.npos; });
}

/// Whether a name has one of these at the beginning of a word, behind a side's letter at most: "hip_r" and "rhip", not "ship".
bool has_word(const std::string& name, std::initializer_list<std::string_view> words) {
  const auto begins_word = [&](std::size_t at) {
    return at == 0 || !std::isalpha(static_cast<unsigned char>(name[at - 1])) ||
           (at == 1 && (name[0] == 'r' || name[0] == 'l'));
  };
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) {
    for (std::size_t at = name.find(word); at != name.npos; at = name.find(word, at + 1))
      if (begins_word(at)) return true;
    return false;
  });
}

/// By the names of a proximal and a distal body.
std::optional<Anatomy> anatomy_between(const std::string& proximal, const std::string& distal) {
  if (has_any(distal, {"femur", "thigh"}) && has_any(proximal, {"pelvis", "ilium", "hip"}))
    return Anatomy::hip;
  if (has_any(proximal, {"femur", "thigh"}) && has_any(distal, {"tibia", "shank", "patella"}))
    return Anatomy::knee;
  if (has_any(proximal, {"tibia", "shank"}) && has_any(distal, {"patella"})) return Anatomy::knee;
  if (has_any(proximal, {"tibia", "shank"}) && has_any(distal, {"talus", "foot"})) return Anatomy::ankle;
  if (has_any(distal, {"humerus"}) && has_any(proximal, {"scapula", "torso", "thorax", "clavicle"}))
    return Anatomy::shoulder;
  if (has_any(proximal, {"humerus"}) && has_any(distal, {"ulna", "forearm"})) return Anatomy::elbow;
  return std::nullopt;
}

bool has_proximal_child(const ModelJoint& joint) {
  const std::string parent = io::lower_case(joint.parent_body), child = io::lower_case(joint.child_body);
  return !anatomy_between(parent, child) && anatomy_between(child, parent);
}

std::optional<Anatomy> anatomy_of(const ModelJoint& joint) {
  const std::string parent = io::lower_case(joint.parent_body), child = io::lower_case(joint.child_body),
                    name = io::lower_case(joint.name);
  if (const auto by_bodies = anatomy_between(parent, child)) return by_bodies;
  if (has_word(name, {"hip"})) return Anatomy::hip;
  if (has_word(name, {"knee", "patellofemoral"})) return Anatomy::knee;
  if (has_word(name, {"ankle"})) return Anatomy::ankle;
  if (has_word(name, {"shoulder", "glenohumeral"})) return Anatomy::shoulder;
  if (has_word(name, {"elbow"})) return Anatomy::elbow;
  return std::nullopt;
}

std::optional<Side> side_of(const ModelJoint& joint) {
  std::optional<Side> side;
  for (const std::string* name : {&joint.name, &joint.child_body, &joint.parent_body}) {
    const std::string text = io::lower_case(*name);
    const bool is_right = text.ends_with("_r") || text.ends_with("_right"),
               is_left = text.ends_with("_l") || text.ends_with("_left");
    if (!is_right && !is_left) continue;
    const Side said = is_right ? Side::right : Side::left;
    if (side && said != *side) return std::nullopt;
    side = said;
  }
  return side;
}

}  // namespace condyle::io
