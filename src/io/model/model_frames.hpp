#pragma once

#include <map>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "condyle/pose.hpp"
#include "io/model/model_element.hpp"

namespace condyle::io {

/// Where something is: in the frame of a body.
struct BodyPlace {
  std::string body;
  Pose X = Pose::Identity();
};

/// Bodies of a model and the frames that hang on them, one on another.
class ModelFrames {
 public:
  explicit ModelFrames(const Source& source) : source_(&source) {}

  void add_body(const std::string& name) {
    bodies_.push_back(name);
    known_.insert(name);
  }
  /// A PhysicalOffsetFrame; `owner` is the joint, body or frame that it stands in.
  void add_frame(const XmlElement& frame, std::string owner);

  const std::vector<std::string>& bodies() const noexcept { return bodies_; }
  bool is_body(const std::string& name) const { return known_.contains(name); }

  /// What a socket leads to, of a component that stands in `owner`: a path whose last name decides, the owner's own frames
  /// before a body. Fails in the name of `of` for one that leads nowhere, could be two, or goes round in a circle.
  BodyPlace place_of(std::string_view socket, std::string_view owner, const ModelElement& of) const;

 private:
  struct Frame {
    std::string owner, parent;
    Pose X;
  };
  const Frame* frame_named(const std::string& name, std::string_view owner, std::string_view stands_in,
                           const ModelElement& of) const;

  const Source* source_;
  std::vector<std::string> bodies_;
  std::unordered_set<std::string> known_;
  std::multimap<std::string, Frame> frames_;  ///< by their names
};

/// X from a translation and body-fixed X-Y-Z angles, elements of these names.
Pose offset_of(const ModelElement& element, std::initializer_list<std::string_view> translation,
               std::initializer_list<std::string_view> orientation);

}  // namespace condyle::io
