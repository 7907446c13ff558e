#pragma once

#include <filesystem>
#include <string>

namespace condyle::io {

/// How a file that is written to `from` names `file`: from the folder that `from` is really in, links and ".." resolved, or as an
/// absolute path where there is no way from one to the other. The file's own name stays, a link's too. Raises FileError for a
/// path with "${", which a joint file takes for an environment variable.
std::string path_from(const std::filesystem::path& from, const std::filesystem::path& file);

}  // namespace condyle::io
