#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/answer/case.hpp"
#include "condyle/answer/range.hpp"
#include "condyle/hip_measures.hpp"
#include "condyle/limit_band.hpp"
#include "condyle/sweep.hpp"

/// The limits of many designs, and where they are safe.

namespace condyle {

/// One of several parts of a sweep: whole lines of designs along the last parameter.
struct SweepShare {
  std::size_t number = 1, of = 1;
};

/// Further values of a design, computed from the joint at its values: shape, pressure.
struct SweepQuantities {
  std::vector<std::string> names;  ///< as columns have them, each with its unit at the end
  /// One for each name, NaN where there is none. May be called from any thread.
  std::function<std::vector<double>(const Joint&)> of;
};

/// Measures of a hip's shape, by their keys. Throws UsageError for a key that no measure has.
[[nodiscard]] SweepQuantities measured_quantities(std::span<const std::string> keys,
                                                  const measure::MeasureOptions& request);

/// Which design is called the best.
enum class BestDesign : std::uint8_t {
  largest_margin,  ///< The least of its margins by their targets' weights is the largest.
  least_change,    ///< It is safe, with fewest steps from the joint as it is; by its margin if none is safe.
};

/// As in files: "largest_margin".
[[nodiscard]] std::string_view name_of(BestDesign by) noexcept;

/// Options of a request for a sweep, with their defaults.
struct SweepRequest {
  std::vector<plan::SweptParameter> parameters = {};  ///< one to four; the last one changes fastest
  std::vector<plan::SweepTarget> targets = {};        ///< one or more
  motion::RangeOptions range = {};
  /// The probability that a design leaves all targets free, over the standard deviations of parameters, and no others.
  std::optional<BandRequest> bands = {};
  /// A joint is made anew for each design that has any: up to a second each.
  std::vector<SweepQuantities> quantities = {};
  SweepShare share = {};
  BestDesign best_by = BestDesign::largest_margin;
};

enum class SweepNoteCode : std::uint8_t {
  differs_from_closed_form,  ///< Meshes of the implant do not have the limits of its sizes: every limit is searched for.
  nothing_is_safe,     ///< No design leaves every target free.
  everything_is_safe,  ///< All designs are safe.
  zone_leaves_window,  ///< Designs at the border of what was swept are safe: the zone goes on beyond.
  separate_intervals,  ///< Along some line the safe designs are not side by side.
  last_value_left_out,  ///< No whole number of steps leads to the last value of a parameter: the sweep ends before it.
  best_is_shared,  ///< Several designs are equally good: what ends them all, and which of them is called best.
  value_is_swept,  ///< A swept parameter has another value than the joint's description: it is that of the joint as it is only.
};

/// Those that are known before any design is: all shares of a sweep have them.
inline constexpr SweepNoteCode all_request_notes[] = {SweepNoteCode::differs_from_closed_form,
                                                      SweepNoteCode::last_value_left_out,
                                                      SweepNoteCode::value_is_swept};

/// As in files: "nothing_is_safe".
[[nodiscard]] std::string_view name_of(SweepNoteCode code) noexcept;

struct SweepNote {
  SweepNoteCode code;
  std::string text;  ///< one sentence
};

/// The limits of all designs of a share, and where they are safe.
struct SweepAnswer {
  std::vector<plan::SweptParameter> parameters;
  std::vector<plan::SweepTarget> targets;
  std::vector<plan::EndingPair> pairs;
  SweepShare share;
  std::size_t first_design = 0;                ///< of the share
  std::vector<plan::DesignLimit> limits = {};  ///< of each design one per target
  /// One per design: the least of what its limits have over the targets' reach; safe where >= 0, NaN if in contact in its reference pose.
  std::vector<double> margin_deg = {};
  std::optional<motion::BandOptions> band_options = {};  ///< of the probabilities if requested
  std::vector<double> probability = {};                  ///< of each design if requested, 0 to 1
  std::vector<std::string> quantity_names = {};
  std::vector<double> quantities = {};  ///< of each design one per name; NaN where there is none
  std::vector<double> quantities_here = {};
  std::vector<plan::SafeInterval> safe = {};  ///< ascending by line and value
  /// Measures of what is safe, by the trapezoidal rule over the lines, and of the whole window; a share has its lines' part. In the product of
  /// the parameters' units.
  double safe_measure = 0, window_measure = 0;
  BestDesign best_by = BestDesign::largest_margin;
  /// The best design; of equals the one with most steps to the next design that is not safe or not in the sweep, then the one
  /// with fewest steps from the joint as it is, then the first. Empty if all are in contact.
  std::optional<std::size_t> best = {};
  std::vector<double> here = {};                    ///< the values that the joint has of the swept parameters
  std::vector<plan::DesignLimit> limits_here = {};  ///< one per target
  std::vector<SweepNote> notes = {};
  std::vector<RangeNote> limit_notes =
      {};  ///< what limits of the joint as it is must be read with, as those of answer_range()
  std::vector<std::string> caveats = {};

  [[nodiscard]] std::size_t designs() const noexcept { return margin_deg.size(); }
  /// The values of a design, counted from the first of the whole sweep.
  [[nodiscard]] std::vector<double> values_of(std::size_t design) const;
};

/// Designs of all axes together.
[[nodiscard]] std::size_t designs_of(std::span<const plan::SweptParameter> parameters);

/// Throws UsageError for what answer_sweep() would refuse before it computes anything: no target or parameter, more than four of these,
/// values outside of a parameter's range, a reach beyond its motion's range, a tilt of what is no hip, a size.
void check_sweep(const Case& joint, const SweepRequest& request);

/// Limits of every design of the share. Empty if it was stopped. Stages: "designs", "borders", "displaced designs",
/// "joints of designs".
///
/// Throws UsageError as check_sweep(), MeshError if nothing of a body could end a motion. Designs of an implant whose bones do not move cost
/// some microseconds a target; where the meshes decide, a millisecond a target and pair of meshes.
[[nodiscard]] std::optional<SweepAnswer> answer_sweep(const Case& joint, const SweepRequest& request,
                                                      const Control& control);
[[nodiscard]] SweepAnswer answer_sweep(const Case& joint, const SweepRequest& request);

/// The shares of one sweep, all of them in their order, as one: the answer of the sweep that was not shared. Throws UsageError if one does not
/// follow the one before.
[[nodiscard]] SweepAnswer merged_sweep(std::span<const SweepAnswer> shares);

}  // namespace condyle
