#include "motion/search/add_free_interval.hpp"

#include <algorithm>

namespace condyle::motion {

void add_free_interval(std::vector<FreeInterval>& intervals, Angle middle, const RotationLimits& both) {
  const Angle turn = Angle::radians(two_pi);
  FreeInterval found{middle - both.negative.turned, middle + both.positive.turned, both.negative,
                     both.positive};
  if (found.high - found.low > turn) {
    found.at_low.turned = found.at_high.turned = turn * 0.5;
    found.low = middle - turn * 0.5, found.high = middle + turn * 0.5;
  }
  const auto overlaps = [&](const FreeInterval& each) {
    for (const Angle shift : {-turn, Angle(), turn})
      if (std::min(each.high + shift, found.high) - std::max(each.low + shift, found.low) >
          narrowest_free_turn)
        return true;
    return false;
  };
  const auto stays = [&](const FreeInterval& each) {
    return each.holds_start() || each.high - each.low >= found.high - found.low;
  };
  if (std::any_of(intervals.begin(), intervals.end(),
                  [&](const FreeInterval& each) { return overlaps(each) && stays(each); }))
    return;
  std::erase_if(intervals, overlaps);
  intervals.push_back(std::move(found));
}

}  // namespace condyle::motion
