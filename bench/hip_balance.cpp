#include <fmt/format.h>

#include <filesystem>
#include <vector>

#include "condyle/io/mesh_file.hpp"
#include "condyle/motion_contact.hpp"
#include "contact/elastic_parts.hpp"
#include "goals.hpp"
#include "questions.hpp"
#include "real_data.hpp"
#include "timing.hpp"

namespace bench {
namespace {

namespace fs = std::filesystem;
using condyle::inverted;
using condyle::Pose;
using condyle::contact::BalancedPose;
using condyle::contact::BalanceOutcome;
using condyle::contact::Casting;
using condyle::contact::ElasticContact;
using condyle::contact::FaceRule;

const TableHead balance_head{
    "hip_balance",
    "The position in which a hip's cartilages carry 1770 N: a pose, and a walk frame after frame; one thread",
    {{"casting", "casting"},
     {"rule", "rule"},
     {"rays", "rays per look"},
     {"look_ms", "a look, ms"},
     {"pose_steps", "Newton steps of a pose"},
     {"pose_ms", "a pose from apart, ms"},
     {"frames", "frames"},
     {"balanced", "balanced"},
     {"carried", "load carried"},
     {"steps", "Newton steps of all"},
     {"walk_ms", "all frames, ms"},
     {"depth_mm", "greatest depth, mm"}}};

/// As many as a cycle is given in.
constexpr std::size_t walk_frames = 101;

struct Way {
  Casting casting;
  FaceRule rule;

  std::string casting_name() const {
    return casting == Casting::both ? "both" : casting == Casting::fixed ? "fixed" : "mobile";
  }
  std::string rule_name() const { return rule == FaceRule::face_centre ? "face_centre" : "cut_faces"; }
  bool is_default() const { return casting == Casting::both && rule == FaceRule::cut_faces; }
};
constexpr Way all_ways[] = {{Casting::fixed, FaceRule::face_centre},  {Casting::fixed, FaceRule::cut_faces},
                            {Casting::mobile, FaceRule::face_centre}, {Casting::mobile, FaceRule::cut_faces},
                            {Casting::both, FaceRule::face_centre},   {Casting::both, FaceRule::cut_faces}};

/// Both cartilages together, as thick as the source made them in the mean.
const condyle::contact::ElasticLayer cartilage{12, 0.42, 1.5};
/// Load of a pelvis on a left femur in F: up and medially, which is to the right.
const condyle::contact::Load stance{.on_mobile = {.force_n = {0, 1700, 500}}};

std::size_t rays_of_a_look(const ElasticContact& surfaces, const Pose& X_FM) {
  std::size_t rays = 0;
  condyle::contact::ElasticCast::Answer answer;
  const auto ask = [&](const auto& cast, const Pose& X_CT) {
    if (!cast) return;
    cast->answer(X_CT, answer);
    rays += answer.found.rays;
  };
  ask(surfaces.parts().from_fixed, X_FM);
  ask(surfaces.parts().from_mobile, inverted(X_FM));
  return rays;
}

}  // namespace

bool ask_hip_balance(Effort effort, Report& report) {
  const fs::path folder = data_folder() / "hip_libhip_m1_left";
  if (!fs::is_directory(folder) || !fs::is_directory(data_folder() / "motion_gait2354_walk")) return false;
  const condyle::Mesh socket(condyle::io::read_mesh(folder / "acetabular_cartilage_gap.ply").mesh);
  const condyle::Mesh head(condyle::io::read_mesh(folder / "femur_cartilage_gap.ply").mesh);
  std::vector<ElasticContact> contacts;
  for (const Way& way : all_ways)
    contacts.push_back(
        {socket,
         head,
         {.casting = way.casting, .rays = {.rule = way.rule}, .fixed = cartilage, .mobile = cartilage}});
  auto walk = walking_hip(condyle::Side::left, walk_frames);
  if (effort == Effort::quick) walk.resize(quick_frames);

  std::vector<std::function<void()>> ways;
  const std::size_t count = contacts.size();
  std::vector<BalancedPose> poses(count);
  std::vector<std::vector<std::optional<BalancedPose>>> walks(count);
  for (std::size_t i = 0; i < count; ++i)
    ways.push_back([&, i] { poses[i] = balance(contacts[i], Pose::Identity(), stance); });
  for (std::size_t i = 0; i < count; ++i)
    ways.push_back([&, i] {
      walks[i] = condyle::motion::balance_along(contacts[i], walk, std::span(&stance, 1)).value();
    });
  for (std::size_t i = 0; i < count; ++i) ways.push_back([&, i] { (void)contacts[i].at(poses[i].X_FM); });
  std::vector<std::vector<double>> samples;
  samples = interleaved(effort == Effort::full ? 9 : 1, ways);

  for (std::size_t i = 0; i < count; ++i) {
    const Way& way = all_ways[i];
    std::int64_t balanced = 0, carried = 0, steps = 0;
    double depth = 0;
    for (const auto& frame : walks[i]) {
      steps += frame->steps;
      if (!frame->carries_load()) continue;
      ++carried;
      balanced += frame->outcome == BalanceOutcome::balanced;
      const auto& surface = frame->contact.mobile ? frame->contact.mobile : frame->contact.fixed;
      depth = std::max(depth, surface->totals.max_depth_mm);
    }
    const double pose_ms = median(samples[i]) * 1e3, walk_ms = median(samples[count + i]) * 1e3;
    report.table(balance_head)
        .add({way.casting_name(), way.rule_name(), std::int64_t(rays_of_a_look(contacts[i], poses[i].X_FM)),
              median(samples[2 * count + i]) * 1e3, std::int64_t(poses[i].steps), pose_ms,
              std::int64_t(walk.size()), balanced, carried, steps, walk_ms, depth});
    if (poses[i].outcome != BalanceOutcome::balanced)
      report.disagreements.push_back(
          fmt::format("hip_balance, {}, {}: {}", way.casting_name(), way.rule_name(), reason_of(poses[i])));
    if (effort == Effort::quick) continue;
    const std::string name = fmt::format("casting {}, {}", way.casting_name(), way.rule_name());
    add_goal({"a balanced pose, " + name, "hip_libhip_m1_left", Bound::at_most, 2, "ms"}, pose_ms, report);
    add_goal({"101 frames of a walk balanced, " + name, "hip_libhip_m1_left", Bound::at_most, 150, "ms"},
             walk_ms, report);
  }
  return true;
}

}  // namespace bench
