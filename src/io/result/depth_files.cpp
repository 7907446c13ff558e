#include "condyle/io/depth_result.hpp"
#include "condyle/io/output_folder.hpp"
#include "io/file/whole_file.hpp"

namespace condyle {

void write_depth(const std::filesystem::path& folder, const DepthQuestion& question,
                 const DepthResult& result) {
  OutputFolder out(folder);
  const DepthArrays &fixed = result.fixed, &mobile = result.mobile;
  write_vtp(out.file("fixed.vtp"), question.joint.fixed.mesh, fixed.points, {&fixed.in_contact, 1});
  write_vtp(out.file("mobile.vtp"), posed(question.X_FM, question.joint.mobile.mesh), mobile.points,
            {&mobile.in_contact, 1});
  io::write_whole_file(out.file("pairs.csv"), result.pairs);
  io::write_whole_file(out.file("depth.json"), result.json);
  out.commit();
}

}  // namespace condyle
