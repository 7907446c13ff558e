#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "condyle/io/joint_file.hpp"
#include "condyle/io/study.hpp"
#include "condyle/pressure.hpp"

namespace CLI {
class App;
}

/// Options on surfaces in contact and loads, shared by the commands that answer with them.

namespace condyle::cli {

/// `when` begins each line of help, where rays are not all that the command knows.
void add_rays(CLI::App& command, io::ContactChanges& options, const std::string& when = "");
void add_layers(CLI::App& command, io::ContactChanges& options);

/// The joint file's entries with the given changes. With pressure UsageError if no body has a layer or one misses a
/// value.
io::ContactEntry contact_of(const io::ContactChanges& changes, const io::JointFile& file, bool with_pressure);

struct BalanceArguments {
  std::vector<double> force, moment, along;
  BodyRole frame = BodyRole::fixed;
  bool rotations = false, ligaments = false;
  bool any() const noexcept { return !force.empty() || !moment.empty(); }
};
/// --force, --force-frame and --along.
void add_force(CLI::App& command, BalanceArguments& given, const std::string& force_help);
void add_balance(CLI::App& command, BalanceArguments& given);
/// Directions of --along; UsageError for a count that is not whole directions.
std::vector<Vec3> directions_of(const std::vector<double>& along);

/// The load of many joints at one pose: its force and directions in components anterior, superior and lateral.
struct StudyLoadArguments {
  std::optional<std::string> pose;
  std::vector<double> force, along;
  io::ContactChanges contact;
  /// Whether anything but the pose is given.
  bool any_beside() const noexcept;
};
/// --force, --along and options on surfaces; `when` begins the help of the first.
void add_study_load(CLI::App& command, StudyLoadArguments& given, const std::string& when);
/// UsageError for directions without a force.
io::StudyLoad study_load_of(const StudyLoadArguments& given, Anatomy anatomy);
contact::Load load_of(const BalanceArguments& given);
/// UsageError for an option on a load where there is none.
void require_load(const BalanceArguments& given, bool has_load);
/// UsageError if the ligaments of a joint are to pull that has none.
contact::BalanceOptions balance_options_of(const BalanceArguments& given, const Joint& joint);

}  // namespace condyle::cli
