#include <algorithm>

#include "io/file/input_recorder.hpp"
#include "io/result/provenance_forms.hpp"

namespace condyle::io {

void add_other_files(Provenance& from, const InputRecorder& read) {
  const auto is_named = [&](const std::filesystem::path& path) {
    const auto is_of = [&](const MeshOrigin& body) {
      return std::any_of(body.files.begin(), body.files.end(),
                         [&](const MeshSource& mesh) { return mesh.path == path; });
    };
    return path == from.joint_path || is_of(from.fixed) || is_of(from.mobile);
  };
  from.other_files.clear();
  for (const Input& input : read.inputs())
    if (input.kind == Input::Kind::file && is_digest(input.state) && !is_named(input.path))
      from.other_files.push_back({input.path, input.state});
  std::sort(from.other_files.begin(), from.other_files.end(),
            [](const OtherFile& a, const OtherFile& b) { return a.path < b.path; });
}

}  // namespace condyle::io
