#include "contact_options.hpp"

#include <fmt/format.h>

#include <cctype>

#include "choice.hpp"
#include "condyle/error.hpp"

namespace condyle::cli {
namespace {

Vec3 vector_of(const std::vector<double>& values) {
  return values.empty() ? Vec3(Vec3::Zero()) : Vec3(values[0], values[1], values[2]);
}

/// With the condition before it, or with a capital where there is none.
std::string sentence(const std::string& when, std::string text) {
  if (when.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return when + text;
}

}  // namespace

void add_rays(CLI::App& command, io::ContactChanges& options, const std::string& when) {
  add_choice(command, "--casting", options.casting,
             {{"fixed", contact::Casting::fixed},
              {"mobile", contact::Casting::mobile},
              {"both", contact::Casting::both}},
             sentence(when, "the body from whose surface rays are cast"), "both");
  add_choice(
      command, "--rule", options.rule,
      {{"face_centre", contact::FaceRule::face_centre}, {"cut_faces", contact::FaceRule::cut_faces}},
      when +
          "face_centre counts whole triangles by their centre, as OpenSim-JAM does; cut_faces cuts them "
          "where the depth is 0",
      "cut_faces");
  add_value(command, "--reach", options.reach_mm, "MM (20)",
            sentence(when, "how far rays go from one surface to the other"));
}

void add_layers(CLI::App& command, io::ContactChanges& options) {
  const auto add = [&](const char* name, std::vector<double>& values, const char* what, const char* text) {
    add_value(command, name, values, text, what)->expected(1, 2);
  };
  add("--e", options.youngs_modulus_mpa,
      "Young's modulus of both layers, or of the fixed body's and the mobile one's", "MPA [MPA]");
  add("--nu", options.poisson_ratio, "Poisson's ratio of the layers, below 0.5", "NU [NU]");
  add("--thickness", options.thickness_mm, "Thickness of the layers", "MM [MM]");
  add_choice(command, "--law", options.law,
             {{"linear", contact::PressureLaw::linear}, {"logarithmic", contact::PressureLaw::logarithmic}},
             "How pressure grows with depth", "linear");
}

io::ContactEntry contact_of(const io::ContactChanges& changes, const io::JointFile& file,
                            bool with_pressure) {
  io::ContactEntry entry = io::changed(file.contact.value_or(io::ContactEntry{}), changes);
  if (changes.any_of_layers() && !entry.fixed && !entry.mobile)
    throw UsageError("--e, --nu and --thickness: a layer needs all three, and the joint file has none");
  if (with_pressure && !entry.fixed && !entry.mobile)
    throw UsageError(
        fmt::format("{}: no layers: give --e, --nu and --thickness, or [contact.fixed] and [contact.mobile] "
                    "in the joint file",
                    file.path.string()));
  return entry;
}

void add_force(CLI::App& command, BalanceArguments& given, const std::string& force_help) {
  add_value(command, "--force", given.force, "X Y Z",
            force_help + ", in N: anterior, superior and to the right, of a left joint too")
      ->expected(3);
  add_choice(command, "--force-frame", given.frame,
             {{"fixed", BodyRole::fixed}, {"mobile", BodyRole::mobile}},
             "The body in whose frame force and moment are given", "fixed");
  add_value(command, "--along", given.along, "X Y Z [X Y Z]",
            "With a force: move along this direction of the fixed frame only, or in the plane of two")
      ->expected(3, 6);
}

void add_balance(CLI::App& command, BalanceArguments& given) {
  add_force(command, given, "Move the mobile body to where the contact carries this force on it");
  add_value(command, "--moment", given.moment, "X Y Z",
            "With --free-rotations: balance this moment about the mobile body's origin too, in N mm")
      ->expected(3);
  add_flag(command, "--free-rotations", given.rotations, true, "With a force: rotate the mobile body too");
  add_flag(command, "--ligaments", given.ligaments, true,
           "With a force, which may then be 0 0 0: the joint's ligaments pull beside the contact");
}

std::vector<Vec3> directions_of(const std::vector<double>& along) {
  if (along.size() % 3 != 0) throw UsageError("--along: needs three numbers, or six for two directions");
  std::vector<Vec3> directions;
  for (std::size_t i = 0; i < along.size(); i += 3)
    directions.emplace_back(along[i], along[i + 1], along[i + 2]);
  return directions;
}

bool StudyLoadArguments::any_beside() const noexcept {
  return contact.any_of_rays() || contact.any_of_layers() || contact.law || !force.empty() || !along.empty();
}

void add_study_load(CLI::App& command, StudyLoadArguments& given, const std::string& when) {
  add_value(command, "--force", given.force, "ANTERIOR SUPERIOR LATERAL",
            when +
                "move the mobile body to where the contact carries this force on it, in N; lateral is "
                "to the right of a right joint, to the left of a left one")
      ->expected(3);
  add_value(command, "--along", given.along, "ANTERIOR SUPERIOR LATERAL [...]",
            "With --force: move along this direction only, or in the plane of two")
      ->expected(3, 6);
  add_rays(command, given.contact, "With --load: ");
  add_layers(command, given.contact);
}

io::StudyLoad study_load_of(const StudyLoadArguments& given, Anatomy anatomy) {
  if (given.force.empty() && !given.along.empty()) throw UsageError("--along: needs --force");
  io::StudyLoad load{io::study_pose(*given.pose, anatomy), given.contact, {}};
  if (!given.force.empty()) load.force_n = vector_of(given.force);
  load.free_directions = directions_of(given.along);
  return load;
}

contact::Load load_of(const BalanceArguments& given) {
  return {.on_mobile = {vector_of(given.force), vector_of(given.moment)}, .frame = given.frame};
}

void require_load(const BalanceArguments& given, bool has_load) {
  if (has_load) return;
  if (given.ligaments) throw UsageError("--ligaments: needs a force, which may be 0 0 0");
  if (!given.along.empty()) throw UsageError("--along: needs --force");
  if (given.rotations) throw UsageError("--free-rotations: needs a force or a moment");
  if (given.frame != BodyRole::fixed) throw UsageError("--force-frame: needs --force");
}

contact::BalanceOptions balance_options_of(const BalanceArguments& given, const Joint& joint) {
  contact::BalanceOptions options;
  options.free_directions = directions_of(given.along);
  options.free_rotations = given.rotations;
  if (given.ligaments) options.ligaments = joint.ligaments;
  if (given.ligaments && joint.ligaments.empty()) throw UsageError("--ligaments: the joint has none");
  return options;
}

}  // namespace condyle::cli
