#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "condyle/io/model_file.hpp"

/// Options of commands that read models of OpenSim.

namespace condyle::cli {

struct ModelOptions {
  std::vector<std::string> geometry;  ///< folders
  std::optional<Anatomy> anatomy;
  std::string contact;
  std::optional<io::PolygonRule> polygons;

  /// Whether there is an option that only a model has.
  bool any() const noexcept { return !geometry.empty() || anatomy || !contact.empty(); }
};

/// --anatomy.
void add_anatomy(CLI::App& command, std::optional<Anatomy>& anatomy, const std::string& help,
                 const std::string& otherwise = "");

/// --polygons; `otherwise` says what holds without it.
void add_polygons(CLI::App& command, std::optional<io::PolygonRule>& polygons, const std::string& otherwise);

/// --repair, of commands that read meshes.
void add_repair(CLI::App& command, std::vector<std::string>& repairs);

/// --anatomy, --contact, --geometry and --polygons.
void add_model(CLI::App& command, ModelOptions& options);
std::vector<std::string> model_names();

/// --geometry alone.
void add_geometry(CLI::App& command, std::vector<std::string>& folders);

/// Whether a file is a model by its name.
bool is_model(const std::string& path);

/// The model, its meshes looked for in the folders too.
io::Model model_of(const std::string& path, const std::vector<std::string>& geometry);

/// Throws UsageError with the joints that there are if none is named.
io::ModelJointRequest request_of(const io::Model& model, const ModelOptions& options,
                                 const std::string& joint, const std::optional<Side>& side);

/// The side that --side names.
void add_side(CLI::App& command, std::optional<Side>& side, const std::string& help);

}  // namespace condyle::cli
