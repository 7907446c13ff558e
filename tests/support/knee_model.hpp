#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace condyle::test {

/// Whether the shared data has the published knee and its OpenSim model.
bool has_knee_model();

/// Copies that model, lenhart2015.osim, into the folder, and makes the cartilages that it names, in metres with all digits, in
/// Geometry beside it; `parts` are some of "femur", "tibia", "patella". Its bones stay missing, as most meshes of most models.
void write_knee_model(const std::filesystem::path& folder, const std::vector<std::string>& parts);

}  // namespace condyle::test
