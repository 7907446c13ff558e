#include "io/sweep/load_quantities.hpp"

#include <limits>

#include "io/file/input_recorder.hpp"
#include "io/study/study_load.hpp"

namespace condyle::io {

SweepQuantities load_quantities(const LoadedJoint& loaded, const StudyLoad& load) {
  study_contact_of(loaded, load.contact);
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return {{"load_max_pressure_mpa", "load_mean_pressure_mpa", "load_area_mm2"},
          [loaded, load, read = InputRecorder::current()](const Joint& joint) -> std::vector<double> {
            const Recording in_whatever_thread(read);
            const LoadAnswer answer = study_load_answer({joint, loaded.report}, load).answer;
            const auto& surface = answer.contact.mobile ? answer.contact.mobile : answer.contact.fixed;
            if (!answer.carries_load() || !surface) return {none, none, none};
            const contact::ContactTotals& totals = surface->totals;
            const bool any = totals.triangles > 0;
            return {any ? totals.max_pressure_mpa : 0, any ? totals.mean_pressure_mpa : 0, totals.area_mm2};
          }};
}

}  // namespace condyle::io
