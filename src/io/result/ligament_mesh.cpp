#include "io/result/ligament_mesh.hpp"

#include <array>
#include <limits>
#include <utility>

#include "io/result/line_mesh.hpp"
#include "kinematics/ligament_path.hpp"

namespace condyle::io {
namespace {

constexpr double half_width_mm = 0.8;

void add_path(TriMesh& mesh, const Ligament& ligament, const Pose& X_FM) {
  const std::vector<Vec3> path = kinematics::ligament_points(ligament, X_FM);
  for (std::size_t i = 1; i < path.size(); ++i) add_line(mesh, path[i - 1], path[i], half_width_mm);
}

}  // namespace

LigamentMesh ligament_mesh(std::span<const Ligament> ligaments, const Pose& X_FM) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  LigamentMesh out;
  std::vector<double> strain, tension;
  std::vector<std::int32_t> number;
  for (std::size_t i = 0; i < ligaments.size(); ++i) {
    add_path(out.mesh, ligaments[i], X_FM);
    const auto state = ligament_state(ligaments[i], X_FM);
    strain.resize(out.mesh.triangles.size(), state ? state->strain : nothing);
    tension.resize(out.mesh.triangles.size(), state ? state->tension_n : nothing);
    number.resize(out.mesh.triangles.size(), static_cast<std::int32_t>(i));
  }
  out.arrays = {
      {"strain", std::move(strain)}, {"tension_n", std::move(tension)}, {"ligament", std::move(number)}};
  return out;
}

std::vector<PictureMark> ligament_marks(std::span<const Ligament> ligaments, const Pose& X_FM) {
  // In the order of LigamentStretch.
  std::array<PictureMark, 4> marks{PictureMark{{}, {110, 110, 110}, "slack ligament"},
                                   PictureMark{{}, {0, 158, 115}, "taut ligament"},
                                   PictureMark{{}, {213, 94, 0}, "ligament at its end"},
                                   PictureMark{{}, {204, 121, 167}, "ligament without a length"}};
  for (const Ligament& ligament : ligaments) {
    const auto stretch = kinematics::stretch_of(ligament, ligament_state(ligament, X_FM));
    add_path(marks[static_cast<std::size_t>(stretch)].mesh, ligament, X_FM);
  }
  std::vector<PictureMark> drawn;
  for (PictureMark& mark : marks)
    if (!mark.mesh.triangles.empty()) drawn.push_back(std::move(mark));
  return drawn;
}

}  // namespace condyle::io
