#include "io/model/read_joint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/error.hpp"
#include "core/one_line.hpp"
#include "io/file/in_quotes.hpp"
#include "io/file/plain_text.hpp"
#include "io/file/words.hpp"
#include "io/model/spatial_transform.hpp"

namespace condyle::io {
namespace {

/// Which of the six axes each coordinate of a joint of this type drives, in their order.
struct JointType {
  std::string_view name;
  std::vector<std::pair<std::size_t, Vec3>> axes;
};

const std::vector<JointType>& joint_types() {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  static const std::vector<JointType> types = {
      {"WeldJoint", {}},
      {"PinJoint", {{0, z}}},
      {"SliderJoint", {{3, x}}},
      {"UniversalJoint", {{0, x}, {1, y}}},
      {"BallJoint", {{0, x}, {1, y}, {2, z}}},
      {"GimbalJoint", {{0, x}, {1, y}, {2, z}}},
      {"PlanarJoint", {{0, z}, {3, x}, {4, y}}},
      {"FreeJoint", {{0, x}, {1, y}, {2, z}, {3, x}, {4, y}, {5, z}}},
  };
  return types;
}

constexpr std::string_view axis_names[] = {"rotation1",    "rotation2",    "rotation3",
                                           "translation1", "translation2", "translation3"};

/// Reference to a body: an element of one of these names, or a connector of versions 30501 to 30507.
std::string socket_of(const ModelElement& joint, std::initializer_list<std::string_view> elements,
                      std::initializer_list<std::string_view> connectors) {
  if (const XmlElement* element = joint.first_of(elements)) return element->text();
  const XmlElement* all = joint.xml().child("connectors");
  if (!all) return {};
  for (const XmlElement& connector : all->children)
    for (const std::string_view name : connectors)
      if (connector.label() == name)
        if (const XmlElement* connectee = connector.child("connectee_name")) return connectee->text();
  return {};
}

ModelCoordinate coordinate_of(const Source& source, const XmlElement& element, const std::string& joint) {
  const ModelElement values(source, element,
                            fmt::format("{}: coordinate {}", joint, in_quotes(element.label())));
  ModelCoordinate coordinate{.name = values.name()};
  if (coordinate.name.empty()) values.fail("has no name");
  coordinate.default_value = values.number("default_value", 0);
  if (const XmlElement* range = element.child("range"); range && !range->text().empty()) {
    const std::vector<double> ends = values.numbers(*range);
    if (ends.size() != 2)
      values.fail_at(*range, fmt::format("range: two numbers are needed, not {}", ends.size()));
    coordinate.range = {std::min(ends[0], ends[1]), std::max(ends[0], ends[1])};
  }
  coordinate.is_clamped = values.flag("clamped", true);
  coordinate.is_locked = values.flag("locked", false);
  coordinate.is_prescribed = values.flag("prescribed", false);
  return coordinate;
}

std::vector<ModelCoordinate> coordinates_of(const ModelElement& joint, const std::string& name) {
  const XmlElement* set = joint.first_of({"coordinates", "CoordinateSet"});
  if (!set) return {};
  if (const XmlElement* objects = set->child("objects")) set = objects;
  std::vector<ModelCoordinate> coordinates;
  constexpr std::size_t most_coordinates = 6;
  for (const XmlElement& child : set->children) {
    if (child.name != "Coordinate") continue;
    if (coordinates.size() == most_coordinates)
      joint.fail_at(child, fmt::format("more than {} coordinates", most_coordinates));
    coordinates.push_back(coordinate_of(joint.source(), child, name));
    for (std::size_t i = 0; i + 1 < coordinates.size(); ++i)
      if (coordinates[i].name == coordinates.back().name)
        joint.fail_at(child, fmt::format("coordinate {} is given twice", in_quotes(coordinates[i].name)));
  }
  return coordinates;
}

TransformAxis axis_of(const Source& source, const XmlElement& element, const std::string& of,
                      const std::vector<ModelCoordinate>& coordinates) {
  const ModelElement values(source, element, of);
  TransformAxis axis;
  const XmlElement* list = element.child("coordinates");
  const std::string named = list ? list->text() : std::string();
  for (const std::string_view word : io::words_of(named)) {
    const auto found = std::find_if(coordinates.begin(), coordinates.end(),
                                    [&](const ModelCoordinate& c) { return c.name == word; });
    if (found == coordinates.end())
      values.fail(fmt::format("coordinate {} is none of this joint's", in_quotes(word)));
    axis.coordinates.push_back(static_cast<std::size_t>(found - coordinates.begin()));
  }
  axis.axis = values.triple({"axis"}, Vec3::UnitX());
  if (!(axis.axis.norm() > 0) || !std::isfinite(axis.axis.norm())) values.fail("axis: has no direction");
  axis.axis.normalize();

  const std::size_t count = axis.coordinates.size();
  for (const XmlElement& child : element.children)
    if (child.name != "coordinates" && child.name != "axis" && child.name != "function" &&
        child.name_attribute != "function" && !is_function(child.name))
      values.fail_at(child, fmt::format("{} is not read here", in_quotes(child.name)));
  if (auto function = values.function()) {
    axis.function = std::move(*function);
  } else if (count == 1) {
    axis.function = LinearFunction{{1}, 0};
  } else if (count > 1) {
    values.fail(fmt::format("{} coordinates and no function of them", count));
  }
  const std::size_t taken = arguments_of(axis.function).value_or(count);
  if (taken != count)
    values.fail(fmt::format("a function of {} coordinates, and {} are named", taken, count));
  return axis;
}

/// OpenSim refuses them too.
void refuse_parallel(const SpatialTransform& axes, const ModelElement& joint) {
  constexpr double parallel = 1e-5;
  for (const std::size_t first : {0u, 3u})
    for (std::size_t i = first; i < first + 3; ++i)
      for (std::size_t k = i + 1; k < first + 3; ++k)
        if (axes[i].axis.cross(axes[k].axis).norm() < parallel)
          joint.fail(fmt::format("{} and {} are about one axis", axis_names[i], axis_names[k]));
}

SpatialTransform custom_transform(const ModelElement& joint, const std::string& name,
                                  const std::vector<ModelCoordinate>& coordinates) {
  if (joint.xml().child("TransformAxisSet"))
    joint.fail("TransformAxisSet is of OpenSim 1: save the model with OpenSim 3 or later");
  const XmlElement* transform = joint.xml().child("SpatialTransform");
  if (!transform) joint.fail("SpatialTransform is missing");
  SpatialTransform axes;
  const Vec3 units[] = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  for (std::size_t i = 0; i < 6; ++i) axes[i].axis = units[i % 3];
  std::array<bool, 6> given{};
  for (const XmlElement& child : transform->children) {
    if (child.name != "TransformAxis") continue;
    const std::string label = child.label();
    const auto* const found = std::find(std::begin(axis_names), std::end(axis_names), label);
    if (found == std::end(axis_names))
      joint.fail_at(child, fmt::format("{} is no name of a TransformAxis", in_quotes(label)));
    const auto i = static_cast<std::size_t>(found - std::begin(axis_names));
    if (given[i]) joint.fail_at(child, fmt::format("{} is given twice", label));
    given[i] = true;
    axes[i] = axis_of(joint.source(), child, fmt::format("{}: {}", name, label), coordinates);
  }
  refuse_parallel(axes, joint);
  return axes;
}

SpatialTransform transform_of(const ModelElement& joint, const std::string& name,
                              const std::vector<ModelCoordinate>& coordinates) {
  const std::string_view element = joint.xml().name;
  if (element == "CustomJoint") return custom_transform(joint, name, coordinates);
  const auto type = std::find_if(joint_types().begin(), joint_types().end(),
                                 [&](const JointType& of) { return of.name == element; });
  if (type == joint_types().end())
    joint.fail(fmt::format("a joint of type {} is not read", core::one_line(element, 60)));
  if (type->axes.size() != coordinates.size())
    joint.fail(
        fmt::format("a {} has {} coordinates, not {}", element, type->axes.size(), coordinates.size()));
  SpatialTransform axes;
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const auto& [slot, direction] = type->axes[i];
    axes[slot] = {{i}, direction, LinearFunction{{1}, 0}};
  }
  return axes;
}

/// Kind of a coordinate in OpenSim: it reads degrees only for those that turn the joint by their own value.
CoordinateMotion motion_of(const SpatialTransform& axes, std::size_t coordinate, const ModelElement& joint,
                           const std::string& name) {
  const auto drives = [&](const TransformAxis& axis) {
    return std::find(axis.coordinates.begin(), axis.coordinates.end(), coordinate) != axis.coordinates.end();
  };
  bool turns = false, moves = false;
  for (std::size_t i = 0; i < 6; ++i) {
    if (!drives(axes[i])) continue;
    (i < 3 ? turns : moves) = true;
    const auto* linear = i < 3 ? std::get_if<LinearFunction>(&axes[i].function) : nullptr;
    if (linear && linear->slopes.size() == 1 && std::abs(linear->slopes[0]) == 1)
      return CoordinateMotion::rotational;
  }
  if (!turns && !moves) joint.fail(fmt::format("coordinate {} is used by no axis", in_quotes(name)));
  return turns ? CoordinateMotion::coupled : CoordinateMotion::translational;
}

void read(ModelJoint& out, const ModelElement& joint, const std::string& of,
          const std::string& enclosing_body, const ModelFrames& frames, int version) {
  const std::string parent =
      socket_of(joint, {"parent_body", "socket_parent_frame", "connector_parent_frame_connectee_name"},
                {"parent_body", "parent_frame"});
  std::string child = socket_of(joint, {"socket_child_frame", "connector_child_frame_connectee_name"},
                                {"child_body", "child_frame"});
  if (parent.empty()) joint.fail("the parent body is missing");
  if (child.empty()) child = enclosing_body;
  if (child.empty()) joint.fail("the child body is missing");
  const std::string here = place_of_joint(joint.xml());
  // The body that can be found stands in a joint that is refused too: a weld of it matters to that body's joints.
  const BodyPlace of_child = frames.place_of(child, here, joint);
  out.child_body = of_child.body;
  const BodyPlace of_parent = frames.place_of(parent, here, joint);
  out.parent_body = of_parent.body;
  joint.require_plain(out.child_body, "the name of its child body");
  joint.require_plain(out.parent_body, "the name of its parent body");
  out.X_PF = of_parent.X * offset_of(joint, {"location_in_parent"}, {"orientation_in_parent"});
  out.X_CM = of_child.X *
             offset_of(joint, {"location_in_child", "location"}, {"orientation_in_child", "orientation"});
  out.is_reversed = joint.flag("reverse", false);
  if (out.is_reversed && version <= last_version_with_reverse) {
    std::swap(out.parent_body, out.child_body);
    std::swap(out.X_PF, out.X_CM);
  }
  out.coordinates = coordinates_of(joint, of);
  ModelTransform transform{transform_of(joint, of, out.coordinates)};
  for (std::size_t i = 0; i < out.coordinates.size(); ++i)
    out.coordinates[i].motion = motion_of(transform.axes, i, joint, out.coordinates[i].name);
  out.transform = std::make_shared<const ModelTransform>(std::move(transform));
}

}  // namespace

bool is_joint(std::string_view element) noexcept {
  return element.ends_with("Joint") && element != "Joint";
}

ModelJoint joint_of(const Source& source, const XmlElement& element, const std::string& enclosing_body,
                    const ModelFrames& frames, int version) {
  const std::string of = fmt::format("joint {}", in_quotes(element.label()));
  const ModelElement joint(source, element, of);
  ModelJoint out{
      .name = plain_text(element.label()), .type = core::one_line(element.name, 60), .line = element.line};
  try {
    joint.name();  // fails for one that is not plain
    read(out, joint, of, enclosing_body, frames, version);
  } catch (const FileError& error) {
    out.why_not = error.what();
  }
  return out;
}

}  // namespace condyle::io
