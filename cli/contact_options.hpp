#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "condyle/io/contact_entry.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/load_balance.hpp"

namespace CLI {
class App;
}

/// Options on surfaces in contact and loads, shared by the commands that answer with them.

namespace condyle::cli {

/// Each where it was given takes the place of what the joint file says.
struct ContactOptions {
  std::optional<Casting> casting;
  std::optional<FaceRule> rule;
  std::optional<double> reach_mm;
  std::optional<PressureLaw> law;
  std::vector<double> e, nu, thickness;  ///< one for both layers, or one of each: fixed, mobile

  bool any_of_rays() const noexcept { return casting || rule || reach_mm; }
};
/// `when` begins each line of help, where rays are not all that the command knows.
void add_rays(CLI::App& command, const std::shared_ptr<ContactOptions>& options,
              const std::string& when = "");
void add_layers(CLI::App& command, const std::shared_ptr<ContactOptions>& options);

/// What the joint file says with what was given. With pressure UsageError where no body has a layer or one misses a value.
ContactEntry contact_of(const ContactOptions& options, const JointFile& file, bool with_pressure);

struct BalanceGiven {
  std::vector<double> force, moment, along;
  BodyRole frame = BodyRole::fixed;
  bool rotations = false;
  bool any() const noexcept { return !force.empty() || !moment.empty(); }
};
void add_balance(CLI::App& command, const std::shared_ptr<BalanceGiven>& given);
Load load_of(const BalanceGiven& given);
BalanceOptions balance_options_of(const BalanceGiven& given);

}  // namespace condyle::cli
