#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/joint.hpp"

/// The joints that are measured, and the poses at which they are.

namespace bench {

/// free: surfaces apart; grazing: just in contact, a few triangles; deep: some millimetres into each other.
/// So they are made; the exact answers show what they are at the scene's own resolution.
enum class PoseKind { free, grazing, deep };

struct ScenePose {
  condyle::Pose X_FM;
  PoseKind kind;
};

struct Scene {
  condyle::Joint joint;
  /// 128, the three kinds in turn, so that the first few are a fair choice too.
  std::vector<ScenePose> poses;
};

/// One shape at several resolutions is a family: growth of cost is reported over it. Families that are shown side
/// by side are a group.
struct SceneName {
  std::string_view name;
  std::string_view family;
  std::string_view group;
};

/// All scenes, those of a family from coarse to fine.
std::span<const SceneName> scene_names();

/// One size beyond the paper's, 197,378 mobile vertices and 625,152 fixed triangles: to see how the fastest
/// grow.
inline constexpr std::string_view finest_scene = "libhip_5";

/// The scene of that name; empty where it is a real joint and its meshes are not there. Real joints are read
/// from the folder that CONDYLE_DATA names, or else from shared/data beside the repository.
std::optional<Scene> make_scene(std::string_view name);

/// The vertices of the fixed body in a frame of the scene's deforming variant: each moves by at most 0.25 mm
/// along a smooth wave 60 mm long, another phase in each frame.
condyle::Points deformed(condyle::PointsView fixed_vertices, int frame);

}  // namespace bench
