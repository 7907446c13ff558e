#include "notes.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <string>

#include "answer.hpp"
#include "choice.hpp"
#include "condyle/error.hpp"
#include "kinematics/wrong_set_up.hpp"

namespace condyle::cli {

void add_strict(CLI::App& command, Strictness& strictness, const std::string& or_what) {
  add_flag(command, "--strict", strictness, Strictness::errors,
           "Refuse to answer, with exit code 4, if something looks wrong with the joint (side, axes, units, "
           "centre, meshes)" +
               or_what + ". By default a note reports it");
}

namespace {

template <class Note>
void say(const std::vector<Note>& notes, const std::string& file, Strictness strictness,
         std::string_view whose = {}) {
  if (strictness == Strictness::errors && !notes.empty()) {
    std::string all;
    for (const Note& each : notes)
      all += fmt::format("{}{}: {}", all.empty() ? "" : "; ", name_of(each.code), each.text);
    throw MeshError(fmt::format("{}: {} (--strict)", file, all));
  }
  note_all(notes, whose);
}

}  // namespace

std::vector<JointNote> noted(const io::LoadedJoint& joint, Strictness strictness, std::string_view whose) {
  std::vector<JointNote> notes = check_joint(joint.joint, joint.report.placement);
  std::vector<JointNote> gravest_first = notes;
  std::stable_partition(gravest_first.begin(), gravest_first.end(),
                        [](const auto& note) { return kinematics::is_wrong_set_up(note.code); });
  say(gravest_first, joint.report.file.path.string(), strictness, whose);
  return notes;
}

void note_contact(const std::vector<motion::ContactNote>& notes, const io::LoadedJoint& joint,
                  Strictness strictness) {
  say(notes, joint.report.file.path.string(), strictness);
}

void say_notes(const std::vector<JointNote>& notes, const std::string& file, Strictness strictness) {
  say(notes, file, strictness);
}

}  // namespace condyle::cli
