#pragma once

#include <optional>
#include <vector>

#include "condyle/io/contact_entry.hpp"

namespace condyle {

/// Values that replace a joint file's entries for its surfaces in contact; only those given replace.
struct ContactChanges {
  std::optional<Casting> casting = {};
  std::optional<FaceRule> rule = {};
  std::optional<double> reach_mm = {};
  std::optional<PressureLaw> law = {};
  /// One for both layers, or one of each: fixed, mobile.
  std::vector<double> youngs_modulus_mpa = {}, poisson_ratio = {}, thickness_mm = {};

  bool any_of_rays() const noexcept { return casting || rule || reach_mm; }
  bool any_of_layers() const noexcept {
    return !youngs_modulus_mpa.empty() || !poisson_ratio.empty() || !thickness_mm.empty();
  }
};

/// The entry with the changes. A body without a layer gets one where modulus, ratio and thickness are all given, and no part
/// of one otherwise; a thickness that is given takes the place of a measured one.
ContactEntry changed(ContactEntry entry, const ContactChanges& changes);

}  // namespace condyle
