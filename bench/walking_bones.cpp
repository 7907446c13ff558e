#include <tbb/task_arena.h>

#include <filesystem>

#include "condyle/io/mesh_file.hpp"
#include "condyle/motion_contact.hpp"
#include "goals.hpp"
#include "mesh/surface_to_surface.hpp"
#include "questions.hpp"
#include "real_data.hpp"
#include "timing.hpp"

namespace bench {
namespace {

namespace fs = std::filesystem;

const TableHead walk_head{"walking_bones",
                          "Contact of bones in each frame of a walk: pairs, smallest gap, depth",
                          {{"scene", "scene"},
                           {"fixed_triangles", "fixed triangles"},
                           {"mobile_triangles", "mobile triangles"},
                           {"frames", "frames"},
                           {"in_contact", "in contact"},
                           {"pairs_ms", "pairs, one thread, ms"},
                           {"gap_ms", "gap, one thread, ms"},
                           {"depth_ms", "depth, one thread, ms"},
                           {"threads", "threads"},
                           {"wall_ms", "all frames, ms on the wall"}}};

}  // namespace

bool ask_walking_bones(Effort effort, Report& report) {
  const fs::path folder = data_folder() / "hip_vhf_right";
  if (!fs::is_directory(folder) || !fs::is_directory(data_folder() / "motion_gait2354_walk")) return false;
  const condyle::Mesh pelvis(condyle::io::read_mesh(folder / "hip_bone.ply").mesh);
  const condyle::Mesh femur(condyle::io::read_mesh(folder / "femur.ply").mesh);
  auto walk = walking_hip(condyle::Side::right);
  if (effort == Effort::quick) walk.resize(quick_frames);

  const condyle::contact::JointContact bones(pelvis, femur);
  const condyle::contact::NormalDepth depth(femur, pelvis);
  const condyle::mesh::TriangleTree fixed(pelvis), mobile(femur);
  std::int64_t in_contact = 0;
  std::vector<double> wall;
  const int rounds = effort == Effort::full ? 9 : 1;
  // One round more than counts, to warm up.
  for (int round = 0; round <= rounds; ++round) {
    const Stopwatch watch;
    const auto frames = condyle::motion::contact_along(bones, &depth, walk).value();
    if (round > 0) wall.push_back(watch.wall_seconds());
    in_contact =
        std::count_if(frames.begin(), frames.end(), [](const auto& frame) { return frame->in_contact; });
  }
  const auto parts = interleaved(rounds, {[&] {
                                            for (const auto& X : walk) (void)bones.pairs(*X);
                                          },
                                          [&] {
                                            for (const auto& X : walk)
                                              condyle::mesh::closest_points(fixed, mobile, *X);
                                          },
                                          [&] {
                                            for (const auto& X : walk) (void)depth.at(X->inverse());
                                          }});
  const auto ms = [](const std::vector<double>& samples) { return median(samples) * 1e3; };
  report.table(walk_head).add({std::string("hip_vhf_right"), std::int64_t(pelvis.triangles().size()),
                               std::int64_t(femur.triangles().size()), std::int64_t(walk.size()), in_contact,
                               ms(parts[0]), ms(parts[1]), ms(parts[2]),
                               std::int64_t{tbb::this_task_arena::max_concurrency()}, ms(wall)});
  if (effort == Effort::full)
    add_goal({"pairs, gap and depth in 73 frames of a walk, all threads", "hip_vhf_right", Bound::at_most, 50,
              "ms on the wall"},
             ms(wall), report);
  return true;
}

}  // namespace bench
