#include "io/result/scope_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/lower_case.hpp"

namespace condyle::io {
namespace {

/// In the order in which a scope names them.
enum class Tissue : std::uint8_t { bones, cartilages, labrum, menisci, soft, implants, layers, strings };
constexpr std::array<std::string_view, 8> tissue_names{"bones",          "cartilages",          "labrum",
                                                       "menisci",        "soft tissue",         "implants",
                                                       "elastic layers", "ligaments as strings"};

struct Tissues {
  std::array<bool, tissue_names.size()> has = {};

  void add(Tissue tissue) noexcept { has[static_cast<std::size_t>(tissue)] = true; }
  bool only_bones() const noexcept {
    return has[0] && std::none_of(has.begin() + 1, has.end(), [](bool is_there) { return is_there; });
  }
};

/// All tissues that a name speaks of ("cartilage with labrum"); `otherwise` where it speaks of none.
void add_named(Tissues& tissues, std::string_view name, Tissue otherwise) {
  static constexpr std::array words{
      std::pair{"cartilage", Tissue::cartilages}, std::pair{"labrum", Tissue::labrum},
      std::pair{"menisc", Tissue::menisci},       std::pair{"ligament", Tissue::soft},
      std::pair{"capsule", Tissue::soft},         std::pair{"tendon", Tissue::soft},
      std::pair{"muscle", Tissue::soft},          std::pair{"implant", Tissue::implants},
      std::pair{"prosthe", Tissue::implants}};
  const std::string lower = core::lower_case(name);
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
  for (const Ligament& ligament : joint.ligaments)
    if (ligament.ends_at_strain) tissues.add(Tissue::strings);
  return tissues;
}

std::string scope_of(const Tissues& tissues) {
  constexpr const char* end = "research software, not a medical device";
  if (tissues.only_bones()) return fmt::format("osseous contact only; soft tissue is not modelled; {}", end);
  std::vector<std::string_view> there;
  for (std::size_t i = 0; i < tissue_names.size(); ++i)
    if (tissues.has[i]) there.push_back(tissue_names[i]);
  std::string list;
  for (std::size_t i = 0; i < there.size(); ++i)
    list += fmt::format("{}{}", i == 0 ? "" : i + 1 == there.size() ? " and " : ", ", there[i]);
  return fmt::format("contact of the {} given; other tissue is not modelled; {}", list, end);
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

}  // namespace condyle::io
