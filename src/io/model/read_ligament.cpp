#include "io/model/read_ligament.hpp"

#include <fmt/format.h>

#include "condyle/error.hpp"
#include "io/file/in_quotes.hpp"
#include "io/file/plain_text.hpp"

namespace condyle::io {
namespace {

ModelLigament::Point point_of(const Source& source, const XmlElement& element, const ModelFrames& frames,
                              const ModelElement& of) {
  if (element.name != "PathPoint")
    of.fail_at(element, fmt::format("{}: a point that moves in its body is not read", element.name));
  const ModelElement values(source, element, fmt::format("point {}", in_quotes(element.label())));
  std::string socket;
  for (const std::string_view key : {"socket_parent_frame", "socket_parent_frame_connectee_name", "body"})
    if (socket.empty()) socket = values.text(key);
  if (socket.empty()) values.fail("socket_parent_frame is missing");
  const BodyPlace place = frames.place_of(socket, "", values);
  return {place.body, posed(place.X, values.triple({"location"}, Vec3::Zero()))};
}

/// The path, by its name in version 4 and before.
const XmlElement& path_of(const XmlElement& element, const ModelElement& values) {
  for (const std::string_view name : {"GeometryPath", "path"})
    if (const XmlElement* path = element.child(name))
      if (name == "GeometryPath" || path->child("PathPointSet")) return *path;
  for (const XmlElement& child : element.children)
    for (const XmlElement& inner : child.children)
      if (inner.name == "GeometryPath") return inner;
  for (const XmlElement& child : element.children)
    if (child.name.ends_with("Path"))
      values.fail(fmt::format("its path is a {}, which is not read", child.name));
  values.fail("its GeometryPath is missing");
}

}  // namespace

ModelLigament ligament_of(const Source& source, const XmlElement& element, const ModelFrames& frames) {
  const ModelElement values(source, element, fmt::format("ligament {}", in_quotes(element.label())));
  ModelLigament ligament{.name = values.name(), .line = element.line};
  const XmlElement& path = path_of(element, values);
  if (const XmlElement* points = path.at({"PathPointSet", "objects"}))
    for (const XmlElement& point : points->children)
      ligament.points.push_back(point_of(source, point, frames, values));
  if (ligament.points.size() < 2) values.fail("a path needs two points");
  if (const XmlElement* wraps = path.at({"PathWrapSet", "objects"}))
    for (const XmlElement& wrap : wraps->children)
      ligament.wraps.push_back(ModelElement(source, wrap).text("wrap_object"));
  ligament.stiffness_n = values.number("linear_stiffness", 1);
  ligament.slack_length = values.number("slack_length", 0);
  ligament.transition_strain = values.number("transition_strain", 0.06);
  ligament.damping_n_s = values.number("damping_coefficient", 0.003);
  ligament.applies = values.flag("appliesForce", true) && !values.flag("isDisabled", false);
  if (!(ligament.slack_length > 0)) values.fail("slack_length must be above 0");
  if (!(ligament.stiffness_n >= 0)) values.fail("linear_stiffness must be 0 or more");
  if (!(ligament.transition_strain >= 0)) values.fail("transition_strain must be 0 or more");
  if (!(ligament.damping_n_s >= 0)) values.fail("damping_coefficient must be 0 or more");
  return ligament;
}

ModelWrap wrap_of(const Source& source, const XmlElement& element, const std::string& body) {
  ModelWrap wrap{.name = plain_text(element.label()), .type = plain_text(element.name), .body = body};
  const ModelElement values(source, element, fmt::format("wrap {}", in_quotes(wrap.name)));
  try {
    wrap.X_BW = offset_of(values, {"translation"}, {"xyz_body_rotation"});
    wrap.radii = wrap.type == "WrapEllipsoid" ? values.triple({"dimensions"}, Vec3::Zero())
                                              : Vec3(values.number("radius", 0), 0, 0);
    if (const std::string quadrant = values.text("quadrant"); !quadrant.empty()) wrap.quadrant = quadrant;
    wrap.is_active = values.flag("active", true);
  } catch (const FileError& error) {
    wrap.why_not = error.what();
  }
  return wrap;
}

}  // namespace condyle::io
