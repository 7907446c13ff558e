#pragma once

#include <span>
#include <string>
#include <string_view>

#include "condyle/io/provenance.hpp"
#include "condyle/motion_map.hpp"

/// Results of `condyle rom --map`, as text. Every key, column, unit and sign is in docs/formats-rom.md.

namespace condyle::io {

/// The summary for people, a few lines: how the ends are spread over the reasons, and the free volume.
std::string map_text(const motion::MotionMap& map);

/// One line per grid point, row by row, with a header line: the held angles, both limits of the varied angle
/// as values of that angle, how they end, and the contact points. Numbers to the last bit. `ligaments` are the joint's.
std::string map_csv(const motion::MotionMap& map, std::span<const Ligament> ligaments = {},
                    const AnswerFrame& frame = {});

/// One line per free interval of every grid point, with a header line: the held angles, both ends as values of the
/// varied angle, whether it holds the start, how the ends came about, and the contact points.
std::string map_intervals_csv(const motion::MotionMap& map, std::span<const Ligament> ligaments = {},
                              const AnswerFrame& frame = {});

/// "flexion" or "extension", and so on: the clinical word for changing an angle in this sense.
std::string_view movement_name(JointAngle angle, RotationSense sense, Anatomy joint) noexcept;
/// The same of what a map varies or holds; of a translation "x" or "negative_x".
std::string movement_name(motion::MapCoordinate coordinate, RotationSense sense, Anatomy joint);

}  // namespace condyle::io
