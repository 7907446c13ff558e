#include "io/report/before_json.hpp"

#include <string>

#include "io/report/body_arrays.hpp"
#include "io/report/file_names.hpp"
#include "io/result/limit_difference.hpp"
#include "io/result/rom_parts.hpp"

namespace condyle::io {
namespace {

/// Names of the arrays of a body before; null if it is the page's own. Triangles are often the page's own where vertices are not.
Json body_before(const Mesh& before, const Mesh& of_page, const std::string& role, BlockArrays& arrays) {
  const bool same_triangles = before.triangles() == of_page.triangles();
  if (same_triangles && before.vertices() == of_page.vertices()) return nullptr;
  return {{"vertices", arrays.add("before_" + role + "_vertices", interleaved(before.vertices().view()))},
          {"triangles", same_triangles ? role + "_triangles"
                                       : arrays.add("before_" + role + "_triangles", corners_of(before))}};
}

std::string file_shown(const std::filesystem::path& file, const ReportLabels& labels) {
  return labels.whole_paths ? file.string() : file.filename().string();
}

}  // namespace

Json reported_rom(const RomResult* rom, const ReportLabels& labels) {
  if (rom == nullptr) return nullptr;
  Json json = rom_object(*rom);
  if (rom->answer.map) json["map"].erase("intervals");
  if (!labels.whole_paths) name_files_only(json["provenance"]);
  return json;
}

Json before_json(const Report& report, BlockArrays& arrays) {
  const ReportedBefore& before = *report.before;
  const Joint &joint = before.joint, &of_page = report.joint;
  Json json{{"file", before.file.empty() ? Json(nullptr) : Json(file_shown(before.file, report.labels))},
            {"joint", {{"name", joint.name}, {"fixed", joint.fixed.name}, {"mobile", joint.mobile.name}}},
            {"rom", reported_rom(before.rom, report.labels)}};
  if (!before.rom) json["rom_error"] = before.rom_error;
  json["differences"] = before.rom && report.rom
                            ? differences_json(limit_differences(before.rom->answer, report.rom->answer))
                            : Json::array();
  json["surfaces"] = {{"fixed", body_before(joint.fixed.mesh, of_page.fixed.mesh, "fixed", arrays)},
                      {"mobile", body_before(joint.mobile.mesh, of_page.mobile.mesh, "mobile", arrays)}};
  return json;
}

}  // namespace condyle::io
