#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "condyle/error.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/io/recorded_motion.hpp"
#include "fuzz/fuzz_input.hpp"
#include "fuzz/one_line.hpp"
#include "fuzz/targets.hpp"
#include "io/motion/curve_files.hpp"
#include "io/result/inspection_result.hpp"
#include "support/temporary_folder.hpp"

namespace condyle::test {
namespace {

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
         (std::isnan(a) && std::isnan(b));
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return same_bits(x, y); });
}

bool same_bits(const TriMesh& a, const TriMesh& b) {
  return a.triangles == b.triangles && same_bits(a.vertices.x, b.vertices.x) &&
         same_bits(a.vertices.y, b.vertices.y) && same_bits(a.vertices.z, b.vertices.z);
}

const TemporaryFolder& folder() {
  static const TemporaryFolder folder;
  return folder;
}

std::string fault_of_meshes(FuzzInput& input) {
  const TriMesh mesh = Mesh(input.mesh()).arrays();
  std::vector<double> numbers(mesh.vertices.size());
  for (double& number : numbers) number = input.any_double();
  for (const char* name : {"x.ply", "x.vtp"}) {
    io::write_mesh(folder() / name, mesh);
    if (!same_bits(io::read_mesh(folder() / name).mesh, mesh))
      return std::string(name) + " does not read back";
  }
  const std::vector<io::MeshArray> arrays{{"numbers", numbers}};
  for (const io::VtpEncoding encoding : {io::VtpEncoding::binary, io::VtpEncoding::text}) {
    io::write_vtp(folder() / "y.vtp", mesh, arrays, {}, {.encoding = encoding});
    if (!same_bits(io::read_mesh(folder() / "y.vtp").mesh, mesh)) return "y.vtp does not read back";
  }
  return {};
}

std::string fault_of_curves(FuzzInput& input) {
  io::Curves curves{.axis = "time", .at = {}, .names = {"a", "b"}, .values = {{}, {}}};
  double time = input.coordinate();
  if (!std::isfinite(time)) time = 0;
  for (std::size_t count = 1 + input.below(6); count > 0; --count, time = std::nextafter(time, 1e300)) {
    curves.at.push_back(time);
    for (auto& column : curves.values) column.push_back(input.any_double());
  }
  io::write_curves_csv(folder() / "x.csv", curves);
  io::write_sto(folder() / "x.sto", "curves", curves, io::AngleUnit::degrees);
  for (const char* name : {"x.csv", "x.sto"}) {
    const io::MotionTable table = io::read_motion_table(folder() / name);
    if (!same_bits(table.values[0], curves.at) || !same_bits(table.values[1], curves.values[0]) ||
        !same_bits(table.values[2], curves.values[1]))
      return std::string(name) + " does not read back";
  }
  return {};
}

std::string fault_of_json(FuzzInput& input) {
  const Mesh mesh = input.mesh();
  std::string name;
  for (std::size_t count = input.below(12); count > 0; --count) name += static_cast<char>(input.byte() | 1);
  std::vector<io::MeshInspection> meshes(1);
  meshes[0].path = name;
  meshes[0].report = inspect(mesh);
  const auto json = nlohmann::json::parse(io::inspection_json(meshes));
  const auto& first = json.at("meshes").at(0);
  if (first.at("triangles") != mesh.triangles().size()) return "another number of triangles in the JSON";
  if (!same_bits(first.at("area").get<double>(), meshes[0].report.area)) return "another area in the JSON";
  if (io::to_text(meshes).empty()) return "no text";
  return {};
}

}  // namespace

std::string fuzz_results(std::string_view bytes) {
  FuzzInput input(bytes);
  try {
    switch (input.below(3)) {
      case 0:
        return fault_of_meshes(input);
      case 1:
        return fault_of_curves(input);
      default:
        return fault_of_json(input);
    }
  } catch (const MeshError& error) {
    return fault_of_message(error.what());
  } catch (const FileError& error) {
    return fault_of_message(error.what(), folder().path().string());
  }
}

}  // namespace condyle::test
