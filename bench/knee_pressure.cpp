#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <vector>

#include "condyle/io/joint_file.hpp"
#include "contact/elastic_parts.hpp"
#include "goals.hpp"
#include "questions.hpp"
#include "real_data.hpp"
#include "timing.hpp"

namespace bench {
namespace {

namespace fs = std::filesystem;
using condyle::Pose;
using condyle::contact::FaceRule;

const TableHead pressure_head{"knee_pressure",
                              "Rays and pressure of a knee's contacts over a recorded flexion; one thread",
                              {{"contact", "contact"},
                               {"rule", "rule"},
                               {"casting_triangles", "casting triangles"},
                               {"target_triangles", "target triangles"},
                               {"frames", "frames"},
                               {"rays", "rays per pose"},
                               {"triangles", "triangles in contact"},
                               {"ms_per_pose", "ms per pose"},
                               {"ns_per_ray", "ns per ray"}}};

/// One contact as its joint file has it, with another rule.
struct KneeContact {
  std::string name;
  condyle::contact::ElasticContact surfaces;
  std::vector<Pose> X_FM;

  KneeContact(const std::string& contact, FaceRule rule, Effort effort)
      : KneeContact(contact, rule, effort,
                    condyle::io::read_joint(fs::path(CONDYLE_SOURCE_DIR) / "tests/support/knee_by_hand" /
                                            (contact + ".toml"))) {}

  void ask() const {
    for (const Pose& X : X_FM) (void)surfaces.at(X);
  }
  /// Rays and triangles in contact of all poses.
  std::pair<std::size_t, std::size_t> work() const {
    std::size_t rays = 0, triangles = 0;
    condyle::contact::ElasticCast::Answer answer;
    for (const Pose& X : X_FM) {
      surfaces.parts().from_mobile->answer(X.inverse(), answer);
      rays += answer.found.rays;
      triangles += surfaces.at(X).mobile->totals.triangles;
    }
    return {rays, triangles};
  }

 private:
  KneeContact(const std::string& contact, FaceRule rule, Effort effort, const condyle::io::LoadedJoint& joint)
      : name(contact), surfaces(made(joint, rule)) {
    const fs::path states = data_folder() / "knee_lenhart2015_right" / "passive_flexion_states.sto";
    for (const auto& X : condyle::io::motion_of(joint, condyle::io::read_motion_table(states)).X_FM)
      X_FM.push_back(X.value());
    if (effort == Effort::quick) X_FM.resize(quick_frames);
  }
  static condyle::contact::ElasticContact made(const condyle::io::LoadedJoint& joint, FaceRule rule) {
    condyle::io::ContactEntry entry = joint.report.file.contact.value();
    entry.rays.rule = rule;
    const condyle::io::ContactSurfaces surfaces = surfaces_of(entry, joint.joint);
    return {surfaces.fixed.mesh, surfaces.mobile.mesh, elastic_options(entry, surfaces, joint)};
  }
};

}  // namespace

bool ask_knee_pressure(Effort effort, Report& report) {
  if (!fs::is_directory(data_folder() / "knee_lenhart2015_right")) return false;
  // The joint files find their meshes by it.
  setenv("CONDYLE_DATA", data_folder().c_str(), 0);
  std::vector<KneeContact> contacts;
  std::vector<std::function<void()>> ways;
  for (const FaceRule rule : {FaceRule::face_centre, FaceRule::cut_faces})
    for (const char* name : {"tibiofemoral", "patellofemoral"}) contacts.emplace_back(name, rule, effort);
  for (const KneeContact& contact : contacts) ways.emplace_back([&] { contact.ask(); });
  const auto samples = interleaved(effort == Effort::full ? 5 : 1, ways);

  for (const FaceRule rule : {FaceRule::face_centre, FaceRule::cut_faces}) {
    const std::string rule_name = rule == FaceRule::face_centre ? "face_centre" : "cut_faces";
    double both = 0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const KneeContact& contact = contacts[i];
      if (contact.surfaces.options().rays.rule != rule) continue;
      const auto frames = static_cast<double>(contact.X_FM.size());
      const double seconds = median(samples[i]);
      both += seconds / frames;
      const auto [rays, triangles] = contact.work();
      report.table(pressure_head)
          .add({contact.name, rule_name, std::int64_t(contact.surfaces.mobile().triangles().size()),
                std::int64_t(contact.surfaces.fixed().triangles().size()), std::int64_t(contact.X_FM.size()),
                double(rays) / frames, double(triangles) / frames, seconds * 1e3 / frames,
                seconds * 1e9 / double(rays)});
    }
    if (effort == Effort::full)
      add_goal({fmt::format("rays and pressure, both contacts at a pose, {}", rule_name),
                "knee_lenhart2015_right", Bound::at_most, 3, "ms"},
               both * 1e3, report);
  }
  return true;
}

}  // namespace bench
