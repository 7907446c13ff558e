#include "io/joint/implant_table.hpp"

#include <fmt/format.h>

#include <limits>

#include "condyle/error.hpp"

namespace condyle::io {

plan::Implant implant_entry(TomlTable& table, double mm_per_unit) {
  plan::Implant implant;
  if (table.required_word("kind", {"total_hip", "reverse_shoulder"}) == 1) implant = plan::ReverseShoulder{};
  for (const plan::ImplantParameter& each : plan::implant_parameters(implant))
    if (const auto value = table.number(each.name))
      each.set(implant, each.unit == "mm" ? *value * mm_per_unit : *value);
  if (auto* hip = std::get_if<plan::TotalHip>(&implant); hip != nullptr && table.has("definition")) {
    constexpr CupDefinition definitions[] = {CupDefinition::radiographic, CupDefinition::anatomic,
                                             CupDefinition::operative};
    hip->cup.definition =
        definitions[table.required_word("definition", {"radiographic", "anatomic", "operative"})];
  }
  if (const auto facets = table.integer("facets")) {
    if (*facets < 0 || *facets > std::numeric_limits<int>::max())
      table.fail("facets", "must be a multiple of 4 from 24 to 2880");
    std::visit([&](auto& design) { design.facets = static_cast<int>(*facets); }, implant);
  }
  table.finish();
  try {
    plan::check_implant(implant);
  } catch (const UsageError& error) {
    table.fail("kind", error.what());
  }
  return implant;
}

std::string implant_text(const plan::Implant& implant) {
  std::string text = fmt::format("[implant]\nkind = \"{}\"\n", name_of(implant));
  if (const auto* hip = std::get_if<plan::TotalHip>(&implant))
    text += fmt::format("definition = \"{}\"\n", name_of(hip->cup.definition));
  for (const plan::ImplantParameter& each : plan::implant_parameters(implant))
    text += fmt::format("{} = {}\n", each.name, each.value(implant));
  return text +
         fmt::format("facets = {}\n", std::visit([](const auto& design) { return design.facets; }, implant));
}

}  // namespace condyle::io
