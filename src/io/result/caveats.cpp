#include "io/result/caveats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

namespace condyle::io {
namespace {

/// In the order in which a scope names them.
enum class Tissue : std::uint8_t { bones, cartilages, labrum, menisci, soft, implants, layers };
constexpr std::array<std::string_view, 7> tissue_names{
    "bones", "cartilages", "labrum", "menisci", "soft tissue", "implants", "elastic layers"};

struct Tissues {
  std::array<bool, tissue_names.size()> has = {};

  bool holds(Tissue tissue) const noexcept { return has[static_cast<std::size_t>(tissue)]; }
  void add(Tissue tissue) noexcept { has[static_cast<std::size_t>(tissue)] = true; }
  bool only_bones() const noexcept {
    return has[0] && std::none_of(has.begin() + 1, has.end(), [](bool is_there) { return is_there; });
  }
};

std::string lower_case(std::string_view name) {
  std::string lower(name);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

/// All tissues that a name speaks of ("cartilage with labrum"); `otherwise` where it speaks of none.
void add_named(Tissues& tissues, std::string_view name, Tissue otherwise) {
  static constexpr std::array words{
      std::pair{"cartilage", Tissue::cartilages}, std::pair{"labrum", Tissue::labrum},
      std::pair{"menisc", Tissue::menisci},       std::pair{"ligament", Tissue::soft},
      std::pair{"capsule", Tissue::soft},         std::pair{"tendon", Tissue::soft},
      std::pair{"muscle", Tissue::soft},          std::pair{"implant", Tissue::implants},
      std::pair{"prosthe", Tissue::implants}};
  const std::string lower = lower_case(name);
  bool is_known = false;
  for (const auto& [word, tissue] : words)
    if (lower.find(word) != lower.npos) {
      tissues.add(tissue);
      is_known = true;
    }
  if (!is_known) tissues.add(otherwise);
}

void add(Tissues& tissues, const Body& body) {
  if (body.parts.empty()) return add_named(tissues, body.name, Tissue::bones);
  for (const BodyPart& part : body.parts) add_named(tissues, part.name, Tissue::bones);
}

void add_surface(Tissues& tissues, const Body& surface, const std::optional<LayerEntry>& layer) {
  if (layer) return add_named(tissues, surface.name, Tissue::layers);
  add(tissues, surface);
}

Tissues tissues_of(const Joint& joint) {
  Tissues tissues;
  add(tissues, joint.fixed);
  add(tissues, joint.mobile);
  return tissues;
}

std::string scope_of(const Tissues& tissues) {
  constexpr const char* end = "research software, not a medical device";
  if (tissues.only_bones())
    return fmt::format("osseous contact of the meshes given; soft tissue is not modelled; {}", end);
  std::vector<std::string_view> there;
  for (std::size_t i = 0; i < tissue_names.size(); ++i)
    if (tissues.has[i]) there.push_back(tissue_names[i]);
  std::string list;
  for (std::size_t i = 0; i < there.size(); ++i)
    list += fmt::format("{}{}", i == 0 ? "" : i + 1 == there.size() ? " and " : ", ", there[i]);
  return fmt::format("contact of the {} given; other tissue is not modelled; {}", list, end);
}

// In full: docs/caveats.md.
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

bool has_labrum(const Joint& joint) {
  return tissues_of(joint).holds(Tissue::labrum);
}

}  // namespace

std::string scope_text(const Joint& joint) {
  return scope_of(tissues_of(joint));
}

std::string scope_text(const ContactEntry& entry, const ContactSurfaces& surfaces) {
  Tissues tissues;
  add_surface(tissues, surfaces.fixed, entry.fixed);
  add_surface(tissues, surfaces.mobile, entry.mobile);
  return scope_of(tissues);
}

std::string scope_text() {
  return "contact of the meshes given; tissue that is not among them is not modelled; research software, not "
         "a medical device";
}

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
  for (const auto& [name, vary, sense, caveats] : caveat_rows) {
    // A motion of one's own may have a built-in one's name and be another.
    if (name != motion.name || vary != motion.vary || sense != motion.sense) continue;
    std::vector<MotionCaveat> found;
    for (const MotionCaveat* caveat : caveats)
      if (caveat && !(caveat == &labrum && has_labrum(joint))) found.push_back(*caveat);
    return found;
  }
  return {unknown};
}

}  // namespace condyle::io
