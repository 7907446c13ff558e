#include "io/model/model_frames.hpp"

#include <fmt/format.h>

#include "io/file/in_quotes.hpp"
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

}  // namespace

std::string place_of_joint(std::string_view joint) {
  return std::string(joint_mark) + std::string(joint);
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
  const ModelElement element(*source_, frame, fmt::format("frame {}", in_quotes(name)));
  const XmlElement* parent =
      element.first_of({"socket_parent", "connector_parent_connectee_name", "connectors"});
  std::string socket;
  if (parent && parent->children.empty())
    socket = parent->text();
  else if (parent)
    for (const XmlElement& connector : parent->children)
      if (const XmlElement* connectee = connector.child("connectee_name")) socket = connectee->text();
  if (socket.empty()) element.fail("socket_parent is missing");
  if (frame_at(owner, name)) element.fail("stands twice in one place");
  const auto added = frames_.emplace(
      name, Frame{owner, std::move(socket), offset_of(element, {"translation"}, {"orientation"})});
  at_.emplace(std::pair(owner, name), &added->second);
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
    const Frame* named = nullptr;
    for (auto at = first; at != last; ++at) {
      if (name_at_end(at->second.owner) != in) continue;
      if (named) of.fail(fmt::format("{} could be one of several frames", in_quotes(path)));
      named = &at->second;
    }
    if (named) return {"", named};
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
  if (!target.frame) return {target.body};
  if (const auto known = places_.find(target.frame); known != places_.end()) return known->second;
  if (depth > longest_chain_of_frames)
    of.fail(fmt::format("its frame goes round in a circle, or hangs on more than {} others",
                        longest_chain_of_frames));
  BodyPlace place = place_of(target_of(target.frame->parent, target.frame->owner, of), depth + 1, of);
  place.X = place.X * target.frame->X;
  places_.emplace(target.frame, place);
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
