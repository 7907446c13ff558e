#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

/// Limits written into models of OpenSim.

namespace condyle::io {

/// The force that acts on a coordinate past its limits.
enum class StopForce {
  limit,   ///< CoordinateLimitForce
  linear,  ///< CoordinateLinearStopForce, of OpenSim 4.6
};

/// A rotational coordinate by its name, and its ends in degrees.
struct CoordinateRange {
  std::string coordinate;
  double lower_deg, upper_deg;
};

/// Its ends in the file's unit, as an element `range` has them.
std::string range_text(const CoordinateRange& range);

/// Whether a force on a coordinate has the name of one that is written here.
bool is_own_force(std::string_view name, std::string_view coordinate);

/// The element of a force, of OpenSim's own stiffness, damping and transition; the linear one is as stiff.
std::string force_element(const CoordinateRange& range, StopForce stop);

/// The text of a model with these ranges of a joint's coordinates, clamped, a force for each, and a comment. Not another byte changes. A force
/// and a comment with provenance that were written so before are replaced. `joint` may be empty: not known. Throws FileError for what is
/// no model, and for a coordinate that is not there once.
std::string with_limits(std::string_view model, const std::filesystem::path& path, const std::string& joint,
                        std::span<const CoordinateRange> ranges, StopForce stop, std::string_view comment);

}  // namespace condyle::io
