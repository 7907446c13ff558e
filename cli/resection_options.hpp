#pragma once

#include <CLI/App.hpp>
#include <cstddef>
#include <optional>
#include <string>

#include "condyle/answer/resection.hpp"
#include "help_formatter.hpp"

/// Options on the bone that must go, shared by the commands that plan it.

namespace condyle::cli {

struct ResectionArguments {
  std::string targets;  ///< "flexion=115 fadir=30"; empty: nothing is planned
  std::string from = "mobile";
  std::optional<double> share, deepest_mm, within_mm, burr_mm, margin_mm, confidence;
  double edge_mm = plan::ResectionOptions{}.edge_mm;
};

/// Adds the options of a cut. `targets` is the option that asks for one, which these need. `given` is written while arguments are
/// read.
void add_cut(CLI::App& command, ResectionArguments& given, CLI::Option* targets);
/// --confidence, of commands that displace joints.
CLI::Option* add_confidence(CLI::App& command, ResectionArguments& given);
/// What it says, empty where the margin is given. Throws UsageError without varied joints.
std::optional<double> confidence_of(const ResectionArguments& given, const std::optional<BandRequest>& bands);
/// --curve.
CLI::Option* add_curve(CLI::App& command, std::size_t& points);
/// Their group in the help, where limits are the command's question.
HelpGroup resection_group();

/// The given options, without the targets, marked vertices and the rules of the limits. Throws UsageError.
plan::ResectionOptions resection_request_of(const ResectionArguments& given);

}  // namespace condyle::cli
