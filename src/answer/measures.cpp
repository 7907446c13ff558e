#include "answer/staged.hpp"
#include "condyle/answer.hpp"

namespace condyle {

std::optional<MeasureAnswer> answer_measures(const Joint& joint, const MeasureQuery& query,
                                             const AnswerControl& control) {
  MeasureAnswer answer{.measures = measure::measure_hip(joint, query.measures)};
  if (!query.bands) return answer;
  answer.band_options = *query.bands;
  auto bands = measure::measure_bands(joint, query.measures, *query.bands,
                                      answer::staged(control, "joints of the band"));
  if (!bands) return std::nullopt;
  answer.bands = std::move(*bands);
  return answer;
}

MeasureAnswer answer_measures(const Joint& joint, const MeasureQuery& query) {
  return *answer_measures(joint, query, {});
}

}  // namespace condyle
