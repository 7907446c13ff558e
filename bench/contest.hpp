#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "table.hpp"

/// One question to Condyle and to others, each asked in turn with it, and what each of them answered wrongly.

namespace bench {

/// Wrong answers among those that were asked for.
struct Wrong {
  std::int64_t missed = 0, invented = 0;
  std::int64_t off = 0;  ///< There, but not as much as it says.
  std::int64_t of = 0;   ///< In truth: 0 missed of 0 says nothing.

  std::int64_t all() const { return missed + invented + off; }
};

/// A question made ready.
struct Ready {
  std::function<void()> ask;     ///< At all poses of the contest, once; the answers are kept.
  std::function<Wrong()> count;  ///< Counts the wrong answers of the last `ask`.
};

struct Contestant {
  std::string name;   ///< For files: "fcl_obbrss".
  std::string title;  ///< For people.
  std::function<Ready()> make;
};

struct Result {
  std::string name, title;
  double making_seconds = 0;
  double seconds = 0;       ///< The time for all poses together, in one thread.
  double ours_seconds = 0;  ///< Condyle's, in turn with it.
  Wrong wrong;
  std::string failure;  ///< Why it has no answers; empty where it has.

  /// How many times longer it takes than Condyle.
  double ratio() const { return seconds / ours_seconds; }
};

struct Contest {
  std::string name;     ///< In the names of ratios: "inside".
  std::string title;    ///< "which vertices are inside"
  std::string counted;  ///< What is missed or invented: "vertices".
  std::size_t asked = 0;
  std::vector<Result> results;  ///< Condyle's first, the others from the fastest on, those that fail last.
};

/// Fills in the results. Whoever throws stays there, with the reason. `seconds` is how long one of the others may be timed
/// for, all rounds together; one that takes longer is timed once.
void hold(Contest& contest, const Contestant& ours, const std::vector<Contestant>& others, double seconds);

/// A row of the table of all contests, rows of each contestant, and the ratios, as name/scene/contestant.
void report_contest(const Contest& contest, const std::string& scene, Report& report);

}  // namespace bench
