#include "io/result/living_text.hpp"

#include <fmt/format.h>

#include <array>

#include "answer/living_limit.hpp"
#include "io/result/motion_groups.hpp"
#include "io/result/text_table.hpp"

namespace condyle::io {

std::string living_text(const RomResult& result) {
  MotionGroups people;
  std::array<MotionGroups, std::size(all_closenesses)> gaps;
  std::string heading;
  for (std::size_t i = 0; i < result.answer.limits.size(); ++i) {
    const motion::MotionLimit& limit = result.answer.limits[i];
    const auto living = living_limit(result.answer, i);
    if (!living) continue;
    if (heading.empty()) heading = "  living hips:\n";
    if (const auto& gap = living->gap) {
      constexpr std::array words{"close", "moderate, too far to say where a living hip ends",
                                 "weak, bone says little of a living hip"};
      const auto of = static_cast<std::size_t>(gap->closeness);
      gaps[of].add(
          std::string(words[of]) + (living->expected ? ", so that \"some\" is the limit less this" : ""),
          fmt::format("{} {:g} (SD {:g})", limit.motion.name, gap->mean.degrees(), gap->sd.degrees()));
      heading = fmt::format(
          "  living hips: soft tissue ended motions earlier than bone in {} hips of cadavers, "
          "deg ({}):\n",
          gap->hips, gap->source);
    }
    if (const auto& range = living->people; range && !living->expected)
      people.add(fmt::format("people, {}{} ({})", range->who,
                             range->people ? fmt::format(", {}", *range->people) : "", range->source),
                 limit.motion.name);
  }
  return wrapped(heading + gaps[0].text() + gaps[1].text() + gaps[2].text() + people.text());
}

}  // namespace condyle::io
