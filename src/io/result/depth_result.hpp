#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "condyle/answer.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/io/provenance.hpp"
#include "condyle/joint.hpp"
#include "condyle/joint_checks.hpp"

/// Results of `condyle depth`, for files. Every key, array, unit and sign is in docs/depths.md.

namespace condyle::io {

/// The pose that a result belongs to.
struct DepthQuestion {
  const Joint& joint;
  PoseDegrees pose;  ///< as it was given
  Pose X_FM;
  std::vector<JointNote> notes = {};  ///< what looks wrong with the joint
  /// Where the answer comes from and in which frame it is given; null: not known, and the joint frame.
  const Provenance* provenance = nullptr;

  AnswerFrame frame() const { return provenance ? provenance->frame : AnswerFrame{}; }
};

/// Arrays of one body, the first of each to colour by: finite everywhere, 0 for what is not inside. On points, where the
/// other mesh is open and nothing can be inside it, nearest distances only. On triangles what rays along their normals
/// found, where the body casts, and in_contact, 1 for a triangle that is in a pair.
struct DepthArrays {
  std::vector<MeshArray> points, triangles;
};

/// An answer in every form in which it is given.
struct DepthResult {
  std::string text;   ///< the summary for people, a few lines
  std::string json;   ///< the summary for programs, a whole document
  std::string pairs;  ///< intersecting triangle pairs, CSV with a header line
  DepthArrays fixed, mobile;
};

/// `answer` is that of answer_depth() to the question's pose.
DepthResult depth_result(const DepthQuestion& question, const DepthAnswer& answer);

/// Whether tables of vertices are written too.
enum class VertexTables { leave_out, write };

struct DepthFiles {
  VtpEncoding encoding = VtpEncoding::binary;
  VertexTables vertices = VertexTables::leave_out;
};

/// Throws FileError if write_depth() could not write into the folder, or would write over a file that was read
/// (Provenance::read): to be called before long work. Leaves nothing.
void check_depth_folder(const std::filesystem::path& folder, const Provenance* from);

/// Writes fixed.vtp and mobile.vtp (both in the fixed body's frame), pairs.csv and depth.json into a folder, on request
/// fixed.csv and mobile.csv with a line per vertex; all or none, and files of an earlier result go. Returns what was
/// written. Throws FileError.
std::vector<std::filesystem::path> write_depth(const std::filesystem::path& folder,
                                               const DepthQuestion& question, const DepthResult& result,
                                               const DepthFiles& files = {});

}  // namespace condyle::io
