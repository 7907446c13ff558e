#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>

#include "condyle/io/pose_text.hpp"
#include "condyle/joint.hpp"
#include "condyle/joint_checks.hpp"
#include "condyle/points.hpp"

/// What all JSON answers have in common.

namespace condyle::io {

using Json = nlohmann::ordered_json;

/// What an answer about bones does not cover; every result says so.
inline constexpr const char* scope_note =
    "osseous contact of the meshes given; soft tissue is not modelled; research software, not a medical "
    "device";

/// An empty answer is null, never a number that could be read as one.
template <class Value>
Json nullable(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

inline Json numbers(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

/// What looks wrong with a joint, under `notes` in every answer for one.
inline Json notes_json(std::span<const JointNote> notes) {
  Json list = Json::array();
  for (const JointNote& note : notes) list.push_back({{"code", name_of(note.code)}, {"text", note.text}});
  return list;
}

/// Which joint it is; null for a hinge that is none in particular.
inline Json anatomy_json(const Joint& joint) {
  return joint.names_its_joint() ? Json(name_of(joint.anatomy)) : Json(nullptr);
}

/// As it was given.
inline Json pose_json(const PoseDegrees& pose, Anatomy joint) {
  Json json;
  for (const JointAngle angle : all_joint_angles) json[name_of(angle, joint)] = pose[angle];
  return json;
}

/// Without the sign of 0, which says nothing.
inline void drop_negative_zeros(Json& json) {
  if (json.is_number_float() && json.get<double>() == 0) json = 0.0;
  if (json.is_structured())
    for (Json& element : json) drop_negative_zeros(element);
}

/// A whole document; bytes of a name that are not UTF-8 are replaced.
inline std::string document(Json json) {
  drop_negative_zeros(json);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace condyle::io
