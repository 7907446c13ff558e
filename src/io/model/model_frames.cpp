#include "io/model/model_frames.hpp"

#include <fmt/format.h>

#include "core/one_line.hpp"
#include "io/file/in_quotes.hpp"
#include "io/mesh/parse.hpp"
#include "io/model/spatial_transform.hpp"

namespace condyle::io {
namespace {

constexpr std::size_t longest_chain_of_frames = 1000;
constexpr std::string_view joint_mark = "joint:";

/// A path without its last name, and that name.
std::pair<std::string, std::string> split_last(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  if (slash == path.npos) return {"", path};
  return {path.substr(0, slash), path.substr(slash + 1)};
}

/// The last name of where a frame stands: of its body, joint or frame.
std::string_view name_at_end(std::string_view owner) {
  owner = owner.substr(owner.rfind('/') + 1);  // all of it where there is no slash
  if (owner.starts_with(joint_mark)) owner.remove_prefix(joint_mark.size());
  return owner;
}

/// How many ".." a path is; 0 for one that is anything else.
std::size_t steps_up(std::string_view path) {
  std::size_t steps = 0;
  for (; path.starts_with(".."); ++steps) {
    path.remove_prefix(2);
    if (path.starts_with('/')) path.remove_prefix(1);
  }
  return path.empty() ? steps : 0;
}

/// 0, 1 and 2 are x, y and z.
struct SignedAxis {
  int axis;
  double sign;
};

/// An axis as "+x", "-z", "y".
SignedAxis signed_axis(const ModelElement& of, std::string_view child, std::string_view otherwise) {
  const std::string given = of.text(child);
  std::string word = lower_case(given.empty() ? otherwise : std::string_view(given));
  const double sign = word.starts_with('-') ? -1 : 1;
  if (word.starts_with('-') || word.starts_with('+')) word.erase(0, 1);
  if (word != "x" && word != "y" && word != "z")
    of.fail(fmt::format("{}: {} is no axis", child, in_quotes(given)));
  return {word[0] - 'x', sign};
}

}  // namespace

std::string place_of_joint(const XmlElement& joint) {
  const std::string name = joint.label();
  return std::string(joint_mark) + (name.empty() ? fmt::format("line {}", joint.line) : name);
}

Pose offset_of(const ModelElement& element, std::initializer_list<std::string_view> translation,
               std::initializer_list<std::string_view> orientation) {
  Pose X = Pose::Identity();
  X.translation() = element.triple(translation, Vec3::Zero());
  X.linear() = body_fixed_xyz(element.triple(orientation, Vec3::Zero()));
  return X;
}

void ModelFrames::add_frame(const XmlElement& frame, const std::string& owner) {
  const std::string name = frame.label();
  if (const auto known = at_.find({owner, name}); known != at_.end()) {
    ++known->second->count;
    return;
  }
  const auto added = frames_.emplace(name, Frame{owner, &frame});
  at_.emplace(std::pair(owner, name), &added->second);
  of_place_[{name, std::string(name_at_end(owner))}].push_back(&added->second);
}

void ModelFrames::add_point(const XmlElement& point, const std::string& owner) {
  const std::string name = point.label();
  points_[name].push_back({owner, &point});
  points_of_place_[{name, std::string(name_at_end(owner))}].push_back({owner, &point});
}

const ModelFrames::Frame* ModelFrames::frame_at(const std::string& owner, const std::string& name) const {
  const auto found = at_.find({owner, name});
  return found == at_.end() ? nullptr : found->second;
}

ModelFrames::Target ModelFrames::target_at(const std::string& path, const ModelElement& of) const {
  if (is_body(path)) return {path, nullptr};
  const auto [owner, name] = split_last(path);
  if (const Frame* frame = frame_at(owner, name)) return {"", frame};
  of.fail(fmt::format("there is no body or frame {}", in_quotes(name)));
}

ModelFrames::Target ModelFrames::target_of(std::string path, const std::string& owner,
                                           const ModelElement& of) const {
  while (path.ends_with('/')) path.pop_back();
  if (const std::size_t steps = steps_up(path)) {
    std::string at = owner;
    for (std::size_t step = 1; step < steps; ++step) at = split_last(at).first;
    return target_at(at, of);
  }
  const auto [before, name] = split_last(path);
  const std::string in = split_last(before).second;
  if (in == "bodyset" && is_body(name)) return {name, nullptr};
  const auto [first, last] = frames_.equal_range(name);
  if (!in.empty() && in != "..") {
    if (const auto named = of_place_.find({name, in}); named != of_place_.end()) {
      if (named->second.size() > 1)
        of.fail(fmt::format("{} could be one of several frames", in_quotes(path)));
      return {"", named->second.front()};
    }
    if (is_body(in) && !is_body(name))
      of.fail(fmt::format("there is no frame {} in body {}", in_quotes(name), in_quotes(in)));
  }
  if (const Frame* own = frame_at(owner, name)) return {"", own};
  if (is_body(name)) return {name, nullptr};
  if (first == last) of.fail(fmt::format("there is no body or frame {}", in_quotes(path)));
  if (std::next(first) != last) of.fail(fmt::format("{} could be one of several frames", in_quotes(name)));
  return {"", &first->second};
}

BodyPlace ModelFrames::place_of(const Target& target, std::size_t depth, const ModelElement& of) const {
  if (!target.frame) {
    if (twice_.contains(target.body)) of.fail(fmt::format("body {} is given twice", in_quotes(target.body)));
    return {target.body};
  }
  if (const auto known = places_.find(target.frame); known != places_.end()) return known->second;
  if (depth > longest_chain_of_frames)
    of.fail(fmt::format("its frame goes round in a circle, or hangs on more than {} others",
                        longest_chain_of_frames));
  const Frame& frame = *target.frame;
  const ModelElement element(*source_, *frame.element,
                             fmt::format("frame {}", in_quotes(frame.element->label())));
  if (frame.count > 1) element.fail("stands twice in one place");
  const std::string_view type = frame.element->name;
  if (type != "PhysicalOffsetFrame" && type != "StationDefinedFrame")
    element.fail(fmt::format("a frame of type {} is not read", core::one_line(type, 60)));
  const BodyPlace place = type == "StationDefinedFrame" ? place_of_stations(frame, depth + 1, element)
                                                        : place_of_offset(frame, depth + 1, element);
  places_.emplace(&frame, place);
  return place;
}

BodyPlace ModelFrames::place_of_offset(const Frame& frame, std::size_t depth, const ModelElement& of) const {
  const XmlElement* parent = of.first_of({"socket_parent", "connector_parent_connectee_name", "connectors"});
  std::string socket;
  if (parent && parent->children.empty())
    socket = parent->text();
  else if (parent)
    for (const XmlElement& connector : parent->children)
      if (const XmlElement* connectee = connector.child("connectee_name")) socket = connectee->text();
  if (socket.empty()) of.fail("socket_parent is missing");
  BodyPlace place = place_of(target_of(socket, frame.owner, of), depth, of);
  place.X = place.X * offset_of(of, {"translation"}, {"orientation"});
  return place;
}

const ModelFrames::Point& ModelFrames::point_named(const std::string& path, const std::string& owner,
                                                   const ModelElement& of) const {
  const auto [before, name] = split_last(path);
  const std::string in = split_last(before).second;
  const std::string_view wanted = in.empty() || in == ".." ? name_at_end(owner) : std::string_view(in);
  const auto named = points_of_place_.find({name, std::string(wanted)});
  const bool is_named = named != points_of_place_.end();
  const auto all = points_.find(name);
  if (!is_named && all == points_.end()) of.fail(fmt::format("there is no point {}", in_quotes(path)));
  const std::vector<Point>& points = is_named ? named->second : all->second;
  if (points.size() > 1) of.fail(fmt::format("{} could be one of several points", in_quotes(path)));
  return points.front();
}

BodyPlace ModelFrames::place_of_point(const std::string& path, const std::string& owner, std::size_t depth,
                                      const ModelElement& of) const {
  const Point& point = point_named(path, owner, of);
  const ModelElement element(*source_, *point.element,
                             fmt::format("point {}", in_quotes(point.element->label())));
  const XmlElement* socket = element.first_of({"socket_parent_frame", "socket_parent_frame_connectee_name"});
  if (!socket) element.fail("socket_parent_frame is missing");
  BodyPlace place = place_of(target_of(socket->text(), point.owner, element), depth, element);
  place.X.translation() = place.X * element.triple({"location"}, Vec3::Zero());
  return place;
}

BodyPlace ModelFrames::place_of_stations(const Frame& frame, std::size_t depth,
                                         const ModelElement& of) const {
  std::vector<BodyPlace> points;
  for (const char* socket : {"socket_point_a", "socket_point_b", "socket_point_c", "socket_origin_point"}) {
    const std::string path = of.text(socket);
    if (path.empty()) of.fail(fmt::format("{} is missing", socket));
    points.push_back(place_of_point(path, frame.owner, depth, of));
    if (points.back().body != points.front().body)
      of.fail(fmt::format("{} is of body {}, and socket_point_a of {}", socket, in_quotes(points.back().body),
                          in_quotes(points.front().body)));
  }
  const Vec3 a = points[0].X.translation(), ab = points[1].X.translation() - a,
             normal = ab.cross(points[2].X.translation() - a);
  constexpr double in_line = 1e-12;  // sine
  if (!(normal.norm() > in_line * ab.norm() * (points[2].X.translation() - a).norm()))
    of.fail("its points a, b and c lie on a line");
  const SignedAxis along_ab = signed_axis(of, "ab_axis", "+x"),
                   across = signed_axis(of, "ab_x_ac_axis", "+y");
  if (along_ab.axis == across.axis) of.fail("ab_axis and ab_x_ac_axis are one axis");
  BodyPlace place = points[3];
  Eigen::Matrix3d R;
  R.col(along_ab.axis) = along_ab.sign * ab.normalized();
  R.col(across.axis) = across.sign * normal.normalized();
  const int third = 3 - along_ab.axis - across.axis;
  R.col(third) = R.col((third + 1) % 3).cross(R.col((third + 2) % 3));
  place.X.linear() = R;
  return place;
}

BodyPlace ModelFrames::place_of(std::string_view socket, const std::string& owner,
                                const ModelElement& of) const {
  return place_of(target_of(std::string(socket), owner, of), 0, of);
}

BodyPlace ModelFrames::place_at(const std::string& path, const ModelElement& of) const {
  return place_of(target_at(path, of), 0, of);
}

}  // namespace condyle::io
