#include "io/joint/other_file.hpp"

#include <fmt/format.h>

#include "condyle/io/label_file.hpp"
#include "io/file/compressed.hpp"
#include "io/image/unread_image.hpp"
#include "io/mesh/parse.hpp"

namespace condyle::io {
namespace {

bool is_mesh(std::string_view bytes, std::string_view start, const std::filesystem::path& path) {
  return mesh_format_named(path) || start.starts_with("ply\n") || start.starts_with("ply\r") ||
         start.starts_with("solid ") || start.starts_with("# vtk DataFile") ||
         start.find("<VTKFile") != start.npos || is_binary_stl(Source{bytes, {}});
}

}  // namespace

std::string other_file(std::string_view bytes, const std::filesystem::path& path) {
  refuse_unread_image(path);
  constexpr std::size_t enough = 1000;  // where XML has named its root
  const std::string_view start = without_byte_order_mark(bytes).substr(0, enough);
  const std::string file = path.string(), extension = lower_case(path.extension().string());
  const std::string_view of_meshes = "condyle init FIXED MOBILE --out hip.toml makes one";
  const auto is = [](std::string_view what, std::string_view command) {
    return fmt::format("is {}, not a joint file: {}", what, command);
  };
  if (is_mesh(bytes, start, path)) return is("a mesh", of_meshes);
  if (start.starts_with("%PDF")) return is("a PDF", of_meshes);
  if (label_format_of(path) || start.starts_with("NRRD0"))
    return is("a label map",
              fmt::format("condyle init {} --fixed LABEL --mobile LABEL --out hip.toml makes one", file));
  if (extension == ".osim" || start.find("<OpenSimDocument") != start.npos)
    return is("a model of OpenSim",
              fmt::format("condyle init {} --joint NAME --out joint.toml makes one", file));
  if (extension == ".mot" || extension == ".sto")
    return is("a recorded motion", fmt::format("condyle motion JOINT --motion {} takes it", file));
  if (extension == ".csv")
    return is("a table", "condyle study takes a table of joints, condyle motion --motion a recorded motion");
  if (extension == ".json")
    return is("JSON", "an answer names the joint file that it is of, as provenance.joint_file");
  if (start.starts_with("\x89PNG")) return is("a picture", of_meshes);
  if (extension == ".html") return is("a page", of_meshes);
  if (const auto packer = packed_by(bytes); !packer.empty())
    return is(fmt::format("compressed by {}", packer), "uncompress it first");
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  return first != start.npos && start[first] == '<' ? is("XML", of_meshes) : std::string();
}

}  // namespace condyle::io
