#pragma once

#include <CLI/App.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "answer.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/joint_checks.hpp"
#include "condyle/motion_contact.hpp"

namespace CLI {
class App;
}

namespace condyle::cli {

/// Severity of notes on a joint: remarks beside an answer, or errors instead of it.
enum class Strictness { notes, errors };

/// What notes of a command may be on beside the joint: add_strict().
inline constexpr const char* or_contact = " or with its layers, load or motion";

/// --strict for a command that answers for a joint; `strictness` is written while arguments are read.
void add_strict(CLI::App& command, Strictness& strictness, const std::string& or_what = {});

/// Looks at a joint as it was read and notes what looks wrong, before anything is computed: what fails later
/// may fail for that. Where notes are errors, throws MeshError with all of them. `whose` stands before each if
/// a command has two joints.
std::vector<JointNote> noted(const io::LoadedJoint& joint, Strictness strictness,
                             std::string_view whose = {});

/// Says notes of an answer, each after `whose` joint it is of if a command has two.
template <class Note>
void note_all(const std::vector<Note>& notes, std::string_view whose = {}) {
  for (const Note& each : notes)
    note(std::string(whose) + std::string(name_of(each.code)) + ": " + each.text,
         std::string(name_of(each.code)));
}

/// Notes of an answer about this file, or MeshError with all of them where they are errors.
void say_notes(const std::vector<JointNote>& notes, const std::string& file, Strictness strictness);

/// The same of notes on layers, loads and motions, once there is an answer.
void note_contact(const std::vector<motion::ContactNote>& notes, const io::LoadedJoint& joint,
                  Strictness strictness);

}  // namespace condyle::cli
