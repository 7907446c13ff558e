#include "io/result/living_text.hpp"

#include <fmt/format.h>

#include "answer/living_limit.hpp"
#include "io/result/text_table.hpp"

namespace condyle::io {

std::string living_text(const RomResult& result) {
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
  if (hips > 0)
    text += fmt::format("\"some\" is the limit less what soft tissue took in {} hips of cadavers; ", hips);
  if (any_people) text += "means are of other people, not this joint; ";
  if (text.empty() && far_off.empty()) return text;
  text = "  living hips: " + text + "sources by --json\n";
  if (!far_off.empty()) text += "    usually ended by soft tissue before bone: " + far_off + "\n";
  return wrapped(text);
}

}  // namespace condyle::io
