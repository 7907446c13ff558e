#include "page_ligaments.hpp"

#include <optional>
#include <string_view>

#include "io/joint/ligament_tables.hpp"
#include "io/result/json.hpp"
#include "io/result/ligament_mesh.hpp"
#include "kinematics/ligament_path.hpp"
#include "page_joint.hpp"

using namespace condyle;

namespace {

/// In the order of LigamentStretch.
constexpr std::string_view stretches[] = {"slack", "taut", "at_end", "unknown"};

io::Json ligament_json(const Ligament& ligament, const Pose& X_FM) {
  const std::optional<LigamentState> state = ligament_state(ligament, X_FM);
  const auto if_known = [&](double LigamentState::*value) {
    return state ? io::Json((*state).*value) : io::Json();
  };
  const TriMesh tube = io::ligament_mesh({&ligament, 1}, X_FM).mesh;
  io::Json vertices = io::Json::array();
  for (std::size_t v = 0; v < tube.vertices.size(); ++v)
    for (const double value : tube.vertices[v]) vertices.push_back(value);
  return {{"name", ligament.name},
          {"is", stretches[static_cast<std::size_t>(kinematics::stretch_of(ligament, state))]},
          {"length_mm", if_known(&LigamentState::length_mm)},
          {"strain", if_known(&LigamentState::strain)},
          {"tension_n", if_known(&LigamentState::tension_n)},
          {"vertices", std::move(vertices)},
          {"triangles", tube.triangles}};
}

}  // namespace

int condyle_set_ligaments(CondyleJoint* joint, const char* toml) {
  return guarded(-1, [&] {
    joint->joint.ligaments.clear();
    for (DescribedLigament& described : io::ligaments_of_text(toml, {}))
      joint->joint.ligaments.push_back(std::move(described.ligament));
    joint->range.reset();
    return 0;
  });
}

const char* condyle_ligaments(CondyleJoint* joint, const double* pose) {
  return guarded(static_cast<const char*>(nullptr), [&] {
    io::Json all = io::Json::array();
    for (const Ligament& ligament : joint->joint.ligaments)
      all.push_back(ligament_json(ligament, pose_of(pose)));
    joint->description = all.dump();
    return joint->description.c_str();
  });
}
