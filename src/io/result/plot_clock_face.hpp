#pragma once

#include <span>
#include <string>
#include <vector>

#include "condyle/first_contact.hpp"
#include "io/result/plot_axes.hpp"

namespace condyle::io {

/// Where a motion ends on the rim of the acetabulum.
struct ClockContact {
  std::string motion;
  double hour;  ///< in [0, 12): 12 (0) superior, 3 anterior on either side of the body
  ContactKind kind = ContactKind::unknown;
};

/// "1:30" of 1.5: hours and minutes of the clock face, 12 for the first hour.
std::string clock_text(double hour);

/// Contacts on the rim as a clock face, SVG text: 12 superior and on top, 3 anterior and to the right, for
/// right and left hips alike, so that sides compare.
std::string clock_face_plot(const PlotHeading& heading, std::span<const ClockContact> contacts);

/// Heights as near as possible (least squares) to those wanted, in the same order, at least `gap` apart and
/// within [low, high]; where there is no room for the gap, it is made smaller. `wanted` ascends.
std::vector<double> spread_apart(std::span<const double> wanted, double gap, double low, double high);

}  // namespace condyle::io
