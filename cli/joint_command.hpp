#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <string>
#include <type_traits>
#include <vector>

#include "answer.hpp"
#include "command_line.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/io/provenance.hpp"
#include "help_formatter.hpp"
#include "io/file/input_recorder.hpp"
#include "io/joint/name_joint_file.hpp"
#include "io/result/provenance_forms.hpp"
#include "notes.hpp"
#include "with_progress.hpp"

/// What commands that answer for a joint have in common: JOINT, --set, --out, --frame, --ascii, --json and --strict, and the way from a
/// joint file to an answer.

namespace condyle::cli {

struct JointArguments {
  std::string joint, out;
  std::vector<std::string> parameters;
  Person person;
  io::AnswerFrameName frame = io::AnswerFrameName::joint;
  io::VtpEncoding vtp_encoding = io::VtpEncoding::binary;
  Strictness strictness = Strictness::notes;
  AnswerForm form = AnswerForm::text;
};

/// Each adds options, whose values are written while arguments are read: --set; that and JOINT; --age and --sex, which limits are held against;
/// --frame and --ascii, of commands that write points and meshes.
void add_set(CLI::App& command, std::vector<std::string>& parameters);
void add_joint(CLI::App& command, JointArguments& given, const char* help = "The joint file, .toml");
void add_person(CLI::App& command, Person& person);
void add_species(CLI::App& command, std::string& species);
void add_where(CLI::App& command, JointArguments& given);

/// The joint at the values of --set, and of this person as far as it is said. Throws UsageError that begins with the option.
io::LoadedJoint joint_at(io::LoadedJoint loaded, const std::vector<std::string>& parameters,
                         const Person& person = {});
io::LoadedJoint joint_of(const JointArguments& given);

/// What an answer is of: `beside` are the files that arguments name, empty if they do not.
io::Provenance provenance_of(const JointArguments& given, const io::LoadedJoint& loaded,
                             const CLI::App& command, const std::vector<std::string>& beside = {});

/// The answer of a question, which takes a Control if it is long. Its errors begin with the joint file.
template <class Question>
auto answered(const JointArguments& given, const Question& question) {
  return io::name_joint_file(given.joint, [&] {
    if constexpr (std::is_invocable_v<Question>)
      return question();
    else
      return with_progress(question);
  });
}

}  // namespace condyle::cli
