#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "condyle/io/mesh_file.hpp"
#include "io/file/output_folder.hpp"
#include "io/file/whole_file.hpp"
#include "io/picture/depth_bands.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/resection_result.hpp"

namespace condyle::io {
namespace {

/// Whether some result has a file of this name: body meshes are numbered where a body has several.
bool is_of_resection(std::string_view name) {
  static constexpr std::string_view names[] = {"resection.json",     "limits.csv",         "curve.csv",
                                               "hours.csv",          "depth_mobile.vtp",   "depth_fixed.vtp",
                                               "depth_mobile.png",   "depth_fixed.png",    "resected.toml",
                                               "resected_fixed.ply", "resected_mobile.ply"};
  if (std::find(std::begin(names), std::end(names), name) != std::end(names)) return true;
  for (const std::string_view role : {"resected_fixed_", "resected_mobile_"})
    if (name.starts_with(role) && name.ends_with(".ply"))
      return name.find_first_not_of("0123456789", role.size()) == name.size() - 4;
  return false;
}

void write_depths(OutputFolder& out, std::string_view role, const plan::CutBone& cut,
                  const ResectionResult& result) {
  std::vector<std::int32_t> needed(cut.needed_by.begin(), cut.needed_by.end());
  const MeshArray arrays[] = {
      {"depth_mm", cut.depth_mm}, {"needed_by", std::move(needed)}, {"needed_from_deg", cut.needed_from_deg}};
  write_vtp(out.file(fmt::format("depth_{}.vtp", role)), cut.before, arrays, {},
            {VtpEncoding::binary, io::provenance_fields(result.provenance)});
}

/// The bone alone, without what goes, which is drawn in bands of depth.
void draw_depths(OutputFolder& out, std::string_view role, const plan::CutBone& cut,
                 const ResectionResult& result) {
  if (!(cut.volume_mm3 > 0)) return;
  PictureOptions options;
  options.view = io::view_of(cut);
  options.colour = PictureColour::none;
  (role == "mobile" ? options.fixed : options.mobile) = BodyStyle::hidden;
  options.field_mm = io::field_of(cut, options.view);
  options.marks = io::depth_bands(cut);
  write_png(out.file(fmt::format("depth_{}.png", role)),
            draw_joint(result.answer.resection.joint, {}, Pose::Identity(), options), result.provenance);
}

void write_bodies(OutputFolder& out, std::string_view role, const Body& body) {
  if (body.parts.empty()) return write_mesh(out.file(fmt::format("resected_{}.ply", role)), body.mesh);
  for (std::size_t p = 0; p < body.parts.size(); ++p)
    write_mesh(out.file(fmt::format("resected_{}_{}.ply", role, p + 1)),
               mesh_of_part(body, body.parts[p].name));
}

}  // namespace

void check_resection_folder(const std::filesystem::path& folder, const Provenance* from) {
  OutputFolder{folder, is_of_resection, io::files_read(from)};
}

std::vector<std::filesystem::path> write_resection(const std::filesystem::path& folder,
                                                   const ResectionResult& result) {
  OutputFolder out(folder, is_of_resection, io::files_read(result.provenance), "resection.json");
  const plan::Resection& resection = result.answer.resection;
  io::write_whole_file(out.file("resection.json"), resection_json(result));
  io::write_whole_file(out.file("limits.csv"), resection_limits_csv(result));
  if (!result.answer.curve.empty()) io::write_whole_file(out.file("curve.csv"), resection_curve_csv(result));
  if (const std::string hours = resection_hours_csv(result); !hours.empty())
    io::write_whole_file(out.file("hours.csv"), hours);
  const auto write = [&](std::string_view role, const std::optional<plan::CutBone>& cut) {
    if (!cut) return;
    write_depths(out, role, *cut, result);
    draw_depths(out, role, *cut, result);
  };
  write("mobile", resection.mobile);
  write("fixed", resection.fixed);
  if (resection.mobile || resection.fixed) {
    io::write_whole_file(out.file("resected.toml"), resected_joint_file(result));
    write_bodies(out, "fixed", resection.joint.fixed);
    write_bodies(out, "mobile", resection.joint.mobile);
  }
  return out.commit();
}

}  // namespace condyle::io
