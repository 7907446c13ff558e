#pragma once

#include <string>
#include <vector>

#include "condyle/impingement_zone.hpp"
#include "condyle/io/mesh_file.hpp"

/// Impingement zones for files. Every array, unit and sign is in docs/formats-rom.md.

namespace condyle::io {

/// Point arrays of one body: radial_depth_mm, ray_to_normal_deg, tangential_depth_deg, tangential_depth_mm.
/// None if the other mesh is open and nothing can be inside it. An arc that nothing ends is NaN.
std::vector<MeshArray> zone_point_arrays(const motion::BodyZone& zone);

/// Cell array in_zone: 1 for a triangle that meets the other body.
MeshArray zone_cell_array(const motion::BodyZone& zone, std::size_t triangles);

/// X_FM at which the zone was found: past the limit.
Pose zone_pose(const motion::ImpingementZone& zone, CoordinateSystem system);

/// Part of a file name that is one whatever characters a motion's name holds: letters, digits, '-' and '_',
/// no more than 60 of them.
std::string file_name_part(std::string_view motion);

}  // namespace condyle::io
