#include "io/report/plan_json.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include "io/result/resection_object.hpp"

namespace condyle::io {
namespace {

Json lowered_json(const plan::CutBone& cut, const std::string& role, BlockArrays& arrays) {
  std::vector<std::uint32_t> lowered;
  std::vector<double> before, depth_mm;
  for (std::uint32_t v = 0; v < cut.depth_mm.size(); ++v) {
    if (cut.depth_mm[v] == 0) continue;
    lowered.push_back(v);
    depth_mm.push_back(cut.depth_mm[v]);
    const Vec3 p = cut.before.vertices[v];
    before.insert(before.end(), {p.x(), p.y(), p.z()});
  }
  return {{"lowered", arrays.add(role + "_lowered", lowered)},
          {"before", arrays.add(role + "_before", before)},
          {"depth_mm", arrays.add(role + "_depth", depth_mm)}};
}

}  // namespace

Json plan_json(const ResectionResult& plan, BlockArrays& arrays) {
  Json json = resection_object(plan);
  // The page has these of the joint.
  for (const char* key : {"condyle", "joint", "fixed", "mobile", "side", "notes", "scope", "provenance"})
    json.erase(key);
  const plan::Resection& resection = plan.answer.resection;
  json["surfaces"] = {
      {"fixed", resection.fixed ? lowered_json(*resection.fixed, "fixed", arrays) : Json(nullptr)},
      {"mobile", resection.mobile ? lowered_json(*resection.mobile, "mobile", arrays) : Json(nullptr)}};
  return json;
}

}  // namespace condyle::io
