#include "joint_command.hpp"

#include "choice.hpp"
#include "condyle/error.hpp"

namespace condyle::cli {

void add_set(CLI::App& command, std::vector<std::string>& parameters) {
  command
      .add_option("--set", parameters,
                  "Move a part of the joint file to this value of its parameter, such as cup.inclination=42, "
                  "or several in one text; any number")
      ->expected(1)
      ->take_all()
      ->option_text("PART.PARAMETER=VALUE ...");
}

void add_joint(CLI::App& command, JointArguments& given, const char* help) {
  add_set(command, given.parameters);
  command.add_option("JOINT", given.joint, help)->required();
}

void add_where(CLI::App& command, JointArguments& given) {
  command
      .add_option_function<std::string>(
          "--frame", [&given](const std::string& name) { given.frame = io::answer_frame_named(name); },
          "The frame in which points and meshes are written: that of the joint, or that of the mesh files")
      ->option_text("joint|source (joint)");
  command.add_flag_callback(
      "--ascii", [&given] { given.vtp_encoding = io::VtpEncoding::text; },
      "Write VTP files as text, which OpenSim reads");
}

io::LoadedJoint joint_at(io::LoadedJoint loaded, const std::vector<std::string>& parameters) {
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
  return joint_at(io::read_joint(given.joint), given.parameters);
}

io::Provenance provenance_of(const JointArguments& given, const io::LoadedJoint& loaded,
                             const CLI::App& command, const std::vector<std::string>& beside) {
  io::Provenance from = io::provenance_of(loaded, words_of(command), given.frame);
  for (const std::string& file : beside)
    if (!file.empty()) from.read.emplace_back(file);
  return from;
}

}  // namespace condyle::cli
