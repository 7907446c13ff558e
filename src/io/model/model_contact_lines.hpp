#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "condyle/io/model_file.hpp"

namespace condyle::io {

/// A surface in contact, and where its mesh lies in the body that it is of.
struct PlacedContactMesh {
  const ModelContactMesh& mesh;
  Pose X;
};

/// The contact of a model that a joint file is to have.
struct ChosenContact {
  const ModelContact& contact;
  PlacedContactMesh casting, target;
  BodyRole casting_role;
  std::string fixed_part, mobile_part;  ///< of bodies of several meshes, else empty
};

/// The table [contact] of a joint file, with its layers; adds what it has not to the notes. `path_of` names a file as the joint
/// file has it. Throws FileError, one line with the line of the model, for numbers that no layer or ray has.
std::string contact_lines(const Model& model, const ChosenContact& chosen,
                          const std::function<std::string(const std::filesystem::path&)>& path_of,
                          std::vector<ModelNote>& notes);

}  // namespace condyle::io
