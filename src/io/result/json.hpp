#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "condyle/io/pose_text.hpp"
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

/// As it was given.
inline Json pose_json(const PoseDegrees& pose) {
  return {{"flexion", pose.flexion},
          {"adduction", pose.adduction},
          {"internal_rotation", pose.internal_rotation}};
}

/// A whole document; bytes of a name that are not UTF-8 are replaced.
inline std::string document(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace condyle::io
