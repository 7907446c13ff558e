#include <algorithm>
#include <iterator>

#include "condyle/io/depth_result.hpp"
#include "condyle/io/output_folder.hpp"
#include "io/file/whole_file.hpp"
#include "io/result/provenance_forms.hpp"

namespace condyle {
namespace {

/// Whether some result has a file of this name.
bool is_of_depth(std::string_view name) {
  static constexpr std::string_view names[] = {"fixed.vtp", "mobile.vtp", "pairs.csv", "depth.json"};
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

}  // namespace

std::vector<std::filesystem::path> write_depth(const std::filesystem::path& folder,
                                               const DepthQuestion& question, const DepthResult& result,
                                               VtpEncoding encoding) {
  OutputFolder out(folder, is_of_depth);
  const AnswerFrame frame = question.frame();
  const VtpOptions options{encoding, io::provenance_fields(question.provenance)};
  const auto write = [&](std::string_view name, const TriMesh& mesh, const DepthArrays& arrays) {
    write_vtp(out.file(name), frame.fixed_mesh(mesh), arrays.points, {&arrays.in_contact, 1}, options);
  };
  write("fixed.vtp", question.joint.fixed.mesh, result.fixed);
  write("mobile.vtp", posed(question.X_FM, question.joint.mobile.mesh), result.mobile);
  io::write_whole_file(out.file("pairs.csv"), io::provenance_comments(question.provenance) + result.pairs);
  io::write_whole_file(out.file("depth.json"), result.json);
  return out.commit();
}

}  // namespace condyle
