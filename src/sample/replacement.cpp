#include "condyle/sample/hip.hpp"

#include <fmt/format.h>

#include <utility>

#include "condyle/error.hpp"
#include "plan/place_implant.hpp"
#include "sample/cut_neck.hpp"
#include "sample/femur_shape.hpp"

namespace condyle::sample {
namespace {

void require_fitting(const plan::TotalHip& implant, const HipParameters& bones) {
  const double socket = bones.head_radius_mm + bones.joint_space_mm;
  if (implant.cup_radius_mm < socket) return;
  throw UsageError(fmt::format(
      "sample replacement: a cup of radius {:g} mm is not inside the pelvis: the socket has {:g} mm",
      implant.cup_radius_mm, socket));
}

}  // namespace

std::optional<plan::ImplantMeshes> sample_replacement(const plan::TotalHip& implant,
                                                      const HipParameters& bones,
                                                      const Resolution& resolution, Side side,
                                                      const std::stop_token& stop) {
  plan::check_implant(implant);
  require_fitting(implant, bones);
  std::optional<SampleHip> hip = sample_hip(bones, resolution, stop);
  if (!hip) return std::nullopt;
  const plan::NeckCut cut = plan::neck_cut(implant, Side::right);
  const FemurAxes axes = sample::femur_axes(bones);
  const Vec3 shift = plan::femur_shift({axes.foot, axes.distal}, implant, cut);
  plan::ImplantMeshes parts = plan::implant_meshes(implant, side, axes.distal);
  TriMesh& femur = hip->femur;
  for (std::size_t v = 0; v < femur.vertices.size(); ++v) femur.vertices.set(v, femur.vertices[v] + shift);
  femur = sample::cut_neck(femur, cut.normal, cut.offset_mm);
  if (side == Side::left) *hip = mirrored(*hip);
  parts.fixed.insert(parts.fixed.begin(), {"hip_bone", std::move(hip->hip_bone)});
  parts.mobile.insert(parts.mobile.begin(), {"femur", std::move(hip->femur)});
  return parts;
}

}  // namespace condyle::sample
