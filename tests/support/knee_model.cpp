#include "support/knee_model.hpp"

#include <cstdio>
#include <fstream>

#include "support/shared_data.hpp"

namespace condyle::test {
namespace {

namespace fs = std::filesystem;

std::string line_of(const Vec3& v) {
  char line[100];
  std::snprintf(line, sizeof line, "vertex %.17g %.17g %.17g\n", v.x(), v.y(), v.z());
  return line;
}

/// STL as text, in metres.
void write_in_metres(const fs::path& path, const TriMesh& mesh) {
  std::string text = "solid mesh\n";
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (int k = 0; k < 3; ++k) {
      const Vec3 v = mesh.corner(t, k);
      text += line_of({v.x() / 1000, v.y() / 1000, v.z() / 1000});
    }
    text += "endloop\nendfacet\n";
  }
  std::ofstream(path, std::ios::binary) << text << "endsolid mesh\n";
}

}  // namespace

bool has_knee_model() {
  const auto data = shared_data();
  return data && fs::exists(*data / "osim_lenhart2015") && fs::exists(*data / "knee_lenhart2015_right");
}

void write_knee_model(const fs::path& folder, const std::vector<std::string>& parts) {
  const fs::path data = shared_data_folder();
  fs::create_directories(folder / "Geometry");
  fs::copy_file(data / "osim_lenhart2015/lenhart2015.osim", folder / "lenhart2015.osim",
                fs::copy_options::overwrite_existing);
  for (const std::string& part : parts)
    write_in_metres(folder / "Geometry" / ("lenhart2015-R-" + part + "-cartilage.stl"),
                    read_ply(data / "knee_lenhart2015_right" / (part + "_cartilage.ply")));
}

}  // namespace condyle::test
