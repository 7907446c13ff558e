#include "io/joint/implant_parts.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

namespace condyle::io {
namespace {

/// Scatter of cup placement and stem version in surgery, degrees, as planning assumes it: for bands.
constexpr double cup_sigma_deg = 4, stem_sigma_deg = 2;

PartParameter angle_of(const plan::Implant& implant, std::string_view size, std::string name,
                       ParameterKind kind, double sigma_deg) {
  const auto sizes = plan::implant_parameters(implant);
  const auto found = std::find_if(sizes.begin(), sizes.end(),
                                  [&](const plan::ImplantParameter& each) { return each.name == size; });
  PartParameter parameter{.name = std::move(name), .kind = kind, .low = found->low, .high = found->high};
  parameter.value = parameter.described = parameter.as_given = found->value(implant);
  parameter.sigma = sigma_deg;
  return parameter;
}

}  // namespace

std::vector<PosedPart> implant_parts(const plan::Implant& implant, BonesAround bones) {
  const auto* hip = std::get_if<plan::TotalHip>(&implant);
  if (hip == nullptr) return {};
  const auto only = [&](std::vector<std::string> names) {
    return bones == BonesAround::some ? std::move(names) : std::vector<std::string>{};
  };
  PosedPart cup{
      .name = "cup", .body = BodyRole::fixed, .meshes = only({"liner"}), .definition = hip->cup.definition};
  cup.parameters = {
      angle_of(implant, "inclination", "inclination", ParameterKind::cup_inclination, cup_sigma_deg),
      angle_of(implant, "anteversion", "anteversion", ParameterKind::cup_anteversion, cup_sigma_deg)};
  PosedPart stem{.name = "stem", .body = BodyRole::mobile, .meshes = only({"head", "neck", "stem"})};
  stem.parameters = {angle_of(implant, "stem_version", "version", ParameterKind::version, stem_sigma_deg)};
  return {std::move(cup), std::move(stem)};
}

}  // namespace condyle::io
