#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "condyle/answer/implant.hpp"
#include "io/result/result_of.hpp"

/// Results of `condyle implant`: text, JSON, and the joint with the implant. docs/implants.md.

namespace condyle::io {

using ImplantResult = ResultOf<ImplantAnswer>;

/// The angles of a cup by each definition, and where liner and neck first touch in closed form, or why there is none: a line each.
std::string implant_lines(const plan::Implant& implant, Side side);

std::string implant_text(const ImplantResult& result);
std::string implant_json(const ImplantResult& result);
/// The joint file of the joint with the implant, whose meshes lie beside it.
std::string implant_joint_file(const ImplantResult& result);
/// The joint that reading these files makes.
LoadedJoint joint_with_implant(const ImplantResult& result);

/// FileError if the folder is not to be written to.
void check_implant_folder(const std::filesystem::path& folder, const Provenance* from);
/// Writes implant.json, and hip.toml with a mesh for each bone and each mesh of the implant. FileError.
std::vector<std::filesystem::path> write_implant(const std::filesystem::path& folder,
                                                 const ImplantResult& result);

}  // namespace condyle::io
