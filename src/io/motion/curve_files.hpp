#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Curves along a motion, and the files they are written to. A file appears whole under its name or not at all; writing
/// raises FileError.

namespace condyle::io {

/// Numbers along a motion, one column each.
struct Curves {
  std::string axis = "time";  ///< what `at` is, and the name of the first column: "time" is in seconds
  std::vector<double> at;     ///< strictly increasing
  std::vector<std::string> names;
  std::vector<std::vector<double>>
      values;  ///< one vector per name, as long as `at`; NaN if there is no value
};

/// The curves over one cycle: `points` values at equal distances from start to end, both included, along "cycle_percent"
/// from 0 to 100. Between two frames linear in time; nothing if either of the two has no value, and at a frame that
/// frame's own value. Raises UsageError for a cycle that is empty or not within the curves, and for less than 2 points.
/// Cost: points * curves, and a binary search per point.
Curves cycle_of(const Curves& curves, double start_s, double end_s, std::size_t points = 101);

/// Unit of the angles among the columns of a file.
enum class AngleUnit { degrees, radians };

/// Writes OpenSim's .sto: title, header, a column `time` and one per curve, NaN as nan. Every number has the digits that
/// read back as the same double. Names must be without blanks and differ, the title is one line; curves are along time.
void write_sto(const std::filesystem::path& path, std::string_view title, const Curves& curves,
               AngleUnit unit);

/// Writes CSV: comments (whole lines, each begun with #), names, a row per point; an empty field for NaN.
void write_curves_csv(const std::filesystem::path& path, const Curves& curves,
                      std::string_view comments = {});

/// One file of a series for ParaView.
struct SeriesFile {
  double time_s = 0;
  std::string part;  ///< what it shows, "fixed" or "mobile": files of one time are shown together
  std::string file;  ///< from the folder of the collection
};

/// Writes a .pvd collection: which VTP file belongs to which time.
void write_pvd(const std::filesystem::path& path, std::span<const SeriesFile> files);

}  // namespace condyle::io
