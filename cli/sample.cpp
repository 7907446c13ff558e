#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>

#include "answer.hpp"
#include "choice.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "core/counted.hpp"
#include "help_formatter.hpp"
#include "io/result/sample_files.hpp"
#include "sample_implants.hpp"
#include "whole_number.hpp"
#include "with_progress.hpp"

namespace condyle::cli {
namespace {

/// Options of both commands.
struct Options {
  sample::HipParameters hip;
  int scenario = 0;
  Side side = Side::right;
  std::string out;
};

struct HipOptions : Options {
  std::size_t femur_triangles = 0, hip_bone_triangles = 0;
  std::optional<double> voxel_mm;
};

struct CartilageOptions : Options {
  sample::CartilageParameters cartilage;
  std::size_t femoral_triangles = 0, acetabular_triangles = 0;
};

std::string counts_line(const char* name, const TriMesh& mesh) {
  return fmt::format("{}: {} vertices, {} triangles\n", name, mesh.vertices.size(), mesh.triangles.size());
}

sample::Resolution resolution_of(const HipOptions& options) {
  if (options.femur_triangles == 0) return static_cast<sample::Scenario>(options.scenario);
  return sample::TriangleCounts{options.hip_bone_triangles, options.femur_triangles};
}

void sample_command(const HipOptions& options) {
  sample::SampleHip hip = sample::sample_hip(options.hip, resolution_of(options));
  if (options.side == Side::left) hip = sample::mirrored(hip);
  io::OutputFolder out(options.out);
  io::write_sample_hip(out, hip, options.side);
  if (options.voxel_mm) io::write_sample_labels(out, hip, options.side, *options.voxel_mm);
  out.commit();
  print(counts_line("hip bone", hip.hip_bone) + counts_line("femur", hip.femur) +
        fmt::format("written to {}: hip_bone.ply, femur.ply, hip.toml{}\n", options.out,
                    options.voxel_mm ? ", labels.nii.gz" : ""));
}

sample::CartilageResolution resolution_of(const CartilageOptions& options) {
  if (options.femoral_triangles == 0) return static_cast<sample::CartilageScenario>(options.scenario);
  return sample::CartilageCounts{options.acetabular_triangles, options.femoral_triangles};
}

void sample_command(const CartilageOptions& options) {
  sample::SampleCartilages cartilages =
      sample::sample_cartilages(options.hip, options.cartilage, resolution_of(options));
  if (options.side == Side::left) cartilages = sample::mirrored(cartilages);
  io::OutputFolder out(options.out);
  io::write_sample_cartilages(out, cartilages, options.side);
  out.commit();
  print(counts_line("acetabular cartilage", cartilages.acetabular) +
        counts_line("femoral cartilage", cartilages.femoral) +
        fmt::format("written to {0}: acetabular_cartilage.ply, femoral_cartilage.ply, cartilages.toml\n",
                    options.out));
}

/// An option in degrees for a parameter that is an Angle.
void add_angle(CLI::App& app, const char* name, Angle& angle, const char* help) {
  app.add_option_function<double>(
         name, [&angle](double degrees) { angle = Angle::degrees(degrees); }, help)
      ->option_text(fmt::format("DEG ({:g})", angle.degrees()));
}

void add_length(CLI::App& app, const char* name, double& length, const char* help) {
  add_value(app, name, length, fmt::format("MM ({:g})", length), help);
}

/// Two counts that are given together or not at all, in place of a scenario.
struct Count {
  const char* option;
  std::size_t& triangles;
};

void add_resolution(CLI::App& command, int& scenario, int first, const char* help, const Count& fixed,
                    const Count& mobile) {
  scenario = first;
  const int last = first + 3;
  auto* by_scenario =
      add_value(command, "--scenario", scenario, fmt::format("{}..{} ({})", first, last, first), help)
          ->check(whole_number(static_cast<std::uint64_t>(first), static_cast<std::uint64_t>(last)));
  const auto add_count = [&](const Count& count) {
    return add_value(command, count.option, count.triangles, "N", "Make exactly this many triangles instead")
        ->check(whole_number(1))
        ->excludes(by_scenario);
  };
  auto *of_mobile = add_count(mobile), *of_fixed = add_count(fixed);
  of_mobile->needs(of_fixed);
  of_fixed->needs(of_mobile);
}

void add_measures(CLI::App& command, sample::HipParameters& hip) {
  add_length(command, "--head-radius", hip.head_radius_mm, "Radius of the femoral head");
  add_length(command, "--joint-space", hip.joint_space_mm, "Joint space between the bones");
  add_angle(command, "--neck-shaft-angle", hip.neck_shaft_angle, "Angle between the axes of neck and shaft");
  add_angle(command, "--anteversion", hip.femoral_anteversion, "Anteversion of the femoral neck");
  add_length(command, "--neck-radius", hip.neck_radius_mm,
             "Half the narrowest front-to-back width of the neck");
  add_length(command, "--neck-length", hip.neck_length_mm,
             "Distance from the head's centre to the shaft's axis");
  add_length(command, "--shaft-length", hip.shaft_length_mm,
             "Distance from the neck's axis to the lower end");
  command
      .add_option_function<double>(
          "--alpha-angle", [&hip](double degrees) { hip.alpha_angle = Angle::degrees(degrees); },
          "Alpha angle of a cam at half past one around the neck, up to 90")
      ->option_text("DEG (no cam)");
  add_angle(command, "--acetabular-inclination", hip.acetabular_inclination,
            "Angle of the socket's opening from the vertical");
  add_angle(command, "--acetabular-version", hip.acetabular_version,
            "Angle of the socket's opening forward of lateral");
  add_angle(command, "--centre-edge-angle", hip.lateral_centre_edge_angle,
            "Lateral centre-edge angle, how far the socket covers the head");
}

HelpGroup measures_group() {
  return {"Measures of the hip",
          {"--alpha-angle", "--head-radius", "--joint-space", "--neck-shaft-angle", "--anteversion",
           "--neck-radius", "--neck-length", "--shaft-length", "--acetabular-inclination",
           "--acetabular-version", "--centre-edge-angle"}};
}

void add_sample_hip(CLI::App& sample) {
  auto* command = sample.add_subcommand("hip", "Make a hip: hip bone, femur and joint file");
  command->footer(
      "Example: condyle sample hip --out sample\n"
      "         condyle sample hip --scenario 2 --neck-shaft-angle 135 --side left --out valgus");
  auto options = std::make_shared<HipOptions>();
  add_out(*command, options->out, "Write hip_bone.ply, femur.ply and hip.toml into this folder")->required();
  add_resolution(*command, options->scenario, 1,
                 "How fine the meshes are: 1 has 1542 triangles of the femur and 2442 of the hip bone, each "
                 "next one four times as many",
                 {"--hip-bone-triangles", options->hip_bone_triangles},
                 {"--femur-triangles", options->femur_triangles});
  add_value(*command, "--voxel", options->voxel_mm, "MM",
            "Write labels.nii.gz too: a label map of both bones with voxels so wide, for condyle init");
  add_choice(*command, "--side", options->side, {{"right", Side::right}, {"left", Side::left}},
             "The side of the body. A left hip is the right one mirrored", "right");
  add_measures(*command, options->hip);
  group_help(*command,
             {{"Most used", {"--out", "--side", "--scenario", "--alpha-angle", "--neck-shaft-angle"}},
              measures_group(),
              {"Resolution", {"--femur-triangles", "--hip-bone-triangles", "--voxel", "--help"}}});
  command->callback([options] { sample_command(*options); });
}

void add_cartilages(CLI::App& sample) {
  auto* command =
      sample.add_subcommand("cartilages", "Make cartilages and labrum of that hip, and a joint file");
  command->footer(
      "Example: condyle sample cartilages --out cartilages\n"
      "         condyle sample cartilages --scenario 6 --clearance -0.3 --out overlapping");
  auto options = std::make_shared<CartilageOptions>();
  add_out(*command, options->out,
          "Write acetabular_cartilage.ply, femoral_cartilage.ply and cartilages.toml into this folder")
      ->required();
  add_resolution(
      *command, options->scenario, 5,
      "How fine the meshes are: 2824 femoral and 2876 acetabular triangles, 4338 and 4222, 7734 and "
      "7870, or 17294 and 14824",
      {"--acetabular-triangles", options->acetabular_triangles},
      {"--femoral-triangles", options->femoral_triangles});
  add_choice(*command, "--side", options->side, {{"right", Side::right}, {"left", Side::left}},
             "The side of the body. A left hip is the right one mirrored", "right");
  add_length(*command, "--clearance", options->cartilage.clearance_mm,
             "Gap between the articular spheres; below 0 they overlap");
  add_length(*command, "--femoral-thickness", options->cartilage.femoral_thickness_mm,
             "Thickness of the femoral cartilage. The acetabular one fills the rest of the joint space");
  add_measures(*command, options->hip);
  group_help(*command,
             {{"Most used", {"--out", "--side", "--scenario", "--clearance", "--femoral-thickness"}},
              measures_group(),
              {"Resolution", {"--femoral-triangles", "--acetabular-triangles", "--help"}}});
  command->callback([options] { sample_command(*options); });
}

struct CohortOptions {
  io::SampleCohort cohort;
  int scenario = 1;
  std::string out;
};

void sample_command(const CohortOptions& options) {
  io::SampleCohort cohort = options.cohort;
  cohort.scenario = static_cast<sample::Scenario>(options.scenario);
  const auto written = with_progress(
      [&](const Control& control) { return io::write_sample_cohort(options.out, cohort, control); },
      Writes::files);
  say_written(written);
  print(fmt::format("{}, for condyle study {}\n", core::counted(cohort.n, "hip", "hips"),
                    written.front().string()));
}

void add_cohort(CLI::App& sample) {
  auto* command =
      sample.add_subcommand("cohort", "Draw hips with random measures: a table for condyle study");
  command->footer(
      "Example: condyle sample cohort --n 4 --seed 1 --out cohort\n"
      "         condyle study cohort/cohort.csv --out study\n"
      "Distributions are in cohort.json. Hip k of a seed is the same for any n.");
  auto options = std::make_shared<CohortOptions>();
  add_out(*command, options->out, "Write cohort.csv and cohort.json into this folder")->required();
  add_value(*command, "--n", options->cohort.n, "N", "Draw this many hips")
      ->required()
      ->check(whole_number(0));
  add_value(*command, "--seed", options->cohort.seed, "N (1)", "The seed of the draws")->check(seed_number());
  add_value(*command, "--scenario", options->scenario, "1..4 (1)",
            "How fine the meshes are, as in condyle sample hip")
      ->check(whole_number(1, 4));
  add_flag(
      *command, "--meshes", options->cohort.meshes, io::CohortMeshes::in_files,
      "Write meshes and joint file of each hip too. Without them a study makes each hip from its measures");
  command->callback([options] { sample_command(*options); });
}

}  // namespace

void add_sample(CLI::App& app) {
  auto* sample = app.add_subcommand("sample", "Make a built-in parametric joint");
  sample->require_subcommand(1);
  add_sample_hip(*sample);
  add_cartilages(*sample);
  add_cohort(*sample);
  add_sample_implants(*sample);
}

}  // namespace condyle::cli
