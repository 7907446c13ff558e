#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <string>

#include "answer.hpp"
#include "condyle/io/sample_files.hpp"
#include "verbs.hpp"

namespace condyle::cli {
namespace {

struct Options {
  HipParameters hip;
  int scenario = 1;
  std::size_t femur_triangles = 0, hip_bone_triangles = 0;
  Side side = Side::right;
  std::string out;
};

Resolution resolution_of(const Options& options) {
  if (options.femur_triangles == 0) return static_cast<Scenario>(options.scenario);
  return TriangleCounts{options.hip_bone_triangles, options.femur_triangles};
}

void run(const Options& options) {
  SampleHip hip = sample_hip(options.hip, resolution_of(options));
  if (options.side == Side::left) hip = mirrored(hip);
  OutputFolder out(options.out);
  write_sample_hip(out, hip, options.side);
  out.commit();
  const auto line = [](const char* name, const TriMesh& mesh) {
    return fmt::format("{}: {} vertices, {} triangles\n", name, mesh.vertices.size(), mesh.triangles.size());
  };
  print(line("hip bone", hip.hip_bone) + line("femur", hip.femur) +
        fmt::format("written to {0}: hip_bone.ply, femur.ply, hip.toml\n", options.out));
}

/// An option in degrees for a parameter that is an Angle.
void add_angle(CLI::App& app, const char* name, Angle& angle, const char* help) {
  app.add_option_function<double>(
         name, [&angle](double degrees) { angle = Angle::degrees(degrees); }, help)
      ->option_text(fmt::format("DEG ({:g})", angle.degrees()));
}

void add_length(CLI::App& app, const char* name, double& length, const char* help) {
  app.add_option(name, length, help)->option_text(fmt::format("MM ({:g})", length));
}

}  // namespace

void add_sample(CLI::App& app) {
  auto* sample = app.add_subcommand("sample", "Make a built-in parametric joint");
  sample->require_subcommand(1);
  auto* verb = sample->add_subcommand("hip", "A hip: hip bone, femur and joint file");
  verb->footer(
      "Example: condyle sample hip --out sample\n"
      "         condyle sample hip --scenario 2 --neck-shaft-angle 135 --side left --out valgus");
  auto options = std::make_shared<Options>();
  HipParameters& hip = options->hip;
  verb->add_option("--out", options->out, "Folder for hip_bone.ply, femur.ply and hip.toml")->required();
  auto* scenario =
      verb->add_option(
              "--scenario", options->scenario,
              "Resolution: 1 is 1542 and 2442 triangles (femur, hip bone), each next four times as many")
          ->check(CLI::Range(1, 4))
          ->option_text("1..4 (1)");
  auto* femur =
      verb->add_option("--femur-triangles", options->femur_triangles, "Exact number of triangles instead")
          ->excludes(scenario);
  auto* hip_bone = verb->add_option("--hip-bone-triangles", options->hip_bone_triangles,
                                    "Exact number of triangles instead")
                       ->excludes(scenario);
  femur->needs(hip_bone);
  hip_bone->needs(femur);
  verb->add_option_function<std::string>(
          "--side",
          [options](const std::string& name) { options->side = name == "left" ? Side::left : Side::right; },
          "Side of the body; a left hip is the mirrored right one")
      ->check(CLI::IsMember({"right", "left"}))
      ->option_text("right|left (right)");
  add_length(*verb, "--head-radius", hip.head_radius_mm, "Radius of the femoral head");
  add_length(*verb, "--joint-space", hip.joint_space_mm, "Bony joint space");
  add_angle(*verb, "--neck-shaft-angle", hip.neck_shaft_angle, "Between the axes of neck and shaft");
  add_angle(*verb, "--anteversion", hip.femoral_anteversion, "Of the femoral neck");
  add_length(*verb, "--neck-radius", hip.neck_radius_mm,
             "Half the narrowest front-to-back width of the neck");
  add_length(*verb, "--neck-length", hip.neck_length_mm, "From the head's centre to the shaft's axis");
  add_length(*verb, "--shaft-length", hip.shaft_length_mm, "From the neck's axis to the lower end");
  verb->add_option_function<double>(
          "--alpha-angle", [&hip](double degrees) { hip.alpha_angle = Angle::degrees(degrees); },
          "Alpha angle of a cam at half past one around the neck, up to 90; no cam if not given")
      ->option_text("DEG");
  add_angle(*verb, "--acetabular-inclination", hip.acetabular_inclination,
            "Of the socket's opening, from the vertical");
  add_angle(*verb, "--acetabular-version", hip.acetabular_version,
            "Of the socket's opening, forward of lateral");
  add_angle(*verb, "--centre-edge-angle", hip.lateral_centre_edge_angle, "Lateral coverage of the head");
  verb->callback([options] { run(*options); });
}

}  // namespace condyle::cli
