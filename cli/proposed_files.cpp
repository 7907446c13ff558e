#include "proposed_files.hpp"

#include <string>
#include <system_error>

#include "answer.hpp"
#include "condyle/error.hpp"
#include "condyle/io/mesh_file.hpp"
#include "io/file/output_file.hpp"
#include "io/file/output_folder.hpp"
#include "notes.hpp"

namespace condyle::cli {

namespace fs = std::filesystem;

void refuse_existing(const fs::path& path, const char* why) {
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(path, ignored)))
    throw FileError(path.string() + ": is there already, " + why + ": name another or remove it");
}

void note_to_fill_in(const io::JointProposal& proposal) {
  for (const std::string& missing : proposal.to_fill_in) note("to fill in: " + missing);
  if (!proposal.units_note.empty()) note(proposal.units_note);
}

void write_proposal(const io::LabelJoint& joint, const fs::path& joint_file) {
  for (const fs::path& mesh : {joint.fixed_mesh, joint.mobile_mesh})
    refuse_existing(mesh, "and is a mesh of a joint");
  note_all(joint.notes);
  note_to_fill_in(joint.proposal);
  const fs::path folder = joint_file.parent_path();
  io::OutputFolder out(folder.empty() ? fs::path(".") : folder);
  io::write_mesh(out.file(joint.fixed_mesh.filename().string()), joint.fixed.surface.mesh);
  io::write_mesh(out.file(joint.mobile_mesh.filename().string()), joint.mobile.surface.mesh);
  io::write_output_file(out.file(joint_file.filename().string()), joint.proposal.toml);
  say_written(out.commit());
}

}  // namespace condyle::cli
