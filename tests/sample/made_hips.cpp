#include "sample/made_hips.hpp"

#include <algorithm>
#include <list>

namespace condyle::test {

const sample::SampleHip& made_hip(sample::Scenario scenario, const sample::HipParameters& parameters) {
  struct Made {
    sample::Scenario scenario;
    sample::HipParameters parameters;
    sample::SampleHip hip;
  };
  static std::list<Made> made;  // references stay good as it grows
  const auto found = std::find_if(made.begin(), made.end(), [&](const Made& other) {
    return other.scenario == scenario && other.parameters == parameters;
  });
  if (found != made.end()) return found->hip;
  return made.emplace_back(Made{scenario, parameters, sample::sample_hip(parameters, scenario)}).hip;
}

}  // namespace condyle::test
