#include "contest.hpp"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <exception>
#include <optional>
#include <stdexcept>

#include "timing.hpp"

namespace bench {
namespace {

const TableHead first_head = {
    "beside_others",
    "Condyle beside the fastest of the others, and beside the fastest that answers nothing "
    "wrongly; ms of processor time a question, one thread, made ready before",
    {{"question", "question"},
     {"asked", "asked"},
     {"condyle_ms", "Condyle, ms"},
     {"condyle_wrong", "wrong"},
     {"fastest", "fastest other"},
     {"fastest_ms", "ms"},
     {"fastest_ratio", "times Condyle's"},
     {"fastest_wrong", "wrong"},
     {"right", "fastest without a wrong answer"},
     {"right_ms", "ms"},
     {"right_ratio", "times Condyle's"}}};

const TableHead all_head = {"beside_others_all",
                            "Every method that answers, at the same poses",
                            {{"question", "question"},
                             {"method", "method"},
                             {"making_ms", "made ready, ms"},
                             {"ms", "ms a question"},
                             {"ratio", "times Condyle's"},
                             {"missed", "missed"},
                             {"invented", "invented"},
                             {"off", "off"},
                             {"of", "of"}}};

/// A contestant in the middle of a contest.
struct Playing {
  Result result;
  std::optional<Ready> ready;
};

/// Calls it; where it throws, the result says why, and is not asked again.
template <class Do>
void guarded(Playing& playing, const Do& what) {
  if (!playing.result.failure.empty()) return;
  try {
    what();
  } catch (const std::exception& error) {
    playing.result.failure = error.what();
  }
}

Playing made(const Contestant& contestant) {
  Playing playing{{.name = contestant.name, .title = contestant.title, .wrong = {}, .failure = {}}, {}};
  guarded(playing,
          [&] { playing.result.making_seconds = seconds_of([&] { playing.ready = contestant.make(); }); });
  return playing;
}

/// Both in turn, so that whatever slows the machine down slows both.
void time_in_turn(const Repeated& ours, Playing& theirs, double seconds) {
  constexpr double short_seconds = 5e-3;
  constexpr int most_rounds = 5;
  const double first = seconds_of(theirs.ready->ask);
  std::optional<Repeated> repeated;
  if (first < short_seconds) repeated.emplace(theirs.ready->ask);
  std::vector<double> our_samples, their_samples;
  const bool is_slow = first * 2 > seconds;
  const int rounds = std::clamp(static_cast<int>(seconds / first), 1, most_rounds);
  for (int round = 0; round < rounds; ++round) {
    our_samples.push_back(seconds_of(ours) / ours.times);
    their_samples.push_back(is_slow    ? first
                            : repeated ? seconds_of(*repeated) / repeated->times
                                       : seconds_of(theirs.ready->ask));
  }
  theirs.result.seconds = median(their_samples);
  theirs.result.ours_seconds = median(our_samples);
}

std::string share(const Wrong& wrong, const std::string& counted) {
  return fmt::format("{} of {} {}", wrong.all(), wrong.of, counted);
}

double ms_a_question(const Contest& contest, double seconds) {
  return seconds * 1e3 / static_cast<double>(contest.asked);
}

}  // namespace

void hold(Contest& contest, const Contestant& ours, const std::vector<Contestant>& others, double seconds) {
  tbb::task_arena(1).execute([&] {
    Playing condyle = made(ours);
    if (!condyle.ready) throw std::runtime_error(contest.name + ": " + condyle.result.failure);
    const Repeated asked(condyle.ready->ask);
    std::vector<Playing> playing;
    for (const Contestant& other : others) {
      playing.push_back(made(other));
      guarded(playing.back(), [&] { time_in_turn(asked, playing.back(), seconds); });
    }
    std::vector<double> samples;
    for (int round = 0; round < 3; ++round) samples.push_back(seconds_of(asked) / asked.times);
    condyle.result.seconds = condyle.result.ours_seconds = median(samples);
    condyle.result.wrong = condyle.ready->count();
    // Counted when all have answered: where the truth is what somebody found and exact predicates confirm, all of them help.
    for (Playing& other : playing) guarded(other, [&] { other.result.wrong = other.ready->count(); });
    std::stable_sort(playing.begin(), playing.end(), [](const Playing& a, const Playing& b) {
      const bool a_fails = !a.result.failure.empty(), b_fails = !b.result.failure.empty();
      return a_fails != b_fails ? b_fails : !a_fails && a.result.ratio() < b.result.ratio();
    });
    contest.results = {std::move(condyle.result)};
    for (Playing& other : playing) contest.results.push_back(std::move(other.result));
  });
}

void report_contest(const Contest& contest, const std::string& scene, Report& report) {
  const Result& ours = contest.results.front();
  const Result *fastest = nullptr, *right = nullptr;
  for (const Result& result : contest.results) {
    Table& all = report.table(all_head);
    if (!result.failure.empty()) {
      const std::string none = "-";
      all.add({contest.name, result.title + ", fails: " + result.failure, none, none, none, none, none, none,
               none});
      continue;
    }
    all.add({contest.name, result.title, result.making_seconds * 1e3, ms_a_question(contest, result.seconds),
             result.ratio(), result.wrong.missed, result.wrong.invented, result.wrong.off, result.wrong.of});
    if (&result == &ours) continue;
    report.ratios[fmt::format("{}/{}/{}", contest.name, scene, result.name)] = result.ratio();
    if (!fastest) fastest = &result;
    if (!right && result.wrong.all() == 0) right = &result;
  }
  if (ours.wrong.all() > 0)
    report.disagreements.push_back(fmt::format("{}/{}/{}: {} wrong", contest.name, scene, ours.name,
                                               share(ours.wrong, contest.counted)));
  std::vector<Cell> row = {contest.title, static_cast<std::int64_t>(contest.asked),
                           ms_a_question(contest, ours.seconds), share(ours.wrong, contest.counted)};
  const auto add = [&](const Result* other) {
    const std::string none = "none";
    row.insert(row.end(), {other ? Cell(other->title) : Cell(none),
                           other ? Cell(ms_a_question(contest, other->seconds)) : Cell(none),
                           other ? Cell(other->ratio()) : Cell(none)});
  };
  add(fastest);
  row.emplace_back(fastest ? share(fastest->wrong, contest.counted) : "none");
  add(right);
  report.table(first_head).add(std::move(row));
}

}  // namespace bench
