#include "io/result/living_text.hpp"

#include <fmt/format.h>

#include "answer/living_limit.hpp"
#include "io/result/text_table.hpp"

namespace condyle::io {

std::string living_text(const RomResult& result, TextForm form) {
  int hips = 0;
  bool any_people = false;
  std::string far_off;
  for (std::size_t i = 0; i < result.answer.limits.size(); ++i) {
    const auto living = living_limit(result.answer, i);
    if (!living) continue;
    if (living->expected) hips = living->gap->hips;
    any_people |= living->people && !living->expected;
    if (living->gap && living->gap->closeness != Closeness::close)
      far_off += (far_off.empty() ? "" : ", ") + result.answer.limits[i].motion.name;
  }
  std::string text;
  if (hips > 0) text += fmt::format("; \"some\": less what soft tissue took in {} cadavers", hips);
  if (any_people) text += "; means: of other people";
  if (form == TextForm::whole && !(text + far_off).empty()) text += "; sources by --json";
  if (!text.empty()) text = "  living hips: " + text.substr(2) + "\n";
  if (form == TextForm::whole && !far_off.empty())
    text += "    usually ended by soft tissue before bone: " + far_off + "\n";
  return wrapped(text);
}

}  // namespace condyle::io
