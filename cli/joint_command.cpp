#include "joint_command.hpp"

#include "choice.hpp"
#include "condyle/error.hpp"

namespace condyle::cli {

void add_set(CLI::App& command, std::vector<std::string>& parameters) {
  add_value(command, "--set", parameters, "PART.PARAMETER=VALUE ...",
            "Move a part of the joint file to this value of its parameter, such as cup.inclination=42, "
            "or several in one text; any number")
      ->expected(1)
      ->take_all();
}

void add_joint(CLI::App& command, JointArguments& given, const char* help) {
  add_set(command, given.parameters);
  command.add_option("JOINT", given.joint, help)->required();
}

void add_person(CLI::App& command, Person& person) {
  add_value(command, "--age", person.age_years, "YEARS",
            "Hold limits against people of this age, instead of that of the joint file")
      ->check(
          [](const std::string& text) {
            double years = 0;
            return CLI::detail::lexical_cast(text, years) && is_age(years) ? "" : "must be 0 to 120 years";
          },
          "");
  add_choice(command, "--sex", person.sex, {{"female", Sex::female}, {"male", Sex::male}},
             "The same of this sex");
  add_species(command, person.species);
}

void add_species(CLI::App& command, std::string& species) {
  add_value(command, "--species", species, "NAME",
            "Whose bones they are, if not a human's: then nothing is held against sizes and ranges of "
            "people, and no unit is inferred from sizes");
}

void add_where(CLI::App& command, JointArguments& given) {
  command
      .add_option_function<std::string>(
          "--frame", [&given](const std::string& name) { given.frame = io::answer_frame_named(name); },
          "The frame in which points and meshes are written: that of the joint, or that of the mesh files")
      ->option_text("joint|source (joint)");
  add_flag(command, "--ascii", given.vtp_encoding, io::VtpEncoding::text,
           "Write VTP files as text, which OpenSim reads");
}

io::LoadedJoint joint_at(io::LoadedJoint loaded, const std::vector<std::string>& parameters,
                         const Person& person) {
  if (person.age_years) loaded.joint.person.age_years = person.age_years;
  if (person.sex) loaded.joint.person.sex = person.sex;
  if (!person.species.empty()) loaded.joint.person.species = person.species;
  if (parameters.empty()) return loaded;
  std::string text;
  for (const std::string& words : parameters) text += words + " ";
  try {
    return with_parameters(loaded, parse_parameters(text));
  } catch (const UsageError& error) {
    throw UsageError(std::string("--set: ") + error.what());
  }
}

io::LoadedJoint joint_of(const JointArguments& given) {
  return joint_at(io::read_joint(given.joint), given.parameters, given.person);
}

io::Provenance provenance_of(const JointArguments& given, const io::LoadedJoint& loaded,
                             const CLI::App& command, const std::vector<std::string>& beside) {
  io::Provenance from = io::provenance_of(loaded, words_of(command), given.frame);
  for (const std::string& file : beside)
    if (!file.empty()) from.read.emplace_back(file);
  return from;
}

}  // namespace condyle::cli
