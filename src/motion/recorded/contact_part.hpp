#pragma once

#include <optional>
#include <vector>

#include "condyle/first_contact.hpp"

namespace condyle::motion {

/// A part of the segment from one sample to the next on which contact is not excluded; all other parts are free. Ends and
/// proofs are fractions of the segment.
struct ContactPart {
  double entry = 0, exit = 0;  ///< entry <= exit
  /// The bodies are in contact somewhere from entry to `first` and somewhere from `last` to exit.
  struct Proven {
    double first, last;
  };
  std::optional<Proven> proven = {};
  double undecided = 0;  ///< how much of it is neither shown to be in contact nor free
  /// Empty if one body is inside the other and their surfaces do not meet, and where nothing is proven.
  std::optional<ContactWitness> at_entry = {}, at_exit = {};
};

/// Ascending and apart.
using ContactParts = std::vector<ContactPart>;

}  // namespace condyle::motion
