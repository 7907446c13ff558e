#include "experiment.hpp"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <map>
#include <numeric>

#include "goals.hpp"
#include "timing.hpp"

namespace bench {
namespace {

using condyle::Pose;

/// Where all threads are timed too.
constexpr std::array<std::string_view, 2> thread_scenes = {"libhip_3", "libhip_4"};

/// Where methods that say of themselves that they are slow to make are asked: the paper's scenarios.
bool is_papers_own(std::string_view scene) {
  return scene.starts_with("sample_");
}

/// At the finest scene only the fastest of each kind are asked.
constexpr std::array<std::string_view, 5> finest_methods = {"radial", "trees", "embree_16_robust",
                                                            "embree_16_culled", "fcl_obbrss"};

constexpr Question questions[] = {Question::touch, Question::pairs, Question::inside};

bool answers(const MethodKind& kind, Question question) {
  switch (question) {
    case Question::touch:
      return kind.answers.touch;
    case Question::pairs:
      return kind.answers.pairs;
    case Question::inside:
      return kind.answers.inside;
  }
  return false;
}

/// One method with room for its answers.
struct Asked {
  explicit Asked(std::unique_ptr<Method> ready = nullptr) : method(std::move(ready)) {}

  std::unique_ptr<Method> method;
  bool touches = false;
  std::vector<condyle::contact::TrianglePair> pairs;
  std::vector<InsideVertex> inside;

  void ask(Question question, const Pose& X_FM) {
    switch (question) {
      case Question::touch:
        touches = method->touch(X_FM);
        break;
      case Question::pairs:
        method->find_pairs(X_FM, pairs);
        break;
      case Question::inside:
        method->find_inside(X_FM, inside);
        break;
    }
  }
};

/// A scene as the methods meet it, with what is true there.
class Stage {
 public:
  Stage(std::string_view scene_name, const Scene& scene)
      : name(scene_name), bodies{scene.joint.fixed.mesh, scene.joint.mobile.mesh} {
    for (const ScenePose& pose : scene.poses) poses.push_back(pose.X_FM);
    reference = std::make_unique<Reference>(bodies, poses);
  }

  /// The fixed body of a frame, and the truth there.
  struct Frame {
    condyle::TriMesh fixed;
    std::unique_ptr<Reference> reference;
  };
  Frame& frame(int number) {
    const auto [at, is_new] = frames_.try_emplace(number);
    if (is_new) {
      at->second.fixed = {deformed(bodies.fixed.vertices, number), bodies.fixed.triangles};
      at->second.reference = std::make_unique<Reference>(Bodies{at->second.fixed, bodies.mobile}, poses);
    }
    return at->second;
  }

  std::string_view name;
  Bodies bodies;
  std::vector<Pose> poses;
  std::unique_ptr<Reference> reference;

 private:
  std::map<int, Frame> frames_;
};

void compare(Asked& asked, const MethodKind& kind, Question question, Reference& reference, std::size_t pose,
             Outcome& outcome) {
  switch (question) {
    case Question::touch:
      if (!outcome.touch) outcome.touch.emplace();
      bench::compare(asked.touches, reference, pose, *outcome.touch);
      break;
    case Question::pairs:
      if (!outcome.pairs) outcome.pairs.emplace();
      bench::compare(asked.pairs, reference, pose, *outcome.pairs);
      break;
    case Question::inside:
      if (!outcome.inside) outcome.inside.emplace();
      bench::compare(asked.inside, reference, pose, kind.depth, *outcome.inside);
      break;
  }
}

bool agrees(const Outcome& outcome) {
  return (!outcome.touch || outcome.touch->agrees()) && (!outcome.pairs || outcome.pairs->agrees()) &&
         (!outcome.inside || outcome.inside->agrees());
}

/// At how many of the scene's poses a method is asked that takes this long.
std::size_t affordable_poses(double seconds_per_pose, const Budget& budget, std::size_t all) {
  const double affordable = budget.seconds / (budget.rounds * std::max(seconds_per_pose, 1e-9));
  std::size_t poses = all;
  while (poses > 4 && static_cast<double>(poses) > affordable) poses /= 2;
  return std::min(poses, all);
}

/// In how many rounds one is timed that takes this long at so many poses: fewer where even those are dear.
int affordable_rounds(double seconds_per_pose, std::size_t poses, const Budget& budget) {
  const double once = std::max(seconds_per_pose * static_cast<double>(poses), 1e-9);
  return std::clamp(static_cast<int>(budget.seconds / once), 1, budget.rounds);
}

double quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1) + 0.5)];
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// rounds[r][p]: seconds of pose p in round r. Returns the median round of each pose.
std::vector<double> median_round(const std::vector<std::vector<double>>& rounds) {
  std::vector<double> per_pose;
  for (std::size_t p = 0; p < rounds.front().size(); ++p) {
    std::vector<double> samples;
    for (const auto& round : rounds) samples.push_back(round[p]);
    per_pose.push_back(median(samples));
  }
  return per_pose;
}

PoseTimes summary(const std::vector<std::vector<double>>& rounds) {
  const std::vector<double> per_pose = median_round(rounds);
  std::vector<double> per_round;
  for (const auto& round : rounds) per_round.push_back(mean(round));
  return {mean(per_pose), quantile(per_pose, 0.5), quantile(per_pose, 0.95),
          (quantile(per_round, 0.75) - quantile(per_round, 0.25)) / (2 * median(per_round))};
}

/// Work of the calling thread without others, whatever parallel loops it meets.
template <class Do>
void alone(const Do& what) {
  tbb::task_arena(1).execute(what);
}

/// Seconds of each of the first poses, warm: where they are so quick together that what the method before
/// left behind would be felt, in the caches and in what the processor predicts of branches, all poses are
/// gone through untimed for as long as it takes to be rid of that. All: a few, again and again, it would come
/// to know by heart. Then only the clock on the wall is read: the system's call for the processor's would be
/// felt as well.
std::vector<double> sweep(Asked& asked, Question question, const std::vector<Pose>& poses,
                          std::size_t count) {
  constexpr double quick_seconds = 5e-3;
  std::vector<double> seconds(poses.size());
  const auto go_through = [&](std::size_t end, const auto& seconds_of_pose) {
    for (std::size_t p = 0; p < end; ++p)
      seconds[p] = seconds_of_pose([&] { asked.ask(question, poses[p]); });
    return std::accumulate(seconds.begin(), seconds.begin() + static_cast<std::ptrdiff_t>(end), 0.0);
  };
  const auto exactly = [](const auto& ask) { return seconds_of(ask); };
  const auto quickly = [](const auto& ask) { return wall_seconds_of(ask); };
  alone([&] {
    double spent = go_through(count, exactly);
    if (spent >= quick_seconds) return;
    while (spent < quick_seconds) spent += go_through(poses.size(), quickly);
    go_through(count, quickly);
  });
  seconds.resize(count);
  return seconds;
}

double cold_sweep(Asked& asked, Question question, const std::vector<Pose>& poses, std::size_t count) {
  std::vector<double> seconds(count);
  alone([&] {
    for (std::size_t p = 0; p < count; ++p) {
      empty_caches();
      seconds[p] = seconds_of([&] { asked.ask(question, poses[p]); });
    }
  });
  return mean(seconds);
}

std::optional<double> thread_speed_up(Asked& asked, Question question, const std::vector<Pose>& poses,
                                      std::size_t count) {
  constexpr double least_seconds = 0.05;
  if (!asked.method->for_another_thread()) return std::nullopt;
  tbb::enumerable_thread_specific<Asked> per_thread(
      [&] { return Asked{asked.method->for_another_thread()}; });
  const auto all = [&](std::size_t repeats) {
    tbb::parallel_for(std::size_t{0}, count * repeats,
                      [&](std::size_t i) { per_thread.local().ask(question, poses[i % count]); });
  };
  const auto wall = [&](std::size_t repeats) {
    const Stopwatch watch;
    all(repeats);
    return watch.wall_seconds();
  };
  all(1);
  const auto repeats = static_cast<std::size_t>(std::ceil(least_seconds / std::max(wall(1), 1e-7)));
  std::vector<double> ratios;
  for (int round = 0; round < 3; ++round) {
    double one_thread = 0;
    alone([&] { one_thread = wall(repeats); });
    ratios.push_back(one_thread / wall(repeats));
  }
  return median(ratios);
}

Work per_pose(const Work& before, Work after, std::size_t asked) {
  for (std::size_t i = 0; i < after.size(); ++i) {
    const std::int64_t counted = after[i].second - (i < before.size() ? before[i].second : 0);
    after[i].second = counted / static_cast<std::int64_t>(std::max<std::size_t>(asked, 1));
  }
  return after;
}

/// Every kind that the filter takes at this scene, and Condyle's own to measure against.
class SceneRun {
 public:
  SceneRun(Stage& stage, const ExperimentFilter& filter, const Budget& budget, ExperimentResult& result)
      : stage_(stage), filter_(filter), budget_(budget), result_(result) {}

  /// Seconds that making ready took; 0 where nothing was asked.
  double run(const MethodKind& kind) {
    std::vector<Question> asked_for;
    for (const Question question : questions)
      if (answers(kind, question) && filter_.takes(question, stage_.name, kind.name))
        asked_for.push_back(question);
    if (asked_for.empty()) return 0;
    Asked asked;
    double build_seconds = 0;
    alone([&] { build_seconds = seconds_of([&] { asked.method = kind.make(stage_.bodies); }); });
    // A short one is done again: the first one also fetches the library's code.
    if (build_seconds < 0.2 && budget_.rounds > 1) {
      std::vector<double> builds;
      alone([&] {
        for (int i = 0; i < 3; ++i) builds.push_back(seconds_of([&] { kind.make(stage_.bodies); }));
      });
      build_seconds = median(builds);
    }
    for (const Question question : asked_for) {
      Outcome outcome = started(kind, question);
      outcome.build_seconds = build_seconds;
      measure(asked, kind, outcome);
      finish(kind, std::move(outcome));
    }
    if (!kind.answers.deforms && build_seconds > budget_.remake_seconds) {
      result_.skipped.push_back(
          fmt::format("{}/{}, deformed: made anew in {:.1f} s", stage_.name, kind.name, build_seconds));
      return build_seconds;
    }
    for (const Question question : asked_for) {
      Outcome outcome = started(kind, question);
      outcome.build_seconds = build_seconds;
      outcome.is_deformed = true;
      measure_deforming(asked, kind, outcome);
      finish(kind, std::move(outcome));
    }
    return build_seconds;
  }

 private:
  Outcome started(const MethodKind& kind, Question question) const {
    Outcome outcome;
    outcome.scene = stage_.name;
    outcome.method = kind.name;
    outcome.question = question;
    outcome.fixed_triangles = stage_.bodies.fixed.triangles.size();
    outcome.mobile_vertices = stage_.bodies.mobile.vertices.size();
    return outcome;
  }

  void finish(const MethodKind& kind, Outcome outcome) {
    if (kind.is_exact && !agrees(outcome))
      result_.disagreements.push_back(fmt::format("{}/{}/{}{}", name_of(outcome.question), outcome.scene,
                                                  kind.name, outcome.is_deformed ? ", deformed" : ""));
    result_.outcomes.push_back(std::move(outcome));
  }

  /// Condyle's first method that answers the question.
  Asked* ours(Question question) {
    const auto [at, is_new] = ours_.try_emplace(question);
    if (is_new) {
      for (const MethodGroup& group : method_groups())
        for (const MethodKind& kind : group.kinds)
          if (group.package.empty() && !at->second.method && answers(kind, question))
            at->second.method = kind.make(stage_.bodies);
    }
    return at->second.method ? &at->second : nullptr;
  }

  void measure(Asked& asked, const MethodKind& kind, Outcome& outcome) {
    const Question question = outcome.question;
    const double first =
        mean(sweep(asked, question, stage_.poses, std::min<std::size_t>(3, stage_.poses.size())));
    // The few that a slow method can afford may be deeper or farther off than the mean.
    const bool at_all_poses =
        budget_.rounds > 1 && has_goal_at_all_poses(question, stage_.name, outcome.method);
    const std::size_t all = stage_.poses.size();
    const std::size_t count = at_all_poses ? all : affordable_poses(first, budget_, all);
    outcome.poses = count;
    const Work before = asked.method->work();
    for (std::size_t p = 0; p < count; ++p) {
      asked.ask(question, stage_.poses[p]);
      compare(asked, kind, question, *stage_.reference, p, outcome);
    }
    outcome.work = per_pose(before, asked.method->work(), count);

    Asked* const condyle = ours(question);
    std::vector<std::vector<double>> rounds, our_rounds;
    constexpr int least_rounds = 3;
    const int affordable = affordable_rounds(first, count, budget_);
    const int round_count = at_all_poses ? std::max(affordable, least_rounds) : affordable;
    for (int round = 0; round < round_count; ++round) {
      if (condyle) our_rounds.push_back(sweep(*condyle, question, stage_.poses, count));
      rounds.push_back(sweep(asked, question, stage_.poses, count));
    }
    outcome.query = summary(rounds);
    if (condyle) {
      outcome.ours_seconds = summary(our_rounds).mean;
      if (question == Question::touch)
        split_by_contact(median_round(rounds), median_round(our_rounds), outcome);
    }
    outcome.bytes = asked.method->bytes();
    if (budget_.rounds == 1) return;
    outcome.cold_seconds = cold_sweep(asked, question, stage_.poses, std::min<std::size_t>(count, 3));
    if (std::find(thread_scenes.begin(), thread_scenes.end(), stage_.name) != thread_scenes.end())
      outcome.thread_speed_up = thread_speed_up(asked, question, stage_.poses, count);
  }

  void split_by_contact(const std::vector<double>& theirs, const std::vector<double>& ours,
                        Outcome& outcome) {
    double free[2] = {0, 0}, touching[2] = {0, 0};
    for (std::size_t p = 0; p < theirs.size(); ++p) {
      double* const sums = stage_.reference->pairs(p).empty() ? free : touching;
      sums[0] += theirs[p], sums[1] += ours[p];
    }
    if (free[1] > 0) outcome.free_ratio = free[0] / free[1];
    if (touching[1] > 0) outcome.touching_ratio = touching[0] / touching[1];
  }

  /// Frame by frame: the body moves, then one pose is asked. What a method makes for the first deformation, and for places where
  /// vertices have not been, it has after going through all frames once; what counts comes then.
  void measure_deforming(Asked& asked, const MethodKind& kind, Outcome& outcome) {
    const Question question = outcome.question;
    const int frames = outcome.build_seconds * budget_.frames > budget_.seconds ? 2 : budget_.frames;
    std::vector<double> updates, queries;
    const auto step = [&](int f) {
      Stage::Frame& frame = stage_.frame(f);
      const auto pose = static_cast<std::size_t>(f);
      double update = 0, query = 0;
      alone([&] {
        update = seconds_of([&] {
          if (kind.answers.deforms)
            asked.method->deform(frame.fixed.vertices);
          else
            asked.method = kind.make({frame.fixed, stage_.bodies.mobile});
        });
        query = seconds_of([&] { asked.ask(question, stage_.poses[pose]); });
      });
      updates.push_back(update), queries.push_back(query);
      compare(asked, kind, question, *frame.reference, pose, outcome);
    };
    for (int f = 0; f < frames; ++f) step(f);
    outcome.first_step_seconds = updates.front() + queries.front();
    updates.clear(), queries.clear();
    for (int round = 0; round < (frames > 2 ? budget_.rounds : 1); ++round)
      for (int f = 0; f < frames; ++f) step(f);
    outcome.poses = static_cast<std::size_t>(frames);
    outcome.update_seconds = median(updates);
    outcome.query = summary({queries});
    outcome.bytes = asked.method->bytes();
  }

  Stage& stage_;
  const ExperimentFilter& filter_;
  const Budget& budget_;
  ExperimentResult& result_;
  std::map<Question, Asked> ours_;
};

}  // namespace

std::string_view name_of(Question question) {
  switch (question) {
    case Question::touch:
      return "touch";
    case Question::pairs:
      return "pairs";
    case Question::inside:
      return "inside";
  }
  return "";
}

bool ExperimentFilter::takes(Question question, std::string_view scene, std::string_view method) const {
  const std::string name = fmt::format("{}/{}/{}", name_of(question), scene, method);
  for (std::size_t first = 0; first <= text.size();) {
    const std::size_t end = std::min(text.find(',', first), text.size());
    if (name.find(text.substr(first, end - first)) == std::string::npos) return false;
    first = end + 1;
  }
  return true;
}

void run_experiment(const SceneName& name, const Scene& scene, const ExperimentFilter& filter,
                    const Budget& budget, ExperimentResult& result) {
  Stage stage(name.name, scene);
  SceneRun scene_run(stage, filter, budget, result);
  for (const MethodGroup& group : method_groups()) {
    for (const MethodKind& kind : group.kinds) {
      const auto skip = [&](std::string_view why) {
        result.skipped.push_back(fmt::format("{}/{}: {}", name.name, kind.name, why));
      };
      if (name.name == finest_scene &&
          std::find(finest_methods.begin(), finest_methods.end(), kind.name) == finest_methods.end())
        continue;
      if (scene.joint.fixed.mesh.triangles().size() + scene.joint.mobile.mesh.triangles().size() >
          kind.most_triangles) {
        skip(fmt::format("not asked above {} triangles", kind.most_triangles));
        continue;
      }
      if (kind.is_slow_to_make && !budget.with_slow_ones) {
        skip("takes seconds to be made ready: not in a quick run");
        continue;
      }
      if (kind.is_slow_to_make && !is_papers_own(name.name)) {
        skip("takes seconds to be made ready: at the paper's scenarios alone");
        continue;
      }
      double& longest = result.longest_build_seconds[{kind.name, std::string(name.family)}];
      if (longest > budget.build_seconds) {
        skip(fmt::format("made ready in {:.1f} s at a smaller one already", longest));
        continue;
      }
      try {
        longest = std::max(longest, scene_run.run(kind));
      } catch (const std::exception& error) {
        skip(error.what());
      }
    }
  }
}

}  // namespace bench
