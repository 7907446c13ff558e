#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "condyle/io/mesh_file.hpp"
#include "condyle/io/provenance.hpp"
#include "condyle/joint_checks.hpp"
#include "io/result/json.hpp"

/// Provenance as each kind of file has it. Null, nothing and nothing if it is not known, as in a program that makes
/// its joints itself.

namespace condyle::io {

class InputRecorder;

/// A file that an answer comes from.
Json file_json(const std::filesystem::path& path, const FileDigest& digest);
std::string file_text(const std::filesystem::path& path, const FileDigest& digest);

/// The command line as a shell takes it, of its words without the program.
std::string command_text(const std::vector<std::string>& words);

/// Files that were read for an answer; nothing if that is not known.
inline std::span<const std::filesystem::path> files_read(const Provenance* from) {
  if (from == nullptr) return {};
  return from->read;
}

Json provenance_json(const Provenance* from);
/// Adds the files that were read beside the joint file and its meshes: once all is read, before anything is written.
void add_other_files(Provenance& from, const InputRecorder& read);
std::vector<VtpField> provenance_fields(const Provenance* from);
/// Lines "# name: value" before a CSV's header line.
std::string provenance_comments(const Provenance* from);
/// The same, and a line "# note: code: text" for each note on the joint.
std::string provenance_comments(const Provenance* from, std::span<const JointNote> notes);

}  // namespace condyle::io
