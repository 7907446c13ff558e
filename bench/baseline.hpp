#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiment.hpp"
#include "table.hpp"

/// Ratios of an earlier run, to see what got worse. Ratios, because they hold on other machines better than
/// times do.

namespace bench {

/// By "question/scene/method": how many times longer the method took than Condyle did in the same run. More
/// is better.
using Ratios = std::map<std::string, double>;

/// Prefix of the names of ratios of whole commands: how many times longer reading their meshes took than they did.
inline constexpr std::string_view command_ratios = "command/";

Ratios ratios_of(const ExperimentResult& result);

/// JSON, one ratio a line.
std::string baseline_text(const Ratios& ratios);

/// Raises std::runtime_error, naming the file, where it is no baseline.
Ratios read_baseline(const std::string& file);

/// One line for each ratio in both that is now below `tolerated` of what it was, the worst first: by
/// default those where Condyle got a quarter slower, or more, beside the other. A whole command may lose a tenth at most.
std::vector<std::string> worse_than(const Ratios& baseline, const Ratios& now, double tolerated = 0.8);

/// The ratios of every stored run that a reader follows over time.
std::span<const std::string_view> main_ratios();

/// Adds a run to a file of stored runs: date, commit, processor, load, and those of the main ratios that it has. Raises
/// std::runtime_error, naming the file, where it is none.
void add_run(const std::string& file, const Report& report, const Ratios& ratios);

}  // namespace bench
