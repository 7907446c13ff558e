#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "condyle/io/model_file.hpp"

namespace condyle::io {

/// By the name of a body: which role it has in a joint, and where it lies in that one.
using RoleOfBody = std::map<std::string_view, std::pair<BodyRole, Pose>>;

/// The tables [[ligament]] of a joint file in metres: ligaments whose points are on the two bodies of the joint, first on one, then on the other.
/// What lies between them and cannot be a string of two bodies is noted.
std::string ligament_lines(const Model& model, const RoleOfBody& role_of_body, std::vector<ModelNote>& notes);

}  // namespace condyle::io
