#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "condyle/pose.hpp"
#include "io/model/model_element.hpp"

namespace condyle::io {

/// Where something is: in the frame of a body.
struct BodyPlace {
  std::string body;
  Pose X = Pose::Identity();
};

/// Scope of a joint's frames, which may have a body's name. A joint without a name has one by its line.
std::string place_of_joint(const XmlElement& joint);

/// Bodies of a model and the frames that are attached to them, one to another. A path gives the place of a component: a body's
/// name, place_of_joint(), and the names of frames after it.
class ModelFrames {
 public:
  explicit ModelFrames(const Source& source) : source_(&source) {}

  /// A second body of one name fails for what refers to either.
  void add_body(const std::string& name) {
    if (known_.insert(name).second)
      bodies_.push_back(name);
    else
      twice_.insert(name);
  }
  /// A frame that stands in `owner`: a PhysicalOffsetFrame or a StationDefinedFrame. What is wrong with it fails for those
  /// that hang on it only. The element is borrowed.
  void add_frame(const XmlElement& frame, const std::string& owner);
  /// A Station or a Marker that stands in `owner`, borrowed: points of a StationDefinedFrame.
  void add_point(const XmlElement& point, const std::string& owner);

  const std::vector<std::string>& bodies() const noexcept { return bodies_; }
  bool is_body(const std::string& name) const { return known_.contains(name); }

  /// Target of a socket of a component that stands in `owner`. A path's last name decides: with the name before it a frame
  /// of that body or joint, else one of the owner's own, else a body, else the only frame of that name; ".." is the owner.
  /// Fails in the name of `of` for one that leads nowhere, could be two, or goes round in a circle.
  BodyPlace place_of(std::string_view socket, const std::string& owner, const ModelElement& of) const;

  /// Where the body or frame at this path is.
  BodyPlace place_at(const std::string& path, const ModelElement& of) const;

 private:
  struct Frame {
    std::string owner;
    const XmlElement* element;
    std::size_t count = 1;  ///< frames of this name in this place
  };
  struct Point {
    std::string owner;
    const XmlElement* element;
  };
  /// A body's name, or a frame.
  struct Target {
    std::string body;
    const Frame* frame = nullptr;
  };

  const Frame* frame_at(const std::string& owner, const std::string& name) const;
  Target target_at(const std::string& path, const ModelElement& of) const;
  Target target_of(std::string path, const std::string& owner, const ModelElement& of) const;
  BodyPlace place_of(const Target& target, std::size_t depth, const ModelElement& of) const;
  BodyPlace place_of_offset(const Frame& frame, std::size_t depth, const ModelElement& of) const;
  BodyPlace place_of_stations(const Frame& frame, std::size_t depth, const ModelElement& of) const;
  const Point& point_named(const std::string& path, const std::string& owner, const ModelElement& of) const;
  BodyPlace place_of_point(const std::string& path, const std::string& owner, std::size_t depth,
                           const ModelElement& of) const;

  const Source* source_;
  std::vector<std::string> bodies_;
  std::set<std::string> known_, twice_;
  using Names = std::pair<std::string, std::string>;

  std::multimap<std::string, Frame> frames_;             ///< by their names
  std::map<Names, Frame*> at_;                           ///< by owner and name
  std::map<Names, std::vector<const Frame*>> of_place_;  ///< by name and the last name of the owner
  std::map<std::string, std::vector<Point>> points_;     ///< by their names
  std::map<Names, std::vector<Point>> points_of_place_;  ///< by name and the last name of the owner
  mutable std::map<const Frame*, BodyPlace> places_;     ///< of frames that were asked for
};

/// X from a translation and body-fixed X-Y-Z angles, elements of these names.
Pose offset_of(const ModelElement& element, std::initializer_list<std::string_view> translation,
               std::initializer_list<std::string_view> orientation);

}  // namespace condyle::io
