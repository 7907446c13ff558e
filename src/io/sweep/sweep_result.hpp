#pragma once

#include <span>
#include <string>
#include <vector>

#include "condyle/answer.hpp"
#include "condyle/io/provenance.hpp"
#include "condyle/joint_checks.hpp"
#include "io/result/json.hpp"

/// Results of `condyle sweep`. Every key, column, unit and sign is in docs/sweeps.md.

namespace condyle::io {

/// A sweep and what it must be read with.
struct SweepResult {
  std::string joint;
  Anatomy anatomy = Anatomy::hip;
  Side side = Side::right;
  std::string scope;
  SweepAnswer answer;
  std::vector<std::string> units = {};  ///< of each parameter: "deg" or "mm"
  Json notes = Json::array();           ///< on the joint's set-up
  Json provenance = nullptr;
};

SweepResult sweep_result_of(const LoadedJoint& loaded, SweepAnswer answer, std::span<const JointNote> notes,
                            const Provenance* from);

std::string sweep_text(const SweepResult& result);
std::string sweep_json(const SweepResult& result);
/// A row for each design: its values, its margin, and where each target ends.
std::string designs_csv(const SweepResult& result);
/// A row for each safe interval along the last parameter.
std::string safe_csv(const SweepResult& result);

/// sweep_json() before it is text.
Json sweep_object(const SweepResult& result);

/// Contents of sweep.json, designs.csv and safe.csv of a share; errors call the folder `name`. Raises FileError.
SweepResult read_sweep_result(const Json& json, std::string_view designs, std::string_view safe,
                              std::string_view name);

}  // namespace condyle::io
