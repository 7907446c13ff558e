#include <string>

#include "condyle/error.hpp"
#include "condyle/io/jam_file.hpp"
#include "io/study/study_h5.hpp"

/// What src/io writes by HDF5: a study has one file less, and what else was asked for is refused.

namespace condyle::io {

void write_jam_file(const std::filesystem::path& path, std::span<const double>, std::span<const JamContact>,
                    std::span<const JamCoordinate>) {
  throw FileError(path.string() + ": this condyle has no HDF5 and writes no such file");
}

std::optional<std::string> study_h5(const StudyColumns&, const StudyTexts&) {
  return std::nullopt;
}

}  // namespace condyle::io
