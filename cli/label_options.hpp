#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "condyle/io/label_file.hpp"

/// Options of commands that read label maps.

namespace condyle::cli {

struct LabelOptions {
  io::LabelFileOptions file;
  std::optional<io::LabelTask> task;
  LabelSurfaceOptions surface;
};

/// --affine, --volume, --axes and --elsewhere.
void add_label_file(CLI::App& command, LabelOptions& options);

/// --task, --pieces, --cavities and --triangles.
void add_label_surface(CLI::App& command, LabelOptions& options);

/// The long names of both, for groups of the help.
std::vector<std::string> label_file_names();
std::vector<std::string> label_surface_names();

/// Throws UsageError for the first of these options that was given: the file is no label map.
void refuse_label_options(const CLI::App& command, const std::string& file);

}  // namespace condyle::cli
