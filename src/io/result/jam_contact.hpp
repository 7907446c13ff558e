#pragma once

#include "condyle/io/jam_file.hpp"
#include "io/result/motion_result.hpp"

namespace condyle::io {

/// The contact of a motion as OpenSim-JAM reports it: for the surface that is cast; the mobile one's if both are.
JamContact jam_contact(const MotionQuestion& question, const MotionAnswer& answer);

/// The joint's coordinates in each frame, by their names: degrees and m, NaN if a frame has no answer.
std::vector<JamCoordinate> jam_coordinates(const MotionQuestion& question, const MotionAnswer& answer);

}  // namespace condyle::io
