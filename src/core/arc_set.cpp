#include "core/arc_set.hpp"

#include <algorithm>

#include "core/wrapped_angle.hpp"

namespace condyle::core {

ArcSet::ArcSet(const std::vector<Arc>& arcs) {
  std::vector<Stretch> stretches;
  for (const Arc& arc : arcs) append(arc, stretches);
  stretches_ = merged(std::move(stretches));
}

ArcSet ArcSet::full_turn() {
  return ArcSet({{Angle(), Angle::radians(two_pi)}});
}

void ArcSet::append(const Arc& arc, std::vector<Stretch>& to) {
  const double width = arc.width.radians();
  if (width >= two_pi) {
    to.push_back({0, two_pi});
    return;
  }
  const double low = wrapped(arc.start.radians()), high = low + width;
  to.push_back({low, std::min(high, two_pi)});
  if (high >= two_pi) to.push_back({0, high - two_pi});
}

std::vector<ArcSet::Stretch> ArcSet::merged(std::vector<Stretch> stretches) {
  std::sort(stretches.begin(), stretches.end());
  std::vector<Stretch> out;
  for (const Stretch& s : stretches) {
    if (!out.empty() && s.low <= out.back().high) {
      out.back().high = std::max(out.back().high, s.high);
    } else {
      out.push_back(s);
    }
  }
  // 0 and 2 pi are one direction.
  if (!out.empty() && out.back().high == two_pi && out.front().low > 0) out.insert(out.begin(), {0, 0});
  if (!out.empty() && out.front().low == 0 && out.back().high < two_pi) out.push_back({two_pi, two_pi});
  return out;
}

bool ArcSet::is_full_turn() const noexcept {
  return stretches_.size() == 1 && stretches_[0] == Stretch{0, two_pi};
}

Angle ArcSet::measure() const noexcept {
  double sum = 0;
  for (const auto& [low, high] : stretches_) sum += high - low;
  return Angle::radians(sum);
}

std::vector<Arc> ArcSet::arcs() const {
  std::vector<Arc> out;
  const bool across_zero = stretches_.size() > 1 && stretches_.front().low == 0;
  for (std::size_t i = across_zero ? 1 : 0; i < stretches_.size(); ++i) {
    const auto& [low, high] = stretches_[i];
    out.push_back({Angle::radians(low), Angle::radians(high - low)});
  }
  if (across_zero) {
    Arc& last = out.back();
    last.width = last.width + Angle::radians(stretches_.front().high);
    if (last.start.radians() == two_pi) last.start = Angle();
  }
  return out;
}

bool ArcSet::holds(const Stretch& stretch) const noexcept {
  const auto after = std::upper_bound(stretches_.begin(), stretches_.end(), stretch.low,
                                      [](double low, const Stretch& s) { return low < s.low; });
  return after != stretches_.begin() && stretch.high <= std::prev(after)->high;
}

bool ArcSet::contains(Angle direction) const noexcept {
  const double at = wrapped(direction.radians());
  return holds({at, at});
}

bool ArcSet::contains(const Arc& arc) const noexcept {
  if (arc.width.radians() >= two_pi) return is_full_turn();
  const double low = wrapped(arc.start.radians()), high = low + arc.width.radians();
  return high < two_pi ? holds({low, high}) : holds({low, two_pi}) && holds({0, high - two_pi});
}

ArcSet ArcSet::united(const ArcSet& other) const {
  ArcSet out;
  std::vector<Stretch> all = stretches_;
  all.insert(all.end(), other.stretches_.begin(), other.stretches_.end());
  out.stretches_ = merged(std::move(all));
  return out;
}

ArcSet ArcSet::complement() const {
  std::vector<Stretch> between;
  double from = 0;
  for (const auto& [low, high] : stretches_) {
    if (low > from) between.push_back({from, low});
    from = high;
  }
  if (from < two_pi) between.push_back({from, two_pi});
  ArcSet out;
  out.stretches_ = merged(std::move(between));
  return out;
}

}  // namespace condyle::core
