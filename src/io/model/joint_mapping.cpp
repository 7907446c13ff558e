#include "io/model/joint_mapping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>

#include "core/trigonometry.hpp"
#include "io/file/in_quotes.hpp"
#include "io/mesh/parse.hpp"
#include "io/model/joint_axes.hpp"
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

/// Its axes in the frame by which its angles are named.
SpatialTransform named_axes(const ModelJoint& joint, const JointAxes& names) {
  SpatialTransform axes = joint.transform->axes;
  for (TransformAxis& axis : axes) axis.axis = names.R_FA.transpose() * axis.axis;
  return axes;
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
std::optional<std::vector<ColumnOfCoordinate>> angle_columns(const ModelJoint& joint,
                                                             const SpatialTransform& axes, Anatomy anatomy,
                                                             Side side) {
  if (anatomy == Anatomy::shoulder) return std::nullopt;
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

/// Columns of the translation, where it is along X, Y and Z by three coordinates, in whatever order.
std::optional<std::vector<ColumnOfCoordinate>> length_columns(const ModelJoint& joint,
                                                              const SpatialTransform& axes) {
  const Vec3 units[] = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  constexpr std::string_view names[] = {"x", "y", "z"};
  std::vector<ColumnOfCoordinate> columns;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = std::find_if(axes.begin() + 3, axes.end(), [&](const TransformAxis& each) {
      return along(each.axis, units[i]) != 0;
    });
    if (axis == axes.end()) return std::nullopt;
    const auto drive =
        drive_of(joint, static_cast<std::size_t>(axis - axes.begin()), CoordinateMotion::translational);
    const double direction = along(axis->axis, units[i]);
    if (!drive) return std::nullopt;
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

/// What each coordinate that turns the joint by its own value is called here, where its axis is one of the joint's.
std::vector<std::string> meanings_of(const ModelJoint& joint, const SpatialTransform& axes,
                                     std::optional<Anatomy> anatomy, Side side) {
  std::vector<std::string> meanings;
  if (!anatomy || anatomy == Anatomy::shoulder) return meanings;
  constexpr double near = 0.7;  // cosine: one axis at most
  const auto senses = senses_of(*anatomy, side);
  constexpr int turns_about[] = {2, 0, 1};  // Z, X and Y
  for (std::size_t i = 0; i < 3; ++i) {
    const auto drive = drive_of(joint, i, CoordinateMotion::rotational);
    if (!drive) continue;
    for (std::size_t angle = 0; angle < 3; ++angle) {
      const double cosine = drive->slope * axes[i].axis[turns_about[angle]] * senses[angle];
      const AngleNames& names = coordinate_names(*anatomy)[angle];
      if (std::abs(cosine) > near)
        meanings.push_back(fmt::format("{} grows with {}", joint.coordinates[drive->coordinate].name,
                                       cosine > 0 ? names.positive : names.negative));
    }
  }
  return meanings;
}

/// 1 or -1: the sense in which a hinge's Z lies along its axis, given by X forwards, Y up and Z to the right. It lies to the
/// right. Across that, the angle grows with adduction or internal rotation, so that both sides are alike.
double direction_of(const Vec3& axis, double positive, Side side) {
  constexpr double right_angle = 1e-6;  // cosine
  if (std::abs(axis.z()) > right_angle) return axis.z() < 0 ? -1 : 1;
  const double across = std::abs(axis.x()) >= std::abs(axis.y()) ? axis.x() : axis.y();
  return (across < 0 ? -1 : 1) * positive * (side == Side::right ? 1 : -1);
}

/// Maps a joint with one rotation about an axis at rest: Z along the axis, to the right, X as near to the body's as can be.
JointMapping hinge(const ModelJoint& joint, const SpatialTransform& axes, const JointAxes& names,
                   std::size_t turning, JointMapping mapping, std::optional<Anatomy> anatomy, Side side) {
  Eigen::Matrix3d before = Eigen::Matrix3d::Identity();
  for (std::size_t i = 0; i < turning; ++i)
    before = before * rotation_about(axes[i].axis, straight_line(axes[i].function)->offset);
  const Vec3 axis = before * axes[turning].axis;
  const Anatomy named = anatomy.value_or(Anatomy::hip);
  const double positive = senses_of(named, side)[0];
  const Vec3 in_parent = mapping.X_WF.linear() * axis, upright = names.R_PB.transpose() * in_parent;
  const double direction = direction_of(upright, positive, side);
  const Vec3 z = direction * axis;
  const auto across = [&](const Vec3& near) { return Vec3((near - near.dot(z) * z).normalized()); };
  // An axis along X leaves Y where it is.
  const Vec3 x = std::abs(z.x()) < 0.9 ? across(Vec3::UnitX()) : Vec3(across(Vec3::UnitY()).cross(z));
  Eigen::Matrix3d R;
  R << x, z.cross(x), z;
  mapping.X_WF.linear() = mapping.X_WF.linear() * R;
  const AngleNames& angle = coordinate_names(named)[0];
  mapping.kind = JointKind::hinge;
  mapping.why = "one rotation about an axis at rest";
  if (names.R_PB.isIdentity(0)) mapping.turned.clear();  // whatever its frame is, the axis lies where it lies
  mapping.meanings.clear();
  if (const auto drive = drive_of(joint, turning, CoordinateMotion::rotational)) {
    const double sense = direction * positive;
    const ModelCoordinate& coordinate = joint.coordinates[drive->coordinate];
    mapping.columns = {column(joint.name, coordinate, angle.positive, CoordinateKind::angle,
                              drive->slope * sense, drive->offset * sense)};
    mapping.meanings = {fmt::format("{} grows with {}", coordinate.name,
                                    drive->slope * sense > 0 ? angle.positive : angle.negative)};
  } else {
    mapping.why += ", by a function of its coordinates";
  }
  const double off = core::arccosine(std::clamp(direction * upright.z(), -1.0, 1.0)) * degrees_per_radian;
  if (off > 45) {
    const Vec3 positive_about =
        ((1000 * direction * positive * in_parent).array().round() / 1000 + 0.0).matrix();  // no -0
    mapping.oblique = fmt::format(
        "the axis is {:.0f} degrees from the direction to the right, nearest to {}: the angle is called {} "
        "nevertheless, positive about ({:.3f}, {:.3f}, {:.3f}) of body {}",
        off, nearest_axis(direction * positive * upright), angle.positive, positive_about.x(),
        positive_about.y(), positive_about.z(), in_quotes(joint.parent_body));
  }
  return mapping;
}

}  // namespace

JointMapping mapping_of(const StandingModel& model, const ModelJoint& joint, std::optional<Anatomy> anatomy,
                        Side side) {
  const JointAxes names = axes_of(model, joint);
  const SpatialTransform axes = io::named_axes(joint, names);
  const std::vector<double> zeros(joint.coordinates.size());
  JointMapping mapping{.kind = JointKind::free, .turned = names.turned};
  mapping.X_WF.linear() = names.R_PA;
  mapping.X_WF.translation() = joint.X_PF * pose_of(joint.transform->axes, zeros).translation();
  mapping.meanings = io::meanings_of(joint, axes, anatomy, side);

  const bool stays = std::all_of(axes.begin() + 3, axes.end(), is_constant);
  std::vector<std::size_t> turning;
  for (std::size_t i = 0; i < 3; ++i)
    if (!is_constant(axes[i])) turning.push_back(i);

  const bool may_be_hinge = anatomy != Anatomy::hip && anatomy != Anatomy::shoulder;
  if (stays && turning.size() == 1 && may_be_hinge)
    return hinge(joint, axes, names, turning[0], mapping, anatomy, side);

  if (auto angles = anatomy ? angle_columns(joint, axes, *anatomy, side) : std::nullopt;
      angles && are_different(*angles)) {
    if (stays) {
      mapping.kind = JointKind::ball;
      mapping.columns = std::move(*angles);
      mapping.why = "three rotations about Z, X and Y, and a centre at rest";
      return mapping;
    }
    if (auto lengths = length_columns(joint, axes); lengths && are_different(*lengths)) {
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
