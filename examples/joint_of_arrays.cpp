// A joint of two meshes in memory: a mesh from arrays, poses step by step, limits, threads, errors, progress and stop.
#include <array>
#include <condyle/condyle.hpp>
#include <cstdio>
#include <exception>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace {

/// x, y, z of each vertex, mm; three vertex numbers of each triangle, counter-clockwise seen from outside.
condyle::TriMesh mesh_of(std::span<const double> xyz, std::span<const condyle::Index> corners) {
  condyle::TriMesh mesh;
  for (std::size_t i = 0; i + 2 < xyz.size(); i += 3)
    mesh.vertices.push_back({xyz[i], xyz[i + 1], xyz[i + 2]});
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
    mesh.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
  return mesh;
}

/// Both meshes lie in one frame W, as a segmentation gives them.
condyle::Joint joint_of(condyle::TriMesh fixed, condyle::TriMesh mobile) {
  condyle::JointDescription description{
      .name = "needle", .kind = condyle::JointKind::ball, .side = condyle::Side::right};
  description.frame.centre = condyle::Vec3(0, 0, 0);  // mm in W; condyle::CentreFit{} fits a head
  description.frame.axes = condyle::FrameDirections{.anterior = {1, 0, 0}, .superior = {0, 1, 0}};
  return condyle::make_joint(description, {"wall", std::move(fixed)}, {"needle", std::move(mobile)}).joint;
}

condyle::Pose flexed(const condyle::Joint& joint, double degrees) {
  return condyle::pose_at(joint.coordinates(),
                          condyle::JointAngles{condyle::Angle::degrees(degrees), {}, {}});
}

/// A query allocates nothing once `inside` is large enough.
void step(const condyle::Joint& joint, const condyle::contact::JointContact& contact) {
  condyle::radial::Penetrations inside;
  for (int degrees = 0; degrees <= 40; degrees += 20) {
    const condyle::Pose X_FM = flexed(joint, degrees);  // p_fixed = X_FM * p_mobile
    contact.mobile_in_fixed(X_FM, inside);
    std::printf("%d deg: %s\n", degrees, contact.in_contact(X_FM) ? "in contact" : "apart");
    for (std::size_t i = 0; i < inside.size(); ++i)
      std::printf("  vertex %u is %.3f mm inside\n", inside.point[i], inside.depth_mm[i]);
  }
}

/// A const JointContact answers on any number of threads.
void step_on_threads(const condyle::Joint& joint, const condyle::contact::JointContact& contact) {
  std::array<char, 90> meets{};
  {
    std::vector<std::jthread> threads;
    for (std::size_t first : {0, 1})
      threads.emplace_back([&, first] {
        for (std::size_t i = first; i < meets.size(); i += 2)
          meets[i] = contact.in_contact(flexed(joint, double(i)));
      });
  }  // joined here
  int poses = 0;
  for (const char each : meets) poses += each;
  std::printf("in contact in %d of %zu poses\n", poses, meets.size());
}

void limits(const condyle::Case& joint) {
  const condyle::RangeAnswer answer = condyle::answer_range(joint, {.motions = joint.motions()});
  const condyle::motion::MotionLimit& flexion = answer.limits.front();
  std::printf("%s ends at %.3f deg: %s\n", flexion.motion.name.c_str(), flexion.end.turned.degrees(),
              std::string(name_of(flexion.end.reason)).c_str());
}

/// The answer is empty if the work was stopped.
void stopped_bands(const condyle::Case& joint) {
  std::stop_source source;
  const condyle::Control control{.progress =
                                     [&](std::string_view stage, std::size_t done, std::size_t total) {
                                       std::fprintf(stderr, "%.*s: %zu of %zu\n", int(stage.size()),
                                                    stage.data(), done, total);
                                       if (done == 5) source.request_stop();
                                     },
                                 .stop = source.get_token()};
  const std::array motions{joint.motions().front()};
  const condyle::RangeRequest request{.motions = {motions.begin(), motions.end()},
                                      .bands = {{.samples = 40}}};
  if (!condyle::answer_range(joint, request, control)) std::printf("stopped\n");
}

}  // namespace

int main() {
  const std::array<condyle::Index, 12> corners{0, 1, 2, 0, 2, 3, 2, 1, 3, 1, 0, 3};
  const std::array<double, 12> wall{5, -30, -10, 5, 0, 30, 5, 30, -10, 15, 0, 0};
  const std::array<double, 12> needle{1, -1, -1, -1, -1, 0, 1, -1, 1, 0, -10, 0};
  try {
    const condyle::Joint joint = joint_of(mesh_of(wall, corners), mesh_of(needle, corners));
    const condyle::contact::JointContact contact(joint);  // tables and trees: built once, asked at any pose
    step(joint, contact);
    step_on_threads(joint, contact);
    limits({.joint = joint});
    stopped_bands({.joint = joint});
  } catch (const std::exception& error) {  // MeshError, UsageError, FileError: one line each
    std::fprintf(stderr, "joint_of_arrays: %s\n", error.what());
    return 1;
  }
}
