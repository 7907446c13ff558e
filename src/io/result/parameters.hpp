#pragma once

#include <span>
#include <string>

#include "condyle/joint.hpp"
#include "io/result/json.hpp"

/// Parameters of parts with a pose of their own, as answers give them.

namespace condyle::io {

/// A line that names the parameters whose values are not those of the joint file; nothing if there are none.
std::string parameters_text(const Joint& joint);

/// ", cup.inclination by 4 deg": the standard deviations of parameters, for the sentence on a band.
std::string sigmas_text(const Joint& joint);

/// An object for each parameter of each part, in their order.
Json parameters_json(std::span<const PosedPart> parts);

/// An object for each part that was cut from a mesh: which, and the planes in the joint frame of its body. Empty if none was.
Json cuts_json(std::span<const PosedPart> parts);

}  // namespace condyle::io
