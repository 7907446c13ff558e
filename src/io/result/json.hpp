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

Json numbers(const Vec3& p);

/// What looks wrong with a joint, under `notes` in every answer for one.
Json notes_json(std::span<const JointNote> notes);

/// Which joint it is; null for a hinge that is none in particular.
Json anatomy_json(const Joint& joint);

/// As it was given.
Json pose_json(const PoseDegrees& pose, Anatomy joint);

/// Without the sign of 0, which says nothing.
void drop_negative_zeros(Json& json);

/// A whole document; bytes of a name that are not UTF-8 are replaced.
std::string document(Json json);

}  // namespace condyle::io
