#include "condyle/answer/measures.hpp"

namespace condyle {

std::optional<MeasureAnswer> answer_measures(const Case& of, const MeasureRequest& request,
                                             const Control& control) {
  const measure::MeasureOptions options = of.measure_options(request.pelvic_tilt);
  MeasureAnswer answer{.measures = measure::measure_hip(of.joint, options)};
  if (!request.bands) return answer;
  answer.band_options = band_options(of, *request.bands);
  auto bands = measure::measure_bands(of.joint, options, answer.band_options, control);
  if (!bands) return std::nullopt;
  answer.bands = std::move(*bands);
  return answer;
}

MeasureAnswer answer_measures(const Case& joint, const MeasureRequest& request) {
  return *answer_measures(joint, request, {});
}

}  // namespace condyle
