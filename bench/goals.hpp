#pragma once

#include <string>

#include "experiment.hpp"
#include "table.hpp"

/// Goals of the library, beside the results of this run.

namespace bench {

/// Whether the measured value is to be at least the goal, or at most.
enum class Bound { at_least, at_most };

struct Goal {
  std::string what;  ///< "every vertex: times faster than Embree, robust"
  std::string scene;
  Bound bound;
  double value;
  std::string unit;  ///< "times", "ns per triangle"
};

/// One row of the table `goals`.
void add_goal(const Goal& goal, double measured, Report& report);

/// Whether there is a goal for Condyle against this method, at the mean over all poses of the scene.
bool has_goal_at_all_poses(Question question, std::string_view scene, std::string_view method);

/// All goals that compare outcomes of the experiment.
void add_goals(const ExperimentResult& result, Report& report);

}  // namespace bench
