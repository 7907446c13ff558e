#pragma once

#include <span>
#include <string>

#include "condyle/implant.hpp"
#include "condyle/joint.hpp"
#include "io/result/json.hpp"

/// Parameters of parts with a pose of their own, as answers give them.

namespace condyle::io {

/// What a plan did to the joint and the values that its parts were set to; empty if it is as its file has it and as it was measured.
std::string planned_text(const Joint& joint);

/// ", meshes in centimetres", and of another species than human which: behind what an answer begins with. Empty of a human's in millimetres.
std::string whose_text(const Joint& joint);

/// Lines on what is planned, on the parameters whose values are not those of the joint file, and on the angles of the cup of an implant by each definition;
/// nothing if there is neither.
std::string parameters_text(const Joint& joint);

/// An object for each of Murray's definitions: inclination_deg and anteversion_deg.
Json cup_json(std::span<const plan::CupAngles> cup);

/// ", cup.inclination by 4 deg": the standard deviations of parameters, for the sentence on a band.
std::string sigmas_text(const Joint& joint);

/// An object for each parameter of each part, in their order.
Json parameters_json(std::span<const PosedPart> parts);

/// An object for each part that was cut from a mesh: which, and the planes in the joint frame of its body. Empty if none was.
Json cuts_json(std::span<const PosedPart> parts);

}  // namespace condyle::io
