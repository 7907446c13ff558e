#pragma once

#include <optional>
#include <vector>

#include "condyle/answer/case.hpp"
#include "condyle/hip_measures.hpp"
#include "condyle/limit_band.hpp"

/// The shape of a hip.

namespace condyle {

/// Options of a request for the shape of a hip, with their defaults.
struct MeasureRequest {
  Angle pelvic_tilt = {};  ///< positive: top forwards, from the frame that the case states
  std::optional<BandRequest> bands = {};
};

/// The measures of a hip, and how far they are certain.
struct MeasureAnswer {
  measure::HipMeasures measures = {};
  /// In the order of measure_definitions() if requested, else none.
  std::vector<measure::MeasureBand> bands = {};
  motion::BandOptions band_options = {};  ///< of the bands
};

/// Measures, and their bands if requested. Empty if it was stopped. Stage: "joints of the band".
///
/// Throws UsageError as measure_hip() and measure_bands() do, and costs what they cost.
[[nodiscard]] std::optional<MeasureAnswer> answer_measures(const Case& joint, const MeasureRequest& request,
                                                           const Control& control);
[[nodiscard]] MeasureAnswer answer_measures(const Case& joint, const MeasureRequest& request = {});

}  // namespace condyle
