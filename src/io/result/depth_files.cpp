#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "io/file/output_folder.hpp"
#include "io/file/whole_file.hpp"
#include "io/result/depth_result.hpp"
#include "io/result/provenance_forms.hpp"

namespace condyle::io {
namespace {

/// Whether some result has a file of this name.
bool is_of_depth(std::string_view name) {
  static constexpr std::string_view names[] = {"fixed.vtp",  "mobile.vtp", "pairs.csv",
                                               "depth.json", "fixed.csv",  "mobile.csv"};
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

/// A line per vertex: its number, where it is, and what its arrays have; empty if they have nothing.
std::string vertices_csv(const DepthArrays& arrays, const Points& points) {
  std::string text = "vertex,x_mm,y_mm,z_mm";
  for (const MeshArray& array : arrays.points) text += "," + array.name;
  text += "\n";
  for (std::size_t v = 0; v < points.size(); ++v) {
    text += fmt::format("{},{},{},{}", v, points.x[v] + 0.0, points.y[v] + 0.0, points.z[v] + 0.0);
    for (const MeshArray& array : arrays.points)
      std::visit(
          [&](const auto& values) {
            const auto value = values[v];
            text += std::isnan(static_cast<double>(value)) ? "," : fmt::format(",{}", value);
          },
          array.values);
    text += "\n";
  }
  return text;
}

/// All of a mesh in F, in mm.
Points points_of(const AnswerFrame& frame, Points points) {
  for (std::size_t v = 0; v < points.size(); ++v) points.set(v, frame.fixed_point(points[v]));
  return points;
}

}  // namespace

void check_depth_folder(const std::filesystem::path& folder, const Provenance* from) {
  OutputFolder{folder, is_of_depth, io::files_read(from)};
}

std::vector<std::filesystem::path> write_depth(const std::filesystem::path& folder,
                                               const DepthQuestion& question, const DepthResult& result,
                                               const DepthFiles& files) {
  OutputFolder out(folder, is_of_depth, io::files_read(question.provenance), "depth.json");
  const AnswerFrame frame = question.frame();
  const VtpOptions options{files.encoding, io::provenance_fields(question.provenance)};
  const auto write = [&](const std::string& name, const TriMesh& mesh, const DepthArrays& arrays) {
    write_vtp(out.file(name + ".vtp"), frame.fixed_mesh(mesh), arrays.points, arrays.triangles, options);
    if (files.vertices == VertexTables::write)
      io::write_whole_file(out.file(name + ".csv"),
                           io::provenance_comments(question.provenance) +
                               vertices_csv(arrays, points_of(frame, mesh.vertices)));
  };
  write("fixed", question.joint.fixed.mesh, result.fixed);
  write("mobile", posed(question.X_FM, question.joint.mobile.mesh), result.mobile);
  io::write_whole_file(out.file("pairs.csv"), io::provenance_comments(question.provenance) + result.pairs);
  io::write_whole_file(out.file("depth.json"), result.json);
  return out.commit();
}

}  // namespace condyle::io
