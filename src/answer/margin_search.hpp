#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "condyle/answer/resection.hpp"
#include "condyle/control.hpp"
#include "motion/rom/displacement.hpp"

namespace condyle {

/// Finds the smallest margin with which a share of varied joints reaches the targets: what displaces a joint moves its surfaces towards
/// each other from any side, which a plan for more degrees would not meet.
class MarginSearch {
 public:
  /// Makes a cut; empty if it was stopped.
  using Cut = std::function<std::optional<plan::Resection>(const plan::ResectionOptions&)>;
  /// How many margins are tried at most.
  static constexpr int most_margins = 12;

  /// Borrows all.
  MarginSearch(const ResectionRequest& request, const motion::BandOptions& displaced, const Control& control,
               Cut cut);

  /// Adds a cut with this margin; false if it was stopped, or if kept bone has no room for it that it had for the first.
  bool add(double margin_mm, plan::Resection cut);

  /// Empty if none was found, or if it was stopped.
  std::optional<double> margin_for(double share);

  /// The widest with which there is a cut, and the widest that was tried.
  double widest_mm() const { return tried_.rbegin()->first; }
  double tried_to_mm() const { return std::max(widest_mm(), failed_mm_); }
  const plan::Resection& cut(double margin_mm) const { return tried_.at(margin_mm).resection; }

 private:
  struct Tried {
    plan::Resection resection;
    std::vector<std::vector<Angle>> turned;  ///< of each target, by the varied joints, descending
  };
  using Each = std::map<double, Tried>;

  double beyond_deg(const Tried& tried, double share) const;
  bool is_found(const Each::value_type& low, const Each::value_type& high, double share) const;
  double wider(Each::const_iterator last, double share) const;
  double between(const Each::value_type& low, const Each::value_type& high, double share) const;

  const ResectionRequest& request_;
  const motion::BandOptions& displaced_;
  const Control& control_;
  Cut make_cut_;
  std::vector<motion::Motion> motions_;
  Each tried_;
  double failed_mm_ = 0;  ///< the last one that was too wide for the bone
  int failures_ = 0;
};

}  // namespace condyle
