#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "accuracy.hpp"
#include "method.hpp"
#include "scenes.hpp"

/// The experiment: every method asked every question it can answer, at the poses of a scene, timed and held
/// against the exact answers.

namespace bench {

enum class Question { touch, pairs, inside };

std::string_view name_of(Question question);

/// How long one method may take over one question at one scene.
struct Budget {
  /// For all timed rounds together: decides at how many poses the slow are asked, at least 4, and in how many
  /// rounds, at least one.
  double seconds = 0.15;
  int rounds = 5;
  int frames = 6;  ///< Shapes of the deforming variant: gone through once, then `rounds` times that count.
  /// A method that was made ready for longer than this at a scene is not asked at larger ones of the family.
  double build_seconds = 20;
  /// One without an update that is made ready for longer than this is not made anew for the deforming
  /// variant.
  double remake_seconds = 0.5;
  bool with_slow_ones = true;  ///< Those that say of themselves that they are slow to make.

  static Budget quick() {
    return {.seconds = 0.04,
            .rounds = 1,
            .frames = 2,
            .build_seconds = 2,
            .remake_seconds = 0.2,
            .with_slow_ones = false};
  }
};

/// Processor seconds of this thread per pose: the median over rounds for each pose.
struct PoseTimes {
  double mean = 0, p50 = 0, p95 = 0;  ///< Over poses.
  double spread = 0;  ///< Half the range between the quartiles of the rounds, over their median.
};

/// One method, one question, one scene.
struct Outcome {
  std::string scene, method;
  Question question;
  bool is_deformed = false;  ///< At each pose the fixed body was another.
  std::size_t fixed_triangles = 0, mobile_vertices = 0;
  std::size_t poses = 0;
  PoseTimes query;
  double cold_seconds = 0;  ///< Mean per pose, all caches emptied before; 0 where not taken.
  double ours_seconds = 0;  ///< Mean per pose of Condyle's answer at the same poses, in turn with it.
  /// Only for `touch`: their time over Condyle's at the poses without and with a contact; 0 where there is
  /// none.
  double free_ratio = 0, touching_ratio = 0;
  double build_seconds = 0;  ///< Made ready once.
  /// Following and one answer after the first deformation, and following later ones of a motion that was followed before; of
  /// `is_deformed` only.
  std::optional<double> first_step_seconds, update_seconds;
  std::optional<double> thread_speed_up;  ///< Poses a second with all threads over one; where it can.
  std::size_t bytes = 0;
  std::optional<InsideAccuracy> inside;
  std::optional<TouchAccuracy> touch;
  std::optional<PairAccuracy> pairs;
  Work work;  ///< Per pose asked once.
};

/// Which are asked: those with every one of the words, parted by commas, in "question/scene/method".
struct ExperimentFilter {
  std::string text;
  bool takes(Question question, std::string_view scene, std::string_view method) const;
};

struct ExperimentResult {
  std::vector<Outcome> outcomes;
  std::vector<std::string> skipped;
  /// Methods that must be exact and are not.
  std::vector<std::string> disagreements;
  /// By method and family of scenes.
  std::map<std::pair<std::string, std::string>, double> longest_build_seconds;
};

/// Adds what was found at this scene.
void run_experiment(const SceneName& name, const Scene& scene, const ExperimentFilter& filter,
                    const Budget& budget, ExperimentResult& result);

}  // namespace bench
