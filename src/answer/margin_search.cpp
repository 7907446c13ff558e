#include "answer/margin_search.hpp"

#include <cmath>
#include <limits>

#include "condyle/error.hpp"
#include "motion/rom/displaced_joint.hpp"

namespace condyle {
namespace {

/// Margins that are tried for a share of varied joints: the largest, mm, and the steps up to it while the share is not reached; the first by
/// what a mm of margin usually gives. It is found once the share ends each motion so little beyond its target, or the margin is so near to one
/// that is too small.
constexpr double largest_margin_mm = 4, least_step_mm = 0.1, most_step_mm = 1, usual_deg_per_mm = 12;
constexpr double found_within_deg = 0.25, found_within_mm = 0.05;
/// Bone that stays may be in the way of one margin and not of a wider one: so much farther it is tried again, so often.
constexpr double after_failure_mm = 0.2;
constexpr int most_failures = 4;

std::vector<bool> blocked(const plan::Resection& cut) {
  std::vector<bool> by_target;
  for (const plan::ReachOutcome& target : cut.targets) by_target.push_back(target.blocked.has_value());
  return by_target;
}

}  // namespace

MarginSearch::MarginSearch(const ResectionRequest& request, const motion::BandOptions& displaced,
                           const Control& control, Cut cut)
    : request_(request), displaced_(displaced), control_(control), make_cut_(std::move(cut)) {
  for (const plan::ReachTarget& target : request.resection.targets) motions_.push_back(target.motion);
}

bool MarginSearch::add(double margin_mm, plan::Resection cut) {
  if (!tried_.empty() && blocked(cut) != blocked(tried_.begin()->second.resection)) return false;
  auto bands = motion::bands_without_widths(cut.joint, motions_, request_.resection.range, displaced_,
                                            {.stop = control_.stop});
  if (!bands) return false;
  Tried tried{std::move(cut), {}};
  for (motion::LimitBand& band : *bands) {
    std::sort(band.turned.begin(), band.turned.end(), std::greater<>());
    tried.turned.push_back(std::move(band.turned));
  }
  tried_.emplace(margin_mm, std::move(tried));
  return true;
}

std::optional<double> MarginSearch::margin_for(double share) {
  for (int margins = 0;; ++margins) {
    auto low = tried_.end(), high = tried_.begin();
    while (high != tried_.end() && beyond_deg(high->second, share) < 0) low = high++;
    const bool none = high == tried_.end();
    if (none ? std::max(low->first, failed_mm_) >= largest_margin_mm || failures_ == most_failures ||
                   margins == most_margins
             : low == tried_.end() || margins == most_margins || is_found(*low, *high, share))
      return none ? std::nullopt : std::optional(high->first);
    const double next = none ? wider(low, share) : between(*low, *high, share);
    plan::ResectionOptions options = request_.resection;
    options.margin_mm = next;
    std::optional<plan::Resection> cut;
    try {
      cut = make_cut_(options);
    } catch (const MeshError&) {  // so much cannot be cut
    }
    if (cut && add(next, std::move(*cut))) continue;
    if (control_.stop.stop_requested()) return std::nullopt;
    if (!none) return high->first;
    failed_mm_ = next, ++failures_;
  }
}

/// By how much the share reaches more than every target that nothing blocks; below 0 less.
double MarginSearch::beyond_deg(const Tried& tried, double share) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    const std::vector<Angle>& turned = tried.turned[i];
    const double needed = std::ceil(share * static_cast<double>(turned.size()) - 1e-9);
    if (!tried.resection.targets[i].blocked)
      least = std::min(least, (turned[static_cast<std::size_t>(std::max(needed, 1.0)) - 1] -
                               request_.resection.targets[i].reach)
                                  .degrees());
  }
  return least;
}

bool MarginSearch::is_found(const Each::value_type& low, const Each::value_type& high, double share) const {
  return high.first - low.first <= found_within_mm || beyond_deg(high.second, share) <= found_within_deg;
}

/// Where the line through the last two margins is at the target, if there are two.
double MarginSearch::wider(Each::const_iterator last, double share) const {
  const double lacks = found_within_deg / 2 - beyond_deg(last->second, share);
  double slope = usual_deg_per_mm;
  if (last != tried_.begin()) {
    const auto& [margin_mm, before] = *std::prev(last);
    slope = (beyond_deg(last->second, share) - beyond_deg(before, share)) / (last->first - margin_mm);
  }
  const double step = slope > 0 ? lacks / slope : most_step_mm;
  const double next = last->first + std::clamp(step, least_step_mm, most_step_mm);
  return std::min(failed_mm_ > last->first ? failed_mm_ + after_failure_mm : next, largest_margin_mm);
}

double MarginSearch::between(const Each::value_type& low, const Each::value_type& high, double share) const {
  const double from = beyond_deg(low.second, share), to = beyond_deg(high.second, share);
  const double part = std::clamp((found_within_deg / 2 - from) / (to - from), 0.1, 0.9);
  return low.first + part * (high.first - low.first);
}

}  // namespace condyle
