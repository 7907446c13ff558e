#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "condyle/answer/resection.hpp"
#include "io/result/result_of.hpp"

/// Results of `condyle resect`: text, JSON, tables, the depth on the surface, and the joint without the bone.
/// docs/planning.md.

namespace condyle::io {

using ResectionResult = ResultOf<ResectionAnswer>;

std::string resection_text(const ResectionResult& result);
std::string resection_json(const ResectionResult& result);
/// A row for each motion: its limit before and after.
std::string resection_limits_csv(const ResectionResult& result);
/// A row for each point of a curve: degrees against mm^3.
std::string resection_curve_csv(const ResectionResult& result);
/// A row for each half hour of the neck's clock: how deep the mobile bone is cut there. Empty without a neck.
std::string resection_hours_csv(const ResectionResult& result);
/// The joint file of the joint without the bone, whose meshes lie beside it.
std::string resected_joint_file(const ResectionResult& result);

/// FileError if the folder is not to be written to.
void check_resection_folder(const std::filesystem::path& folder, const Provenance* from);
/// Writes resection.json, limits.csv, curve.csv, hours.csv, depth_mobile and depth_fixed as .vtp and .png of the bones that were cut, and
/// resected.toml with its meshes. FileError.
std::vector<std::filesystem::path> write_resection(const std::filesystem::path& folder,
                                                   const ResectionResult& result);

}  // namespace condyle::io
