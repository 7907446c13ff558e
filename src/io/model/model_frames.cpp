#include "io/model/model_frames.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/file/in_quotes.hpp"
#include "io/model/spatial_transform.hpp"

namespace condyle::io {
namespace {

constexpr std::size_t longest_chain_of_frames = 1000;

}  // namespace

Pose offset_of(const ModelElement& element, std::initializer_list<std::string_view> translation,
               std::initializer_list<std::string_view> orientation) {
  Pose X = Pose::Identity();
  X.translation() = element.triple(translation, Vec3::Zero());
  X.linear() = body_fixed_xyz(element.triple(orientation, Vec3::Zero()));
  return X;
}

void ModelFrames::add_frame(const XmlElement& frame, std::string owner) {
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
  frames_.emplace(
      name, Frame{std::move(owner), std::move(socket), offset_of(element, {"translation"}, {"orientation"})});
}

/// Of the component that it stands in, else of the owner that the path names, else the only one.
const ModelFrames::Frame* ModelFrames::frame_named(const std::string& name, std::string_view owner,
                                                   std::string_view stands_in, const ModelElement& of) const {
  const auto [first, last] = frames_.equal_range(name);
  const Frame *of_owner = nullptr, *only = nullptr;
  std::size_t count = 0;
  for (auto at = first; at != last; ++at, ++count) {
    only = &at->second;
    if (only->owner == stands_in) return only;
    if (only->owner == owner) of_owner = only;
  }
  if (of_owner || count < 2) return of_owner ? of_owner : only;
  of.fail(fmt::format("{} could be one of {} frames", in_quotes(name), count));
}

BodyPlace ModelFrames::place_of(std::string_view socket, std::string_view owner,
                                const ModelElement& of) const {
  BodyPlace place;
  std::string path(socket), stands_in(owner);
  for (std::size_t steps = 0; steps <= std::min(frames_.size(), longest_chain_of_frames); ++steps) {
    while (path.ends_with('/')) path.pop_back();
    const std::size_t slash = path.rfind('/');
    std::string name = slash == path.npos ? path : path.substr(slash + 1);
    const std::string before = slash == path.npos ? "" : path.substr(0, slash);
    std::string in(before.substr(before.rfind('/') + 1));  // all of it where there is no slash
    if (name == "..") name = stands_in, in.clear();

    const auto [first, last] = frames_.equal_range(name);
    const bool is_own =
        std::any_of(first, last, [&](const auto& each) { return each.second.owner == stands_in; });
    if (!is_own && is_body(name)) {
      place.body = name;
      return place;
    }
    const Frame* frame = frame_named(name, in, stands_in, of);
    if (!frame) of.fail(fmt::format("there is no body or frame {}", in_quotes(path)));
    place.X = frame->X * place.X;
    path = frame->parent;
    stands_in = frame->owner;
  }
  of.fail(fmt::format("the frame {} goes round in a circle, or hangs on more than {} others",
                      in_quotes(socket), longest_chain_of_frames));
}

}  // namespace condyle::io
