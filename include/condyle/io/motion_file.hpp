#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "condyle/io/file_digest.hpp"

namespace condyle {

/// A recorded motion as its file has it: a table of numbers with named columns, nothing converted.
struct MotionTable {
  std::filesystem::path path;        ///< as given, for messages
  std::vector<std::string> columns;  ///< one name each, no two the same; the column of times is among them
  std::size_t rows = 0;              ///< at least one
  /// One vector of `rows` numbers per column. NaN if the file has a gap (`nan`, an empty CSV cell), never inf.
  std::vector<std::vector<double>> values;
  std::vector<std::size_t> line_of_row;  ///< line of the file, from 1, for messages
  /// Value of `inDegrees=` in an OpenSim header, which applies to angles; empty if the header has none.
  std::optional<bool> in_degrees;
  std::vector<std::string> processing;  ///< where the file contradicts itself and was read nevertheless
  FileDigest digest;
};

/// Reads .mot and .sto (OpenSim) or .csv (comma; the first row has the names, lines with # are comments); the extension
/// decides, in upper or lower case. What is accepted: docs/motion-files.md. Line ends of any system, a byte order mark
/// and empty lines at the end are passed over; numbers are read the same in every locale.
/// Raises FileError, one line "file: line N: column 'x': what is wrong", where rows and names differ in number, a cell
/// has no number or an infinite one, two columns share a name, times do not increase, or a header or all rows are missing.
MotionTable read_motion_table(const std::filesystem::path& path);

/// When each row was.
struct FrameTimes {
  std::vector<double> values;  ///< strictly increasing
  bool in_seconds = true;      ///< else numbers of frames
};

/// The column `time` in seconds; without one the column `Frame`, or else frames counted from 0. Case does not count.
FrameTimes frame_times(const MotionTable& table);

}  // namespace condyle
