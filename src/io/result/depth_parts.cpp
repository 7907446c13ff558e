#include "io/result/depth_parts.hpp"

#include <fmt/format.h>

#include "io/file/format_version.hpp"

namespace condyle::io {
namespace {

Json matrix_json(const Pose& X) {
  Json rows = Json::array();
  for (int i = 0; i < 4; ++i)
    rows.push_back({X(i, 0) + 0.0, X(i, 1) + 0.0, X(i, 2) + 0.0, X(i, 3) + 0.0});  // no -0
  return rows;
}

}  // namespace

Json depth_header(const DepthQuestion& question, const char* method) {
  const auto& [joint, pose, X_FM, provenance] = question;
  return {{"condyle", format_version},
          {"joint", joint.name},
          {"fixed", joint.fixed.name},
          {"mobile", joint.mobile.name},
          {"side", joint.side == Side::right ? "right" : "left"},
          {"method", method},
          {"pose_deg", pose_json(pose)},
          {"X_FM", matrix_json(X_FM)}};
}

std::string depth_headline(const DepthQuestion& question, bool in_contact, std::size_t pairs) {
  const auto& [joint, pose, X_FM, provenance] = question;
  return fmt::format("{}: {} in {}, flexion {}, adduction {}, internal rotation {} deg\n", joint.name,
                     joint.mobile.name, joint.fixed.name, pose.flexion, pose.adduction,
                     pose.internal_rotation) +
         fmt::format("  {}; {} intersecting triangle pairs\n", in_contact ? "in contact" : "free", pairs);
}

std::string inside_line(const Body& body, std::size_t inside, std::size_t on_surface) {
  std::string line =
      fmt::format("  {}: {} of {} vertices inside", body.name, inside, body.mesh.vertices().size());
  if (on_surface > 0) line += fmt::format(", {} exactly on the surface", on_surface);
  return line + "\n";
}

std::string place_text(const Vec3& p) {
  return fmt::format("at ({:.2f}, {:.2f}, {:.2f}) mm", p.x(), p.y(), p.z());
}

std::string open_line(const Body& body) {
  return fmt::format("  {}: no answer, the other mesh is open and has no inside\n", body.name);
}

DepthArrays arrays_of(const Body& body, std::vector<MeshArray> points, const std::vector<TrianglePair>& pairs,
                      Index TrianglePair::*triangle) {
  std::vector<std::uint8_t> in_contact(body.mesh.triangles().size());
  for (const TrianglePair& pair : pairs) in_contact[pair.*triangle] = 1;
  return {std::move(points), {"in_contact", std::move(in_contact)}};
}

std::string pairs_csv(const std::vector<TrianglePair>& pairs) {
  std::string text = "fixed_triangle,mobile_triangle\n";
  for (const auto& [fixed, mobile] : pairs) text += fmt::format("{},{}\n", fixed, mobile);
  return text;
}

}  // namespace condyle::io
