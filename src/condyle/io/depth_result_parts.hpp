#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "condyle/contact/radial_summary.hpp"
#include "condyle/io/depth_result.hpp"

/// What the results of both methods have in common.

namespace condyle {

using Json = nlohmann::ordered_json;

inline constexpr const char* scope_note =
    "osseous contact of the meshes given; soft tissue is not modelled; research software, not a medical "
    "device";

/// An empty answer is null, never a number that could be read as one.
template <class Value>
Json nullable(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json numbers(const Vec3& p);

/// The question and the answers that do not depend on the method.
Json depth_header(const DepthQuestion& question, const char* method);

/// "right hip: femur in hip bone, flexion 90, ...", and whether they touch; two lines.
std::string depth_headline(const DepthQuestion& question, bool in_contact, std::size_t pairs);

/// "  femur: 25 of 7349 vertices inside" and what is worth saying besides; one line.
std::string inside_line(const Body& body, std::size_t inside, std::size_t on_surface);

}  // namespace condyle
