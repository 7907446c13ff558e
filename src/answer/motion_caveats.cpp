#include "answer/motion_caveats.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "core/lower_case.hpp"

namespace condyle {
namespace {

// In full: docs/range-of-motion.md.
constexpr std::string_view turley = "Turley 2013, PMC3589629", han = "Han 2020, J Orthop Res 38:1779",
                           van_arkel = "van Arkel 2015, PMC4655836", labrum_study = "PMC7754612";

constexpr MotionCaveat bone_in_flexion{MotionCaveatCode::bone_may_end,
                                       "bone contact may end them in normal hips",
                                       "In native hips flexion, also with abduction, was at risk of bone "
                                       "contact: bone may be what ends this motion, and soft tissue "
                                       "may still end it earlier.",
                                       turley};
constexpr MotionCaveat bone_in_adduction{
    MotionCaveatCode::bone_may_end, "bone contact may end them in normal hips, by one reading of the source",
    "The source counts \"flexion, flexion combined with abduction and adduction\" as at risk of bone contact "
    "in native "
    "hips, and soft tissue as what limits flexion with adduction: adduction from neutral may be one of the "
    "three.",
    turley};
constexpr MotionCaveat bone_in_abduction_at_90{MotionCaveatCode::bone_may_end,
                                               "bone contact may end them in normal hips",
                                               "In eight cadaver hips bone met bone in high abduction with "
                                               "flexion too: bone may be what ends this motion.",
                                               han};
constexpr MotionCaveat bone_in_fadir{MotionCaveatCode::bone_may_end,
                                     "bone contact may end them in normal hips",
                                     "In eight cadaver hips bone met bone in high flexion with adduction and "
                                     "internal rotation: bone may be what ends this motion.",
                                     han};
constexpr MotionCaveat soft_tissue{MotionCaveatCode::soft_tissue_ends,
                                   "soft tissue usually ends them before bone does",
                                   "In native hips soft tissue, not bone, limited extension and flexion with "
                                   "adduction: a living hip usually stops before this "
                                   "limit.",
                                   turley};
constexpr MotionCaveat close{MotionCaveatCode::soft_tissue_close,
                             "soft tissue ended them 4.9 (SD 3.8) deg before bone in cadaver hips",
                             "In eight cadaver hips soft tissue ended internal rotation at 90 degrees of "
                             "flexion 4.9 (SD 3.8) degrees before bone would have.",
                             han};
constexpr MotionCaveat capsule{MotionCaveatCode::capsule_restrains,
                               "the capsule restrains them; no source says whether bone ends them",
                               "The capsule of cadaver hips left at most 50 (SD 10) degrees of unresisted "
                               "rotation, internal and external together, in "
                               "mid-flexion, and less towards the limits of the other angles: no source "
                               "known here says whether bone ends this motion.",
                               van_arkel};
constexpr MotionCaveat labrum{MotionCaveatCode::labrum_not_modelled,
                              "a labrum, which no mesh is called, took 18 deg off them (median)",
                              "No mesh is called a labrum: in simulations of 19 hips in flexion and "
                              "adduction a labrum took 18 degrees off internal "
                              "rotation (median; quartiles 15 and 25).",
                              labrum_study};
constexpr MotionCaveat unknown{MotionCaveatCode::end_unknown,
                               "not known whether bone or soft tissue usually ends them",
                               "No source known here says whether bone or soft tissue usually ends this "
                               "motion: soft tissue may end it before this limit.",
                               {}};

struct Row {
  std::string_view motion;
  JointAngle vary;
  RotationSense sense;
  std::array<const MotionCaveat*, 2> caveats;
};

constexpr JointAngle flexion = JointAngle::flexion, adduction = JointAngle::adduction,
                     internal = JointAngle::internal_rotation;
constexpr RotationSense plus = RotationSense::positive, minus = RotationSense::negative;

constexpr std::array caveat_rows{
    Row{"flexion", flexion, plus, {&bone_in_flexion, nullptr}},
    Row{"extension", flexion, minus, {&soft_tissue, nullptr}},
    Row{"internal_rotation", internal, plus, {&capsule, nullptr}},
    Row{"external_rotation", internal, minus, {&capsule, nullptr}},
    Row{"adduction", adduction, plus, {&bone_in_adduction, nullptr}},
    Row{"abduction_at_90_flexion", adduction, minus, {&bone_in_flexion, &bone_in_abduction_at_90}},
    Row{"adduction_at_90_flexion", adduction, plus, {&soft_tissue, nullptr}},
    Row{"internal_rotation_at_90_flexion", internal, plus, {&close, &labrum}},
    Row{"external_rotation_at_90_flexion", internal, minus, {&capsule, nullptr}},
    Row{"fadir", internal, plus, {&bone_in_fadir, &labrum}},
    Row{"faber", internal, minus, {&capsule, nullptr}},
};

bool is_called_labrum(std::string_view name) {
  return core::lower_case(name).find("labrum") != std::string::npos;
}

bool has_labrum(const Body& body) {
  if (body.parts.empty()) return is_called_labrum(body.name);
  return std::any_of(body.parts.begin(), body.parts.end(),
                     [](const BodyPart& part) { return is_called_labrum(part.name); });
}

}  // namespace

std::string_view name_of(MotionCaveatCode code) noexcept {
  switch (code) {
    case MotionCaveatCode::bone_may_end:
      return "bone_may_end";
    case MotionCaveatCode::soft_tissue_ends:
      return "soft_tissue_ends";
    case MotionCaveatCode::soft_tissue_close:
      return "soft_tissue_close";
    case MotionCaveatCode::capsule_restrains:
      return "capsule_restrains";
    case MotionCaveatCode::labrum_not_modelled:
      return "labrum_not_modelled";
    case MotionCaveatCode::end_unknown:
      return "end_unknown";
  }
  return "end_unknown";
}

std::vector<MotionCaveat> motion_caveats(const Joint& joint, const motion::Motion& motion) {
  if (!joint.is_hip()) return {};
  if (joint.implant) return {unknown};
  for (const auto& [name, vary, sense, caveats] : caveat_rows) {
    // A motion of one's own may have a built-in one's name and be another.
    if (name != motion.name || vary != motion.vary || sense != motion.sense) continue;
    std::vector<MotionCaveat> found;
    for (const MotionCaveat* caveat : caveats)
      if (caveat && !(caveat == &labrum && (has_labrum(joint.fixed) || has_labrum(joint.mobile))))
        found.push_back(*caveat);
    return found;
  }
  return {unknown};
}

}  // namespace condyle
